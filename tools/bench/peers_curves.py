"""Errors as figures, and two curves of time against error compared where both have the same error."""
import math
from dataclasses import dataclass


@dataclass(frozen=True)
class AtEqualError:
    error: float     # the least that both reach
    ours: float      # time for it
    theirs: float
    bound: str = ""  # "ours" or "theirs": that one has less error already with the cheapest setting measured

    @property
    def ratio(self):
        """How many times as long the other one takes; below 1: it is faster."""
        return self.theirs / self.ours


def figures(errors):
    """Of a list of differences, by the names of the chapters' reports."""
    count = len(errors)
    return {"pixels": count, "rmse": math.sqrt(sum(e * e for e in errors) / count), "bias": sum(errors) / count,
            "mean_abs": sum(map(abs, errors)) / count, "max_abs": max(map(abs, errors))}


def front(curve):
    """Of (time, error) pairs those that nothing else beats in both, cheapest first."""
    best, kept = math.inf, []
    for time, error in sorted(curve):
        if error < best:
            best = error
            kept.append((time, error))
    return kept


def timeAt(curve, error):
    """Straight lines between neighbours of the front, in logarithms; None where the curve does not come down to `error`."""
    points = front(curve)
    if not points or points[-1][1] > error:
        return None
    if points[0][1] <= error:
        return points[0][0]
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= error:
            along = math.log(e0 / error) / math.log(e0 / e1) if e1 > 0 else 1.0
            return t0 * (t1 / t0) ** along
    return None


def atEqualError(ours, theirs):
    """AtEqualError of two lists of (time, error), None where one is empty."""
    if not ours or not theirs:
        return None
    error = max(front(ours)[-1][1], front(theirs)[-1][1])
    bound = next((name for name, curve in (("ours", ours), ("theirs", theirs)) if front(curve)[0][1] < error), "")
    return AtEqualError(error, timeAt(ours, error), timeAt(theirs, error), bound)
