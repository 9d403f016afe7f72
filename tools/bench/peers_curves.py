"""Errors as figures, and two curves compared where both have the same error."""
import math
from dataclasses import dataclass

from bench import curves


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


def curveOf(results, time):
    """`time`: which of a result's times, "cpu_ms" or "process_cpu_ms"."""
    ordered = sorted(results, key=lambda result: result["value"])
    return curves.Curve(ordered[0]["technique"] if ordered else "", [(r[time], r["error"]["rmse"], r) for r in ordered])


def atEqualError(ours, theirs):
    """AtEqualError of two curves, None where one is empty."""
    if not ours.points or not theirs.points:
        return None
    error = max(min(point[1] for point in curve.points) for curve in (ours, theirs))
    bound = next((name for name, curve in (("ours", ours), ("theirs", theirs))
                  if min(curve.points, key=lambda point: point[:2])[1] < error), "")
    return AtEqualError(error, curves.timeTo(ours, error)[0], curves.timeTo(theirs, error)[0], bound)
