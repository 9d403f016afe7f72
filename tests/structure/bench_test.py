"""./run bench: what is measured is kept and merged, an interrupted run goes on, curves say what is cheapest, and the page is
what its results make."""
import io
import json
import re
import unittest
import xml.etree.ElementTree as xml
from unittest import mock

from bench_tree import PROGRAM, BenchTest, point, result
from temporary_tree import ROOT, TreeTest

import png
from bench import browse, curves, document, error, estimates, files, raster, results, runner, sections, skips
from bench import store, svg, techniques, work
from bench import measuring as measuring_module
from bench.figures import Curve, Figure, Line, Mark, layOut
from bench.measuring import Measuring
from bench.progress import Progress

class MeasuringTest(BenchTest):
    def testRepeatsLieInterleavedAndTheTruthIsAskedForOnce(self):
        self.measure([point(2), point(4)])
        samples = [re.search(r"--samples (\d+)", line)[1] for line in self.started()]
        self.assertEqual(samples, ["2", "4", "2", "4", "2", "4"])
        self.assertEqual(["--compare-truth" in line for line in self.started()], 2 * [True] + 4 * [False])

    def testSlowPointsAreStartedOnceAndQuickOnesTimedMoreOften(self):
        self.measure([point(2), point(4000)])
        runs = [re.search(r"--samples (\d+).*--runs (\d+)", line).groups() for line in self.started()]
        self.assertEqual(runs, [("2", "1"), ("4000", "1"), ("2", "12"), ("2", "12")])

    def testRepeatsEndWhenTheTimeIsOverAndFirstPassesDoNot(self):
        with mock.patch.dict(measuring_module.BUDGET_S, {False: 0}):
            self.measure([point(2), point(4)])
        self.assertEqual(len(self.started()), 2)
        self.measure([point(2), point(4)])
        self.assertEqual(len(self.started()), 6, "the next run goes on")

    def testAMachineTooSlowForOnePassIsToldSoAndNothingIsLeftUnmeasured(self):
        said = io.StringIO()
        with mock.patch.dict(measuring_module.BUDGET_S, {False: 0}):
            measuring = Measuring([point(2), point(4)], False, Progress(said))
            measuring.run()
        self.assertIn("one pass over all points took 0:0", said.getvalue())
        self.assertIn("2 repeats are left out", said.getvalue())
        self.assertEqual([found["passes"] for found in measuring.results()], [1, 1])

    def testARepeatThatWouldEndTooLateIsNotBegun(self):
        long, short = {"wall_ms": 900.0, "setup_ms": 60e3}, {"wall_ms": 1.0}
        measuring = Measuring([point(2), point(4)], False, Progress(io.StringIO()))
        measuring.samples = {point(2): [long], point(4): [short]}
        with mock.patch.dict(measuring_module.BUDGET_S, {False: 30}):
            self.assertEqual([measuring.overAfter(p) for p in (point(2), point(4))], [True, False])

    def testAResultHoldsWhatTheReportsSay(self):
        found = self.measure([point(4, once=("bake",))]).results()[0]
        self.assertEqual((found["wall_ms"], found["wall_min_ms"], found["once_ms"], found["passes"]), (8.0, 4.0, 7.0, 3))
        self.assertEqual(found["error"]["rmse"], 0.125)
        self.assertEqual(found["error"]["standard_error"], 0.001)
        self.assertEqual(found["area_light"]["rmse"], 0.3)
        self.assertFalse(found["memory_with_truth"])
        self.assertGreater(found["memory_mb"], 1.0)

    def testMemoryIsThatOfAPassWithoutTheExactAnswer(self):
        sample = {"wall_ms": 1.0, "wall_min_ms": 1.0, "cpu_ms": 1.0, "cpu_min_ms": 1.0}
        compared, plain = {**sample, "compared": True, "memory_mb": 50.0}, {**sample, "compared": False, "memory_mb": 70.0}
        both, one = results.merge(point(2), [compared, plain]), results.merge(point(2), [compared])
        self.assertEqual((both["memory_mb"], both["memory_with_truth"]), (70.0, False))
        self.assertEqual((one["memory_mb"], one["memory_with_truth"]), (50.0, True))

    def testARunGoesOnWhereItWas(self):
        with mock.patch.object(runner, "measure", side_effect=[runner.measure(point(2)), KeyboardInterrupt]):
            with self.assertRaises(KeyboardInterrupt):
                self.measure([point(2), point(4)])
        before = len(self.started())
        store.path().write_text(store.path().read_text() + '{"id": "torn')  # as if the machine had stopped
        self.measure([point(2), point(4)], quick=True)
        self.assertEqual(len(self.started()) - before, 3, "one pass of two was there")
        self.assertEqual(len(self.measure([point(2), point(4)], quick=True).results()), 2)
        self.assertEqual(len(self.started()) - before, 3, "all was there")

    def testAProgramOrShaderThatChangedIsMeasuredAgain(self):
        for path, text in (("build/release/bin/00_a", PROGRAM + "\n"), ("shaders/a.glsl", "void main() { discard; }")):
            self.measure([point(2)], quick=True)
            before = len(self.started())
            self.write(path, text, executable=True)
            self.forget()
            self.measure([point(2)], quick=True)
            self.assertEqual(len(self.started()) - before, 2, path)

    def testAFailureIsToldAndTheRestGoesOn(self):
        measuring = self.measure([point(13), point(2)])
        self.assertEqual(list(measuring.failures.values()), ["no luck with thirteen"])
        self.assertEqual([found["value"] for found in measuring.results()], [2])

    def testAProgramThatHangsIsEnded(self):
        self.write("build/release/bin/00_a", "#!/bin/sh\nexec sleep 60\n", executable=True)
        with mock.patch.object(runner, "LIMIT_S", 0.2):
            measuring = self.measure([point(2)])
        self.assertIn("took longer than 0.2 s", str(list(measuring.failures.values())))

    def testProgressOnATerminalIsOneLineThatIsCleared(self):
        terminal = io.StringIO()
        terminal.isatty = lambda: True
        progress = Progress(terminal)
        progress.show(1, 2, 61.0, "a")
        progress.clear()
        self.assertIn("1 of 2, 1:01 left: a", terminal.getvalue())
        self.assertNotIn("\n", terminal.getvalue())
        self.assertTrue(terminal.getvalue().endswith("\r"))


