"""Log-log figures: what a section hands over, to be drawn as SVG and PNG."""
from dataclasses import dataclass, field


@dataclass
class Curve:
    label: str
    points: list                 # [(x, y), ...], positive; joined in this order
    front: list = field(default_factory=list)  # indices of points to mark: nothing is better in both
    dashed: bool = False         # for a model or a limit


@dataclass
class Figure:
    name: str                    # of its files: out/bench/NAME.svg and .png
    title: str
    x: str                       # what the axis shows, with its unit: "ms a frame"
    y: str
    curves: list
    inDocs: bool = False         # also docs/images/bench_NAME.svg, for docs/benchmark.md
