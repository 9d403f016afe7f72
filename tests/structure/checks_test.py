"""The steps of ./test: each says what is wrong, and none passes when its tool fails."""
import contextlib
import io
import unittest
from unittest import mock

from temporary_tree import TreeTest

import build
import checks
import test_command
import test_page
import tidy


class FormattingTest(TreeTest):
    def outcome(self):
        said = io.StringIO()
        with mock.patch.object(checks, "ROOT", self.root), contextlib.redirect_stdout(said):
            return checks.formatting(), said.getvalue()

    def testNamesTheFileThatIsNotFormatted(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("common/a.cpp", "int a;\n")
        self.assertEqual(self.outcome(), ((1, 0), ""))
        self.write("common/b.h", "int   b;\n")
        result, said = self.outcome()
        self.assertEqual(result, (0, 1))
        self.assertIn("clang-format -i common/b.h\n", said)


class LintTest(TreeTest):
    def setUp(self):
        super().setUp()
        self.write(".clang-tidy", "Checks: '-*,modernize-use-nullptr'\nWarningsAsErrors: '*'\nHeaderFilterRegex: '.*'\n")
        self.write("common/a.h", "inline int* a() { return nullptr; }\n")
        self.write("common/a.cpp", '#include "common/a.h"\nint main() { return a() != nullptr; }\n')
        file = self.root / "common/a.cpp"
        self.write("build/release/compile_commands.json",
                   f'[{{"directory": "{self.root}", "file": "{file}", "command": "c++ -I{self.root} -c {file}"}}]')

    def complaint(self):
        return tidy.Linter(self.root, self.root / "build/release").complaint("common/a.cpp")

    def testComplainsUntilItIsMendedAndRemembersWhatPassed(self):
        self.assertEqual(self.complaint(), "")
        with mock.patch.object(tidy.subprocess, "run", wraps=tidy.subprocess.run) as ran:
            self.assertEqual(self.complaint(), "")
            self.assertEqual(ran.call_count, 1, "only the version is asked for: the file passed before")
        self.write("common/a.h", "inline int* a() { return 0; }\n")
        self.assertIn("modernize-use-nullptr", self.complaint())
        self.assertIn("modernize-use-nullptr", self.complaint(), "a complaint is not remembered as a pass")


    def testAStepThatComplainsFails(self):
        with mock.patch.object(checks, "ROOT", self.root), mock.patch.object(build, "ROOT", self.root), \
                mock.patch.object(build, "configure"), contextlib.redirect_stdout(io.StringIO()) as said:
            self.assertEqual(checks.lint(), (1, 0))
            self.write("common/a.h", "inline int* a() { return 0; }\n")
            self.assertEqual(checks.lint(), (0, 1))
        self.assertIn("modernize-use-nullptr", said.getvalue())


class ProgramsTest(TreeTest):
    """The steps that run programs, on programs that stand for ours."""

    def outcome(self, step, *words):
        with mock.patch.object(checks, "ROOT", self.root), mock.patch.object(build, "build"), \
                mock.patch.object(build, "folder", lambda preset: self.root / preset), \
                contextlib.redirect_stdout(io.StringIO()) as said, contextlib.redirect_stderr(said):
            return step(*words), said.getvalue()

    def testEveryTestIsCountedAndAFailureShown(self):
        self.write("release/CTestTestfile.cmake", 'add_test(a true)\nadd_test(b true)\n')
        self.assertEqual(self.outcome(checks.ctest, "release"), ((2, 0), ""))
        self.write("release/CTestTestfile.cmake", 'add_test(a true)\nadd_test(b sh -c "echo the reason; exit 1")\n')
        result, said = self.outcome(checks.ctest, "release")
        self.assertEqual(result, (1, 1))
        self.assertIn("the reason\nFAILED b\n", said)

    def testWhatCannotBeTestedHereIsNamedAndIsNoFailure(self):
        self.write("release/CTestTestfile.cmake",
                   'add_test(a true)\nadd_test(b sh -c "echo a_test.cpp:7: Skipped; echo no disk; echo SKIPPED")\n'
                   'set_tests_properties(b PROPERTIES SKIP_REGULAR_EXPRESSION SKIPPED)\n')
        self.assertEqual(self.outcome(checks.ctest, "release"), ((1, 0), "SKIPPED b: no disk\n"))
        self.write("release/CTestTestfile.cmake", 'add_test(a true)\nadd_test(b no_such_program)\n')
        result, said = self.outcome(checks.ctest, "release")
        self.assertEqual(result, (1, 1), "a program that is not there is none of these")
        self.assertIn("FAILED b\n", said)

    def testNoTestsAtAllAreAFailure(self):
        self.write("release/CTestTestfile.cmake", "add_test(a true)\n")
        self.assertEqual(self.outcome(checks.ctest, "release")[0], (1, 0))
        self.write("release/CTestTestfile.cmake", "")
        try:
            (_, failed), _ = self.outcome(checks.ctest, "release")
        except build.BuildError:
            failed = 1
        self.assertEqual(failed, 1, "the results of an earlier run were counted")

    def withoutOsmesa(self, backend, refusal):
        self.write("no-osmesa/bin/02_shadow_test", f'''#!/usr/bin/env python3
import json, sys
if "--backend" in sys.argv:
    sys.exit({refusal})
open(sys.argv[sys.argv.index("--report") + 1], "w").write(json.dumps({{"backend": "{backend}"}}))
''', executable=True)
        return self.outcome(checks.withoutOsmesa)[0]

    def testWithoutOsmesaEglIsChosenAndOsmesaRefused(self):
        self.assertEqual(self.withoutOsmesa("egl", '"no OSMesa in this build"'), (2, 0))
        self.assertEqual(self.withoutOsmesa("osmesa", '"no OSMesa in this build"'), (1, 1))
        self.assertEqual(self.withoutOsmesa("egl", "0"), (1, 1))
        self.assertEqual(self.withoutOsmesa("egl", '"two\\nlines"'), (1, 1))

    def testAFuzzTargetThatFindsSomethingFails(self):
        self.assertEqual(self.outcome(checks.fuzz, 1)[0], (0, 1), "no target is no pass")
        self.write("tests/fuzz/x_fuzz.cpp", "")
        self.write("fuzz/bin/fuzz_x", "#!/bin/sh\n", executable=True)
        self.assertEqual(self.outcome(checks.fuzz, 1)[0], (1, 0))
        self.write("fuzz/bin/fuzz_x", "#!/bin/sh\nexit 77\n", executable=True)
        self.assertEqual(self.outcome(checks.fuzz, 1)[0], (0, 1))

    def stressed(self, failed, status):
        """The outcome with a program that leaves a report of 30 cases; with None, none."""
        write = "" if failed is None else f'''open(sys.argv[sys.argv.index("--report") + 1], "w").write(
    json.dumps({{"cases": 30, "failed": {failed}}}))'''
        (self.root / "out").mkdir(exist_ok=True)
        self.write("release/bin/stress", f"#!/usr/bin/env python3\nimport json\nimport sys\n{write}\nsys.exit({status})\n",
                   executable=True)
        return self.outcome(checks.stress, 1)[0]

    def testStressCountsCasesAndNoReportIsNoPass(self):
        self.assertEqual(self.stressed(0, 0), (30, 0))
        self.assertEqual(self.stressed(2, 1), (28, 2))
        self.assertEqual(self.stressed(0, 1), (30, 1), "a kept case that failed")
        self.assertEqual(self.stressed(None, 1), (0, 1))


class ChoiceTest(unittest.TestCase):
    def steps(self, *words):
        return [name for name, _ in test_command.chosenSteps(test_command.parse(words))]

    def testFlagsChooseTheSteps(self):
        everything, fast = self.steps(), self.steps("--fast")
        self.assertEqual(everything[:len(fast)], fast)
        self.assertLess(len(fast), len(everything))
        for step in ("lint", "sanitizers", "without OSMesa", "fuzzing"):
            self.assertIn(step, everything)
        self.assertEqual(self.steps("--sanitize"), ["sanitizers"])
        self.assertEqual(self.steps("--fuzz", "0"), ["fuzzing"])
        self.assertEqual(self.steps("--stress"), ["numerical stress"])
        self.assertEqual(self.steps("--stress", "7"), ["numerical stress"])
        self.assertEqual(self.steps("03")[0], "tests of 03_polygon_offset")


class TotalsTest(unittest.TestCase):
    def perform(self, *steps):
        with contextlib.redirect_stdout(io.StringIO()):
            return test_command.perform([(step.__name__, step) for step in steps])

    def testAFailingStepDoesNotStopTheOthers(self):
        def good():
            return 3, 0

        def broken():
            raise build.BuildError("no compiler")

        self.assertEqual(self.perform(good, broken, good), (6, 1))

    def testAProcessThatFailsIsAFailure(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            self.assertEqual(checks.judge("x", checks.run(["sh", "-c", "echo why >&2; exit 3"])), (0, 1))
        self.assertIn("why\nFAILED x (status 3)", said.getvalue())
        self.assertEqual(checks.judge("x", checks.run(["true"])), (1, 0))


class PageTest(TreeTest):
    def testShowsFailuresFirstWithTheirWorstPixels(self):
        common = '"test": "T.t", "pixels": 4, "excluded": 1'
        self.write("out/test/03_a/good/record.json", '{"name": "03_a/good", "passed": true, ' + common + ', "bounds": '
                   '[{"name": "rmse", "measured": 0.1, "bound": 0.2, "kept": true}], "worst": []}')
        self.write("out/test/03_a/bad/record.json", '{"name": "03_a/bad", "passed": false, ' + common + ', "bounds": '
                   '[{"name": "max_abs", "measured": 0.5, "bound": 0.2, "kept": false}], '
                   '"worst": [{"x": 7, "y": 9, "actual": null, "exact": 0.25}]}')
        self.write("out/test/03_a/bad/actual.png", "")
        self.write("out/test/03_b/record.json", '{"name": "03_b", "passed": false, "test": "T.u", "problem": "<sizes>"}')
        with mock.patch.object(test_page, "FOLDER", self.root / "out/test"), contextlib.redirect_stdout(io.StringIO()):
            test_page.write()
        page = self.read("out/test/index.html")
        self.assertIn("3 comparisons with exact answers, 2 failed", page)
        self.assertIn('<img src="03_a/bad/actual.png"', page)
        self.assertIn("<td>7, 9</td><td>NaN</td><td>0.25</td>", page)
        self.assertIn("<span class=broken>max_abs 0.5 of 0.2</span>", page)
        self.assertIn("&lt;sizes&gt;", page)
        self.assertLess(page.index("03_a/bad</h3>"), page.index("03_a/good"))


if __name__ == "__main__":
    unittest.main()
