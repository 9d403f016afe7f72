"""Section `peers`: other programs that estimate the same, beside ours at equal error.

Blender's Cycles and MeshLab come from Debian's packages and are installed when they are asked for (`./run bench --peers`).
They get the course's own scenes, exported by bench.export, and are compared with the course's own exact answers.
"""
import shutil
from dataclasses import dataclass, field, replace

import build
import tables
from bench import peers_cycles, peers_jobs, peers_meshlab, peers_ours
from bench.figures import Curve, Figure
from bench.peers_curves import atEqualError, curveOf
from bench.points import Point
from bench.runner import PointError

NAME = "peers"
ON_REQUEST = True


@dataclass(frozen=True)
class Way:
    technique: str
    chapter: str      # ours: the program; else the peer's command
    quantity: str     # "soft shadow" or "ambient at vertices"
    scenes: tuple
    axis: str
    values: tuple
    flags: tuple = ()  # {value} stands for where it is on the axis
    quick: int = 2     # so many of the values
    why: str = field(default="", compare=False)


SHADOW, AMBIENT = "soft shadow", "ambient at vertices"
BOTH = ("heckbert_herf", "courtyard")
WAYS = (
    Way("08 masks", "08_accumulation", SHADOW, BOTH, "samples", (4, 16, 64, 256),
        ("--method", "mask", "--samples", "{value}", "--others-samples", "{value}"),
        why="A light point costs one drawing of what is in between, for all pixels at once, and nothing is weighted "
            "where all points agree. It makes the whole texture of every receiver that a pixel shows, and draws for "
            "each receiver and light point: that is cheap for one plane, and dear for hundreds of paving stones."),
    Way("08 exact", "08_accumulation", SHADOW, BOTH[:1], "points", (0,), ("--method", "exact"),
        why="Cone subtraction where few triangles are in the way: no samples, and the error that is left is that of "
            "blending between texels."),
    Way("00 shadow rays", "00_ray_traced_truth", SHADOW, BOTH, "samples", (4, 16, 64, 256), ("--samples", "{value}"),
        why="One camera ray a pixel, then shadow rays alone, and only 16 of them where these agree."),
    Way("Cycles", "blender", SHADOW, BOTH, "samples", (4, 16, 64, 256), ("--samples", "{value}"),
        why="A path tracer: every sample is a camera ray, a hit, an evaluated material and a shadow ray, and a lit "
            "pixel gets as many as a penumbra. It needs nothing but its hierarchy, and knows nothing of receivers, "
            "lights or planes that it could use."),
    Way("09 rays at vertices", "09_ambient_occlusion", AMBIENT, ("knot",), "samples", (16, 64, 256, 1024),
        ("--method", "vertices", "--samples", "{value}"),
        why="Neighbouring vertices use one another's rays where that costs no accuracy."),
    Way("09 rays, not shared", "09_ambient_occlusion", AMBIENT, ("knot",), "samples", (16, 64, 256, 1024),
        ("--method", "vertices", "--share", "off", "--samples", "{value}"),
        why="The same rays in bundles, each vertex for itself."),
    Way("10 shadow maps", "10_accumulated_occlusion", AMBIENT, ("knot",), "samples", (64, 256, 1024, 4096),
        ("--method", "vertices", "--samples", "{value}"),
        why="The idea of MeshLab's filter, but a map is looked up where it was drawn, by OpenGL for all vertices at "
            "once; back faces are culled, the bias is derived, and directions are spread evenly."),
    Way("Cycles bake", "blender", AMBIENT, ("knot",), "samples", (4, 16, 64, 256), ("--samples", "{value}"),
        why="Rays from every corner of every triangle, about six for each vertex, with the same random numbers, so "
            "that five of the six tell nothing new."),
    Way("MeshLab", "meshlabserver", AMBIENT, ("knot",), "views", (32, 128, 512, 2048),
        ("--views", "{value}", "--map-size", "512"),
        why="A depth map for each direction is read back and looked up by one thread, vertex by vertex; what is below"
            " a vertex' horizon is looked up too."),
    Way("MeshLab, maps of 2048", "meshlabserver", AMBIENT, ("knot",), "views", (128, 512),
        ("--views", "{value}", "--map-size", "2048"), quick=0, why="Finer maps, where size limits the one above."),
)
PEERS = {"blender": ("Blender", "blender"), "meshlabserver": ("MeshLab", "meshlab")}  # command: name, package
absent = set()  # commands that `prepare` could not get


