"""Runs one point once: a chapter's program, its report, and what the system says about the process."""
import json
import os
import re
import signal
import subprocess
import tempfile
import threading
from pathlib import Path

import build

SIZE = "512x512"
BUDGET_MS = 500.0     # of frames timed in one pass, once it is known how long one takes
LIMIT_S = 900         # a program that takes longer hangs
STANDARD_ERROR = re.compile(r"standard error (\S+?)[,;)]?(?:\s|$)")


class PointError(Exception):
    """A point could not be measured; the message is the program's last line."""


def frames(point, sample):
    """How many to time in the next pass, from what the first one took: slow ones once, fast ones more often."""
    if sample is None:
        return 1
    return max(1, min(point.most, int(BUDGET_MS / max(sample["wall_ms"], 1e-3))))


def words(point, runs, compare, report):
    command = [str(build.folder("release") / "bin" / point.chapter), *point.command()[1:]]
    if "--size" not in point.flags:
        command += ["--size", SIZE]
    command += ["--headless", "--quiet", "--runs", str(runs), "--report", str(report)]
    return command + (["--compare-truth"] if compare else [])


def runChild(command, output=subprocess.DEVNULL, environment=None):
    """(exit status, what it said on stderr, resources it used). It is ended when it hangs or we are interrupted.

    `output`: subprocess.STDOUT keeps what it said on both.
    """
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen(command, cwd=build.ROOT, stdin=subprocess.DEVNULL, stderr=said, env=environment,
                                 stdout=said if output == subprocess.STDOUT else output)
        timer = threading.Timer(LIMIT_S, child.kill)
        timer.start()
        try:
            _, status, usage = os.wait4(child.pid, 0)  # Popen.wait would forget what the child used
            child.returncode = os.waitstatus_to_exitcode(status)
        except BaseException:
            child.kill()
            child.wait()
            raise
        finally:
            timer.cancel()
        said.seek(0)
        return child.returncode, said.read().decode(errors="replace").strip(), usage


def endOf(status):
    """Of a program that said nothing."""
    if status == -signal.SIGKILL:
        return f"killed: it took longer than {LIMIT_S} s, or memory ran out"
    return f"ended by signal {-status}" if status < 0 else f"no message; status {status}"


def errorOf(entry):
    """Figures of a report's "error" or "error_area_light", or None."""
    if not entry:
        return None
    kept = {key: entry[key] for key in ("quantity", "truth", "against", "pixels", "rmse", "mean_abs", "max_abs", "bias")
            if key in entry}
    if left := STANDARD_ERROR.search(entry.get("truth", "")):
        kept["standard_error"] = float(left[1])
    return kept


def measure(point, runs=1, compare=True):
    """One sample: a dict as it is kept in results.jsonl. Throws PointError."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        status, said, usage = runChild(words(point, runs, compare, report))
        if status != 0 or not report.is_file():
            raise PointError((said or endOf(status)).splitlines()[-1])
        read = json.loads(report.read_text())
    time = read["time"]
    sample = {"wall_ms": time["frame_ms"]["median"], "wall_min_ms": time["frame_ms"]["min"],
              "cpu_ms": time["frame_cpu_ms"]["median"], "cpu_min_ms": time["frame_cpu_ms"]["min"],
              "setup_ms": time["setup_ms"], "runs": time["frame_ms"]["runs"], "memory_mb": usage.ru_maxrss / 1024.0,
              "process_cpu_s": usage.ru_utime + usage.ru_stime, "compared": compare,
              "once_ms": sum(time.get("passes_ms", {}).get(name, {}).get("median", 0.0) for name in point.once),
              "work": read["work"], "renderer": read["renderer"], "backend": read["backend"]}
    if compare:
        sample["error"] = errorOf(read.get("error"))
        sample["area_light"] = errorOf(read.get("error_area_light"))
    return sample
