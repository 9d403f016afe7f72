"""Log-log figures: what a section hands over, laid out once and drawn as SVG (bench.svg) and PNG (bench.raster)."""
from dataclasses import dataclass, field

import plot

WIDTH, HEIGHT = 860, 480
LEFT, RIGHT, TOP, BOTTOM = 76, 236, 40, 56
MARKS = ("circle", "square", "diamond", "triangle")
GREY, GUIDE, INK = "#dddddd", "#999999", "#333333"


@dataclass
class Curve:
    label: str
    points: list                 # [(x, y), ...], positive, joined in this order; y None: a vertical line at x
    front: list = field(default_factory=list)  # indices of points to mark: nothing is better in both
    dashed: bool = False         # for what is not ours, or stands at one time
    guide: bool = False          # not measured: a law to compare slopes with, grey and without marks
    look: int = -1               # which colour and mark, so that a technique looks alike in all figures; -1: by its place


@dataclass
class Figure:
    name: str                    # of its files: out/bench/NAME.svg and .png
    title: str
    x: str                       # what the axis shows, with its unit: "ms a frame"
    y: str
    curves: list
    inDocs: bool = False         # also docs/images/bench_NAME.svg, for docs/benchmark.md
    scene: str = ""              # what out/benchmark.html may be narrowed to
    quantity: str = ""
    ticks: tuple = ()            # of x; none: 1, 2 and 5 times powers of ten

    def markdown(self):
        """How docs/benchmark.md shows it."""
        return f"![{self.title}: {self.y} against {self.x}, both logarithmic](images/bench_{self.name}.svg)"


# What a figure is made of, in pixels of WIDTH x HEIGHT, to be drawn in this order.

@dataclass
class Line:
    points: list
    colour: str
    width: float
    dashed: bool = False


@dataclass
class Mark:
    x: float
    y: float
    shape: str
    colour: str
    filled: bool


@dataclass
class Text:
    x: float
    y: float                     # of the base line
    words: str
    anchor: str = "middle"       # "start", "end"
    colour: str = INK
    size: int = 13
    upright: bool = False        # read from below


def limits(values, least):
    """Of an axis: a little room around the values, and at least a factor `least` from end to end."""
    low, high = min(values) / 1.15, max(values) * 1.15
    widen = max(1.0, (least / (high / low)) ** 0.5)
    return low / widen, high * widen


def named(value):
    """Of a tick: 0.02, 500, 20 k, 1 M."""
    return f"{value / 1e6:g} M" if value >= 1e6 else f"{value / 1e3:g} k" if value >= 1e4 else f"{value:g}"


def labels(axis, values, apart):
    """Ticks that get a label: those too near to the last one labelled go without."""
    shown, last = set(), None
    decades = [v for v in values if f"{v:e}".startswith("1.0")]
    for value in [*decades, *values]:
        if all(abs(axis.at(value) - axis.at(other)) >= apart for other in shown):
            shown.add(value)
    return shown


def grid(figure, x, y, xLimits, yLimits):
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    parts, ticks = [], figure.ticks or plot.ticks(*xLimits)
    shown = labels(x, ticks, 44)
    for tick in ticks:
        parts.append(Line([(x.at(tick), TOP), (x.at(tick), bottom)], GREY, 1))
        if tick in shown:
            parts.append(Text(x.at(tick), bottom + 18, named(tick)))
    ticks = plot.ticks(*yLimits)
    shown = labels(y, ticks, 15)
    for tick in ticks:
        parts.append(Line([(LEFT, y.at(tick)), (right, y.at(tick))], GREY, 1))
        if tick in shown:
            parts.append(Text(LEFT - 8, y.at(tick) + 4, named(tick), "end"))
    return [*parts, Text((LEFT + right) / 2, HEIGHT - 14, figure.x), Text(16, (TOP + bottom) / 2, figure.y, upright=True),
            Text(LEFT, 22, figure.title, "start", size=15)]


def lookOf(curve, place):
    """(colour, mark): every colour with the first mark, then every colour with the next."""
    at = place if curve.look < 0 else curve.look
    return (GUIDE if curve.guide else plot.COLOURS[at % len(plot.COLOURS)]), MARKS[at // len(plot.COLOURS) % len(MARKS)]


def curveParts(curve, colour, shape, x, y):
    if curve.points[0][1] is None:
        at = x.at(curve.points[0][0])
        return [Line([(at, TOP), (at, HEIGHT - BOTTOM)], colour, 1.5, dashed=True)]
    places = [(x.at(a), y.at(b)) for a, b in curve.points]
    parts = [Line(places, colour, 2, curve.dashed or curve.guide)] if len(places) > 1 else []
    marks = [Mark(*place, shape, colour, i in curve.front) for i, place in enumerate(places)]
    return parts if curve.guide else parts + marks


def legend(entries, marked):
    """A line of words for each curve, beside a sample of it, in the order of the curves."""
    left, parts = WIDTH - RIGHT + 14, []
    for i, (curve, colour, shape) in enumerate(entries):
        y = TOP + 8 + 19 * i
        parts.append(Line([(left, y), (left + 24, y)], colour, 2, curve.dashed or curve.guide))
        if curve.points[0][1] is not None and not curve.guide:
            parts.append(Mark(left + 12, y, shape, colour, True))
        parts.append(Text(left + 32, y + 4, curve.label, "start"))
    y = TOP + 16 + 19 * len(entries)
    if marked:
        parts += [Mark(left + 12, y, "circle", "#666666", True), Text(left + 32, y + 4, "filled: the Pareto front,", "start"),
                  Text(left + 32, y + 20, "nothing quicker and as right", "start")]
    return parts


def layOut(figure):
    """Lines, marks and texts of a figure."""
    xs = [point[0] for curve in figure.curves for point in curve.points]
    ys = [point[1] for curve in figure.curves for point in curve.points if point[1] is not None] or [0.1, 1.0]
    xLimits, yLimits = limits(xs, 10.0), limits(ys, 10.0)
    x = plot.Axis(*xLimits, LEFT, WIDTH - RIGHT)
    y = plot.Axis(*yLimits, HEIGHT - BOTTOM, TOP)
    parts, entries = grid(figure, x, y, xLimits, yLimits), []
    for i, curve in enumerate(figure.curves):
        look = lookOf(curve, i)
        parts += curveParts(curve, *look, x, y)
        entries.append((curve, *look))
    return parts + legend(entries, any(curve.front for curve in figure.curves))
