"""./run's page: every view of every chapter in one file, and a failure that does not hide."""
import contextlib
import io
import re
import unittest
from unittest import mock

from temporary_tree import TreeTest

import build
import gallery

# Stands for a chapter: its help names three views, of which "depth" cannot be rendered.
PROGRAM = """#!/usr/bin/env python3
import json, sys
from pathlib import Path
flags = sys.argv[1:]
if "--help" in flags:
    print("03_a: idea\\n\\nViews (--view NAME)\\n  color                    what one\\n" + " " * 27 + "sees\\n"
          "  depth                    the map\\n  error                    how far off\\n\\nExit status: 0")
    sys.exit()
value = lambda name: flags[flags.index("--" + name) + 1]
if value("view") == "error" and "--compare-truth" not in flags:
    sys.exit("--view error: needs --compare-truth")
if value("view") == "depth":
    print("no depth today", file=sys.stderr)
    sys.exit(1)
Path(value("output")).parent.mkdir(parents=True, exist_ok=True)
Path(value("output")).write_bytes(b"picture of " + value("view").encode())
report = {"time": {"frame_ms": {"median": 12.34}}, "work": {"triangles_submitted": 4321}}
if "--compare-truth" in flags:
    report["error"] = {"quantity": "visibility", "truth": "ray traced", "against": "point light", "rmse": 0.0321,
                       "max_abs": 1, "bias": 0}
Path(value("report")).write_text(json.dumps(report))
"""


class GalleryTest(TreeTest):
    def render(self, names):
        self.write("tools/gallery.html", (build.ROOT / "tools" / "gallery.html").read_text())
        said = io.StringIO()
        with mock.patch.object(build, "ROOT", self.root), contextlib.redirect_stderr(said), \
                contextlib.redirect_stdout(said):
            return gallery.render(names, "courtyard", "8x8"), said.getvalue()

    def setUp(self):
        super().setUp()
        self.write("build/release/bin/03_a", PROGRAM, executable=True)

    def testHoldsEverythingInOneFile(self):
        status, said = self.render(["03_a"])
        self.assertEqual(status, 0, said)
        page = self.read("out/index.html")
        self.assertIn('"meaning": "what one sees"', page)
        self.assertEqual(page.count("data:image/png;base64,"), 2)
        self.assertIn("<td>visibility against point light (ray traced)</td><td>0.0321</td>", page)
        self.assertIn("<td>12.3</td><td>triangles submitted 4,321</td>", page)
        self.assertEqual(re.findall(r'(?:src|href)="[^"]', page), [], "the page points outside itself")
        self.assertEqual(re.findall(r"%[A-Z]+%", page), [], "a part of the page was not filled in")

    def testExactAnswersOfManyRaysAreMadeOfFewer(self):
        traced = PROGRAM.replace("03_a: idea", "03_a: idea\\n  --truth-rays N  rays").replace(
            '"ray traced"', 'value("truth-rays") + " rays"')
        self.write("build/release/bin/03_a", traced, executable=True)
        status, said = self.render(["03_a"])
        self.assertEqual(status, 0, said)
        self.assertIn(f"({gallery.TRUTH_RAYS} rays)", self.read("out/index.html"))

    def testSaysWhichViewFailed(self):
        _, said = self.render(["03_a"])
        self.assertIn("03_a: --view depth: no depth today", said)
        self.assertIn("--view depth: no depth today", self.read("out/index.html"))

    def testFailsWhenAChapterRendersNothing(self):
        self.write("build/release/bin/04_b", PROGRAM.replace('== "depth"', '!= ""'), executable=True)
        self.assertEqual(self.render(["03_a", "04_b"])[0], 1)
        self.assertEqual(self.render([])[0], 1)


if __name__ == "__main__":
    unittest.main()
