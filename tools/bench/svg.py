"""A figure as SVG: the same figure gives the same bytes."""
import html
import math

import plot
from bench import figures

DASHES = ' stroke-dasharray="6 4"'


def corners(mark):
    """Of the mark's outline, in the figure's pixels; a circle is a polygon of many."""
    if mark.shape == "circle":
        shape = [(4 * math.cos(a * math.tau / 24), 4 * math.sin(a * math.tau / 24)) for a in range(24)]
    else:
        shape = {"square": [(-4, -4), (4, -4), (4, 4), (-4, 4)], "diamond": [(0, -5), (5, 0), (0, 5), (-5, 0)],
                 "triangle": [(0, -5), (5, 4), (-5, 4)]}[mark.shape]
    return [(mark.x + x, mark.y + y) for x, y in shape]


def drawMark(mark):
    fill = mark.colour if mark.filled else "#ffffff"
    style = f'fill="{fill}" stroke="{mark.colour}" stroke-width="1.5"'
    if mark.shape == "circle":
        return f'<circle cx="{mark.x:.1f}" cy="{mark.y:.1f}" r="4" {style}/>'
    return f'<polygon points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in corners(mark))}" {style}/>'


def drawText(text):
    size = f' font-size="{text.size}"' if text.size != 13 else ""
    turn = f' transform="rotate(-90 {text.x:.1f} {text.y:.1f})"' if text.upright else ""
    return (f'<text x="{text.x:.1f}" y="{text.y:.1f}" text-anchor="{text.anchor}" fill="{text.colour}"{size}{turn}>'
            f"{html.escape(text.words, quote=False)}</text>")


def drawLine(line):
    drawn = plot.line(line.points, line.colour, line.width)
    return drawn.replace("/>", DASHES + "/>") if line.dashed else drawn


DRAW = {figures.Line: drawLine, figures.Mark: drawMark, figures.Text: drawText}


def render(figure):
    title = html.escape(f"{figure.title}: {figure.y} against {figure.x}", quote=False)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {figures.WIDTH} {figures.HEIGHT}" '
             f'font-family="sans-serif" font-size="13">', f"<title>{title}</title>",
             f'<rect width="{figures.WIDTH}" height="{figures.HEIGHT}" fill="#fff"/>']
    return "\n".join([*parts, *(DRAW[type(part)](part) for part in figures.layOut(figure)), "</svg>", ""])