def prepare():
    """Installs the peers; says in one line each which are not to be had, and their points are left out."""
    try:
        build.install("peers")
    except build.BuildError:
        pass  # nobody may install here: what is there already will do
    for command, (name, package) in PEERS.items():
        if not shutil.which(command):
            absent.add(command)
            print(f"{name} is left out: Debian's package {package} could not be installed here")


def points(quick):
    """The last two words are no flags: they change when what prepares and asks has changed, and all is measured again."""
    made, recipes = [], {True: ("--recipe", peers_jobs.recipe()), False: ("--recipe", peers_ours.recipe())}
    for way in WAYS:
        if way.chapter in absent:
            continue
        for scene in way.scenes[:1] if quick else way.scenes:
            for value in way.values[:way.quick] if quick else way.values:
                flags = tuple(word.format(value=value) for word in way.flags) + recipes[way.chapter in PEERS]
                made.append(Point(NAME, scene, way.technique, way.chapter, way.axis, value, flags, way.quantity))
    return made


def measure(point):
    asked, value = replace(point, flags=point.flags[:-2]), int(point.value)
    try:
        if point.chapter == "blender":
            return (peers_cycles.shadow if point.quantity == SHADOW else peers_cycles.bake)(point.scene, value)
        if point.chapter == "meshlabserver":
            return peers_meshlab.bake(point.scene, value, int(asked.flags[asked.flags.index("--map-size") + 1]))
        return (peers_ours.shadow if point.quantity == SHADOW else peers_ours.bake)(asked)
    except (OSError, ValueError, KeyError, peers_jobs.export.ExportError) as problem:
        raise PointError(f"{type(problem).__name__}: {problem}") from problem


def groups(results):
    """[((quantity, scene), {technique: [result, ...]})] in the order of the points."""
    found = {}
    for result in results:
        if result.get("error"):
            found.setdefault((result["quantity"], result["scene"]), {}).setdefault(result["technique"], []).append(result)
    return list(found.items())


def isPeer(technique):
    return any(way.technique == technique and way.chapter in PEERS for way in WAYS)


def shown(ms):
    return f"{ms:.3g}" if ms < 1000 else f"{ms:.0f}"


def measuredTable(curves):
    rows = [[technique, f"{r['axis']} {r['value']:g}" if r["value"] else "–", f"{r['error']['rmse']:.5f}",
             f"{r['error']['bias']:+.5f}", shown(r["cpu_ms"]), shown(r["wall_ms"]), shown(r["process_cpu_ms"])]
            for technique, results in curves.items() for r in results]
    return tables.markdown(["program", "setting", "error", "bias", "CPU ms", "ms", "CPU ms, whole process"], rows,
                           ["---", "---"] + 5 * ["---:"])


def equalRow(ours, theirs, curves):
    alone, whole = (atEqualError(curveOf(curves[ours], time), curveOf(curves[theirs], time))
                    for time in ("cpu_ms", "process_cpu_ms"))
    atMost = {"ours": ("≤ ", ""), "theirs": ("", "≤ ")}.get(alone.bound, ("", ""))
    verdict = f"{ours}, {alone.ratio:.3g} times" if alone.ratio >= 1 else f"{theirs}, {1 / alone.ratio:.3g} times"
    return [ours, theirs, f"{alone.error:.2g}", atMost[0] + shown(alone.ours), atMost[1] + shown(alone.theirs), verdict,
            f"{whole.ratio:.3g}"]


