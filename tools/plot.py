"""Plots of tables in pages: one line for each column over the row labels or a column, both axes logarithmic, as SVG.

The same cells give the same bytes, so that a page and its plot can be compared without running anything.
"""
import math

WIDTH, HEIGHT = 720, 440
LEFT, RIGHT, TOP, BOTTOM = 70, 150, 20, 55
COLOURS = ("#4477aa", "#ee6677", "#228833", "#aa7700", "#66a0cc", "#aa3377", "#666666")  # Paul Tol's, told apart by most eyes


class PlotError(Exception):
    pass


def numbers(cells, what):
    try:
        values = [float(cell) for cell in cells]
    except ValueError:
        raise PlotError(f"{what} must be numbers, not {', '.join(cells)}") from None
    if min(values) <= 0:
        raise PlotError(f"{what} must be positive: both axes are logarithmic")
    return values


class Axis:
    """From values to pixels."""

    def __init__(self, low, high, start, end):
        self.low, self.scale, self.start = math.log10(low), (end - start) / (math.log10(high) - math.log10(low)), start

    def at(self, value):
        return self.start + (math.log10(value) - self.low) * self.scale


def ticks(low, high):
    """1, 2 and 5 times powers of ten."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [m * 10.0 ** d for d in decades for m in (1, 2, 5) if low <= m * 10.0 ** d <= high]


def spread(places, distance):
    """Labels' heights, moved apart where they would overlap; in the order of `places`."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    moved = list(places)
    for before, after in zip(order, order[1:]):
        moved[after] = max(moved[after], moved[before] + distance)
    overflow = max(0.0, moved[order[-1]] - (HEIGHT - BOTTOM))
    return [place - overflow for place in moved]


def text(x, y, what, anchor="middle", colour="#333"):
    escaped = what.replace("&", "&amp;").replace("<", "&lt;")
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{escaped}</text>'


def line(points, colour, width):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}"/>'


def across(headings, rows, heading):
    """Headings and rows with column `heading` in place of the labels, in its order. Throws PlotError."""
    at = headings.index(heading)
    order = [at] + [i for i in range(1, len(headings)) if i != at]
    values = numbers([row[at] for row in rows], f"column {heading}")
    ordered = sorted(range(len(rows)), key=lambda i: values[i])
    return [headings[i] for i in order], [[rows[r][i] for i in order] for r in ordered]


def logLog(headings, rows, title):
    """`headings`: of the label column, then of each line; `rows`: their cells. Throws PlotError."""
    if len(rows) < 2 or len(headings) < 2:
        raise PlotError("a plot needs two rows and a column beside the labels")
    xs = numbers([row[0] for row in rows], f"the labels ({headings[0]})")
    if min(xs) == max(xs):
        raise PlotError(f"a plot needs two different values of {headings[0]}")
    lines = [numbers([row[i] for row in rows], f"column {headings[i]}") for i in range(1, len(headings))]
    low, high = min(map(min, lines)) / 1.2, max(map(max, lines)) * 1.2
    x, y = Axis(min(xs), max(xs), LEFT, WIDTH - RIGHT), Axis(low, high, HEIGHT - BOTTOM, TOP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
             f'font-size="13">', f"<title>{title.replace('&', '&amp;').replace('<', '&lt;')}</title>",
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>']
    for tick in ticks(low, high):
        parts += [line([(LEFT, y.at(tick)), (WIDTH - RIGHT, y.at(tick))], "#ddd", 1),
                  text(LEFT - 8, y.at(tick) + 4, f"{tick:g}", "end")]
    for value in xs:
        parts += [line([(x.at(value), TOP), (x.at(value), HEIGHT - BOTTOM)], "#ddd", 1),
                  text(x.at(value), HEIGHT - BOTTOM + 18, f"{value:g}")]
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, headings[0]))
    heights = spread([y.at(values[-1]) + 4 for values in lines], 15)
    for i, values in enumerate(lines):
        colour = COLOURS[i % len(COLOURS)]
        parts += [line([(x.at(a), y.at(b)) for a, b in zip(xs, values)], colour, 2),
                  text(WIDTH - RIGHT + 8, heights[i], headings[i + 1], "start", colour)]
    return "\n".join([*parts, "</svg>", ""])
