"""The techniques of the chapters, what they estimate, what they turn for quality, on which scenes they make sense, and why
they cost what they cost."""
import math
from dataclasses import dataclass

from bench.points import Point

TRUTH_RAYS = "1024"  # of exact answers that are many rays: their standard error is reported, and far below the errors
# Irradiance of level ground under the whole overcast sky of radiance 1 at the zenith (Moon & Spencer 1942): 7 pi / 9.
OPEN_SKY = 7.0 * math.pi / 9.0


@dataclass(frozen=True)
class Quantity:
    name: str
    title: str
    unit: float           # errors are divided by it
    alternative: str      # the technique a reader would otherwise pick, or ""
    floor: str            # what is left where more work does not help
    without: str = ""     # why there is no alternative


BIAS = ("bias, since the margin that keeps a wide filter from shadowing its own receiver lets light through at contacts, "
        "most of it on curved surfaces, and no further tap takes it back")
NO_RAYS = "no ray of chapter 00 estimates a filter: compare under *the visibility of an area light*"
QUANTITIES = (
    Quantity("hard", "the hard shadow of a point light", 1.0, "00 rays",
             "of a map the texels along the shadow's edge, of rays the pixels whose edge passes within a rounding of float"),
    Quantity("box", "visibility filtered by a box on the light's map", 1.0, "", BIAS, NO_RAYS),
    Quantity("disk", "visibility filtered by a disk on the light's map", 1.0, "", BIAS, NO_RAYS),
    Quantity("area", "the visibility of an area light", 1.0, "00 rays",
             "of rays the slivers that the first 16 miss (`--adaptive off` asks them all), of masks the blending between "
             "texels, and on curved surfaces, where only maps help, the maps' bias"),
    Quantity("ambient", "ambient visibility", 1.0, "09 rays",
             "of maps their texels and of rays their noise; of vertices whatever lies between them, which no ray from a "
             "vertex sees"),
    Quantity("sky", "the irradiance under an overcast sky, divided by that of open ground", OPEN_SKY, "11 rays",
             "the bent normal itself, one look-up in place of an integral; of vertices whatever lies between them"),
)

# The light of each scene, by kind of quantity; a scene that is not there has no such light, and the combination is left out.
# A square light stands for the lamp in its middle.
HARD = {"heckbert_herf": 0, "contact": 0, "fence": 0, "knot": 0, "courtyard": 0}
# Of boxes and disks: not the window of `courtyard`, whose middle is behind its mullion, so that its one map is all dark.
FILTERED = {"heckbert_herf": 0, "contact_panel": 0, "fence": 0, "knot": 1, "courtyard": 0}
AREA = {"heckbert_herf": 0, "contact_panel": 0, "knot": 1, "courtyard": 2}
LIGHTS = {"hard": HARD, "box": FILTERED, "disk": FILTERED, "area": AREA}
SCENES = ("heckbert_herf", "contact", "contact_panel", "fence", "knot", "courtyard")
PUNCTUAL = ("contact", "fence", "knot", "courtyard")  # whose hard light has none: chapter 00 casts one ray
LARGE = ("knot", "courtyard")                         # 70 000 triangles and more
SKY_SCENES = ("heckbert_herf", "contact", "fence", "knot", "courtyard")
QUICK_SCENES = ("heckbert_herf", "contact", "contact_panel")


@dataclass(frozen=True)
class Technique:
    name: str
    chapter: str
    quantity: str
    axis: str
    values: tuple
    large: tuple          # values on large scenes
    flags: tuple          # "{}" in one is the value, "{64}" the value times 64
    why: str              # one sentence: why it costs what it costs
    scenes: tuple = ()    # none: every scene that has the light
    once: tuple = ()      # passes of the report that are made once, before the first frame


SOFT = ("--view", "visibility")
DISK = (*SOFT, "--radius", "8")
SKY = ("--view", "ambient", "--truth-rays", TRUTH_RAYS)
IRRADIANCE = ("--view", "irradiance", "--sky", "overcast", "--truth-rays", TRUTH_RAYS)
MAPS = (256, 512, 1024, 2048, 4096)
TAPS, MOST_TAPS = (4, 16, 64, 256), (8, 16, 64, 256)

