"""docs/refresh: what it fills in, and that --check sees every way in which a page can be stale."""
import contextlib
import io
import unittest

from temporary_tree import TreeTest

import pages
import png
import tables

MAIN = """int main() {
    // [begin:outer]
    pass1();
    // [begin:inner]
        pass2();
    // [end:inner]
    // [end:outer]
}
"""

# Stands for a chapter: its picture and its figures come from a file, so that a test can change them.
PROGRAM = """#!/usr/bin/env python3
import json, sys
from pathlib import Path
sys.path.insert(0, "TOOLS")
import png
flags = sys.argv[1:]
state = json.loads(Path("state.json").read_text())
if "--list-parameters" in flags:
    print(json.dumps([{"name": "bias", "range": [0, 8], "default": 1, "unit": "texels", "help": "a | b"}]))
elif "--output" in flags:
    png.write(Path(flags[flags.index("--output") + 1]), 2, 2, 1, bytes([state["grey"]] * 4))
else:
    rmse = state["rmse"] * (2 if "none" in flags else 1)
    report = {"error": {"rmse": rmse}, "time": {"ms": state["ms"]}, "list": [rmse]}
    Path(flags[flags.index("--report") + 1]).write_text(json.dumps(report))
"""

PAGE = """# 00 A

The idea.

**Estimates** V; **exact answer:** a ray.

<!-- code: chapters/00_a/main.cpp outer -->
<!-- end -->
<!-- code: chapters/00_a/main.cpp inner --><!-- end -->
<!-- picture: 00_a --scene x -> images/a.png | a picture -->
<!-- end -->
<!-- table: errors
column method = label
column RMSE   = error.rmse * 100 .1f
column ratio  = error.rmse relative .2f
column ms     = time.ms .1f
row {m = derived, none}{m} | 00_a --method {m}
-->
<!-- end -->

<!-- table: curve
column N = label
column RMSE = error.rmse .3f
row {n = 4, 16}{n} | 00_a --samples {n}
-->
<!-- end -->
<!-- plot: curve -> images/curve.svg | a curve -->
<!-- end -->
<!-- table: cost
column method = label
column cost = time.ms .1f
column RMSE = error.rmse .3f
row {m = none, derived}{m} | 00_a --method {m}
-->
<!-- end -->
<!-- plot: cost by RMSE -> images/cost.svg | cost over error -->
<!-- end -->

It is off by <!-- value: errors | none | RMSE --><!-- end --> %.

<!-- parameters: 00_a -->
<!-- end -->

```
<!-- code: shown as it is -->
```
"""


