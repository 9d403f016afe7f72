"""Renders every view of every chapter and writes out/index.html, one file that holds everything."""
import base64
import html
import json
import re
import subprocess
import sys
import time
from pathlib import Path

import build
import files

VIEW = re.compile(r"^  ([\w-]+)\s+(\S.*)$")
TRUTH_VIEWS = ("truth", "error")
TIMED_VIEW = "color"
# Of chapters whose exact answer is many rays a pixel: as many as their default would take minutes a picture. The page shows
# the standard error that is left.
TRUTH_RAYS = "256"


def viewsOf(said):
    """Names and meanings of a chapter's views, from its help."""
    section = re.search(r"^Views.*?\n(.*?)(?:\n\n|\Z)", said, re.DOTALL | re.MULTILINE)
    views = {}
    for line in section[1].splitlines() if section else []:
        if entry := VIEW.match(line):
            views[entry[1]] = entry[2]
        elif views and line.strip():
            views[list(views)[-1]] += " " + line.strip()
    return views


def renderView(program, view, scene, size, folder, truthFlags):
    """(PNG path, report), or (None, what the program said)."""
    picture, report = folder / f"{view}.png", folder / f"{view}.json"
    flags = ["--headless", "--scene", scene, "--size", size, "--view", view, "--output", picture, "--report", report]
    # Only the first view's time is shown. The others need not be drawn anew to be timed: with many rays a pixel that is seconds.
    flags += ["--runs", "3"] if view == TIMED_VIEW else ["--still"]
    if view in TRUTH_VIEWS:
        flags += ["--compare-truth", *truthFlags]
    ran = subprocess.run([program, *flags], capture_output=True, text=True)
    if ran.returncode != 0:
        return None, (ran.stderr.strip() or "no message").splitlines()[-1]
    return picture, json.loads(report.read_text())


def renderChapter(name, scene, size):
    program = build.folder("release") / "bin" / name
    folder = build.ROOT / "out" / name
    chapter = {"name": name, "views": [], "error": None, "problems": []}
    said = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    truthFlags = ["--truth-rays", TRUTH_RAYS] if "--truth-rays" in said else []
    for view, meaning in viewsOf(said).items():
        picture, report = renderView(program, view, scene, size, folder, truthFlags)
        if picture is None:
            chapter["problems"].append(f"--view {view}: {report}")
            continue
        image = "data:image/png;base64," + base64.b64encode(picture.read_bytes()).decode()
        ms = report["time"]["frame_ms"]["median"] if view == TIMED_VIEW else None
        chapter["views"].append({"name": view, "meaning": meaning, "image": image, "ms": ms, "work": report["work"]})
        chapter["error"] = report.get("error", chapter["error"])
    return chapter


def figures(chapter):
    """The row of a chapter in the table of errors and times."""
    color = next((view for view in chapter["views"] if view["name"] == TIMED_VIEW), {"ms": None, "work": {}})
    error = chapter["error"] or {}
    work = ", ".join(f"{name.replace('_', ' ')} {value:,}" for name, value in color["work"].items())
    exact = f"{error['quantity']} against {error['against']} ({error['truth']})" if error else "–"
    number = lambda key: f"{error[key]:.3g}" if key in error else "–"  # noqa: E731
    ms = "–" if color["ms"] is None else f"{color['ms']:.1f}"
    cells = [chapter["name"], exact, number("rmse"), number("max_abs"), number("bias"), ms, work]
    return "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells) + "</tr>"


def write(chapters, scene, size, path):
    shown = [{"name": c["name"], "views": [{k: v[k] for k in ("name", "meaning", "image")} for v in c["views"]]}
             for c in chapters]
    problems = "".join(f"<p class=problem>{html.escape(c['name'])} {html.escape(problem)}</p>"
                       for c in chapters for problem in c["problems"])
    page = (build.ROOT / "tools" / "gallery.html").read_text()
    for name, value in (("SCENE", html.escape(f"{Path(scene).stem}, {size}")), ("PROBLEMS", problems),
                        ("ROWS", "\n".join(figures(c) for c in chapters)),
                        ("DATA", json.dumps(shown).replace("</", "<\\/"))):
        page = page.replace(f"%{name}%", value)
    files.write(path, page)


def render(names, scene, size):
    started, chapters = time.monotonic(), []
    path = build.ROOT / "out" / "index.html"
    files.requireWritable(path)  # before minutes of rendering for a page that cannot be kept
    for name in names:
        print(f"rendering {name}", file=sys.stderr, flush=True)
        chapters.append(renderChapter(name, scene, size))
        for problem in chapters[-1]["problems"]:
            print(f"{name}: {problem}", file=sys.stderr)
    write(chapters, scene, size, path)
    failed = not chapters or any(not chapter["views"] for chapter in chapters)
    print(f"{path}: {len(chapters)} chapters, {sum(len(c['views']) for c in chapters)} pictures "
          f"in {time.monotonic() - started:.0f} s")
    return 1 if failed else 0
