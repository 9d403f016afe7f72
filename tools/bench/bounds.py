"""./run bench --check: ratios that the project promises, against bounds in bounds.json.

An entry of bounds.json has

    name, what, issue       what is promised, in a few words and in a sentence; the issue that asks for it
    at_least or at_most     the bound of the ratio
    program, find           a benchmark of tests/bench with its arguments, and what to look for in what it prints: a regular
                            expression with the group `ratio`, or with `over` and `under`; of several lines the worst counts
    over, under, figure     or two points of a section by their ids, and which figure of them is divided (cpu_ms)

Ratios are of one run, so that another machine, or a busy one, moves both sides. A bound states what is asked for, also where
today falls short of it.
"""
import json
import re
import shlex
import subprocess
import sys

import build
import tables
from bench import sections
from bench.measuring import Measuring
from bench.progress import Progress


class BoundError(Exception):
    """A bound could not be measured; said in its line."""


def load():
    return json.loads((build.ROOT / "tools" / "bench" / "bounds.json").read_text())


def programs():
    """What has to be built."""
    return list(dict.fromkeys(shlex.split(bound["program"])[0] for bound in load() if "program" in bound))


def output(command, known):
    """What a benchmark prints; each command line is run once. Throws BoundError."""
    if command not in known:
        words = shlex.split(command)
        ran = subprocess.run([build.folder("release") / "bin" / words[0], *words[1:]], cwd=build.ROOT, capture_output=True,
                             text=True, errors="replace")
        if ran.returncode != 0:
            raise BoundError((ran.stderr.strip() or f"no message; status {ran.returncode}").splitlines()[-1])
        known[command] = ran.stdout
    return known[command]


def printedRatios(bound, said):
    """Every ratio that a program printed. Throws BoundError."""
    found = []
    for match in re.finditer(bound["find"], said, re.MULTILINE):
        groups = match.groupdict()
        found.append(float(groups["ratio"]) if "ratio" in groups else float(groups["over"]) / float(groups["under"]))
    if not found:
        raise BoundError(f"`{bound['program']}` printed nothing like {bound['find']}")
    return found


def worst(bound, ratios):
    return min(ratios) if "at_least" in bound else max(ratios)


def holds(bound, ratio):
    return ratio >= bound["at_least"] if "at_least" in bound else ratio <= bound["at_most"]


def pointResults(bounds):
    """{id: result} of the points that bounds divide, measured now if they were not. Throws BoundError for an unknown id."""
    wanted = {bound[side] for bound in bounds if "over" in bound for side in ("over", "under")}
    known = {point.id: point for section in sections.ALL for point in section.points(False)}
    if unknown := sorted(wanted - set(known)):
        raise BoundError(f"no section has a point {unknown[0]}: mend tools/bench/bounds.json")
    measuring = Measuring([known[name] for name in sorted(wanted)], False, Progress())
    measuring.run()
    return {result["id"]: result for result in measuring.results()}


def dividedPoints(bound, results):
    try:
        return [results[bound["over"]][bound["figure"]] / results[bound["under"]][bound["figure"]]]
    except KeyError as missing:
        raise BoundError(f"{missing} could not be measured") from None


def evaluate(bounds, progress):
    """[(bound, ratio or None, why not), ...] in the order of the file."""
    known, results, found = {}, pointResults(bounds), []
    for i, bound in enumerate(bounds):
        progress.show(i, len(bounds), 0.0, bound.get("program", bound["name"]))
        try:
            ratios = (printedRatios(bound, output(bound["program"], known)) if "program" in bound
                      else dividedPoints(bound, results))
            found.append((bound, worst(bound, ratios), ""))
        except BoundError as problem:
            found.append((bound, None, str(problem)))
    progress.clear()
    return found


def row(bound, ratio, problem):
    asked = f">= {bound['at_least']:g}" if "at_least" in bound else f"<= {bound['at_most']:g}"
    verdict = "not measured" if ratio is None else "holds" if holds(bound, ratio) else "FALLS SHORT"
    measured = "–" if ratio is None else f"{ratio:.3g}"
    return [bound["name"], measured, asked, verdict, str(bound["issue"]), problem or bound["what"]]


def check():
    """Prints every ratio; exit status 1 when one falls short or could not be measured."""
    try:
        found = evaluate(load(), Progress())
    except BoundError as problem:
        print(problem, file=sys.stderr)
        return 1
    print(tables.markdown(["ratio", "measured", "asked", "", "issue", "what"], [row(*entry) for entry in found]))
    short = [bound["name"] for bound, ratio, _ in found if ratio is None or not holds(bound, ratio)]
    print(f"{len(found) - len(short)} of {len(found)} hold" + (f"; short: {', '.join(short)}" if short else ""))
    return 1 if short else 0
