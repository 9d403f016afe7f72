"""How time and memory grow: with triangles, pixels, lights, samples and vertices, and with which exponent."""
import math
import subprocess
from dataclasses import dataclass

import build
import tables
from bench import growth_reasons, many_lights, whole
from bench.figures import Curve, Figure
from bench.points import Point
from bench.runner import PointError

NAME = "growth"
SCENES = "out/bench/scenes/"  # made when they are first needed
ABOVE_LINEAR = 1.1
LEAST_MS = 0.5  # a time below it is the clock's, and no exponent is fitted through it

TRIANGLES = (1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6, 2e6)
SIDES = (128, 256, 512, 1024, 2048, 4096)
SMALLER_SIDES = SIDES[:-1]  # where 4096 squared takes minutes, or gigabytes
LIGHTS = (1, 2, 4, 8, 16)
SAMPLES = (4, 8, 16, 32, 64, 128)
QUICK = {"triangles": (1e3, 1e4, 1e5), "pixels": (128, 256, 512), "lights": (1, 4), "samples": (4, 16, 64),
         "vertices": (1e3, 1e4)}


@dataclass(frozen=True)
class Growth:
    """A chapter's technique along one axis."""
    axis: str
    technique: str
    chapter: str
    flags: tuple
    values: tuple
    baked: bool = False   # no frame is timed that does the work: the whole run is
    quick: bool = False
    flag: str = ""        # of the axis samples: the flag that takes the value
    scene: str = "knot"   # of the axes pixels and samples
    runs: int = 1         # the first frame of chapter 00 also builds the hierarchy: of two, the faster one counts

    def point(self, value):
        scene, flags = self.scene, self.flags
        if self.axis in ("triangles", "vertices"):
            scene = f"{SCENES}knot_{value:.0f}.glb"
        elif self.axis == "lights":
            scene = f"{SCENES}lights_{value:.0f}.gltf"
        elif self.axis == "pixels":
            flags = (*flags, "--size", f"{value:.0f}x{value:.0f}")
        else:
            flags = (*flags, self.flag, f"{value:.0f}")
        # A knot has half as many vertices as triangles; a square picture the square of its side in pixels.
        amount = value ** 2 if self.axis == "pixels" else value / 2 if self.axis == "vertices" else value
        return Point(NAME, scene, self.technique, self.chapter, self.axis, amount, flags, self.axis, compare=False,
                     most=self.runs)

    def points(self, quick):
        if not quick:
            return [self.point(value) for value in self.values]
        return [self.point(value) for value in QUICK[self.axis] if value in self.values] if self.quick else []


AREA = ("--light", "1", "--others", "unshadowed", "--view", "irradiance")
LAMPS = ("--light", "-1", "--texels-per-metre", "40", "--view", "irradiance")
RAYS = ("--method", "rays", "--view", "ambient")
BAKE = ("--method", "vertices", "--view", "ambient")
SMALL = ("--size", "256x256")


def alike(axis, values, entries):
    return [Growth(axis, technique, chapter, flags, **{"values": values, **more})
            for technique, chapter, flags, more in entries]


GROWTHS = (
    *alike("triangles", TRIANGLES, [
        ("00 rays", "00_ray_traced_truth", ("--samples", "4", *SMALL), {"quick": True, "runs": 2}),
        ("03 one map", "03_polygon_offset", (), {"quick": True}),
        ("04 PCF", "04_pcf", (), {}),
        ("07 branching", "07_branching", (), {}),
        ("08 masks", "08_accumulation", (*AREA, "--samples", "8"), {"quick": True}),
        ("09 rays", "09_ambient_occlusion", (*RAYS, "--samples", "4", *SMALL), {}),
        ("10 maps", "10_accumulated_occlusion", ("--samples", "8", "--view", "ambient"), {}),
    ]),
    *alike("pixels", SIDES, [
        ("00 rays", "00_ray_traced_truth", ("--samples", "1", "--light", "1"), {"quick": True, "values": SMALLER_SIDES}),
        ("03 one map", "03_polygon_offset", (), {"quick": True}),
        ("04 PCF", "04_pcf", (), {}),
        ("07 branching", "07_branching", (), {}),
        ("08 masks", "08_accumulation", (*AREA, "--samples", "32"), {}),
        ("09 rays", "09_ambient_occlusion", (*RAYS, "--samples", "1"), {"values": SMALLER_SIDES}),
        ("10 maps", "10_accumulated_occlusion", ("--samples", "8", "--view", "ambient"), {"values": SMALLER_SIDES}),
    ]),
    *alike("lights", LIGHTS, [
        ("00 rays", "00_ray_traced_truth", ("--samples", "16", *SMALL), {"quick": True}),
        ("08 masks", "08_accumulation", LAMPS, {"quick": True}),
        ("08 accumulated", "08_accumulation", (*LAMPS, "--method", "accumulate"), {}),
    ]),
    *alike("samples", SAMPLES, [
        ("00 rays", "00_ray_traced_truth", ("--light", "1", "--adaptive", "off", *SMALL),
         {"quick": True, "flag": "--samples"}),
        ("07 branching", "07_branching", (), {"quick": True, "flag": "--samples", "values": SAMPLES[1:]}),
        ("08 masks", "08_accumulation", AREA, {"quick": True, "flag": "--samples"}),
        ("08 accumulated", "08_accumulation", (*AREA, "--method", "accumulate"), {"flag": "--samples"}),
        ("09 rays", "09_ambient_occlusion", (*RAYS, *SMALL), {"flag": "--samples"}),
        ("10 maps", "10_accumulated_occlusion", ("--view", "ambient"), {"flag": "--samples"}),
        ("09 bake", "09_ambient_occlusion", BAKE, {"baked": True, "flag": "--samples"}),
    ]),
    *alike("vertices", TRIANGLES, [
        ("09 bake", "09_ambient_occlusion", (*BAKE, "--samples", "16"), {"baked": True, "quick": True}),
        ("09 bake of bits", "09_ambient_occlusion", ("--method", "bits", "--samples", "64", "--view", "irradiance"),
         {"baked": True}),
        ("10 maps, at vertices", "10_accumulated_occlusion",
         ("--method", "vertices", "--samples", "8", "--view", "ambient"), {}),
    ]),
)
TITLES = {"triangles": "triangles of the scene", "pixels": "pixels of the picture", "lights": "area lights",
          "samples": "samples", "vertices": "vertices of the scene"}


