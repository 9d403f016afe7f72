"""Every skip of the course, on and off: what it saves, and that the picture stays the same to the bit."""
import json
import subprocess
import tempfile
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import build
import tables
from bench import exr, whole
from bench.points import Point
from bench.runner import PointError

NAME = "skips"
ALL_ON = "all on"


@dataclass(frozen=True)
class Off:
    """One thing switched off: a skip by its name, or a parameter that leaves work out too."""
    name: str
    flags: tuple
    counter: str = ""    # of a parameter, or of a skip where its own does not count: rays of a bake
    help: str = ""
    exact: bool = True   # claims the same picture, to the bit
    quick: bool = False  # measured by --quick too


@dataclass(frozen=True)
class Case:
    label: str
    chapter: str
    scene: str
    flags: tuple
    off: tuple
    whole: bool = False  # the time of the whole run, since the work is a bake
    runs: int = 5

    def point(self, technique, flags, on):
        return Point(NAME, self.scene, technique, self.chapter, "on", float(on), self.flags + flags, self.label,
                     compare=False)

    def points(self, quick):
        off = [o for o in self.off if o.quick or not quick]
        return [self.point(ALL_ON, (), True), *(self.point(o.name, o.flags, False) for o in off)] if off else []


def skip(name, counter="", quick=False):
    return Off(name, ("--no-skip", name), counter, quick=quick)


def everything(counter, *more):
    flags = ("--skip-none", *more)
    return Off(" ".join(flags), flags, counter, "nothing is left out")


MAPS = ("--fit", "view", "--map-size", "1024")
NEAR = ("--light", "1", "--camera", "1", "--map-size", "256", "--size", "128x128")  # few pixels: the triangles' time shows
MASKS = ("--others", "unshadowed", "--view", "irradiance")
NOT_SHARED = Off("--share off", ("--share", "off"), "rays_baked", "neighbours use one another's rays: other values, as accurate",
                 exact=False)
CASES = (
    Case("a light's rays", "00_ray_traced_truth", "courtyard", ("--samples", "64", "--size", "256x256"), (
        skip("rays-facing-away"),
        Off("--adaptive off", ("--adaptive", "off"), "shadow_rays", "16 rays that agree stand for the rest: a guess, nearly "
            "always right", exact=False)), runs=1),
    Case("a lantern, and half of the scene in sight", "03_polygon_offset", "courtyard", NEAR, (
        skip("clusters-off-map"), skip("clusters-unseen", quick=True), everything("triangles_shaded")), runs=15),
    Case("nothing moves", "03_polygon_offset", "courtyard", (*MAPS, "--still"), (skip("kept-maps"),)),
    Case("a wide filter", "07_branching", "courtyard", (*MAPS, "--samples", "64"), (
        Off("--classify none", ("--classify", "none"), "visibility_tests", "all taps only where the minima and maxima of "
            "the map leave open whether all of them agree"),
        everything("visibility_tests", "--classify", "none"))),
    Case("a wide filter, nothing moves", "07_branching", "courtyard", (*MAPS, "--still"), (skip("kept-min-max"),)),
    Case("an area light on planes", "08_accumulation", "room", (*MASKS, "--light", "1"), (
        skip("receivers-unseen"), skip("receivers-unreached"), skip("clusters-not-between"), skip("texels-unreached"),
        skip("texels-agreeing"), everything("occluders_drawn")), runs=3),
    Case("on planes, exactly", "08_accumulation", "contact_panel",
         (*MASKS, "--method", "exact", "--texels-per-metre", "16"), (skip("triangles-off-block"),), runs=1),
    Case("on planes, nothing moves", "08_accumulation", "knot", (*MASKS, "--light", "1", "--still"), (
        skip("kept-shadows", quick=True), skip("kept-textures"))),
    Case("rays to the sky", "09_ambient_occlusion", "gully",
         ("--method", "rays", "--samples", "64", "--view", "ambient", "--size", "256x256"), (
             skip("rays-to-open-sky", quick=True),), runs=1),
    Case("rays to the sky, nothing moves", "09_ambient_occlusion", "gully",
         ("--method", "rays", "--samples", "16", "--view", "ambient", "--size", "256x256", "--still"), (skip("kept-rays"),)),
    Case("indoors, near surfaces only", "09_ambient_occlusion", "room",
         ("--method", "rays", "--samples", "64", "--range", "0.25", "--view", "ambient", "--size", "256x256"), (
             skip("rays-to-open-sky"),), runs=1),
    Case("a bake", "09_ambient_occlusion", "courtyard", ("--method", "vertices", "--samples", "256", "--view", "ambient"), (
        skip("rays-to-open-sky", "rays_baked"),
        NOT_SHARED), whole=True, runs=1),
    Case("a bake of a mesh", "09_ambient_occlusion", "knot", ("--method", "vertices", "--samples", "256", "--view", "ambient"), (
        NOT_SHARED,), whole=True, runs=1),
    Case("a bake of bits", "09_ambient_occlusion", "gully",
         ("--method", "bits", "--samples", "512", "--view", "irradiance"), (
             skip("rays-to-open-sky", "rays_baked"),), whole=True, runs=1),
    Case("many maps", "10_accumulated_occlusion", "gully", ("--samples", "128", "--view", "ambient"), (
        skip("maps-below-horizon"), skip("look-ups-facing-away"), everything("shadow_maps_rendered")), runs=2),
    Case("many maps, on the ground", "10_accumulated_occlusion", "heckbert_herf",
         ("--samples", "128", "--view", "ambient", "--camera", "1"), (skip("maps-below-horizon"),), runs=2),
    Case("many maps, nothing moves", "10_accumulated_occlusion", "gully",
         ("--samples", "128", "--view", "ambient", "--still"), (skip("kept-occlusion"),), runs=2),
    Case("a lamp alone", "11_bent_normals", "courtyard",
         ("--samples", "16", "--view", "color", "--combine", "none", "--size", "256x256"), (skip("sky-not-shown"),), runs=2),
)


