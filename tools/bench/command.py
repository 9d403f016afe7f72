"""./run bench: the command line, and what happens in which order.

    ./run bench                     every section: out/benchmark.html, out/bench/, and docs/benchmark.md; under 30 minutes
    ./run bench --quick             three scenes, few settings: out/ only, under 3 minutes
    ./run bench --section NAME      only this section; may be repeated
    ./run bench --scene NAME        only this scene; may be repeated
    ./run bench --peers             instead other programs that estimate the same, installed from Debian's packages
    ./run bench --check             compare ratios with tools/bench/bounds.json; exit 1 and say which fell short

What was measured is kept in out/bench/results.jsonl and measured again only when a program, shader or asset has changed: a
run that was interrupted goes on where it was. docs/benchmark.md is written when every point of every section is there; what
it says of other programs stays, with its own date, until --peers measures them again.
"""
import argparse
import contextlib
import sys
import time

import build
from bench import bounds, document, files, held, results, sections, store
from bench.measuring import Measuring
from bench.progress import Progress, clock


def parse(words):
    """Leaves with status 2 when they are wrong."""
    parser = argparse.ArgumentParser(prog="./run bench", description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="few points of three scenes")
    parser.add_argument("--check", action="store_true", help="ratios against their bounds")
    parser.add_argument("--peers", action="store_true", help="what other programs make of the same")
    parser.add_argument("--section", action="append", choices=sections.names(), help="only this one")
    parser.add_argument("--scene", action="append", metavar="NAME", help="only this one")
    options = parser.parse_args(words)
    options.bench = True
    if options.check and (options.quick or options.peers or options.section or options.scene):
        parser.error("argument --check: measures what bounds.json names, and goes with no other flag")
    scenes = {point.scene for section in sections.ALL for point in section.points(False)}
    for scene in options.scene or ():
        if scene not in scenes:
            parser.error(f"argument --scene: no point has scene {scene}; there are {', '.join(sorted(scenes))}")
    return options


def chosenSections(options):
    names = [*(options.section or []), *(["peers"] if options.peers else [])]
    if names:
        return [section for section in sections.ALL if section.NAME in names]
    return [section for section in sections.ALL if not held.onRequest(section)]


def pointsOf(options):
    """Each once: two sections may ask for the same."""
    every = [point for section in chosenSections(options) for point in section.points(options.quick)]
    return [point for point in dict.fromkeys(every) if not options.scene or point.scene in options.scene]


def writeUp(options, measured):
    """The files of what was asked for, and docs/ when nothing is missing there."""
    machine = results.machine(measured)
    page, figures = document.made(machine, measured)
    print(f"{files.write(machine, measured, page, figures)}: {len(measured)} points")
    if options.quick:
        return
    machine, found, missing = held.content(held.page())
    if missing and not (machine and any(map(held.onRequest, chosenSections(options)))):
        print(f"docs/benchmark.md stays as it is: {missing} points are not measured yet (./run bench does)")
        return
    print(f"{document.write(machine, found)}: {len(found)} points" + (
        f", of which those of ./run bench are still of {machine['date']}" if missing else ""))


def run(options):
    """Exit status."""
    if options.check:
        with contextlib.suppress(build.BuildError):  # nobody may install here: a benchmark says which mesh it leaves out
            build.install("bench")
        return bounds.check()
    for section in chosenSections(options):
        getattr(section, "prepare", lambda: None)()
    started, points = time.monotonic(), pointsOf(options)
    if not points:
        print("./run bench: no section has a point of this scene" + (" in --quick: leave it out" if options.quick else ""),
              file=sys.stderr)
        return 2
    measuring = Measuring(points, options.quick, Progress())
    try:
        measuring.run()
    except KeyboardInterrupt:
        print(f"\ninterrupted after {clock(time.monotonic() - started)}; what was measured is in {store.path()}, and the "
              "same command goes on from there", file=sys.stderr)
        return 130
    measured = measuring.results()
    if measured:
        writeUp(options, measured)
    for point, problem in measuring.failures.items():
        print(f"failed: {point.id}: {problem}", file=sys.stderr)
    print(f"{measuring.made} runs in {clock(time.monotonic() - started)}", file=sys.stderr)
    return 1 if measuring.failures else 0


def targets(options, chapters):
    """What has to be built first."""
    return [*chapters, "make_assets", *(bounds.programs() if options.check else ())]


def main(options, chapters):
    build.build("release", targets(options, chapters))
    return run(options)
