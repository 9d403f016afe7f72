"""What the peers and our own chapters are given: scenes exported once, exact answers, and processes whose CPU is counted."""
import array
import hashlib
import json
import math
import os
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import build
import reports
from bench import export
from bench.runner import LIMIT_S, PointError

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
    """Of the code that prepares and asks: what it makes is not used again when it has changed."""
    here = Path(__file__).resolve().parent
    files = sorted(here.glob("peers*.py")) + sorted(here.glob("blender_*.py")) + [here / "export.py"]
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:8]


def folder():
    made = build.ROOT / "out" / "bench" / "peers"
    made.mkdir(parents=True, exist_ok=True)
    return made


def program(chapter):
    return build.folder("release") / "bin" / chapter


def run(command, environment=None):
    """Used. Throws PointError with the last thing that the process said."""
    with tempfile.TemporaryFile() as said:
        started = time.perf_counter()
        child = subprocess.Popen([str(word) for word in command], cwd=build.ROOT, stdin=subprocess.DEVNULL, stdout=said,
                                 stderr=subprocess.STDOUT, env={**os.environ, **(environment or {})})
        timer = threading.Timer(LIMIT_S, child.kill)
        timer.start()
        try:
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        except BaseException:
            child.kill()
            child.wait()
            raise
        finally:
            timer.cancel()
        wall = time.perf_counter() - started
        said.seek(0)
        text = said.read().decode(errors="replace")
    if child.returncode != 0:
        raise PointError(f"{command[0]}: status {child.returncode}: {(text.split(chr(10) * 2)[0] or 'no message').strip()[-300:]}")
    return Used(usage.ru_utime + usage.ru_stime, wall, text)


def made(name, suffix, needs, make):
    """A file that is made once: `make` writes it beside its place, and it is moved there whole. `needs`: files and words."""
    key = hashlib.sha256(recipe().encode())
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
    return draw("truth", "--view", "truth", "--compare-truth"), draw("ours", "--view", "visibility", "--samples", "64")


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


def sample(cpu_s, wall_s, process: Used, error, **further):
    """As bench.runner.measure gives it; process_*: of the whole process, from its start to its end."""
    return {"wall_ms": 1e3 * wall_s, "wall_min_ms": 1e3 * wall_s, "cpu_ms": 1e3 * cpu_s, "cpu_min_ms": 1e3 * cpu_s, "runs": 1,
            "process_cpu_ms": 1e3 * process.cpu_s, "process_wall_ms": 1e3 * process.wall_s,
            "compared": error is not None, "error": error, **further}


def readJson(path):
    return json.loads(Path(path).read_text())