class CurvesTest(unittest.TestCase):
    def curve(self, *points, technique="a"):
        return curves.Curve(technique, [(ms, error_, {}) for ms, error_ in points])

    def testBetweenTwoSettingsOnLogarithmicAxes(self):
        self.assertAlmostEqual(curves.timeTo(self.curve((1, 0.1), (100, 0.001)), 0.01)[0], 10.0)

    def testASettingThatIsSlowerAndWorseDoesNotCount(self):
        self.assertAlmostEqual(curves.timeTo(self.curve((1, 0.1), (50, 0.2), (100, 0.001)), 0.01)[0], 10.0)

    def testNeverAndFromTheStart(self):
        self.assertIsNone(curves.timeTo(self.curve((1, 0.1), (9, 0.05)), 0.01))
        self.assertEqual(curves.timeTo(self.curve((3, 0.1), (9, 0.05)), 0.2)[0], 3)

    def testWhatIsExactIsReachedAtItsOwnTime(self):
        self.assertEqual(curves.timeTo(self.curve((1, 0.1), (50, 0.0)), 0.01)[0], 50)

    def testSlope(self):
        self.assertAlmostEqual(curves.slope([(1, 1), (4, 0.5), (16, 0.25)]), -0.5)
        self.assertIsNone(curves.slope([(1, 1), (2, 2)]))
        self.assertIsNone(curves.slope([(1, 1), (1, 2), (1, 3)]))
        self.assertIsNone(curves.slope([(1, 1), (1.2, 0.2), (1.4, 0.1)]), "as quick: its slope would be noise's")
        self.assertEqual([curves.shownSlope(v) for v in (None, -0.001, -0.756)], ["–", "0.00", "-0.76"])

    def testTheFrontHasNothingQuickerAndAsRight(self):
        a, b = self.curve((1, 0.1), (10, 0.01)), self.curve((2, 0.1), (5, 0.05), (20, 0.02), technique="b")
        self.assertEqual(curves.front([a, b]), {("a", 0), ("a", 1), ("b", 1)})


