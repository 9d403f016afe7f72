"""The chapters beside the peers, measured by the same means: the frame or the bake alone, and the whole process."""
import hashlib
import tempfile
from pathlib import Path

from bench import peers_jobs as jobs
from bench.peers_curves import figures
from bench.runner import errorOf

QUIET = ("--headless", "--quiet")
SLOW_MS = 500.0


def reported(words, folder):
    """(report, jobs.Used) of a chapter."""
    file = Path(folder) / "report.json"
    used = jobs.run([jobs.program(words[0]), *words[1:], *QUIET, "--report", file])
    return jobs.readJson(file), used


def recipe():
    """Of the code that asks, as peers_jobs.recipe for the others."""
    files = (Path(__file__), Path(jobs.__file__), Path(jobs.export.__file__))
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:8]


def timed(words, folder):
    """(seconds of CPU and of wall for a frame, report, jobs.Used of a process that draws it once)."""
    _, whole = reported([*words, "--still"], folder)
    report, _ = reported(words, folder)
    if report["time"]["frame_ms"]["median"] < SLOW_MS:  # slow frames are not drawn again for a median
        report, _ = reported([*words, "--runs", "5"], folder)
    frame = report["time"]
    return 1e-3 * frame["frame_cpu_ms"]["median"], 1e-3 * frame["frame_ms"]["median"], report, whole


def shadow(point):
    words = [*point.command(), *jobs.VIEWS[point.scene].flags(), "--view", "visibility"]
    with tempfile.TemporaryDirectory() as folder:
        cpu, wall, report, whole = timed(words, folder)
        error = errorOf(reported([*words, "--compare-truth"], folder)[0]["error"])
    return jobs.sample(cpu, wall, whole.cpu_s, error, renderer=report["renderer"])


def bake(point):
    """A bake happens once, before the first frame: it is the whole process without what it takes to show the same scene by
    its normals alone. Chapter 10 adds up its maps in every frame."""
    small = ("--size", "16x16")
    with tempfile.TemporaryDirectory() as folder:
        cpu, wall, report, whole = timed([*point.command(), *small], folder)
        if point.chapter.startswith("09"):
            _, idle = reported([point.chapter, "--scene", point.scene, "--method", "hemisphere", *small], folder)
            cpu, wall = max(whole.cpu_s - idle.cpu_s, 1e-3), max(whole.wall_s - idle.wall_s, 1e-3)
        error = vertexErrors(point, small, Path(folder) / "baked.glb")
    sample = jobs.sample(cpu, wall, whole.cpu_s, error, renderer=report["renderer"])
    return jobs.withNoise(sample, jobs.vertexTruth(point.scene)[1])


def vertexErrors(point, small, saved):
    jobs.run([jobs.program(point.chapter), *point.command()[1:], *small, *QUIET, "--save", saved,
              "--output", saved.with_suffix(".png")])
    truth = jobs.vertexTruth(point.scene)[0].values
    return figures([a - b for a, b in zip(jobs.vertexValues(saved), truth)])
