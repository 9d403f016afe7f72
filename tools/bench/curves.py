"""Curves of error against time: what is on the front, how steep they are, and when they reach an error."""
import math
from dataclasses import dataclass, field

LEAST_SPAN = 1.5  # times that lie nearer together than this factor have no slope but that of noise
EXACT = 3e-5  # an error below is the rounding of float pictures: such a point is exact, and stands on no logarithmic axis


@dataclass
class Curve:
    technique: str
    points: list = field(default_factory=list)  # (ms, error, result), in order of the axis' value

    def exact(self):
        """The quickest point without error, or None."""
        found = [point for point in self.points if point[1] < EXACT]
        return min(found, key=lambda point: point[0]) if found else None

    def drawn(self):
        return [point for point in self.points if point[1] >= EXACT]


def slope(points):
    """Of the straight line through (log x, log y) that fits best; None for fewer than three, or hardly any range of x."""
    if len(points) < 3 or max(p[0] for p in points) < LEAST_SPAN * min(p[0] for p in points):
        return None
    xs, ys = [math.log(p[0]) for p in points], [math.log(p[1]) for p in points]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    width = sum((a - x) ** 2 for a in xs)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys)) / width


def shownSlope(value):
    """"–" for None; a slope that is rounded to nothing has no sign."""
    return "–" if value is None else f"{round(value, 2) + 0.0:+.2f}".replace("+0.00", "0.00")


def front(curves):
    """{(technique, index)} of points of which no other is as quick and as right, or better in one of both."""
    every = [(ms, error, curve.technique, i) for curve in curves for i, (ms, error, _) in enumerate(curve.points)]
    best, least = set(), math.inf
    for _, error, technique, i in sorted(every, key=lambda p: (p[0], p[1])):
        if error < least:
            best.add((technique, i))
            least = error
    return best


def timeTo(curve, level):
    """(ms, result) at which a curve reaches an error: between two settings interpolated on logarithmic axes; None: never.

    A setting that is quicker and better than another makes that one pointless, so the curve is its own front first.
    """
    steps = []
    for ms, error, result in sorted(curve.points, key=lambda p: (p[0], p[1])):
        if not steps or error < steps[-1][1]:
            steps.append((ms, error, result))
    before = None
    for ms, error, result in steps:
        if error <= level:
            if before is None or error < EXACT:
                return ms, result
            share = math.log(before[1] / level) / math.log(before[1] / error)
            return math.exp(math.log(before[0]) + share * math.log(ms / before[0])), result
        before = (ms, error)
    return None