TECHNIQUES = (
    Technique("00 rays", "00_ray_traced_truth", "hard", "samples", (1,), (1,), (*SOFT, "--samples", "{}"),
              "one shadow ray a pixel is exact, and its cost grows with the logarithm of the triangles", PUNCTUAL),
    Technique("02 no bias", "02_shadow_test", "hard", "map-size", MAPS, MAPS, (*SOFT, "--map-size", "{}"),
              "one look-up a pixel, but acne that no resolution takes away"),
    Technique("03 derived bias", "03_polygon_offset", "hard", "map-size", MAPS, MAPS, (*SOFT, "--map-size", "{}"),
              "one look-up a pixel; only pixels on a shadow's edge are wrong, and they get fewer as the map gets finer"),
    # The box is 1/64 of the map at every setting: more tests are finer texels under the same box.
    Technique("04 tests", "04_pcf", "box", "kernel-width", (3, 5, 9, 15), (3, 5, 9, 15),
              (*SOFT, "--kernel-width", "{}", "--map-size", "{64}"),
              "n x n tests at every pixel, in penumbra or not, and a bias that grows with the kernel"),
    Technique("04 bilinear", "04_pcf", "box", "kernel-width", (3, 5, 9, 15), (3, 5, 9, 15),
              (*SOFT, "--kernel-width", "{}", "--map-size", "{64}", "--bilinear", "on"),
              "the sampler blends four tests for little more than the price of one, which removes the steps between texels"),
    Technique("04 receiver plane", "04_pcf", "box", "kernel-width", (3, 5, 9, 15), (3, 5, 9, 15),
              (*SOFT, "--kernel-width", "{}", "--map-size", "{64}", "--receiver-plane", "on"),
              "a few operations a tap buy a bias that does not grow with the kernel, so that contacts keep their shadows"),
    Technique("05 jittered", "05_jittered_disk", "disk", "samples", TAPS, TAPS,
              (*DISK, "--pattern", "jittered", "--samples", "{}"),
              "one pattern for all pixels needs no look-up of its own, and what it misses shows as bands"),
    Technique("05 sobol", "05_jittered_disk", "disk", "samples", TAPS, TAPS,
              (*DISK, "--pattern", "sobol", "--samples", "{}"),
              "one pattern for all pixels, better spread than the jittered one for the same price"),
    Technique("06 texture", "06_jitter_texture", "disk", "samples", MOST_TAPS, MOST_TAPS,
              (*DISK, "--method", "texture", "--samples", "{}"),
              "every pixel fetches its own pattern, eight taps to a texel, and takes all taps everywhere"),
    Technique("06 rotation", "06_jitter_texture", "disk", "samples", MOST_TAPS, MOST_TAPS,
              (*DISK, "--method", "rotation", "--samples", "{}"),
              "one spiral turned by a hash of the pixel: no pattern is fetched, each tap is a rotation"),
    Technique("07 min-max", "07_branching", "disk", "samples", MOST_TAPS, MOST_TAPS, (*DISK, "--samples", "{}"),
              "a minimum and a maximum decide lit and dark at once, and only the penumbra takes the taps"),
    Technique("00 rays", "00_ray_traced_truth", "area", "samples", (4, 16, 64, 256, 1024), (4, 16, 64, 256),
              (*SOFT, "--samples", "{}"), "every shadow ray walks the hierarchy; where the first 16 agree no more are cast"),
    Technique("07 contact-hardening", "07_branching", "area", "samples", (16, 64, 256), (16, 64, 256),
              (*SOFT, "--penumbra", "contact-hardening", "--radius", "64", "--samples", "{}"),
              "one map from the light's middle: cheap, and blind to what only the light's rim sees"),
    Technique("08 mask", "08_accumulation", "area", "samples", (4, 16, 64, 256, 1024), (4, 16, 64),
              (*SOFT, "--method", "mask", "--samples", "{}", "--others-samples", "{}"),
              "32 light points a draw call, a bit each, on the texels that a shadow can reach"),
    Technique("08 accumulate", "08_accumulation", "area", "samples", (4, 16, 64, 256, 1024), (1, 4, 16),
              (*SOFT, "--method", "accumulate", "--samples", "{}", "--others-samples", "{}"),
              "clear, draw and add over every texel for every light point, as in the paper"),
    Technique("08 shadow maps", "08_accumulation", "area", "samples", (4, 16, 64, 256), (4, 16, 64),
              (*SOFT, "--method", "shadow-maps", "--samples", "{}", "--others-samples", "{}"),
              "a depth map and a look-up for every light point, on surfaces of any shape"),
    # Exactly, 70 000 triangles over one floor take minutes: no alternative that anybody would pick.
    Technique("08 exact", "08_accumulation", "area", "others-samples", (16,), (),
              (*SOFT, "--method", "exact", "--others-samples", "{}"),
              "cone subtraction where a texel block sees an occluder, a formula elsewhere: no sample at all"),
    Technique("09 rays", "09_ambient_occlusion", "ambient", "samples", (4, 16, 64, 256), (4, 16, 64),
              (*SKY, "--samples", "{}"), "rays from every pixel, in directions that no cache likes"),
    Technique("09 vertices", "09_ambient_occlusion", "ambient", "samples", (16, 64, 256, 1024), (16, 64, 256),
              (*SKY, "--method", "vertices", "--samples", "{}"),
              "rays from vertices only, shared among neighbours, once: then a frame is free, and what lies between vertices "
              "is blended", once=("bake",)),
    Technique("10 pixels", "10_accumulated_occlusion", "ambient", "samples", (16, 64, 256, 1024), (16, 64, 256),
              (*SKY, "--samples", "{}"), "one depth map answers one direction for all pixels at once"),
    Technique("10 vertices", "10_accumulated_occlusion", "ambient", "samples", (16, 64, 256), (16, 64, 256),
              (*SKY, "--method", "vertices", "--samples", "{}"),
              "depth maps looked up at vertices only: fewer look-ups, and what lies between is blended"),
    Technique("11 rays", "11_bent_normals", "sky", "samples", (4, 16, 64, 256), (4, 16, 64),
              (*IRRADIANCE, "--source", "rays", "--samples", "{}"),
              "rays from every pixel for A and B, one look-up along B: what stays is the error of a bent normal"),
    Technique("11 vertices", "11_bent_normals", "sky", "samples", (16, 64, 256), (16, 64, 256),
              (*IRRADIANCE, "--source", "vertices", "--samples", "{}"),
              "A and B are baked with the vertices, and a frame is one look-up", once=("bake",)),
    Technique("11 maps", "11_bent_normals", "sky", "samples", (16, 64, 256), (16, 64),
              (*IRRADIANCE, "--source", "maps", "--samples", "{}"),
              "one depth map a direction gives A and B to all pixels at once"),
)


