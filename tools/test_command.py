"""./test: tests everything the project promises.

    ./test                  everything, from nothing in under 25 minutes on two cores
    ./test --fast           unit, image and structure tests, pages and format; under 3 minutes after a build
    ./test 03               the tests of one chapter, and its page
    ./test --sanitize       unit tests (hostile files among them) under AddressSanitizer and UBSan
    ./test --fuzz SECONDS   libFuzzer on everything that reads a file
    ./test --endurance      10 000 frames of all chapters in one process, and 200 kills while files are written
    ./test --stress         numerical stress: 100 000 cases, an hour or two; a failing one is printed as a command line
    ./test --stress 7       the same with another seed, other cases
    ./test --help

The first run installs what is missing (as root, or with sudo) and builds. A failing image test leaves the picture, the
exact one, the error x10 and the ten worst pixels; out/test/index.html shows them and every comparison that was made. The
last line is the total, and the exit status is 1 when anything failed.
"""
import argparse
import sys
import time

import build
import checks
import house
import test_page

FUZZ_SECONDS = 20
STRESS_SEED = 1  # of docs/stress.md


def everything():
    """The steps of a full run in order: (name, function that returns (passed, failed)). `--fast` takes the first ones."""
    return [
        ("unit, image and structure tests", lambda: checks.ctest("release")),
        ("pages", lambda: checks.pages(["--check"])),
        ("format", checks.formatting),
        ("lint", checks.lint),
        ("sanitizers", checks.sanitizers),
        ("without OSMesa", checks.withoutOsmesa),
        ("fuzzing", lambda: checks.fuzz(FUZZ_SECONDS)),
    ]


def fast():
    return [
        ("unit, image and structure tests", lambda: checks.ctest("release", ["-LE", "slow"])),
        ("pages", lambda: checks.pages(["--check", "--fast"])),
        ("format", checks.formatting),
    ]


def ofChapter(name):
    page = f"docs/{name}.md"
    return [
        (f"tests of {name}", lambda: checks.ctest("release", ["-R", name])),
        ("page", lambda: checks.pages(["--check", page])),
    ]


def perform(steps):
    """Runs all steps, whatever happens to one; returns the totals."""
    passed = failed = 0
    for name, step in steps:
        print(f"== {name}", flush=True)
        started = time.monotonic()
        try:
            good, bad = step()
        except build.BuildError as problem:
            print(problem)
            good, bad = 0, 1
        print(f"   {good} passed, {bad} failed, {time.monotonic() - started:.0f} s", flush=True)
        passed, failed = passed + good, failed + bad
    return passed, failed


def chosenSteps(options):
    if options.fuzz is not None:
        return [("fuzzing", lambda: checks.fuzz(options.fuzz))]
    if options.endurance:
        return [("endurance", checks.endurance)]
    if options.stress is not None:
        return [("numerical stress", lambda: checks.stress(options.stress))]
    if options.sanitize:
        return [("sanitizers", checks.sanitizers)]
    if options.chapter:
        return ofChapter(house.findChapter(build.ROOT, options.chapter))
    return fast() if options.fast else everything()


def parse(words):
    """Leaves with status 2 when they are wrong."""
    parser = argparse.ArgumentParser(prog="./test", description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("chapter", nargs="?", help="number or name of one chapter")
    parser.add_argument("--fast", action="store_true", help="what is quick to run")
    parser.add_argument("--sanitize", action="store_true", help="only the sanitizers")
    parser.add_argument("--endurance", action="store_true", help="only the long form of the endurance and kill tests")
    parser.add_argument("--fuzz", type=int, metavar="SECONDS", help="only fuzzing, for so long")
    parser.add_argument("--stress", type=int, nargs="?", const=STRESS_SEED, metavar="SEED", help="only numerical stress, for long")
    options = parser.parse_args(words)
    if options.chapter and not house.findChapter(build.ROOT, options.chapter):
        parser.error(f"there is no chapter {options.chapter}; there are {', '.join(house.chapterNames(build.ROOT))}")
    return options


def main(words):
    options = parse(words)
    build.install("test")
    test_page.clear()
    passed, failed = perform(chosenSteps(options))
    test_page.write()
    print(f"{passed} passed, {failed} failed", flush=True)
    return 1 if failed or not passed else 0


def guarded(words):
    try:
        return main(words)
    except (build.BuildError, OSError) as problem:
        print(build.reason(problem), file=sys.stderr)
        print("0 passed, 1 failed")
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(guarded(sys.argv[1:]))
