"""./run bench --check: ratios that the project promises, against bounds in bounds.json.

An entry of bounds.json has

    name, what, page        what is promised, in a few words and in a sentence; the page of docs/ that explains it
    at_least or at_most     the bound of the ratio
    program, find           a benchmark of tests/bench with its arguments, and what to look for in what it prints: a regular
                            expression with the group `ratio`, or with `over` and `under`; of several lines the worst counts
    over, under, figure     or two points of a section by their ids, and which figure of them is divided (cpu_ms)

Both sides of a ratio are of one run, so that another machine, or a busy one, moves both. All programs are run in turn, and
again while there is time: of a bound's rounds the median counts, and the table shows the least and the most of them. A bound
states what is promised, also where today falls short of it.
"""
import json
import re
import shlex
import statistics
import subprocess
import sys
import time

import build
import tables
from bench import sections
from bench.measuring import Measuring
from bench.progress import Progress
from bench.runner import LIMIT_S, endOf

ROUNDS = 3
BUDGET_S = 900  # a round that would take longer is left out; the first one is not


class BoundError(Exception):
    """A bound could not be measured; said in its line."""


def load():
    return json.loads((build.ROOT / "tools" / "bench" / "bounds.json").read_text())


def programs():
    """What has to be built."""
    return list(dict.fromkeys(shlex.split(bound["program"])[0] for bound in load() if "program" in bound))


def output(command):
    """What a benchmark prints. Throws BoundError."""
    words = shlex.split(command)
    try:
        ran = subprocess.run([build.folder("release") / "bin" / words[0], *words[1:]], cwd=build.ROOT, capture_output=True,
                             text=True, errors="replace", timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        raise BoundError(f"`{command}` took longer than {LIMIT_S} s") from None
    if ran.returncode != 0:
        raise BoundError((ran.stderr.strip() or endOf(ran.returncode)).splitlines()[-1])
    return ran.stdout


def rounds(commands, progress):
    """{command: [what it printed in each round] or the BoundError that ended it}: all in turn, again while there is time."""
    began, took, said = time.monotonic(), {}, {command: [] for command in commands}
    for number in range(ROUNDS):
        left = [command for command in commands if isinstance(said[command], list)]
        if number and time.monotonic() - began + sum(took[command] for command in left) > BUDGET_S:
            progress.say(f"{BUDGET_S // 60} minutes would be over: {ROUNDS - number} of {ROUNDS} rounds are left out")
            break
        for i, command in enumerate(left):
            later = sum(took.get(other, 30.0) for other in left[i:]) + (ROUNDS - number - 1) * sum(
                took.get(other, 30.0) for other in left)
            progress.show(number * len(left) + i, ROUNDS * len(left), later, f"round {number + 1}, {command}")
            started = time.monotonic()
            try:
                said[command].append(output(command))
            except BoundError as problem:
                said[command] = problem
            took[command] = time.monotonic() - started
    progress.clear()
    return said


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
    if not wanted:
        return {}
    measuring = Measuring([known[name] for name in sorted(wanted)], False, Progress())
    measuring.run()
    return {result["id"]: result for result in measuring.results()}


def dividedPoints(bound, results):
    try:
        return [results[bound["over"]][bound["figure"]] / results[bound["under"]][bound["figure"]]]
    except KeyError as missing:
        raise BoundError(f"{missing} could not be measured") from None


def ratiosOf(bound, said, results):
    """One for each round. Throws BoundError."""
    if "program" not in bound:
        return dividedPoints(bound, results)
    printed = said[bound["program"]]
    if isinstance(printed, BoundError):
        raise printed
    return [worst(bound, printedRatios(bound, text)) for text in printed]


def evaluate(bounds, progress):
    """[(bound, ratios of its rounds, why there are none), ...] in the order of the file."""
    results, found = pointResults(bounds), []
    said = rounds(list(dict.fromkeys(bound["program"] for bound in bounds if "program" in bound)), progress)
    for bound in bounds:
        try:
            found.append((bound, ratiosOf(bound, said, results), ""))
        except BoundError as problem:
            found.append((bound, [], str(problem)))
    return found


def verdict(bound, ratios):
    if not ratios:
        return "not measured"
    return "holds" if holds(bound, statistics.median(ratios)) else "FALLS SHORT"


def row(bound, ratios, problem):
    asked = f">= {bound['at_least']:g}" if "at_least" in bound else f"<= {bound['at_most']:g}"
    measured = f"{statistics.median(ratios):.3g}" if ratios else "–"
    spread = f"{min(ratios):.3g} … {max(ratios):.3g}" if len(ratios) > 1 else "–"
    return [bound["name"], measured, spread, asked, verdict(bound, ratios), f"docs/{bound['page']}.md",
            problem or bound["what"]]


def check():
    """Prints every ratio; exit status 1 when one falls short or could not be measured."""
    try:
        found = evaluate(load(), Progress())
    except BoundError as problem:
        print(problem, file=sys.stderr)
        return 1
    print(tables.markdown(["ratio", "measured", "least … most", "bound", "", "explained in", "what"],
                          [row(*entry) for entry in found]))
    short = [bound["name"] for bound, ratios, _ in found if verdict(bound, ratios) != "holds"]
    print(f"{len(found) - len(short)} of {len(found)} hold" + (f"; short: {', '.join(short)}" if short else ""))
    return 1 if short else 0
