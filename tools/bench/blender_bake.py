"""Runs inside Blender: Cycles bakes ambient occlusion into a mesh's vertices, and its error against the file's own values.

The exact answer is the "quality" of the PLY file's vertices. Cycles' result is what its AO pass has: the share of
cosine-weighted rays that escape, at every corner of a triangle; Blender gives a vertex the mean of its corners.
"""
import array
import sys
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import blender_scene as peer  # noqa: E402
from blender_scene import export, figures  # noqa: E402


def build(work):
    scene = peer.emptyScene(work["threads"])
    scene.world.light_settings.distance = 1e4  # ten metres unless said otherwise: what is farther would not occlude
    baked = peer.importMesh(work["surfaces"])
    attribute = baked.data.color_attributes.new("ambient", "FLOAT_COLOR", "POINT")
    baked.data.color_attributes.active_color = attribute
    baked.select_set(True)
    scene.render.bake.target = "VERTEX_COLORS"
    return scene, baked


def bake(scene, samples):
    """Seconds of CPU and of wall."""
    scene.cycles.samples = samples
    cpu, wall = peer.cpu(), time.perf_counter()
    bpy.ops.object.bake(type="AO")
    return peer.cpu() - cpu, time.perf_counter() - wall


def main(work):
    scene, baked = build(work)
    started = peer.cpu()
    cpu, wall = bake(scene, work["samples"])
    colours = array.array("f", bytes(16 * len(baked.data.vertices)))
    baked.data.color_attributes["ambient"].data.foreach_get("color", colours)
    truth = export.readPly(work["surfaces"]["file"]).values
    peer.answer(work["answer"], phase={"start_cpu_s": started, "build_cpu_s": 0.0, "cpu_s": cpu, "wall_s": wall},
                error=figures([a - b for a, b in zip(colours[0::4], truth)]))


main(peer.job())