def points(quick):
    return [point for case in CASES for point in case.points(quick)]


def caseOf(label):
    return next(case for case in CASES if case.label == label)


@lru_cache(maxsize=None)
def declared(chapter):
    """The chapter's own words about its skips: name -> {name, counter, help}."""
    program = build.folder("release") / "bin" / chapter
    said = subprocess.run([program, "--list-skips"], capture_output=True, text=True)
    if said.returncode != 0:
        raise PointError(f"{chapter} --list-skips: {said.stderr.strip()}")
    return {entry["name"]: entry for entry in json.loads(said.stdout)}


def withPicture(point, runs):
    """(sample, bytes of the .exr that the last frame gave)."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "picture.exr"
        sample = whole.measure(replace(point, flags=(*point.flags, "--output", str(file))), runs)
        return sample, file.read_bytes()


@lru_cache(maxsize=None)
def pictureWithAllOn(case):
    return withPicture(case.point(ALL_ON, (), True), 1)[1]


def differing(one, other):
    """(pixels that differ, pixels): the values decide, since a file also holds the parameters that made it."""
    a, b = exr.decoded(one), exr.decoded(other)
    return a.differing(b), a.size[0] * a.size[1]


def measure(point):
    case = caseOf(point.quantity)
    sample, picture = withPicture(point, case.runs)
    if point.technique == ALL_ON:
        return sample
    off = next(o for o in case.off if o.name == point.technique)
    try:
        sample["differing"], sample["pixels"] = differing(pictureWithAllOn(case), picture)
    except exr.ExrError as problem:
        raise PointError(f"{point.id}: {problem}") from None
    own = declared(case.chapter).get(off.name, {})
    sample["counter"], sample["help"] = off.counter or own.get("counter", ""), own.get("help", off.help)
    return sample


def milliseconds(result, case):
    return result["total_cpu_ms"] if case.whole else result["cpu_ms"]


def shownTime(ms):
    return f"{ms:.0f}" if ms >= 100 else f"{ms:.1f}" if ms >= 1 else f"{ms:.2f}"


def shownWork(counter, on, off):
    if not counter:
        return ""
    return f"{counter} {on['work'].get(counter, 0):,} → {off['work'].get(counter, 0):,}".replace(",", " ")


def shownProof(off, exact):
    if off["differing"] == 0:
        return f"0 of {off['pixels']:,}".replace(",", " ")
    share = f"{off['differing']:,} of {off['pixels']:,}".replace(",", " ")
    return f"**{share}**" if exact else f"{share} (not claimed)"


def row(case, on, off):
    with_, without = milliseconds(on, case), milliseconds(off, case)
    kind = next(o for o in case.off if o.name == off["technique"])
    return [f"`{off['technique']}`", f"{case.chapter[:2]} {case.scene}: {case.label}", shownTime(with_), shownTime(without),
            f"{without / max(with_, 1e-3):.2f}", shownWork(off["counter"], on, off), shownProof(off, kind.exact),
            off["help"]]


HEADINGS = ["switched off", "where", "ms with", "ms without", "ratio", "work, with → without", "pixels that differ",
            "what is left out, and why it may be"]


ALIGNMENT = ["---", "---", "---:", "---:", "---:", "---", "---:", "---"]


def measuredRows(results):
    """(rows, results of exact skips that were not exact)."""
    rows, broken = [], []
    for case in CASES:
        mine = [r for r in results if r["quantity"] == case.label]
        on = next((r for r in mine if r["technique"] == ALL_ON), None)
        for off in case.off:
            found = next((r for r in mine if r["technique"] == off.name), None)
            if on and found:
                rows.append(row(case, on, found))
                if off.exact and found["differing"]:
                    broken.append(found)
    return rows, broken


def page(results):
    rows, broken = measuredRows(results)
    verdict = (f"**{len(broken)} of them changed the picture**, which none may." if broken else
               "None of those that claim to be exact changed a bit of any picture.")
    lines = [
        "## Skips", "",
        "Work that cannot change the picture is not done. `--no-skip NAME` does it all the same, `--skip-none` all of it, "
        "and `--help` of each chapter lists the names. Here each is switched off alone (parameters that leave work out too "
        "are in the same table): CPU time of a frame, or of the whole run for a bake; a counter of the work; and both pictures, "
        "written as linear floats and compared bit by bit.", "",
        verdict, "",
        tables.markdown(HEADINGS, rows, ALIGNMENT), "",
        "A ratio near 1 says that the scene has little to leave out, or that the machine is good at what is left out: a "
        "triangle that is clipped costs its vertices only. Noise is a few per cent.", ""]
    return lines, []
