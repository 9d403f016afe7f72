"""Section `growth`: how time and memory grow with triangles, pixels, lights, samples and vertices, with which exponents."""
import plot
import tables
from bench import growth_points, whole
from bench.figures import Curve, Figure
from bench.growth_fit import ABOVE_LINEAR, fitted
from bench.growth_points import TITLES

NAME = growth_points.NAME
TECHNIQUES = list(dict.fromkeys(growth.technique for growth in growth_points.GROWTHS))
TECHNIQUES.insert(len(plot.COLOURS), "")  # nobody's: or `08 accumulated` would have the colour of `00 rays` beside it


def points(quick):
    return [point for growth in growth_points.GROWTHS for point in growth.points(quick)]


def measure(point):
    growth_points.provideScene(point)
    return whole.measure(point, point.most)


def curveOf(label, technique, pairs):
    """A technique looks alike in every figure."""
    return Curve(label, pairs, look=TECHNIQUES.index(technique))


def linear(curves):
    """What is linear, to compare slopes with: through the highest end, as far as the figure reaches."""
    points = [point for curve in curves for point in curve.points]
    x, y = max((curve.points[-1] for curve in curves), key=lambda point: point[1])
    start = max(min(p[0] for p in points), x * min(p[1] for p in points) / y)
    return Curve("linear", [(start, y * start / x), (x, y)], guide=True)


def timeFigure(axis, fits):
    curves = [curveOf(f.growth.technique, f.growth.technique, [(x, max(y, 1e-3)) for x, y in f.shown()]) for f in fits]
    ticks = () if axis == "pixels" else tuple(sorted({x for curve in curves for x, _ in curve.points}))
    return Figure(f"growth_{axis}", f"CPU time over {TITLES[axis]}", TITLES[axis], "ms of CPU", [*curves, linear(curves)],
                  inDocs=True, ticks=ticks)


def memoryFigure(fits):
    return Figure("growth_memory", "Memory over triangles and vertices", "triangles or vertices of the scene", "MB",
                  [curveOf(f"{f.growth.technique}, {f.growth.axis}", f.growth.technique, f.pairs(lambda r: r["memory_mb"]))
                   for f in fits])


HEADINGS = ["technique", "from … to", "ms a frame", "exponent", "s in all", "exponent", "MB", "exponent", "why"]
ALIGNMENT = ["---", "---", *["---:"] * 6, "---"]


def verdict(fits):
    steep = [f"{f.growth.technique} over {f.growth.axis}" for f in fits if f.steep()]
    return f"Worse than linear: {', '.join(steep)}; the table says why." if steep else "Nothing grows worse than linearly."


def page(results):
    fits, figures = fitted(results), []
    lines = [
        "## How the work grows", "",
        "CPU time of a frame at the end of each range, of the whole run (loading, hierarchies, bakes) and the largest memory "
        "of the process, each with the exponent of the power law through the upper half of the range, where what does not "
        f"grow no longer hides what does. An exponent above {ABOVE_LINEAR} is in bold.", "", verdict(fits), ""]
    for axis, title in TITLES.items():
        mine = [f for f in fits if f.growth.axis == axis]
        if mine:
            figures.append(timeFigure(axis, mine))
            lines += [f"### With the {title}", "", tables.markdown(HEADINGS, [f.row() for f in mine], ALIGNMENT), "",
                      figures[-1].markdown(), ""]
    if large := [f for f in fits if f.growth.axis in ("triangles", "vertices")]:
        figures.append(memoryFigure(large))
    return lines, figures
