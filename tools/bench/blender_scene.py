"""What both scripts that run inside Blender share (`blender --background --python SCRIPT -- JOB.json`).

A job is what tools/bench/peers_cycles.py writes: PLY files, where to put the answer, and what the exporter says of the
meshes, which is compared with what Blender made of them. Standard library only: Debian's Blender brings no numpy.
"""
import array
import json
import resource
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bench import export  # noqa: E402
from bench.peers_curves import figures  # noqa: E402


def cpu():
    """Seconds of all threads of this process since it began."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def job():
    return json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())


def emptyScene(threads):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = threads
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.light_sampling_threshold = 0.0
    scene.world = bpy.data.worlds.new("dark")
    scene.world.color = (0, 0, 0)
    return scene


def material():
    """White and diffuse: radiance times pi is irradiance."""
    made = bpy.data.materials.new("white")
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    surface = nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (1, 1, 1, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    made.node_tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
    return made


def summary(mesh):
    places = array.array("f", bytes(12 * len(mesh.vertices)))
    mesh.vertices.foreach_get("co", places)
    return {**export.Mesh(positions=places).summary(), "triangles": len(mesh.polygons)}


def importMesh(described):
    """The object that Blender's own importer makes of a PLY file, with the normals that the file has and it ignores."""
    bpy.ops.import_mesh.ply(filepath=described["file"])
    made = bpy.context.view_layer.objects.active
    if summary(made.data) != described["summary"]:
        sys.exit(f"Blender read {summary(made.data)} from {described['file']}, and it holds {described['summary']}")
    normals = export.readPly(described["file"]).normals
    made.data.polygons.foreach_set("use_smooth", [True] * len(made.data.polygons))
    made.data.use_auto_smooth = True
    made.data.normals_split_custom_set_from_vertices(list(zip(normals[0::3], normals[1::3], normals[2::3])))
    made.data.materials.clear()
    made.data.materials.append(material())
    # Both move rays' starts or darken grazing light for looks; here the answer is to be right.
    made.cycles.shadow_terminator_geometry_offset = 0.0
    made.cycles.shadow_terminator_offset = 0.0
    return made


def answer(to, **said):
    Path(to).write_text(json.dumps({"version": bpy.app.version_string, **said}))