def filled(flag, value):
    return flag.replace("{64}", str(64 * value)).replace("{}", str(value)) if "{" in flag else flag


def lightFlags(technique, scene):
    """None where the scene has no light for the technique. The sky is above all scenes but those that have none."""
    if technique.quantity not in LIGHTS:
        return () if scene in SKY_SCENES else None
    light = LIGHTS[technique.quantity].get(scene)
    return None if light is None else ("--light", str(light))


def pointsOf(technique, scene, quick):
    light = lightFlags(technique, scene)
    if light is None or (technique.scenes and scene not in technique.scenes):
        return []
    values = technique.large if scene in LARGE else technique.values
    if quick:  # every other one, the best ones left out: a curve is a curve from two points on
        values = values[:4:2] if len(values) > 2 else values
    return [Point("error", scene, technique.name, technique.chapter, technique.axis, value,
                  (*light, *(filled(flag, value) for flag in technique.flags), *onceFlags(technique)), technique.quantity,
                  once=technique.once) for value in values]


def onceFlags(technique):
    return ("--pass-times",) if technique.once else ()


def allPoints(quick):
    scenes = QUICK_SCENES if quick else SCENES
    return [point for scene in scenes for technique in TECHNIQUES for point in pointsOf(technique, scene, quick)]


def quantity(name):
    return next(q for q in QUANTITIES if q.name == name)


def namesOf(quantityName):
    """Of the techniques that estimate it, in the order of the chapters: what else is compared with it estimates another."""
    return list(dict.fromkeys(t.name for t in TECHNIQUES if t.quantity == quantityName))


def whyOf(name, quantityName):
    found = [t for t in TECHNIQUES if t.name == name]
    exact = [t for t in found if t.quantity == quantityName] or found
    return exact[0].why if exact else ""
