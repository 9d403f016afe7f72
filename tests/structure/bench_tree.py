"""A folder with a program that stands for a chapter, and results as the benchmark would have measured them."""
import io
from unittest import mock

from temporary_tree import ROOT, TreeTest

import build
import reports
from bench.measuring import Measuring
from bench.points import Point
from bench.progress import Progress

# Stands for a chapter: error and time follow from --samples, and --samples 13 fails. Each start is a line of `started`.
PROGRAM = """#!/usr/bin/env python3
import json, sys
flags = sys.argv[1:]
value = lambda name: flags[flags.index("--" + name) + 1]
open("started", "a").write(" ".join(flags) + "\\n")
samples, runs = int(value("samples")), int(value("runs"))
if samples == 13:
    print("first line", file=sys.stderr)
    sys.exit("no luck with thirteen")
ms = {"median": 2.0 * samples, "min": 1.0 * samples, "max": 9.0, "runs": runs}
report = {"time": {"setup_ms": 5.0, "frame_ms": ms, "frame_cpu_ms": ms, "passes_ms": {"bake": {"median": 7.0}}},
          "work": {"shadow_rays": 10 * samples, "pixels_receiving": 10}, "renderer": "fake GL", "backend": "none"}
if "--compare-truth" in flags:
    report["error"] = {"quantity": "visibility", "truth": "ray traced, 512 rays a pixel, standard error 1.0e-03",
                       "against": "area light", "pixels": 9, "rmse": 0.5 / samples, "mean_abs": 0, "max_abs": 1, "bias": 0}
    report["error_area_light"] = {"against": "area light", "rmse": 0.3, "max_abs": 1, "bias": 0.1}
open(value("report"), "w").write(json.dumps(report))
"""


def point(samples, technique="00 rays", scene="knot", **more):
    return Point("error", scene, technique, "00_a", "samples", samples, ("--samples", str(samples)), "area", **more)


def result(technique, ms, rmse, scene="knot", quantity="area", **more):
    figures = {"rmse": rmse, "max_abs": 1.0, "bias": 0.0, **more}
    return {"id": f"{technique}{ms}{scene}", "section": "error", "scene": scene, "technique": technique, "chapter": "00_a",
            "axis": "samples", "value": 4, "quantity": quantity, "flags": [], "wall_ms": ms, "wall_min_ms": ms, "cpu_ms": ms,
            "cpu_min_ms": ms, "once_ms": 0.0, "setup_ms": 1.0, "memory_mb": 9.0, "memory_with_truth": False, "passes": 1,
            "runs": 3, "work": {"shadow_rays": 40, "pixels_receiving": 10}, "error": figures, "area_light": None,
            "renderer": "fake GL"}


class BenchTest(TreeTest):
    def setUp(self):
        super().setUp()
        self.write("build/release/bin/00_a", PROGRAM, executable=True)
        self.write("shaders/a.glsl", "void main() {}")
        self.write("tools/bench/browse.html", (ROOT / "tools" / "bench" / "browse.html").read_text())
        patched = mock.patch.object(build, "ROOT", self.root)
        patched.start()
        self.addCleanup(patched.stop)
        self.forget()

    @staticmethod
    def forget():
        """What this process remembers of files that a build would have changed."""
        reports.fileDigest.cache_clear()
        reports.inputsDigest.cache_clear()

    def measure(self, points, quick=False):
        measuring = Measuring(points, quick, Progress(io.StringIO()))
        measuring.run()
        return measuring

    def started(self):
        return self.read("started").splitlines() if (self.root / "started").exists() else []