class RefreshTest(TreeTest):
    def setUp(self):
        super().setUp()
        self.write("chapters/00_a/main.cpp", MAIN)
        self.write("docs/00_a.md", PAGE)
        self.write("README.md", "<!-- chapters -->\n<!-- end -->\n<!-- dependencies -->\n<!-- end -->\n")
        self.write("tools/packages.txt", "# comment\ncmake  build  Configures it.\n")
        self.write("build/bin/00_a", PROGRAM.replace("TOOLS", str(pages.ROOT / "tools")), executable=True)
        self.state(grey=100, rmse=0.125, ms=7)

    def state(self, grey, rmse, ms):
        self.write("state.json", f'{{"grey": {grey}, "rmse": {rmse}, "ms": {ms}}}')
        # The cache is by content of programs, shaders and assets; this stands for a program that was built anew.
        for path in self.root.glob("build/docs_cache/*"):
            path.unlink()

    def run_(self, check=False, fast=False, names=()):
        said = io.StringIO()
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            status = pages.refresh(list(names), check, fast, "build", root=self.root)
        return status, said.getvalue()

    def expectStale(self, *words, fast=True):
        for mode in ({True, False} if fast else {False}):
            status, said = self.run_(check=True, fast=mode)
            self.assertEqual(status, 1, said)
            for word in words:
                self.assertIn(word, said)

    def change(self, path, old, new):
        text = self.read(path)
        self.assertIn(old, text)
        self.write(path, text.replace(old, new))

    def refreshed(self):
        self.assertEqual(self.run_(), (0, ""))
        self.assertEqual(self.run_(check=True), (0, ""))
        self.assertEqual(self.run_(check=True, fast=True), (0, ""))

    def testFillsInEveryKind(self):
        self.refreshed()
        page = self.read("docs/00_a.md")
        self.assertIn("```cpp\npass1();\n    pass2();\n```", page)
        self.assertIn("![a picture](images/a.png)", page)
        self.assertIn("| derived | 12.5 | 1.00 | 7.0 |", page)
        self.assertIn("| none | 25.0 | 2.00 | 7.0 |", page)
        self.assertIn("![a curve](images/curve.svg)", page)
        self.assertIn("<title>a curve</title>", self.read("docs/images/curve.svg"))
        self.assertIn("off by <!-- value: errors | none | RMSE -->25.0<!-- end", page)
        self.assertIn("| `--bias` | 0 … 8 | 1 | texels | a \\| b |", page)
        self.assertIn("```\n<!-- code: shown as it is -->\n```", page)
        self.assertIn("| [00_a](docs/00_a.md) | The idea. | V | a ray |", self.read("README.md"))
        self.assertIn("| `cmake` | Configures it. |", self.read("README.md"))

    def testATableWithoutANameKeepsItsFirstColumn(self):
        table = tables.parse("column samples = label\ncolumn RMSE = error.rmse .4f\nrow 4 | 00_a --samples 4", "here")
        self.assertEqual(([column.heading for column in table.columns], table.name), (["samples", "RMSE"], ""))

    def testRefreshingTwiceChangesNothing(self):
        self.refreshed()
        before = self.read("docs/00_a.md")
        self.state(grey=101, rmse=0.1251, ms=900)
        self.refreshed()
        self.assertEqual(before, self.read("docs/00_a.md"))

    def testSeesChangedCode(self):
        self.refreshed()
        self.change("chapters/00_a/main.cpp", "pass2", "pass3")
        self.expectStale("docs/00_a.md:7", "docs/00_a.md:13")

    def testSeesUnknownRegion(self):
        self.refreshed()
        self.change("docs/00_a.md", "main.cpp inner", "main.cpp other")
        self.expectStale("no region other", "inner, outer", "region inner is shown by no page")

    def testSeesUnusedRegion(self):
        self.refreshed()
        self.write("shaders/00_a/a.frag", "// [begin:lonely]\nx;\n// [end:lonely]\n")
        self.expectStale("shaders/00_a/a.frag: region lonely is shown by no page")

    def testSeesChangedCommandLines(self):
        self.refreshed()
        self.change("docs/00_a.md", "--scene x", "--scene y")
        self.change("docs/00_a.md", "--method {m}", "--mode {m}")
        self.expectStale("docs/00_a.md:18: `picture", "`table: errors` was changed")

    def testSeesChangedPicture(self):
        self.refreshed()
        self.state(grey=103, rmse=0.125, ms=7)
        self.expectStale("images/a.png differs by 3.0 levels", fast=False)

    def testSeesMissingAndLeftOverPictures(self):
        self.refreshed()
        (self.root / "docs/images/a.png").rename(self.root / "docs/images/b.png")
        self.expectStale("no picture images/a.png", "b.png: no page makes or shows this picture")

    def testLeavesThePicturesOfTheBenchmarkToIt(self):
        self.refreshed()
        self.write("docs/images/bench_a.svg", "<svg/>")
        self.expectStale("bench_a.svg: no page makes or shows this picture")
        self.write("docs/benchmark.md", "![a plot](images/bench_a.svg)\n")
        self.assertEqual(self.run_(check=True), (0, ""))

    def testSeesChangedFiguresButNotTimes(self):
        self.refreshed()
        self.state(grey=100, rmse=0.125, ms=900)
        self.assertEqual(self.run_(check=True), (0, ""))
        self.state(grey=100, rmse=0.13, ms=7)
        self.expectStale("derived, RMSE: the page says 12.5, the program 13.0", fast=False)

    def testSeesChangedPlot(self):
        self.refreshed()
        before = self.read("docs/images/curve.svg")
        self.run_()
        self.assertEqual(self.read("docs/images/curve.svg"), before)
        self.change("docs/images/curve.svg", "polyline", "polygon")
        self.expectStale("images/curve.svg", "curve")
        self.refreshed()
        self.assertEqual(self.read("docs/images/curve.svg"), before)

    def testPlotsOverAColumn(self):
        self.refreshed()
        svg = self.read("docs/images/cost.svg")
        self.assertIn(">RMSE</text>", svg)  # below the axis
        self.assertIn(">cost</text>", svg)
        self.assertEqual(svg.count("<polyline points"), 1 + 2 + svg.count('text-anchor="end"'))
        left, right = (float(text) for text in (svg.index(">0.125<"), svg.index(">0.25<")))
        self.assertLess(left, right)
        for argument, said in (("cost by MSE", "no column MSE"), ("cost by method", "must be numbers")):
            self.change("docs/00_a.md", "plot: cost by RMSE", f"plot: {argument}")
            status, message = self.run_()
            self.assertEqual(status, 1)
            self.assertIn(said, message)
            self.change("docs/00_a.md", f"plot: {argument}", "plot: cost by RMSE")
        self.change("docs/00_a.md", "{m = none, derived}", "{m = a, b}")
        self.assertIn("two different", self.run_()[1])

    def testSeesFigureTypedByHand(self):
        self.refreshed()
        self.change("docs/00_a.md", "-->25.0<!--", "-->24.0<!--")
        self.expectStale("value: errors | none | RMSE` is stale")

    def testSeesWrongMarkers(self):
        for old, new, words in (("<!-- code: chapters/00_a/main.cpp outer -->\n<!-- end -->",
                                 "<!-- code: chapters/00_a/main.cpp outer -->", "`code` has no `<!-- end -->`"),
                                ("<!-- parameters: 00_a", "<!-- paramters: 00_a", "unknown marker `paramters`"),
                                ("off by <!--", "off by\n<!--", "may not begin a line"),
                                ("error.rmse relative", "error.rsme relative", "no error.rsme"),
                                ("| none | RMSE", "| nothing | RMSE", "rows derived, none"),
                                ("picture: 00_a", "picture: 00_b", "no program 00_b")):
            with self.subTest(new):
                self.write("docs/00_a.md", PAGE)
                self.change("docs/00_a.md", old, new)
                self.run_()
                self.expectStale(words, fast=False)

    def testSaysWhatAFailingProgramSaid(self):
        self.write("build/bin/00_a", "#!/bin/sh\necho first; echo the reason >&2; exit 3\n", executable=True)
        status, said = self.run_()
        self.assertEqual(status, 1)
        self.assertIn("ended with status 3, saying: the reason", said)

    def testDiffBetweenChapters(self):
        self.write("chapters/01_b/main.cpp", MAIN.replace("pass1", "passOne").replace("// [", "// ("))
        self.write("docs/01_b.md", PAGE.replace("00", "01").split("<!-- code")[0] + "<!-- diff: 00_a 01_b -->\n<!-- end -->\n")
        self.refreshed()
        self.assertIn("From 00_a to 01_b: 5 lines added, 5 removed", self.read("docs/01_b.md"))
        self.assertIn("+    passOne();", self.read("docs/01_b.md"))
        self.change("chapters/01_b/main.cpp", "passOne", "passTwo")
        self.expectStale("diff: 00_a 01_b` is stale")


class PngTest(TreeTest):
    def testReadsWhatItWrites(self):
        pixels = bytes((7 * i * i + i) % 256 for i in range(5 * 4 * 3))
        png.write(self.root / "a.png", 5, 4, 3, pixels)
        self.assertEqual(png.read(self.root / "a.png"), (5, 4, 3, pixels))

    def testUndoesEveryFilter(self):
        # Rows with filters 0 to 4 of the same content: each must come back as the row it encodes.
        row, above = bytes([10, 200, 30, 90]), bytes([50, 60, 70, 80])
        left, corner = bytes([0]) + row[:-1], bytes([0]) + above[:-1]
        paeth = [min((a, b, c), key=lambda v: abs(a + b - c - v)) for a, b, c in zip(left, above, corner)]
        for kind, guess in enumerate((bytes(4), left, above, [(a + b) // 2 for a, b in zip(left, above)], paeth)):
            line = bytearray((v - g) % 256 for v, g in zip(row, guess))
            png.unfilter(kind, line, above, 1)
            self.assertEqual(bytes(line), row, kind)


if __name__ == "__main__":
    unittest.main()
