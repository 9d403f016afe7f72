"""A figure as PNG, twice the size of the SVG: lines, marks and letters drawn with nothing but the standard library."""
import math
from functools import lru_cache

import png
from bench import figures, font
from bench.svg import corners

SCALE = 2


class Canvas:
    """White at first; everything is blended over it by how much of a pixel it covers."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.pixels = bytearray(b"\xff" * (3 * width * height))

    def blend(self, x, y, colour, cover):
        if cover <= 0.0 or not (0 <= x < self.width and 0 <= y < self.height):
            return
        at, cover = 3 * (y * self.width + x), min(1.0, cover)
        for c in range(3):
            self.pixels[at + c] = round(self.pixels[at + c] * (1.0 - cover) + colour[c] * cover)

    def segment(self, a, b, colour, width):
        """With round ends, so that the corners of a polyline are closed."""
        (x0, y0), (x1, y1), reach = a, b, 0.5 * width + 1.0
        dx, dy = x1 - x0, y1 - y0
        length = dx * dx + dy * dy
        steep = abs(dy) > abs(dx)
        low, high = (min(y0, y1), max(y0, y1)) if steep else (min(x0, x1), max(x0, x1))
        slope = (dx / dy if steep else dy / dx) if length > 0 else 0.0
        across = reach * math.sqrt(1.0 + slope * slope)
        for u in range(math.floor(low - reach), math.ceil(high + reach) + 1):
            middle = (x0 + (min(max(u + 0.5, low), high) - y0) * slope) if steep else (
                y0 + (min(max(u + 0.5, low), high) - x0) * slope)
            for v in range(math.floor(middle - across), math.ceil(middle + across) + 1):
                x, y = (v, u) if steep else (u, v)
                px, py = x + 0.5 - x0, y + 0.5 - y0
                t = min(1.0, max(0.0, (px * dx + py * dy) / length)) if length > 0 else 0.0
                self.blend(x, y, colour, 0.5 * width + 0.5 - math.hypot(px - t * dx, py - t * dy))

    def bar(self, a, b, colour, width):
        """A line along an axis: whole pixels, and quick, since a grid has many."""
        left, right = (round(v) for v in (min(a[0], b[0]), max(a[0], b[0])))
        top, bottom = (round(v) for v in (min(a[1], b[1]), max(a[1], b[1])))
        if left == right:
            left, right = left - width // 2, left - width // 2 + width
        else:
            top, bottom = top - width // 2, top - width // 2 + width
        left, right = max(0, left), min(self.width, right)
        for y in range(max(0, top), min(self.height, bottom)):
            at = 3 * (y * self.width + left)
            self.pixels[at:at + 3 * (right - left)] = bytes(colour) * (right - left)

    def fill(self, outline, colour):
        """A convex polygon, pixels whole or not at all: its outline is drawn over the steps."""
        sides = list(zip(outline, outline[1:] + outline[:1]))
        xs, ys = [math.floor(x) for x, _ in outline], [math.floor(y) for _, y in outline]
        for y in range(min(ys), max(ys) + 1):
            for x in range(min(xs), max(xs) + 1):
                turns = [(bx - ax) * (y + 0.5 - ay) - (by - ay) * (x + 0.5 - ax) for (ax, ay), (bx, by) in sides]
                if min(turns) >= 0.0 or max(turns) <= 0.0:
                    self.blend(x, y, colour, 1.0)


def rgb(colour):
    return tuple(int(colour[i:i + 2], 16) for i in (1, 3, 5))


def dashes(points, on=12.0, off=8.0):
    """The pieces of a polyline that are drawn when it is dashed."""
    pieces = []
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        length, at = math.hypot(x1 - x0, y1 - y0), 0.0
        while at < length:
            end = min(length, at + on)
            pieces.append(tuple((x0 + (x1 - x0) * t / length, y0 + (y1 - y0) * t / length) for t in (at, end)))
            at = end + off
    return pieces


def drawLine(canvas, line):
    points, colour, width = [(SCALE * x, SCALE * y) for x, y in line.points], rgb(line.colour), SCALE * line.width
    for a, b in dashes(points) if line.dashed else zip(points, points[1:]):
        if a[0] == b[0] or a[1] == b[1]:
            canvas.bar(a, b, colour, round(width))
        else:
            canvas.segment(a, b, colour, width)


def drawMark(canvas, mark):
    outline = [(SCALE * x, SCALE * y) for x, y in corners(mark)]
    canvas.fill(outline, rgb(mark.colour) if mark.filled else (255, 255, 255))
    for a, b in zip(outline, outline[1:] + outline[:1]):
        canvas.segment(a, b, rgb(mark.colour), SCALE * 1.5)


@lru_cache(maxsize=None)
def letter(which):
    return font.doubled(font.dots(which))


def drawText(canvas, text):
    """In letters of 14 dots; larger texts are the same, twice as thick."""
    words, colour = text.words.replace("−", "-").replace("×", "x").replace("–", "-"), rgb(text.colour)
    width = SCALE * font.ADVANCE * len(words)
    start = {"start": 0, "middle": -width // 2, "end": -width}[text.anchor]
    bold = 1 if text.size > 13 else 0
    for i, character in enumerate(words):
        for row, line in enumerate(letter(character)):
            for column, set_ in enumerate(line):
                for thick in range(bold + 1) if set_ else ():
                    along, below = start + SCALE * font.ADVANCE * i + column + thick, row - SCALE * (font.HIGH - 1)
                    x, y = (below, -along) if text.upright else (along, below)
                    canvas.blend(round(SCALE * text.x) + x, round(SCALE * text.y) + y, colour, 1.0)


DRAW = {figures.Line: drawLine, figures.Mark: drawMark, figures.Text: drawText}


def render(figure, path):
    canvas = Canvas(SCALE * figures.WIDTH, SCALE * figures.HEIGHT)
    for part in figures.layOut(figure):
        DRAW[type(part)](canvas, part)
    png.write(path, canvas.width, canvas.height, 3, bytes(canvas.pixels), quick=True)