def equalTable(curves):
    rows = [equalRow(ours, theirs, curves) for theirs in curves if isPeer(theirs) for ours in curves if not isPeer(ours)]
    return tables.markdown(["ours", "theirs", "error", "ours, CPU ms", "theirs, CPU ms", "faster",
                            "theirs : ours, whole process"], rows, ["---", "---", "---:", "---:", "---:", "---", "---:"])


def check(curves):
    """Our picture's error by their program, beside ours: the two ways to count agree."""
    theirs = next((r["ours"]["rmse"] for results in curves.values() for r in results if r.get("ours")), None)
    ours = next((r["error"]["rmse"] for r in curves.get("08 masks", ()) if r["value"] == 64), None)
    if theirs is None or ours is None:
        return []
    return [f"Blender's Python finds an error of {theirs:.5f} in the picture of `08 masks` with 64 points, our own report "
            f"{ours:.5f}: both count alike.", ""]


def groupLines(quantity, scene, curves):
    lines = [f"### {quantity[0].upper()}{quantity[1:]}: {scene}", "", measuredTable(curves), ""]
    errors = [r["error"]["standard_error"] for results in curves.values() for r in results if "standard_error" in r["error"]]
    if errors:
        lines += [f"The exact answer is itself rays, and has a standard error of {errors[0]:.5f}.", ""]
    lines += check(curves)
    if any(map(isPeer, curves)) and not all(map(isPeer, curves)):
        lines += ["At the least error that both reach, between settings interpolated on logarithmic axes (≤: the cheapest "
                  "setting measured has less error already):", "", equalTable(curves), ""]
    why = {way.technique: way.why for way in WAYS if way.quantity == quantity}
    return lines + [f"- **{technique}**: {why[technique]}" for technique in curves if why.get(technique)] + [""]


def figure(quantity, scene, curves):
    drawn = []
    for look, (technique, results) in enumerate(curves.items()):
        curve = curveOf(results, "cpu_ms")
        if kept := [point[:2] for point in curve.drawn()]:
            drawn.append(Curve(technique, kept, dashed=isPeer(technique), look=look))
        if exact := curve.exact():
            drawn.append(Curve(f"{technique}: exact", [(exact[0], None)], dashed=True, look=look))
    return Figure(f"peers_{quantity.replace(' ', '_')}_{scene}", f"{scene}: {quantity}; dashed: other programs",
                  "ms of CPU", "root mean square error", drawn, True, scene, quantity)


def page(results):
    lines, figures = ["## Other programs", "", INTRODUCTION.strip(), "", versions(results), ""], []
    for (quantity, scene), curves in groups(results):
        figures.append(figure(quantity, scene, curves))
        lines += [*groupLines(quantity, scene, curves), figures[-1].markdown(), ""]
    return lines, figures


def versions(results):
    named = sorted({r["version"] for r in results if r.get("version")})
    return f"Measured beside {' and '.join(named)}." if named else ""


INTRODUCTION = """
Blender's path tracer Cycles and MeshLab's filter "Ambient Occlusion" estimate what chapters here estimate. `./run bench
--peers` installs them from Debian's packages, exports the scenes (PLY, checked by counts and bounds in the program that
reads them), and measures both with the same exact answer, two threads, no denoiser.

*CPU ms* is the rendering or baking alone, all threads together: of Cycles its render call with the hierarchy already built,
or its bake; of MeshLab the process without what the same process takes with no filter, display server included; of ours a
frame, or for chapter 09 the process without what it takes when it has nothing to bake. *Whole process* is from its start to
its end. Cycles' soft shadow is its picture divided by the same picture without shadows and with the same random numbers:
that takes away noise, and its time is not counted, so its error here is the best that it could have.
"""
