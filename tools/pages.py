"""Refreshes or checks all pages: the body of docs/refresh."""
import os
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import files
import fill
import markers
import regions
from markers import PageError
from reports import Programs

ROOT = Path(__file__).resolve().parent.parent


def allPages(root):
    return [Path(p) for p in regions.trackedFiles(root, "README.md", "CONTRIBUTING.md", "docs/*.md")]


def refresh(names, check, fast, build, force=False, root=ROOT):
    """Exit status: 0, or 1 when something is wrong (each problem on one line of stderr)."""
    programs = Programs(root, build)
    chosen = [Path(name).resolve().relative_to(root) for name in names] or allPages(root)
    made = [fill.Page(root, path, programs, check, fast, force) for path in chosen]
    # A check measures no time, so that pages may be made side by side; what is written down is measured alone.
    with ThreadPoolExecutor(os.cpu_count() if check else 1) as pool:
        problems = [problem for found in pool.map(refreshPage, made) for problem in found]
    if check and not names:
        problems += leftOver(root, made)
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


def refreshPage(page):
    """Fills in one page and returns what is wrong with it; pieces that are wrong stay as they are."""
    path = page.root / page.path
    try:
        text = path.read_text()
        found = markers.find(text, str(page.path))
    except (OSError, PageError) as error:
        return [str(error)]
    problems, replacements = [], []
    for marker in found:
        try:
            body = fill.FILLERS[marker.kind](marker, page)
            if page.check:
                checkMarker(marker, body)
            replacements.append((marker, body))
        except PageError as error:
            problems.append(str(error))
    if not page.check:
        new = markers.replaceBodies(text, replacements)
        if new != text:
            files.write(path, new)
            print(f"refreshed {page.path}")
    return problems


def checkMarker(marker, body):
    if marker.kind == "value" and marker.column == 0:
        raise PageError(f"{marker.where}: a value may not begin a line: Markdown would end the paragraph there")
    if marker.digest != marker.freshDigest():
        raise PageError(f"{marker.where}: `{marker.kind}: {marker.argument.splitlines()[0]}` was changed, its body was "
                        "not: run docs/refresh")
    if body != marker.body:
        raise PageError(f"{marker.where}: `{marker.kind}: {marker.argument}` is stale: run docs/refresh")


def ofBenchmark(root):
    """Pictures of docs/benchmark.md: ./run bench writes both, and tests/structure/bench_test.py compares them."""
    page = root / "docs" / "benchmark.md"
    shown = re.findall(r"\]\((images/bench_\w+\.svg)\)", page.read_text()) if page.is_file() else []
    return {f"docs/{path}" for path in shown}


def leftOver(root, made):
    """What exists and no page shows."""
    shown = set().union(*(page.shownRegions for page in made))
    pictures = set().union(*(page.pictureFiles for page in made)) | ofBenchmark(root)
    problems = [f"{path}: region {name} is shown by no page: show it, or remove its markers"
                for path, name in regions.allRegions(root) if (path, name) not in shown]
    problems += [f"{path}: no page makes or shows this picture: remove it"
                 for path in regions.trackedFiles(root, "docs/images/*.png", "docs/images/*.svg") if path not in pictures]
    return problems
