"""./run bench: which files a run writes, what it says, and what stays on the page from another day."""
import contextlib
import io
import types
import unittest
from unittest import mock

from bench_tree import BenchTest, point

from bench import command, document, error, held, results, runner, sections
from bench.points import Point
from bench.runner import PointError


class CommandTest(BenchTest):
    def run_(self, *words, points=(point(2), point(4))):
        said = io.StringIO()
        with mock.patch.object(error, "points", lambda quick: list(points)), contextlib.redirect_stdout(said), \
                contextlib.redirect_stderr(said), mock.patch.object(sections, "ALL", [error]):
            return command.run(command.parse(list(words))), said.getvalue()

    def testAWholeRunWritesThePage(self):
        self.write("docs/images/x", "")
        status, said = self.run_()
        self.assertEqual(status, 0, said)
        self.assertEqual(document.stale(self.root), "")
        for path in ("out/benchmark.html", "out/bench/results.csv", "out/bench/results.json",
                     "out/bench/error_area_knot.png", "out/bench/error_area_knot.svg"):
            self.assertTrue((self.root / path).is_file(), path)

    def testAQuickOrPartialRunDoesNot(self):
        self.assertEqual(self.run_("--quick")[0], 0)
        self.assertFalse((self.root / "docs/benchmark.md").exists())
        other = point(4, scene="contact")
        status, said = self.run_("--scene", "knot", points=(point(2), other))
        self.assertIn("1 points are not measured yet", said)
        self.assertFalse((self.root / "docs/benchmark.md").exists())

    def testAFailureFailsTheRun(self):
        status, said = self.run_(points=(point(2), point(13)))
        self.assertEqual(status, 1)
        self.assertIn("failed: error/knot/area/00 rays/samples=13: no luck with thirteen", said)
        self.assertTrue((self.root / "out/benchmark.html").is_file())

    def testAnInterruptSaysThatTheSameCommandGoesOn(self):
        with mock.patch.object(runner, "measure", side_effect=KeyboardInterrupt):
            status, said = self.run_()
        self.assertEqual(status, 130)
        self.assertIn("the same command goes on from there", said)

    def testNothingToMeasureIsAWrongCommandLine(self):
        status, said = self.run_("--quick", points=())
        self.assertEqual(status, 2)
        self.assertIn("in --quick: leave it out", said)

    def testAWrongCommandLine(self):
        for words in (["--section", "none"], ["--scene", "none"], ["--fast"], ["--check", "--quick"], ["--check", "--scene", "knot"]):
            with self.subTest(words), contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit) as left:
                command.parse(words)
            self.assertEqual(left.exception.code, 2)


def programs(values=(2, 4)):
    """A section on request, as `peers` is."""
    made = [Point("peers", "knot", "Cycles", "blender", "samples", value, (), "soft shadow") for value in values]
    said = lambda r: f"Cycles {r['value']}: {r['wall_ms']}"  # noqa: E731
    page = lambda found: (["## Other programs", "", *map(said, found)], [])  # noqa: E731
    return types.SimpleNamespace(NAME="peers", ON_REQUEST=True, points=lambda quick: made, page=page, ms=5.0,
                                 measure=lambda point: sample(programs.ms))


def sample(ms):
    return {"wall_ms": ms, "wall_min_ms": ms, "cpu_ms": ms, "cpu_min_ms": ms, "runs": 1, "error": None, "work": {}}


class OnRequestTest(BenchTest):
    """What other programs take is measured now and then; the page keeps it, with its own day, until it is measured again."""

    def run_(self, *words, others, commit="aaa", changed=False, ms=5.0):
        programs.ms = ms
        if changed:
            self.write("shaders/a.glsl", f"// {commit}")
            self.forget()
        said = io.StringIO()
        about = lambda found: {"processor": "P", "cores": 2, "renderer": "R", "date": "D", "commit": commit,  # noqa: E731
                               "load": 0.5}
        with mock.patch.object(error, "points", lambda quick: [point(2)]), contextlib.redirect_stdout(said), \
                contextlib.redirect_stderr(said), mock.patch.object(sections, "ALL", [error, others]), \
                mock.patch.object(results, "machine", about):
            self.assertEqual(command.run(command.parse(list(words))), 0, said.getvalue())
            self.assertEqual(document.stale(self.root) if (self.root / "docs/benchmark.md").exists() else "", "")
        return said.getvalue()

    def setUp(self):
        super().setUp()
        self.write("docs/images/x", "")

    def page(self):
        return self.read("docs/benchmark.md")

    def testALaterRunKeepsThemWithTheirOwnDay(self):
        self.run_(others=programs())
        self.assertNotIn("Other programs", self.page())
        self.run_("--peers", others=programs(), commit="bbb")
        self.assertIn("Measured with `./run bench --peers` on P (2 cores), R, D, commit bbb; load average 0.5.", self.page())
        self.assertIn("Cycles 2: 5.0", self.page())
        self.run_(others=programs(), commit="ccc", changed=True, ms=7.0)
        self.assertIn("commit ccc", self.page())
        self.assertIn("--peers` on P (2 cores), R, D, commit bbb", self.page())
        self.assertIn("Cycles 4: 5.0", self.page())
        self.assertIn("1 points on `knot`", self.page(), "theirs are not counted among ours")

    def testMeasuringThemAgainLeavesTheRestAsItIs(self):
        self.run_(others=programs(), commit="aaa")
        said = self.run_("--peers", others=programs(), commit="bbb", changed=True, ms=9.0)
        self.assertIn("still of D", said)
        self.assertIn("Measured on P (2 cores), R, D, commit aaa", self.page())
        self.assertIn("Cycles 2: 9.0", self.page())

    def testFewerNewOnesDoNotTakeThePlaceOfAll(self):
        self.run_(others=programs())
        self.run_("--peers", others=programs(), commit="bbb")
        fewer = programs()
        fewer.measure = mock.Mock(side_effect=[sample(9.0), *4 * [PointError("no")]])
        programs.ms = 9.0
        self.write("shaders/a.glsl", "// other")
        self.forget()
        with mock.patch.object(sections, "ALL", [error, fewer]), contextlib.redirect_stderr(io.StringIO()):
            self.measure(fewer.points(False))
            self.assertEqual([r["wall_ms"] for r in held.requested(fewer, held.page())[1]], [5.0, 5.0])


if __name__ == "__main__":
    unittest.main()
