"""What goes between the two comments of each kind of marker."""
import difflib
import re
from dataclasses import dataclass, field
from pathlib import Path

import files
import house
import plot as plots
import png
import regions
import tables
from markers import PageError

PICTURE = re.compile(r"^(.*?)\s+->\s+(\S+\.png)\s*\|\s*(.*)$", re.DOTALL)
PLOT = re.compile(r"^(\S+)(?:\s+by\s+(.+?))?\s+->\s+(\S+\.svg)\s*\|\s*(.*)$", re.DOTALL)
PICTURES_IN_A_ROW = 3
PICTURE_TOLERANCE = 2.0  # root mean square, levels of 255


@dataclass
class Page:
    """A page being refreshed, and what its markers share."""
    root: Path
    path: Path                 # relative to root
    programs: object
    check: bool
    fast: bool
    force: bool = False
    tables: dict = field(default_factory=dict)      # name -> (Table, rows of cells)
    shownRegions: set = field(default_factory=set)
    pictureFiles: set = field(default_factory=set)

    def link(self, path):
        """`path` (relative to the root) as this page has to write it."""
        return path[len("docs/"):] if self.path.parts[0] == "docs" and path.startswith("docs/") else (
            "../" + path if self.path.parts[0] == "docs" else path)


def fenced(language, lines):
    return "\n```%s\n%s\n```\n" % (language, "\n".join(lines))


def code(marker, page):
    words = marker.argument.split()
    if len(words) not in (1, 2):
        raise PageError(f"{marker.where}: code takes a file and a region, not `{marker.argument}`")
    region = words[1] if len(words) == 2 else None
    page.shownRegions.add((words[0], region))
    return fenced(regions.language(words[0]), regions.extract(page.root, words[0], region, marker.where))


def changedLines(root, old, new):
    read = lambda path: (root / path).read_text().splitlines() if (root / path).is_file() else []  # noqa: E731
    return list(difflib.unified_diff(read(old), read(new), old, new, lineterm="", n=2))


def diff(marker, page):
    words = marker.argument.split()
    if len(words) != 2:
        raise PageError(f"{marker.where}: diff takes two chapters, not `{marker.argument}`")
    for chapter in words:
        regions.readLines(page.root, f"chapters/{chapter}/main.cpp", marker.where)
    old, new = words
    pairs = [(f"chapters/{old}/main.cpp", f"chapters/{new}/main.cpp")]
    for path in regions.trackedFiles(page.root, f"shaders/{new}"):
        pairs.append((path.replace(new, old), path))
    lines = [line for pair in pairs for line in changedLines(page.root, *pair)]
    added = sum(line.startswith("+") and not line.startswith("+++") for line in lines)
    removed = sum(line.startswith("-") and not line.startswith("---") for line in lines)
    summary = f"From {old} to {new}: {added} lines added, {removed} removed"
    return f"\n<details><summary>{summary}</summary>\n{fenced('diff', lines)}\n</details>\n"


def command(line):
    """How the reader makes the same picture."""
    program, _, flags = " ".join(line.split()).partition(" ")
    return f"./run {program[:2]} --headless {flags} --output a.png".replace("  ", " ")


def updatePicture(marker, page, line, file):
    """Renders the picture unless the one that is there shows the same; in check mode says so instead."""
    target = page.root / "docs" / file
    page.pictureFiles.add(f"docs/{file}")
    if page.check and not target.is_file():
        raise PageError(f"{marker.where}: there is no picture {file}: run docs/refresh")
    if page.check and page.fast:
        return
    rendered = page.programs.picture(line, marker.where)
    fresh = png.read(rendered)
    distance = png.rootMeanSquare(png.read(target), fresh) if target.is_file() else float("inf")
    if page.check and distance > PICTURE_TOLERANCE:
        raise PageError(f"{marker.where}: {file} differs by {distance:.1f} levels (root mean square; {PICTURE_TOLERANCE} "
                        f"allowed) from what `{line}` renders: run docs/refresh and look at both")
    if not page.check and (distance > PICTURE_TOLERANCE or page.force):
        png.write(target, *fresh)


def splitPicture(marker, line):
    parts = PICTURE.match(line.strip())
    if not parts:
        raise PageError(f"{marker.where}: a picture is `COMMAND -> FILE.png | text`, not `{line.strip()}`")
    return " ".join(parts[1].split()), parts[2], " ".join(parts[3].split())


def picture(marker, page):
    line, file, text = splitPicture(marker, marker.argument)
    updatePicture(marker, page, line, file)
    return f"\n\n![{text}]({page.link('docs/' + file)})\n\n<sub>`{command(line)}`</sub>\n\n"


