"""From samples to results: one dict for each point, as sections, plots and files read it.

    id section scene technique chapter axis value quantity flags      the point's (flags as a list)
    wall_ms cpu_ms                   median over the passes of their medians (each pass: frames of one process)
    wall_min_ms cpu_min_ms           least of all frames
    once_ms                          what is made once before the first frame, where a technique bakes; else 0
    setup_ms memory_mb               least of the passes; memory without the exact answer where a pass went without it
                                     (a process that needs less than Python, some 30 MB, is shown with Python's: Linux counts
                                     from before the program began)
    memory_with_truth                true where none did: the slowest points are run once
    passes runs                      how often a process was started; frames timed in all
    work                             counters of one frame
    at load                          when (UTC) it was measured last, and how busy the machine was: waiting threads
    error area_light                 {quantity truth against pixels rmse max_abs bias standard_error} or None

and what a section's own `measure` adds. Figures are rounded to four digits: more is noise, and the page must come out the
same from the file as from memory.
"""
import os
import platform
import re
import statistics
import subprocess
from pathlib import Path

import build

MERGED = {"wall_ms", "wall_min_ms", "cpu_ms", "cpu_min_ms", "once_ms", "setup_ms", "memory_mb", "runs", "compared", "work",
          "error", "area_light", "renderer", "backend", "seconds", "process_cpu_s",
          "at", "load"}


def pointFields(point):
    return {"id": point.id, "section": point.section, "scene": point.scene, "technique": point.technique,
            "chapter": point.chapter, "axis": point.axis, "value": point.value, "quantity": point.quantity,
            "flags": list(point.flags)}


def rounded(value):
    """Four significant digits, through dicts and lists; whole numbers stay as they are."""
    if isinstance(value, float):
        return float(f"{value:.4g}")
    if isinstance(value, dict):
        return {key: rounded(entry) for key, entry in value.items()}
    return [rounded(entry) for entry in value] if isinstance(value, list) else value


def merge(point, samples):
    """The result of a point that was measured at least once."""
    # The exact answer needs memory of its own, which is not the technique's.
    plain = [s for s in samples if not s.get("compared")]
    compared = next((s for s in samples if s.get("compared")), samples[0])
    median = lambda key: statistics.median(s.get(key, 0.0) for s in samples)  # noqa: E731
    least = lambda key, of=samples: min(s.get(key, 0.0) for s in of)  # noqa: E731
    last = samples[-1]
    result = {**pointFields(point), **{key: value for key, value in last.items() if key not in MERGED},
              "wall_ms": median("wall_ms"), "wall_min_ms": least("wall_min_ms"), "cpu_ms": median("cpu_ms"),
              "cpu_min_ms": least("cpu_min_ms"), "once_ms": median("once_ms"), "setup_ms": least("setup_ms"),
              "memory_mb": least("memory_mb", plain or samples), "memory_with_truth": not plain,
              "passes": len(samples), "runs": sum(s.get("runs", 1) for s in samples), "work": last.get("work", {}),
              "error": compared.get("error"), "area_light": compared.get("area_light"),
              "renderer": last.get("renderer", ""), "at": last.get("at", "")[:16],
              "load": statistics.median(s.get("load", 0.0) for s in samples)}
    return rounded(result)


def said(words):
    ran = subprocess.run(words, cwd=build.ROOT, capture_output=True, text=True)
    return ran.stdout.strip() if ran.returncode == 0 else ""


def processor():
    info = Path("/proc/cpuinfo")
    name = re.search(r"^model name\s*:\s*(.+)$", info.read_text(), re.MULTILINE) if info.is_file() else None
    return name[1].strip() if name else platform.machine()


def machine(results):
    """On what, when and of which state of the project the results were measured."""
    commit = said(["git", "rev-parse", "--short=10", "HEAD"]) or "unknown"
    changed = bool(said(["git", "status", "--porcelain", "--untracked-files=no"]))
    renderers = sorted({r["renderer"] for r in results if r.get("renderer") and r["renderer"] != "CPU"})
    return {"processor": processor(), "cores": os.cpu_count() or 1, "renderer": ", ".join(renderers) or "CPU",
            "date": max((r["at"].replace("T", " ") + " UTC" for r in results if r.get("at")), default="at an unknown time"),
            "commit": commit + (" with local changes" if changed else ""),
            "load": rounded(statistics.median(r.get("load", 0.0) for r in results) if results else 0.0)}
