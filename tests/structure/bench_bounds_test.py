"""./run bench --check: ratios are found, the median of the rounds counts, and what falls short is said and fails."""
import contextlib
import io
import json
import unittest
from unittest import mock

from bench_tree import BenchTest, point
from temporary_tree import ROOT

import build
from bench import bounds, error, sections


class BoundsTest(BenchTest):
    def check(self, entries, said=""):
        self.write("tools/bench/bounds.json", json.dumps(entries))
        self.write("build/release/bin/a_bench", f"#!/usr/bin/env python3\nprint({said!r})\n", executable=True)
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            return bounds.check(), out.getvalue()

    def entry(self, **more):
        return {"name": "n", "what": "w", "page": "00_a", "program": "a_bench 7",
                "find": r"^a (?P<over>\S+) (?P<under>\S+)$", **more}

    def testTheWorstOfSeveralLinesCounts(self):
        said = "a 6 2\nb 1 1\na 10 2"
        self.assertEqual(self.check([self.entry(at_least=3)], said)[0], 0)
        status, printed = self.check([self.entry(at_least=4)], said)
        self.assertEqual(status, 1)
        self.assertIn("FALLS SHORT", printed)
        self.assertIn("0 of 1 hold; short: n", printed)
        self.assertEqual(self.check([self.entry(at_most=5)], said)[0], 0)
        self.assertEqual(self.check([self.entry(at_most=4.9)], said)[0], 1)

    def testARatioThatIsNotPrintedIsNoRatio(self):
        status, printed = self.check([self.entry(at_least=0)], "nothing")
        self.assertEqual(status, 1)
        self.assertIn("printed nothing like", printed)

    def testProgramsTakeTurnsAndTheMedianRoundCounts(self):
        for name in ("a_bench", "b_bench"):  # says 1, then 5, then 3
            self.write(f"build/release/bin/{name}", "#!/bin/sh\necho $0 >> turns\n"
                       f"echo ratio $(sed -n \"$(grep -c {name} turns)p\" said)\n", executable=True)
        self.write("said", "1\n5\n3\n")
        self.write("tools/bench/bounds.json", json.dumps([self.entry(program=f"{name}_bench", find=r"ratio (?P<ratio>\S+)",
                                                                     name=name, at_least=bound)
                                                          for name, bound in (("a", 3), ("b", 4))]))
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            self.assertEqual(bounds.check(), 1)
        self.assertEqual([line[-7:-6] for line in self.read("turns").split()], list("ababab"))
        self.assertIn("| a | 3 | 1 … 5 | >= 3 | holds | docs/00_a.md | w |", out.getvalue())
        self.assertIn("short: b", out.getvalue())

    def testRoundsEndWhenTheTimeIsOverAndTheFirstOneDoesNot(self):
        with mock.patch.object(bounds, "BUDGET_S", 0):
            status, printed = self.check([self.entry(at_least=3)], "a 6 2")
        self.assertEqual(status, 0)
        self.assertIn("2 of 3 rounds are left out", printed)
        self.assertIn("| n | 3 | – |", printed)

    def testAProgramThatFailsOrHangsIsSaidAndNotRunAgain(self):
        entries = [self.entry(at_least=3)]
        self.write("tools/bench/bounds.json", json.dumps(entries))
        for script, why in (("echo no luck >&2; exit 3", "no luck"), ("kill -9 $$", "killed"),
                            ("exec sleep 60", "took longer")):
            self.write("build/release/bin/a_bench", f"#!/bin/sh\necho x >> tries\n{script}\n", executable=True)
            out = io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out), mock.patch.object(bounds, "LIMIT_S", 0.5):
                self.assertEqual(bounds.check(), 1)
            self.assertIn(why, out.getvalue())
            self.assertIn("not measured", out.getvalue())
        self.assertEqual(self.read("tries"), "x\nx\nx\n")

    def testPointsAreDivided(self):
        entry = {"name": "n", "what": "w", "page": "00_a", "over": point(8).id, "under": point(4).id, "figure": "cpu_ms"}
        with mock.patch.object(error, "points", lambda quick: [point(4), point(8)]):
            self.assertEqual(self.check([{**entry, "at_most": 2}])[0], 0)
            self.assertEqual(self.check([{**entry, "at_most": 1.9}])[0], 1)
            self.assertIn("mend tools/bench/bounds.json", self.check([{**entry, "over": "x", "at_most": 1}])[1])

    def testTheProjectsBoundsNameProgramsAndPointsThatExist(self):
        with mock.patch.object(build, "ROOT", ROOT):
            known = {p.id for section in sections.ALL for p in section.points(False)}
            for bound in bounds.load():
                with self.subTest(bound["name"]):
                    self.assertEqual(len({"at_least", "at_most"} & set(bound)), 1)
                    self.assertTrue((ROOT / "docs" / f"{bound['page']}.md").is_file())
                    if "program" in bound:
                        name = bound["program"].split()[0]
                        self.assertTrue((ROOT / "tests" / "bench" / f"{name}.cpp").is_file())
                        self.assertRegex(bound["find"], r"\(\?P<(ratio|over)>")
                    else:
                        self.assertLessEqual({bound["over"], bound["under"]}, known)


if __name__ == "__main__":
    unittest.main()
