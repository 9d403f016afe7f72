"""Runs inside Blender: an area light's soft shadow by Cycles, and its error.

Direct light on white diffuse surfaces, no filter between pixels, no denoiser, no bounces. Divided by the same picture
without shadows, of the same random numbers, it is what chapters 00 and 08 show as `--view visibility`. The exact answer is
the .exr that they write with `--view truth`; it is no number where none is defined, and these pixels are left out.
The division takes away noise that Cycles' picture has, and its time is not counted: the error is Cycles' at its best.
"""
import array
import math
import re
import sys
import time
from pathlib import Path

import bpy
import mathutils

sys.path.insert(0, str(Path(__file__).resolve().parent))
import blender_scene as peer  # noqa: E402
from blender_scene import figures  # noqa: E402


def addCamera(scene, described):
    lens = bpy.data.cameras.new("camera")
    lens.clip_start, lens.clip_end = described["near"], 1e4
    if "height" in described:
        lens.type, lens.ortho_scale = "ORTHO", described["height"]
    else:
        lens.sensor_fit, lens.angle = "VERTICAL", described["fov"]
    scene.camera = bpy.data.objects.new("camera", lens)
    scene.camera.matrix_world = mathutils.Matrix(described["world"])
    scene.collection.objects.link(scene.camera)


def addLight(scene, described):
    """Cycles samples its own rectangle light by solid angle, better than the triangles of a mesh that glows."""
    a, b, _, d = (mathutils.Vector(corner) for corner in described["corners"])
    u, v = b - a, d - a
    lamp = bpy.data.lights.new("light", "AREA")
    lamp.shape, lamp.size, lamp.size_y = "RECTANGLE", u.length, v.length
    lamp.energy = 100.0  # whatever it is: the picture without shadows divides it away
    made = bpy.data.objects.new("light", lamp)
    axes = mathutils.Matrix((u.normalized(), -v.normalized(), -u.cross(v).normalized())).transposed()
    made.matrix_world = mathutils.Matrix.Translation(a + 0.5 * u + 0.5 * v) @ axes.to_4x4()
    made.visible_camera = False
    scene.collection.objects.link(made)


def build(work):
    scene = peer.emptyScene(work["threads"])
    surfaces = peer.importMesh(work["surfaces"])
    # The camera sees the mesh that shines, and it throws no shadow; light comes from the lamp in its place.
    shining = peer.importMesh(work["shining"])
    shining.visible_shadow = shining.visible_diffuse = False
    addCamera(scene, work["camera"])
    addLight(scene, work["light"])
    cycles, render = scene.cycles, scene.render
    cycles.max_bounces = cycles.diffuse_bounces = 0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 0.01
    render.resolution_x = render.resolution_y = work["size"]
    render.resolution_percentage = 100
    render.use_persistent_data = True  # the hierarchy is built in the first render, of one sample
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = work["picture"]
    return scene, surfaces


def pixels(path):
    """The red channel, rows in the order of all pictures that Blender reads."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    values = array.array("f", bytes(4 * image.size[0] * image.size[1] * image.channels))
    image.pixels.foreach_get(values)
    return values[0::image.channels]


def samplesOf(path):
    """What Cycles wrote into the head of its picture."""
    found = re.search(rb"cycles\.\w+\.samples\x00string\x00.{4}(\d+)", Path(path).read_bytes()[:65536], re.DOTALL)
    return int(found[1]) if found else None


def errors(work, scene, surfaces):
    """Cycles', and that of our own picture, which must be what our own report says."""
    if samplesOf(work["picture"]) not in (None, work["samples"]):
        sys.exit(f"Cycles took {samplesOf(work['picture'])} samples, and not the {work['samples']} that it was asked for")
    lit = pixels(work["picture"])
    surfaces.visible_shadow = False
    scene.render.filepath = work["picture"] + ".unshadowed.exr"
    bpy.ops.render.render(write_still=True)
    visible = [a / b if b > 0 else 0.0 for a, b in zip(lit, pixels(scene.render.filepath))]
    truth, ours = pixels(work["truth"]), pixels(work["ours"])
    defined = [i for i, value in enumerate(truth) if math.isfinite(value)]
    return {"error": figures([visible[i] - truth[i] for i in defined]),
            "ours": figures([ours[i] - truth[i] for i in defined])}


def main(work):
    scene, surfaces = build(work)
    started = peer.cpu()
    scene.cycles.samples = 1
    bpy.ops.render.render(write_still=False)
    scene.cycles.samples = work["samples"]
    scene.update_tag()  # or the hierarchy is kept, and the number of samples too
    built, wall = peer.cpu(), time.perf_counter()
    bpy.ops.render.render(write_still=True)
    phase = {"start_cpu_s": started, "build_cpu_s": built - started, "cpu_s": peer.cpu() - built,
             "wall_s": time.perf_counter() - wall}
    peer.answer(work["answer"], phase=phase, **errors(work, scene, surfaces))


main(peer.job())
