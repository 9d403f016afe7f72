"""What is measured of growth: techniques of chapters along triangles, pixels, lights, samples and vertices."""
import subprocess
from dataclasses import dataclass

import build
from bench import many_lights
from bench.points import Point
from bench.runner import PointError
from files import write as put

NAME = "growth"
SCENES = "out/bench/scenes/"  # made when they are first needed

TRIANGLES = (1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6, 2e6)
SIDES = (128, 256, 512, 1024, 2048, 4096)
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
        ("00 rays", "00_ray_traced_truth", ("--samples", "1", "--light", "1"), {"quick": True}),
        ("03 one map", "03_polygon_offset", (), {"quick": True}),
        ("04 PCF", "04_pcf", (), {}),
        ("07 branching", "07_branching", (), {}),
        ("08 masks", "08_accumulation", (*AREA, "--samples", "32"), {}),
        ("09 rays", "09_ambient_occlusion", (*RAYS, "--samples", "1"), {}),
        ("10 maps", "10_accumulated_occlusion", ("--samples", "8", "--view", "ambient"), {}),
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


def provideScene(point):
    """Makes the scene of the point, unless it is there or one of assets/."""
    if not point.scene.startswith(SCENES):
        return
    file, program = build.ROOT / point.scene, build.folder("release") / "bin" / "make_assets"
    count = file.stem.split("_")[1]
    file.parent.mkdir(parents=True, exist_ok=True)
    if point.axis == "lights":
        put(file, many_lights.gltf(int(count)))
        return
    if file.is_file() and file.stat().st_mtime > program.stat().st_mtime:
        return
    ran = subprocess.run([program, "--knot", count, file], capture_output=True, text=True)
    if ran.returncode != 0:
        raise PointError(f"{point.scene}: {ran.stderr.strip() or 'make_assets failed'}")
