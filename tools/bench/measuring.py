"""All points, pass after pass: noise of the machine hits all alike, since the repeats of one point lie minutes apart."""
import os
import time
from datetime import datetime, timezone

from bench import results, runner, sections, store
from bench.runner import PointError

MOST_PASSES = {False: 3, True: 2}  # by `quick`
SLOW_S, VERY_SLOW_S = 1.0, 5.0     # of a process without exact answer: twice, once
BUDGET_S = {False: 1620, True: 165}  # a repeat that would take longer is left for the next run, which goes on from there


def passesFor(samples, quick):
    """How many a point gets, once its first sample tells how long it takes."""
    if not samples:
        return 1
    first = samples[0]
    seconds = 1e-3 * (first.get("setup_ms", 0.0) + 2.0 * first["wall_ms"])
    return min(MOST_PASSES[quick], 1 if seconds > VERY_SLOW_S else 2 if seconds > SLOW_S else 3)


def measureOnce(point, samples):
    section = sections.named(point.section)
    if hasattr(section, "measure"):
        return section.measure(point)
    # The exact answer does not change from pass to pass: once is enough.
    compared = any(s.get("compared") for s in samples)
    return runner.measure(point, runner.frames(point, samples[0] if samples else None), point.compare and not compared)


class Measuring:
    """Goes through the points and keeps what it finds. `samples`: {point: [dict]}; `failures`: {point: why}."""

    def __init__(self, points, quick, progress):
        held = store.load()
        self.quick, self.progress = quick, progress
        self.keys = {point: store.digest(point) for point in points}
        self.samples = {point: list(held.get((point.id, self.keys[point]), [])) for point in points}
        self.failures = {}
        self.spent, self.made = 0.0, 0

    def wanted(self, number):
        """Points that lack pass `number`, counted from 0."""
        return [point for point, samples in self.samples.items()
                if point not in self.failures and number >= len(samples) and number < passesFor(samples, self.quick)]

    def run(self):
        """Measures every point once, and again while there is time; an interrupt leaves what was measured."""
        began = time.monotonic()
        for number in range(MOST_PASSES[self.quick]):
            todo = self.wanted(number)
            for i, point in enumerate(todo):
                if number and time.monotonic() - began > BUDGET_S[self.quick]:
                    self.progress.say(f"{BUDGET_S[self.quick] // 60} minutes are over: {len(todo) - i} repeats are left out")
                    return self.progress.clear()
                self.progress.show(i, len(todo), self.left(todo[i:], number), f"pass {number + 1}, {point.id}")
                self.one(point)
        self.progress.clear()

    def one(self, point):
        started = time.monotonic()
        try:
            sample = measureOnce(point, self.samples[point])
        except PointError as problem:
            self.failures[point] = str(problem)
            self.progress.say(f"{point.id}: {problem}")
            return
        sample.update(seconds=time.monotonic() - started, load=os.getloadavg()[0], at=datetime.now(timezone.utc).isoformat())
        self.spent, self.made = self.spent + sample["seconds"], self.made + 1
        self.samples[point].append(sample)
        store.append(point, self.keys[point], sample)

    def left(self, todo, number):
        """Seconds: of what was measured before what it took without the exact answer, of the rest the mean so far."""
        mean = self.spent / self.made if self.made else 1.0
        known = lambda s: 1e-3 * (s.get("setup_ms", 0.0) + max(2.0 * s["wall_ms"], runner.BUDGET_MS))  # noqa: E731
        each = lambda point: known(self.samples[point][0]) if self.samples[point] else mean  # noqa: E731
        later = 0.0 if number + 1 >= MOST_PASSES[self.quick] else sum(
            each(point) for point in self.samples if point not in self.failures)
        return sum(each(point) for point in todo) + later * (MOST_PASSES[self.quick] - number - 1)

    def results(self):
        return [results.merge(point, samples) for point, samples in self.samples.items() if samples]
