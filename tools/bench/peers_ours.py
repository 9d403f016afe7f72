"""The chapters beside the peers, measured by the same means: the frame or the bake alone, and the whole process."""
import tempfile
from pathlib import Path

from bench import peers_jobs as jobs
from bench.peers_curves import figures
from bench.runner import errorOf

QUIET = ("--headless", "--quiet")


def reported(words, folder):
    """(report, jobs.Used) of a chapter."""
    file = Path(folder) / "report.json"
    used = jobs.run([jobs.program(words[0]), *words[1:], *QUIET, "--report", file])
    return jobs.readJson(file), used


def shadow(point):
    words = [*point.command(), *jobs.VIEWS[point.scene].flags(), "--view", "visibility"]
    with tempfile.TemporaryDirectory() as folder:
        timed, used = reported([*words, "--runs", "3"], folder)
        once, whole = reported(words, folder)
        error = errorOf(reported([*words, "--compare-truth"], folder)[0]["error"])
    frame = timed["time"]
    return jobs.sample(1e-3 * frame["frame_cpu_ms"]["median"], 1e-3 * frame["frame_ms"]["median"], whole.cpu_s, error,
                       renderer=once["renderer"], runs=3)


def bake(point):
    """A bake happens once, before the first frame: it is the whole process without what it takes to show the same scene by
    its normals alone. Chapter 10 adds up its maps in every frame, and writes a file besides."""
    small = ("--size", "16x16")
    with tempfile.TemporaryDirectory() as folder:
        report, whole = reported([*point.command(), *small], folder)
        if point.chapter.startswith("10"):
            frame = reported([*point.command(), *small, "--runs", "3"], folder)[0]["time"]
            cpu, wall = 1e-3 * frame["frame_cpu_ms"]["median"], 1e-3 * frame["frame_ms"]["median"]
        else:
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
