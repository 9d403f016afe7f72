"""From samples to results: one dict for each point, as sections, plots and files read it.

    id section scene technique chapter axis value quantity flags      the point's (flags as a list)
    wall_ms cpu_ms                   median over the passes of their medians (each pass: frames of one process)
    wall_min_ms cpu_min_ms           least of all frames
    setup_ms memory_mb               least of the passes; memory without the exact answer where a pass went without it
    passes runs                      how often a process was started; frames timed in all
    work                             counters of one frame
    error area_light                 {quantity truth against pixels rmse max_abs bias standard_error} or None
"""
import os
import platform
import re
import statistics
import subprocess
from datetime import datetime, timezone
from pathlib import Path

import build


def pointFields(point):
    return {"id": point.id, "section": point.section, "scene": point.scene, "technique": point.technique,
            "chapter": point.chapter, "axis": point.axis, "value": point.value, "quantity": point.quantity,
            "flags": list(point.flags)}


def merge(point, samples):
    """The result of a point that was measured at least once."""
    # The exact answer needs memory of its own, which is not the technique's.
    plain = [s for s in samples if not s.get("compared")] or samples
    compared = next((s for s in samples if s.get("compared")), {})
    known = {"wall_ms", "wall_min_ms", "cpu_ms", "cpu_min_ms", "setup_ms", "memory_mb", "runs", "compared", "work", "error",
             "area_light", "renderer", "backend"}
    further = {key: value for key, value in samples[-1].items() if key not in known}
    return {**pointFields(point), **further,
            "wall_ms": statistics.median(s["wall_ms"] for s in samples), "wall_min_ms": min(s["wall_min_ms"] for s in samples),
            "cpu_ms": statistics.median(s["cpu_ms"] for s in samples), "cpu_min_ms": min(s["cpu_min_ms"] for s in samples),
            "setup_ms": min(s.get("setup_ms", 0.0) for s in samples),
            "memory_mb": min(s.get("memory_mb", 0.0) for s in plain),
            "passes": len(samples), "runs": sum(s.get("runs", 1) for s in samples), "work": samples[-1].get("work", {}),
            "error": compared.get("error"), "area_light": compared.get("area_light"),
            "renderer": samples[-1].get("renderer", "")}


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
            "date": datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
            "commit": commit + (" with local changes" if changed else ""), "load": round(os.getloadavg()[0], 2)}
