"""Blender's Cycles: the soft shadow of an area light, and ambient occlusion baked into vertices.

Everything is done by two scripts inside Blender, whose own clock tells the render from what comes before it.
"""
import json
import tempfile
from pathlib import Path

from bench import peers_jobs as jobs
from bench.runner import PointError

HERE = Path(__file__).resolve().parent


def blender(script, job):
    """What the script answers."""
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.json"
        written = Path(folder) / "job.json"
        written.write_text(json.dumps({**job, "threads": jobs.THREADS, "answer": str(answer),
                                       "picture": str(Path(folder) / "picture.exr")}))
        used = jobs.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1",
                         "--python", HERE / script, "--", written])
        if not answer.is_file():
            raise PointError(f"Blender's {script} gave no answer: {used.said.strip()[-200:]}")
        return jobs.readJson(answer)


def asSample(said):
    """The whole process is what it takes without the comparison: its start, the building of its hierarchy, the render."""
    phase = said["phase"]
    whole = phase["start_cpu_s"] + phase["build_cpu_s"] + phase["cpu_s"]
    return jobs.sample(phase["cpu_s"], phase["wall_s"], whole, said["error"], ours=said.get("ours"),
                       build_cpu_ms=1e3 * phase["build_cpu_s"], version=f"Blender {said['version']}")


def shadow(scene, samples):
    view, exported = jobs.VIEWS[scene], jobs.sceneOf(scene)
    truth, ours = jobs.shadowTruth(view)
    light = exported.lights[view.light]
    return asSample(blender("blender_shadow.py", {
        "surfaces": jobs.ply(f"{scene}_surfaces", exported.surfaces, jobs.asset(scene)),
        "shining": jobs.ply(f"{scene}_shining", exported.shining, jobs.asset(scene)),
        "camera": exported.cameras[view.camera], "light": {"corners": light.corners}, "size": jobs.SIZE, "samples": samples,
        "truth": str(truth), "ours": str(ours)}))


def bake(scene, samples):
    mesh, noise, source = jobs.vertexTruth(scene)
    job = {"surfaces": jobs.ply(f"{scene}_vertices", mesh, source), "samples": samples}
    return jobs.withNoise(asSample(blender("blender_bake.py", job)), noise)
