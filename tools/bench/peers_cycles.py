"""Blender's Cycles: the soft shadow of an area light, and ambient occlusion baked into vertices.

Everything is done by two scripts inside Blender, whose own clock tells the render from what comes before it.
"""
import json
import re
import tempfile
from pathlib import Path

from bench import peers_jobs as jobs
from bench.runner import PointError

HERE = Path(__file__).resolve().parent
SEEN = re.compile(r"^Error: (?:Python: )?(.+)$|^\w*Error: (.+)$", re.MULTILINE)


def blender(script, job):
    """(what the script answers, jobs.Used)"""
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.json"
        written = Path(folder) / "job.json"
        written.write_text(json.dumps({**job, "threads": jobs.THREADS, "answer": str(answer),
                                       "picture": str(Path(folder) / "picture.exr")}))
        used = jobs.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", HERE / script,
                         "--", written])
        if not answer.is_file():
            raise PointError(f"Blender's {script} gave no answer: {used.said.strip()[-200:]}")
        return jobs.readJson(answer), used


def asSample(said, used):
    """The process without what only the comparison needs: its start, the building of its hierarchy, the render."""
    phase = said["phase"]
    process = jobs.Used(phase["start_cpu_s"] + phase["build_cpu_s"] + phase["cpu_s"], used.wall_s, "")
    return jobs.sample(phase["cpu_s"], phase["wall_s"], process, said.get("error"), ours=said.get("ours"),
                       build_cpu_ms=1e3 * phase["build_cpu_s"], renderer="")


def shadow(scene, samples, compare):
    view, exported = jobs.VIEWS[scene], jobs.sceneOf(scene)
    truth, ours = jobs.shadowTruth(view)
    light = exported.lights[view.light]
    return asSample(*blender("blender_shadow.py", {
        "surfaces": jobs.ply(f"{scene}_surfaces", exported.surfaces, jobs.asset(scene)),
        "shining": jobs.ply(f"{scene}_shining", exported.shining, jobs.asset(scene)),
        "camera": exported.cameras[view.camera], "light": {"corners": light.corners}, "size": jobs.SIZE, "samples": samples,
        "truth": str(truth), "ours": str(ours), "compare": compare}))


def bake(scene, samples):
    mesh, _, source = jobs.vertexTruth(scene)
    return asSample(*blender("blender_bake.py", {"surfaces": jobs.ply(f"{scene}_vertices", mesh, source), "samples": samples}))
