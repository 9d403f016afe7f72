"""What the peers and our own chapters are given: scenes exported once, exact answers, and processes whose CPU is counted."""
import array
import hashlib
import json
import math
import os
import subprocess
import time
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import build
import reports
from bench import export
from bench.runner import PointError, runChild

SIZE = 512
THREADS = 2
TRUTH_SEEDS = (101, 102, 103, 104)  # of rays at each vertex: as many runs of 4096, none of them one that is measured


@dataclass(frozen=True)
class View:
    """A soft shadow, as flags of the chapters and as indices of what the exporter finds."""
    scene: str
    light: int
    camera: int

    def flags(self):
        return ("--light", str(self.light), "--camera", str(self.camera), "--size", f"{SIZE}x{SIZE}")


VIEWS = {view.scene: view for view in (View("heckbert_herf", 0, 1), View("courtyard", 2, 0))}


@dataclass
class Used:
    cpu_s: float
    wall_s: float
    said: str


def recipe():
    """Of the code that exports and asks: what it measured counts no more when it has changed."""
    here = Path(__file__).resolve().parent
    files = [*sorted(here.glob("blender_*.py")), *(here / f"peers_{name}.py" for name in ("cycles", "jobs", "meshlab")),
             here / "export.py"]
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:8]


def folder():
    made = build.ROOT / "out" / "bench" / "peers"
    made.mkdir(parents=True, exist_ok=True)
    return made


def program(chapter):
    return build.folder("release") / "bin" / chapter


def reason(said):
    """The one line of a failed process that says why: programs go on talking after it."""
    lines = [line.strip() for line in said.splitlines() if line.strip() and "script failed" not in line]
    return next((line for line in reversed(lines) if "error" in line.lower()), lines[-1] if lines else "no message")


def run(command, environment=None):
    """Used. Throws PointError with the reason that the process gave."""
    started = time.perf_counter()
    status, said, usage = runChild([str(word) for word in command], subprocess.STDOUT, {**os.environ, **(environment or {})})
    if status != 0:
        raise PointError(f"{Path(command[0]).name} ended with status {status}: {reason(said)}")
    return Used(usage.ru_utime + usage.ru_stime, time.perf_counter() - started, said)


def made(name, suffix, needs, make):
    """A file that is made once: `make` writes it beside its place, and it is moved there whole. `needs`: files and words."""
    key = hashlib.sha256(Path(export.__file__).read_bytes() + Path(__file__).read_bytes())
    for need in needs:
        key.update((reports.fileDigest(need) if isinstance(need, Path) else str(need)).encode())
    path = folder() / f"{name}.{key.hexdigest()[:12]}{suffix}"
    if not path.is_file():
        new = path.with_name("new." + path.name)
        make(new)
        new.rename(path)
    return path


def asset(scene):
    return build.ROOT / "assets" / f"{scene}.glb"


def ply(name, mesh, source):
    """{"file", "summary"}, as blender_scene.importMesh takes it."""
    path = made(name, ".ply", [source, name], lambda new: export.writePly(new, mesh))
    return {"file": str(path), "summary": mesh.summary()}


@lru_cache(maxsize=4)
def sceneOf(name):
    return export.load(asset(name))


def shadowTruth(view):
    """The exact visibility as .exr, no number where it is undefined; and our own picture, to compare two ways to count."""
    chapter = program("08_accumulation")

    def draw(name, *flags):
        return made(f"{view.scene}_{name}", ".exr", [chapter, asset(view.scene)], lambda new: run(
            [chapter, "--scene", view.scene, *view.flags(), "--headless", "--quiet", "--output", new, *flags]))
    return draw("truth", "--view", "truth", "--compare-truth"), draw(
        "ours", "--view", "visibility", "--method", "mask", "--samples", "64", "--others-samples", "64")


def vertexValues(glb):
    scene = export.load(glb)
    return list(scene.shining.values) + list(scene.surfaces.values)


@lru_cache(maxsize=2)
def vertexTruth(scene):
    """(mesh whose values are the exact ambient visibility at its vertices, their standard error, the scene it is of)."""
    chapter = program("09_ambient_occlusion")
    files = [made(f"{scene}_rays_{seed}", ".glb", [chapter, asset(scene)], lambda new, seed=seed: run(
        [chapter, "--scene", scene, "--method", "vertices", "--samples", "4096", "--share", "off", "--seed", seed,
         "--size", "16x16", "--headless", "--quiet", "--save", new, "--output", folder() / "vertices.png"]))
        for seed in TRUTH_SEEDS]
    runs = [vertexValues(file) for file in files]
    baked = export.load(files[0])
    mesh = baked.shining  # the meshes that shine occlude too
    mesh.add(baked.surfaces)
    count = len(runs)
    mesh.values = array.array("f", [sum(values) / count for values in zip(*runs)])
    spread = sum((value - mean) ** 2 for values in runs for value, mean in zip(values, mesh.values))
    return mesh, math.sqrt(spread / (len(mesh.values) * (count - 1) * count)), files[0]


def sample(cpu_s, wall_s, processCpu_s, error, **further):
    """As bench.runner.measure gives it; process_cpu_ms: of the whole process, from its start to its end."""
    return {"wall_ms": 1e3 * wall_s, "wall_min_ms": 1e3 * wall_s, "cpu_ms": 1e3 * cpu_s, "cpu_min_ms": 1e3 * cpu_s,
            "runs": 1, "process_cpu_ms": 1e3 * processCpu_s, "setup_ms": 0.0, "compared": True, "error": error,
            "renderer": "CPU", **further}


def withNoise(sample, noise):
    """Of an exact answer that is rays itself."""
    sample["error"]["standard_error"] = noise
    return sample


def readJson(path):
    return json.loads(Path(path).read_text())
