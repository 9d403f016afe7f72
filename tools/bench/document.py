"""docs/benchmark.md: written from docs/benchmark.json alone, so that a test can write it again and compare."""
import hashlib
import json

import build
from files import write as put
from bench import files, sections, svg

DIGEST = "<!-- written by ./run bench from benchmark.json, digest {}: edit neither -->"


def pageOf(machine, results, source):
    """(text, figures). `source`: the text of the results' file."""
    requested, lines, figures = machine.get("requested", {}), [], []
    for section in sections.ALL:
        own = [result for result in results if result["section"] == section.NAME]
        if own:
            more, drawn = section.page(own)
            if section.NAME in requested:  # measured on another day, perhaps elsewhere: said below its heading
                more[1:1] = ["", f"Measured with `./run bench --{section.NAME}` {on(requested[section.NAME])}."]
            lines += ["", *more]
            figures += drawn
    always = [result for result in results if result["section"] not in requested]
    digest = hashlib.sha256(source.encode()).hexdigest()[:16]
    text = "\n".join([*(head(machine, always) if always else HEADING), *lines, "", DIGEST.format(digest), ""])
    while "\n\n\n" in text:
        text = text.replace("\n\n\n", "\n\n")
    return text, figures


def on(machine):
    """Where, when and of which state of the project: "on ..."."""
    return (f"on {machine['processor']} ({machine['cores']} cores), {machine['renderer']}, {machine['date']}, commit "
            f"{machine['commit']}; load average {machine['load']:.1f}")


HEADING = ["# Run time against error"]


def head(machine, results):
    frames = sum(result.get("runs", 0) for result in results)
    scenes = list(dict.fromkeys(f"`{r['scene']}`" for r in results if "/" not in r["scene"]))  # not what a section makes
    return [*HEADING, "",
            "Which technique is cheapest for a given error, why, and how its cost grows. Every figure on this page was "
            f"measured by `./run bench`, which wrote it: {len(results)} points on {', '.join(scenes)}, {frames} "
            "timed frames, their repeats interleaved so that noise of the machine hits all alike.", "",
            f"Measured {on(machine)}, of which a program that is measured is up to {machine['cores']}. Another machine has "
            "other times; their ratios are what `./run bench --check` compares with bounds."]


def read(text):
    """(machine, results) of a results' file."""
    held = json.loads(text)
    return held["machine"], held["results"]


def made(machine, results):
    """(text, figures) from what the results' file says, as the test that compares them does it."""
    source = files.jsonOf(machine, results)
    return pageOf(*read(source), source)


def write(machine, results):
    """docs/benchmark.json, the page that is made of it, and the pictures that it shows."""
    source = files.jsonOf(machine, results)
    page, figures = made(machine, results)
    put(build.ROOT / "docs" / "benchmark.json", source)
    put(build.ROOT / "docs" / "benchmark.md", page)
    for name, drawn in pictures(figures).items():
        put(build.ROOT / "docs" / "images" / name, drawn)
    for old in (build.ROOT / "docs" / "images").glob("bench_*.svg"):
        if old.name not in pictures(figures):
            old.unlink()
    return build.ROOT / "docs" / "benchmark.md"


def pictures(figures):
    """{file name: SVG} of those that the page shows."""
    return {f"bench_{figure.name}.svg": svg.render(figure) for figure in figures if figure.inDocs}


def stale(root):
    """What is wrong with the committed page: "" when it is what its results make."""
    source = (root / "docs" / "benchmark.json").read_text()
    page, figures = pageOf(*read(source), source)
    if (root / "docs" / "benchmark.md").read_text() != page:
        return "docs/benchmark.md is not what docs/benchmark.json makes: ./run bench writes both"
    for name, drawn in pictures(figures).items():
        file = root / "docs" / "images" / name
        if not file.is_file() or file.read_text() != drawn:
            return f"docs/images/{name} does not show docs/benchmark.json: ./run bench writes both"
    return ""