def pictures(marker, page):
    entries = [splitPicture(marker, line) for line in marker.argument.splitlines() if line.strip()]
    if not entries:
        raise PageError(f"{marker.where}: there is no picture in this list")
    body = "\n\n"
    for at in range(0, len(entries), PICTURES_IN_A_ROW):
        row = entries[at:at + PICTURES_IN_A_ROW]
        for line, file, _ in row:
            updatePicture(marker, page, line, file)
        images = [f"![{text}]({page.link('docs/' + file)})" for _, file, text in row]
        commands = [f"<sub>`{command(line)}`</sub>" for line, _, _ in row]
        body += tables.markdown([text for _, _, text in row], [images, commands]) + "\n\n"
    return body


def table(marker, page):
    described = tables.parse(marker.argument, marker.where)
    shown = tables.fromMarkdown(marker.body)
    if described.name in page.tables:
        raise PageError(f"{marker.where}: two tables of this page are called {described.name}")
    rows = shown
    if page.check and not page.fast:
        for _, line in described.rows:
            page.programs.program(line, marker.where)
    if not (page.check and (page.fast or not described.compared())):
        fresh = tables.cells(described, lambda line: page.programs.report(line, marker.where), marker.where)
        changes = tables.differences(described, shown, fresh)
        if page.check and changes:
            raise PageError(f"{marker.where}: stale: {changes[0]}: run docs/refresh")
        # Times differ from run to run: they alone are no reason to change a page.
        rows = fresh if changes or page.force or marker.digest != marker.freshDigest() else shown
    if described.name:
        page.tables[described.name] = (described, rows)
    if page.check:
        return marker.body
    return "\n\n" + tables.markdown([c.heading for c in described.columns], rows, tables.alignments(described)) + "\n\n"


def value(marker, page):
    parts = [part.strip() for part in marker.argument.split("|")]
    if len(parts) != 3:
        raise PageError(f"{marker.where}: a value is `TABLE | ROW | COLUMN`, not `{marker.argument}`")
    if parts[0] not in page.tables:
        raise PageError(f"{marker.where}: no table above in this page is called {parts[0]}; name it in its first line")
    described, rows = page.tables[parts[0]]
    return tables.cellOf(described, rows, parts[1], parts[2], marker.where)


def plot(marker, page):
    parts = PLOT.match(marker.argument)
    if not parts:
        raise PageError(f"{marker.where}: a plot is `TABLE [by COLUMN] -> FILE.svg | text`, not `{marker.argument}`")
    name, across, file, words = parts[1], parts[2], parts[3], " ".join(parts[4].split())
    if name not in page.tables:
        raise PageError(f"{marker.where}: no table above in this page is called {name}; name it in its first line")
    described, rows = page.tables[name]
    headings = [column.heading for column in described.columns]
    if across and across not in headings:
        raise PageError(f"{marker.where}: table {name} has no column {across}, only {', '.join(headings)}")
    try:
        if across:
            headings, rows = plots.across(headings, rows, across)
        fresh = plots.logLog(headings, rows, words)
    except plots.PlotError as error:
        raise PageError(f"{marker.where}: {error}") from None
    target = page.root / "docs" / file
    page.pictureFiles.add(f"docs/{file}")
    shown = target.read_text() if target.is_file() else ""
    if page.check and shown != fresh:
        raise PageError(f"{marker.where}: {file} does not show table {name}: run docs/refresh")
    if not page.check and shown != fresh:
        files.write(target, fresh)
    return f"\n\n![{words}]({page.link('docs/' + file)})\n\n"


def parameters(marker, page):
    if page.check and page.fast:
        return marker.body
    rows = []
    for p in page.programs.parameters(marker.argument, marker.where):
        limits = " | ".join(p.get("choices", []) + (["FILE"] if p.get("or_file") else []))
        if p.get("range"):
            limits = "{} … {}".format(*p["range"])
        rows.append([f"`--{p['name']}`", limits, str(p.get("default", "")), p.get("unit", ""), p.get("help", "")])
    return "\n\n" + tables.markdown(["parameter", "range", "default", "unit", "meaning"], rows) + "\n\n"


def chapters(marker, page):
    rows = []
    for name in house.chapterNames(page.root):
        c = house.chapter(page.root, name)
        rows.append([f"[{name}]({page.link(f'docs/{name}.md')})", c.idea, c.estimates, c.exact])
    return "\n\n" + tables.markdown(["program", "the new idea", "what it estimates", "its exact answer"], rows) + "\n\n"


def dependencies(marker, page):
    rows = [[f"`{p.name}`", p.reason] for p in house.packages(page.root)]
    return "\n\n" + tables.markdown(["Debian package", "why"], rows) + "\n\n"


FILLERS = {f.__name__: f for f in (code, diff, picture, pictures, table, value, plot, parameters, chapters, dependencies)}
