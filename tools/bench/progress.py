"""A bar with the time left on a terminal; elsewhere a plain line now and then."""
import sys
import time

PLAIN_EVERY_S = 30.0


def clock(seconds):
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"


class Progress:
    def __init__(self, stream=None):
        self.stream = stream or sys.stderr
        self.terminal = self.stream.isatty()
        self.shown = time.monotonic() - PLAIN_EVERY_S
        self.width = 0

    def show(self, done, total, left, what):
        """`left`: seconds, an estimate; `what`: the point that begins now."""
        line = f"{done} of {total}, {clock(left)} left: {what}"
        if self.terminal:
            bar = "#" * (20 * done // max(1, total))
            line = f"[{bar:20}] {line}"[:118]
            print(f"\r{line:{self.width}}", end="", file=self.stream, flush=True)
            self.width = len(line)
        elif time.monotonic() - self.shown >= PLAIN_EVERY_S:
            self.shown = time.monotonic()
            print(line, file=self.stream, flush=True)

    def say(self, line):
        """A line that stays."""
        self.clear()
        print(line, file=self.stream, flush=True)

    def clear(self):
        if self.terminal and self.width:
            print(f"\r{'':{self.width}}\r", end="", file=self.stream, flush=True)
