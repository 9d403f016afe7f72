"""Results along an axis, and the exponents with which time and memory grow along it."""
import math
from dataclasses import dataclass

from bench import growth_reasons
from bench.growth_points import GROWTHS, Growth

ABOVE_LINEAR = 1.1
LEAST_MS = 0.5  # a time below it is the clock's, and no exponent is fitted through it


def exponent(pairs):
    """Of the power law through the upper half of the range, by least squares of logarithms; None: nothing to fit."""
    upper = sorted(pairs)[len(pairs) // 2:] if len(pairs) > 3 else sorted(pairs)[-2:]
    logs = [(math.log(x), math.log(y)) for x, y in upper if x > 0 and y > 0]
    if len(logs) < 2:
        return None
    meanX, meanY = (sum(values) / len(logs) for values in zip(*logs))
    spread = sum((x - meanX) ** 2 for x, _ in logs)
    return sum((x - meanX) * (y - meanY) for x, y in logs) / spread if spread else None


def shownExponent(value):
    if value is None:
        return ""
    return f"**{value:.2f}**" if value > ABOVE_LINEAR else f"{value:.2f}"


def amount(value):
    return f"{value / 1e6:.3g} M" if value >= 1e6 else f"{value / 1e3:.3g} k" if value >= 1e3 else f"{value:.0f}"


@dataclass
class Fitted:
    """One technique along one axis, measured."""
    growth: Growth
    results: list  # by value

    def pairs(self, key):
        return [(r["value"], key(r)) for r in self.results]

    def frame(self):
        """Of the frame; nothing for a bake, whose work is in none."""
        return [] if self.growth.baked else self.pairs(lambda r: r["cpu_min_ms"])

    def whole(self):
        return self.pairs(lambda r: r["total_cpu_ms"])

    def shown(self):
        """What the figure shows."""
        return self.frame() or self.whole()

    def exponents(self):
        """Of frame, whole run and memory; None where too little was measured."""
        above = lambda pairs: [(x, y) for x, y in pairs if y >= LEAST_MS]  # noqa: E731
        return exponent(above(self.frame())), exponent(above(self.whole())), exponent(self.pairs(lambda r: r["memory_mb"]))

    def steep(self):
        return any(value and value > ABOVE_LINEAR for value in self.exponents())

    def row(self):
        frame, whole_, memory = map(shownExponent, self.exponents())
        first, last = self.results[0], self.results[-1]
        return [self.growth.technique, f"{amount(first['value'])} … {amount(last['value'])}",
                "" if self.growth.baked else f"{last['cpu_min_ms']:.1f}", frame, f"{1e-3 * last['total_cpu_ms']:.1f}",
                whole_, f"{last['memory_mb']:.0f}", memory, self.why()]

    def why(self):
        reasons = growth_reasons.REASONS
        return reasons.get((self.growth.axis, self.growth.technique), reasons[self.growth.axis])


def fitted(results):
    found = []
    for growth in GROWTHS:
        mine = sorted((r for r in results if (r["axis"], r["technique"]) == (growth.axis, growth.technique)),
                      key=lambda r: r["value"])
        if len(mine) >= 2:
            found.append(Fitted(growth, mine))
    return found
