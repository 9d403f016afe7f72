"""From results of section `error` to curves that may be compared: one quantity, one scene, one unit."""
import math

from bench import curves, techniques

LUCK = 1.05  # so much more error may a finer setting have, and count as having kept it
NOISE = 1.5  # an error that is less than so many times the exact answer's own says nothing


def milliseconds(result):
    """A frame with all that it needs: what is baked once is paid by the first frame of a scene that moves."""
    return result["wall_ms"] + result.get("once_ms", 0.0)


def errorFigures(result, quantity):
    """The error that counts for a quantity, or None; of a filtered shadow also the one against the area light."""
    if quantity == "area" and result.get("area_light"):
        return result["area_light"]
    return result["error"] if result["quantity"] == quantity else None


def errorOf(figures, unit):
    """Root mean square error without the share of the exact answer's own noise, which is independent of it."""
    noise = figures.get("standard_error", 0.0)
    return math.sqrt(max(figures["rmse"] ** 2 - noise ** 2, (0.1 * noise) ** 2)) / unit


def curvesOf(results, scene, quantity):
    """One for each technique that estimates the quantity in the scene, in the order of the results."""
    unit, found = techniques.quantity(quantity).unit, {}
    for result in results:
        figures = errorFigures(result, quantity) if result["scene"] == scene else None
        if figures:
            curve = found.setdefault(result["technique"], curves.Curve(result["technique"]))
            curve.points.append((milliseconds(result), errorOf(figures, unit), result))
    return list(found.values())


def limitOf(every, quantity):
    """Below this error the exact answer's own noise is too large to tell techniques apart."""
    figures = [errorFigures(result, quantity) for curve in every for _, _, result in curve.points]
    return NOISE * max((f.get("standard_error", 0.0) for f in figures), default=0.0) / techniques.quantity(quantity).unit


def lasting(curve, level):
    """The curve without settings that are below an error by luck: a finer one has more again."""
    first = len(curve.points)
    while first > 0 and curve.points[first - 1][1] <= LUCK * level:
        first -= 1
    return curves.Curve(curve.technique, [p for i, p in enumerate(curve.points) if i >= first or p[1] > level])


def reaching(every, level):
    """[(ms, technique, result), ...] of all that reach an error and keep it, the quickest first."""
    found = [(*reached, curve.technique) for curve in every if (reached := curves.timeTo(lasting(curve, level), level))]
    return sorted(((ms, technique, result) for ms, result, technique in found), key=lambda entry: entry[:2])


def best(every):
    """(error, ms, technique, result) of the least error of all."""
    return min(((error, ms, curve.technique, result) for curve in every for ms, error, result in curve.points),
               key=lambda entry: entry[:3])


def together(every, label):
    """One curve of the best settings of several, for a figure in which they would hide one another."""
    front = curves.front(every)
    points = [point for curve in every for i, point in enumerate(curve.points) if (curve.technique, i) in front]
    return curves.Curve(label, sorted(points, key=lambda point: point[:2]))