class PageTest(BenchTest):
    RESULTS = [result("00 rays", 10.0, 0.1), result("00 rays", 1000.0, 0.001), result("08 mask", 5.0, 0.1),
               result("08 mask", 50.0, 0.001), result("08 exact", 300.0, 0.0),
               result("00 rays", 10.0, 0.4, "courtyard"), result("00 rays", 90.0, 0.2, "courtyard")]

    def levels(self, results_):
        rows = error.sceneRows(estimates.curvesOf(results_, "knot", "area"), "knot", "area")
        return {level: cells for cells in rows for level in cells[1].split(", ")}

    def testNamesTheCheapestTheRunnerUpAndTheAlternative(self):
        rows = self.levels(self.RESULTS)
        self.assertEqual(rows["0.01"], ["knot", "0.01", "08 mask", "15.8", "00 rays", "6.3", "100", "6.3"])

    def testSaysWhereNobodyComes(self):
        rows = error.sceneRows(estimates.curvesOf(self.RESULTS, "courtyard", "area"), "courtyard", "area")
        self.assertEqual(rows, [["courtyard", "0.1, 0.03, 0.01, 0.003",
                                 "none; 00 rays comes to 0.2, hardly any of it bias", "90", *4 * "–"]])
        leaking = estimates.curvesOf([result("00 rays", 9.0, 0.5, bias=0.3)], "knot", "area")
        self.assertEqual(error.sceneRows(leaking, "knot", "area")[0][2], "none; 00 rays comes to 0.5, bias +0.3")

    def testWhatIsBetterByLuckIsNotReached(self):
        lucky = [result("11 vertices", 1.0, 0.08), result("11 vertices", 2.0, 0.13), result("11 vertices", 3.0, 0.12)]
        every = estimates.curvesOf(lucky, "knot", "area")
        self.assertEqual(estimates.reaching(every, 0.1), [])
        self.assertEqual([ms for ms, _, _ in estimates.reaching(every, 0.2)], [1.0])
        self.assertAlmostEqual(estimates.reaching(every, 0.121)[0][0], 2.9, places=1)

    def testDoesNotCompareBelowTheNoiseOfTheExactAnswer(self):
        noisy = [result("00 rays", 10.0, 0.1, standard_error=0.01), result("00 rays", 100.0, 0.0105, standard_error=0.01)]
        rows = self.levels(noisy)
        self.assertIn("noise", rows["0.01"][2])
        self.assertEqual(rows["0.03"][2], "00 rays")
        figures = {"rmse": 0.05, "standard_error": 0.03}
        self.assertAlmostEqual(estimates.errorOf(figures, 2.0), 0.02)

    def testAFilteredShadowCountsAgainstTheAreaLight(self):
        light = {"rmse": 0.2, "bias": 0.1, "max_abs": 1}
        filtered = {**result("07 min-max", 4.0, 0.01, quantity="disk"), "area_light": light}
        self.assertEqual(estimates.curvesOf([filtered], "knot", "area")[0].points[0][1], 0.2)
        self.assertEqual(estimates.curvesOf([filtered], "knot", "disk")[0].points[0][1], 0.01)
        self.assertIn("0.200", error.areaTable([filtered]))

    def testThePageIsMadeOfTheResultsAlone(self):
        machine = {"processor": "P", "cores": 2, "renderer": "R", "date": "D", "commit": "C", "load": 0.5}
        self.write("docs/x", "")
        self.write("docs/images/bench_old.svg", "")
        document.write(machine, self.RESULTS)
        page = self.read("docs/benchmark.md")
        self.assertEqual(document.stale(self.root), "")
        self.assertIn("| knot | 0.01 | 08 mask |", page)
        shown = re.findall(r"\]\((images/[^)]*)\)", page)
        self.assertEqual(shown, ["images/bench_error_area_knot.svg"])
        self.assertTrue((self.root / "docs" / shown[0]).is_file())
        self.assertFalse((self.root / "docs/images/bench_old.svg").exists(), "a picture that no page shows")
        for path, old, new in (("docs/benchmark.md", "6.3", "9.9"),
                               ("docs/benchmark.json", '"wall_ms":5.0', '"wall_ms":4.0'),
                               (f"docs/{shown[0]}", "polyline", "line")):
            with self.subTest(path):
                text = self.read(path)
                self.assertIn(old, text)
                self.write(path, text.replace(old, new, 1))
                self.assertTrue(document.stale(self.root))
                self.write(path, text)

    def testFilesForReadersOfTables(self):
        self.assertEqual(results.rounded({"a": [1.23456, 7], "b": "x"}), {"a": [1.235, 7], "b": "x"})
        rows = files.csvOf(self.RESULTS).splitlines()
        self.assertEqual(len(rows), 1 + len(self.RESULTS))
        self.assertTrue(all(row.count(",") == rows[0].count(",") for row in rows))
        self.assertEqual(json.loads(files.jsonOf({"cores": 2}, self.RESULTS))["results"], self.RESULTS)

    def testThePageToBrowsePointsNowhere(self):
        machine = {"processor": "P", "cores": 2, "renderer": "R", "date": "D", "commit": "C", "load": 0.5}
        lines, figures = error.page(self.RESULTS)
        page = browse.page(machine, self.RESULTS, figures, {f.name: svg.render(f) for f in figures})
        self.assertEqual(page.count("<svg"), 2)
        self.assertEqual(re.findall(r'(?:src|href)="[^"]', page), [], "the page points outside itself")
        self.assertEqual(re.findall(r"%[A-Z]+%", page), [], "a part of the page was not filled in")
        self.assertIn('"technique": "08 exact"', page)

    def testEveryTechniqueSaysWhy(self):
        for technique in techniques.TECHNIQUES:
            self.assertTrue(technique.why and not technique.why.endswith("."), technique.name)
        self.assertEqual(work.facts({"shadow_rays": 40, "pixels_receiving": 10}), "4 shadow rays a pixel")
        self.assertEqual(work.facts({}), "")


