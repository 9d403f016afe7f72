"""docs/stress.md is what its report says, and the page says what a report can say."""
import json
import unittest

from temporary_tree import ROOT

import stress_page

REPORT = {
    "schema": 1, "seed": 7, "cases": 30, "refused": 2, "failed": 1, "seconds": 2.0, "cpu_seconds": 1.5, "cases_per_second": 15,
    "axes": [{"name": "aside", "unit": "metres", "help": "how far"}, {"name": "unused", "unit": "", "help": "nobody has it"}],
    "subjects": [{
        "name": "bias", "claim": "no acne", "cases": 30, "refused": 2, "failed": 1, "refusals": {"too far": 2},
        "worst": [{"name": "dark pixels", "value": 3.0, "command": "stress --subject bias"}],
        "failures": [{"what": "dark pixels: 3", "command": "stress --subject bias --aside 1", "drawn": "longer"}],
        "bins": {"aside": [
            {"from": "0", "cases": 20, "refused": 0, "failed": 0, "worst": {"dark, however far aside": 0.0}},
            {"from": "1", "cases": 10, "refused": 2, "failed": 1, "worst": {"dark, however far aside": 0.25}}]},
    }],
}


class StressPageTest(unittest.TestCase):
    def testThePageIsMadeOfItsReport(self):
        report = json.loads((ROOT / stress_page.REPORT).read_text())
        self.assertEqual((ROOT / stress_page.PAGE).read_text(), stress_page.pageOf(report),
                         "run tools/stress_page.py docs/stress.json")
        self.assertEqual(report["failed"], 0)
        self.assertFalse(report["interrupted"])
        self.assertGreaterEqual(report["cases"], 100000)

    def testSaysWhatFailedAndHowToRunItAgain(self):
        page = stress_page.pageOf(REPORT)
        self.assertIn("* dark pixels: 3\n  `stress --subject bias --aside 1`", page)
        self.assertIn("1 failed", page)
        self.assertIn("| `bias` | no acne | 30 | 2 | 1 |", page)
        self.assertIn("| `bias` | too far | 2 |", page)

    def testCountsByPieceAndSaysWhereFloatsEnd(self):
        page = stress_page.pageOf(REPORT)
        self.assertIn("**`--aside`** (metres): how far\n\n| 0 | 1 |\n|---|---|\n| 20 | 10 |", page)
        self.assertIn("| 1 | 10 | 0.25 |", page)
        self.assertNotIn("unused", page)

    def testExplainsTheSubjectsThatItHas(self):
        self.assertNotIn("## Leaks", stress_page.pageOf(REPORT))
        report = json.loads(json.dumps(REPORT))
        gap = "gap that shadows, of the scene's size"
        leak = {"name": "leak", "claim": "shadows", "cases": 9, "refused": 4, "failed": 0, "refusals": {}, "failures": [],
                "worst": [],
                "bins": {"light-angle": [{"from": "80.91", "cases": 9, "refused": 4, "failed": 0, "worst": {gap: 0.06}}]}}
        gained = {"name": "accumulation", "claim": "no light", "cases": 1, "refused": 0, "failed": 0, "refusals": {},
                  "failures": [], "bins": {},
                  "worst": [{"name": "light gained by a shadow, over the rounding", "value": 0.077, "command": "x"},
                            {"name": "visibility above 1", "value": 0, "command": "x"}]}
        kernel = {"name": "kernel", "claim": "share", "cases": 1, "refused": 0, "failed": 0, "refusals": {}, "failures": [],
                  "bins": {}, "worst": [{"name": "beside, over its rounding", "value": 0.5, "command": "x"}]}
        report["subjects"] += [leak, gained, kernel]
        page = stress_page.pageOf(report)
        self.assertIn("| 80.91 | 9 | 4 | 0.06 | 0 |", page)
        self.assertIn("| light gained by a shadow, over the rounding | 0.077 |\n", page)
        self.assertNotIn("| visibility above 1 | 0 |\n", page)
        self.assertIn("| `kernel` | beside, over its rounding | 0.5 |", page)

    def testAReportWithoutFailuresHasNoSuchHeading(self):
        quiet = json.loads(json.dumps(REPORT))
        quiet["failed"] = 0
        quiet["subjects"][0].update(failures=[], refusals={})
        page = stress_page.pageOf(quiet)
        self.assertIn("nothing failed", page)
        self.assertNotIn("## What failed", page)
        self.assertNotIn("## What is refused", page)


if __name__ == "__main__":
    unittest.main()
