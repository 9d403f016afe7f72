"""All points, pass after pass: noise of the machine hits all alike, since the repeats of one point lie minutes apart."""
import os
import time
from datetime import datetime, timezone

from bench import results, runner, sections, store
from bench.progress import clock
from bench.runner import PointError

MOST_PASSES = {False: 3, True: 2}  # by `quick`
SLOW_S, VERY_SLOW_S = 1.0, 5.0     # of a process without exact answer: twice, once
BUDGET_S = {False: 1620, True: 165}  # a repeat that would end later is left for the next run, which goes on from there


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
        self.spent, self.made, self.began = 0.0, 0, time.monotonic()

    def wanted(self, number):
        """Points that lack pass `number`, counted from 0."""
        return [point for point, samples in self.samples.items()
                if point not in self.failures and number >= len(samples) and number < passesFor(samples, self.quick)]

    def run(self):
        """Measures every point once, and again while there is time; an interrupt leaves what was measured."""
        self.began = time.monotonic()
        for number in range(MOST_PASSES[self.quick]):
            todo = self.wanted(number)
            for i, point in enumerate(todo):
                if number and self.overAfter(point):
                    return self.leaveOut(len(todo) - i, number)
                self.progress.show(i, len(todo), self.left(todo[i:], number), f"pass {number + 1}, {point.id}")
                self.one(point)
        self.progress.clear()

    def overAfter(self, point):
        """Would a repeat of the point end after the time that a run may take?"""
        return time.monotonic() - self.began + self.repeat(point) > BUDGET_S[self.quick]

    def leaveOut(self, count, number):
        """Says how much was not repeated, and whether the machine was too slow for even one pass."""
        spent, planned = time.monotonic() - self.began, BUDGET_S[self.quick]
        if number == 1 and spent > planned:
            self.progress.say(f"one pass over all points took {clock(spent)}, more than the {clock(planned)} planned for "
                              "all passes: this machine is slower, or busier, than the plan expects; nothing is left "
                              f"unmeasured, and {count} repeats are left out")
        else:
            self.progress.say(f"{clock(planned)} are over: {count} repeats are left out; the same command makes them")

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

    def repeat(self, point):
        """Seconds that a point takes once more, by its first sample; it goes without the exact answer then."""
        first = self.samples[point][0]
        return 1e-3 * (first.get("setup_ms", 0.0) + max(2.0 * first["wall_ms"], runner.BUDGET_MS))

    def left(self, todo, number):
        """Seconds: of what was measured before what it took then, of the rest the mean so far."""
        mean = self.spent / self.made if self.made else 1.0
        each = lambda point: self.repeat(point) if self.samples[point] else mean  # noqa: E731
        later = 0.0 if number + 1 >= MOST_PASSES[self.quick] else sum(
            each(point) for point in self.samples if point not in self.failures)
        return sum(each(point) for point in todo) + later * (MOST_PASSES[self.quick] - number - 1)

    def results(self):
        return [results.merge(point, samples) for point, samples in self.samples.items() if samples]