class FigureTest(TreeTest):
    FIGURE = Figure("a", "a < b", "ms", "error", [Curve("one", [(1, 0.1), (10, 0.01), (100, 0.001)], [1]),
                                                  Curve("exact", [(20, None)], dashed=True)])

    def testTheSvgIsWellFormedAndStable(self):
        drawn = svg.render(self.FIGURE)
        self.assertEqual(drawn, svg.render(self.FIGURE))
        marks = [node for node in xml.fromstring(drawn).iter() if node.tag.endswith("circle")]
        filled = [node for node in marks if node.get("fill") != "#ffffff" and node.get("cx") < "600"]
        self.assertEqual(len(filled), 1, "one point of the curve is on the front")

    def testThePngShowsTheSame(self):
        raster.render(self.FIGURE, self.root / "a.png")
        width, height, channels, pixels = png.read(self.root / "a.png")
        self.assertEqual((width, height, channels), (1720, 960, 3))
        at = lambda x, y: pixels[3 * (int(2 * y) * width + int(2 * x)):][:3]  # noqa: E731
        parts = layOut(self.FIGURE)
        (x0, y0), (x1, y1), _ = next(part for part in parts if isinstance(part, Line) and len(part.points) == 3).points
        self.assertEqual(at((x0 + x1) / 2, (y0 + y1) / 2), bytes.fromhex("4477aa"), "half way between two points")
        marks = [part for part in parts if isinstance(part, Mark)]
        self.assertEqual([at(mark.x, mark.y) == b"\xff\xff\xff" for mark in marks[:3]], [True, False, True])


class CommittedPageTest(unittest.TestCase):
    def testThePageIsWhatItsResultsMake(self):
        self.assertEqual(document.stale(ROOT), "")

    def testEverySkipIsSwitchedOffSomewhere(self):
        sources = "".join(header.read_text() for part in ("chapters", "common") for header in (ROOT / part).rglob("*.h"))
        declared = set(re.findall(r"inline constexpr Skip \w+\{\s*\"([\w-]+)\"", sources))
        self.assertIn("kept-maps", declared)
        self.assertEqual(declared - {off.name for case in skips.CASES for off in case.off}, set())

    def testPointsHaveNamesOfTheirOwn(self):
        for quick in (True, False):
            every = [p for section in sections.ALL for p in section.points(quick)]
            self.assertTrue(every)
            self.assertEqual(len({p.id for p in every}), len(set(every)))


if __name__ == "__main__":
    unittest.main()