def points(quick):
    return [point for growth in GROWTHS for point in growth.points(quick)]


def provideScene(point):
    """Makes the scene of the point, unless it is there or one of assets/."""
    if not point.scene.startswith(SCENES):
        return
    file, program = build.ROOT / point.scene, build.folder("release") / "bin" / "make_assets"
    count = file.stem.split("_")[1]
    file.parent.mkdir(parents=True, exist_ok=True)
    if point.axis == "lights":
        file.write_text(many_lights.gltf(int(count)))
        return
    if file.is_file() and file.stat().st_mtime > program.stat().st_mtime:
        return
    ran = subprocess.run([program, "--knot", count, file], capture_output=True, text=True)
    if ran.returncode != 0:
        raise PointError(f"{point.scene}: {ran.stderr.strip() or 'make_assets failed'}")


def measure(point):
    provideScene(point)
    return whole.measure(point, point.most)


def exponent(pairs):
    """Of the power law through the upper half of the range, by least squares of logarithms; None: nothing to fit."""
    upper = sorted(pairs)[len(pairs) // 2:] if len(pairs) > 3 else sorted(pairs)[-2:]
    logs = [(math.log(x), math.log(y)) for x, y in upper if x > 0 and y > 0]
    if len(logs) < 2:
        return None
    meanX, meanY = (sum(values) / len(logs) for values in zip(*logs))
    spread = sum((x - meanX) ** 2 for x, _ in logs)
    return sum((x - meanX) * (y - meanY) for x, y in logs) / spread if spread else None


def shownExponent(value):
    if value is None:
        return ""
    return f"**{value:.2f}**" if value > ABOVE_LINEAR else f"{value:.2f}"


def amount(value):
    return f"{value / 1e6:.3g} M" if value >= 1e6 else f"{value / 1e3:.3g} k" if value >= 1e3 else f"{value:.0f}"


@dataclass
class Fitted:
    """One technique along one axis, measured."""
    growth: Growth
    results: list  # by value

    def pairs(self, key):
        return [(r["value"], key(r)) for r in self.results]

    def frame(self):
        """Of the frame; nothing for a bake, whose work is in none."""
        return [] if self.growth.baked else self.pairs(lambda r: r["cpu_min_ms"])

    def whole(self):
        return self.pairs(lambda r: r["total_cpu_ms"])

    def shown(self):
        """What the figure shows."""
        return self.frame() or self.whole()

    def exponents(self):
        """Of frame, whole run and memory; None where too little was measured."""
        above = lambda pairs: [(x, y) for x, y in pairs if y >= LEAST_MS]  # noqa: E731
        return exponent(above(self.frame())), exponent(above(self.whole())), exponent(self.pairs(lambda r: r["memory_mb"]))

    def steep(self):
        return any(value and value > ABOVE_LINEAR for value in self.exponents())

    def row(self):
        frame, whole_, memory = map(shownExponent, self.exponents())
        first, last = self.results[0], self.results[-1]
        return [self.growth.technique, f"{amount(first['value'])} … {amount(last['value'])}",
                "" if self.growth.baked else f"{last['cpu_min_ms']:.1f}", frame, f"{1e-3 * last['total_cpu_ms']:.1f}",
                whole_, f"{last['memory_mb']:.0f}", memory, self.why()]

    def why(self):
        reasons = growth_reasons.REASONS
        return reasons.get((self.growth.axis, self.growth.technique), reasons[self.growth.axis])


def fitted(results):
    found = []
    for growth in GROWTHS:
        mine = sorted((r for r in results if (r["axis"], r["technique"]) == (growth.axis, growth.technique)),
                      key=lambda r: r["value"])
        if len(mine) >= 2:
            found.append(Fitted(growth, mine))
    return found


def timeFigure(axis, fits):
    """A dashed line through the first curve's end is what is linear."""
    curves = [Curve(f.growth.technique, [(x, max(y, 1e-3)) for x, y in f.shown()]) for f in fits]
    x, y = curves[0].points[-1]
    first = curves[0].points[len(curves[0].points) // 2][0]
    return Figure(f"growth_{axis}", f"CPU time over {TITLES[axis]}", TITLES[axis], "ms of CPU",
                  [*curves, Curve("linear", [(first, y * first / x), (x, y)], dashed=True)], inDocs=True)


def memoryFigure(fits):
    return Figure("growth_memory", "Memory over triangles and vertices", "triangles or vertices of the scene", "MB",
                  [Curve(f"{f.growth.technique}, {f.growth.axis}", f.pairs(lambda r: r["memory_mb"])) for f in fits])


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
