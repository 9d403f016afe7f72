"""What the project is made of: its chapters, their pages' heads, and the packages it stands on."""
import re
from dataclasses import dataclass

from markers import PageError

TITLE = re.compile(r"^# (\d\d) (.+)$")


@dataclass
class Chapter:
    name: str       # "03_polygon_offset"
    title: str
    idea: str
    estimates: str
    exact: str


@dataclass
class Package:
    name: str
    group: str      # "build", "library", "test", "optional"
    reason: str


def chapterNames(root):
    return sorted(path.parent.name for path in (root / "chapters").glob("[0-9][0-9]_*/main.cpp"))


def findChapter(root, word):
    """"03", "3" or "03_polygon_offset" -> the chapter's name, or None."""
    names = chapterNames(root)
    if word in names:
        return word
    matches = [name for name in names if word.isdigit() and name.startswith(f"{int(word):02d}_")]
    return matches[0] if matches else None


def chapter(root, name):
    """Reads the head of the chapter's page (its form: docs/refresh --help)."""
    path = root / "docs" / f"{name}.md"
    if not path.is_file():
        raise PageError(f"docs/{name}.md is missing: every chapter has a page")
    paragraphs = [" ".join(p.split()) for p in re.split(r"\n\s*\n", path.read_text())]
    paragraphs = [p for p in paragraphs if not p.startswith("<!--")]
    title = TITLE.match(paragraphs[0]) if paragraphs else None
    estimates = next((p for p in paragraphs if p.startswith("**Estimates**")), None)
    if not title or title[1] != name[:2] or not estimates or "**exact answer:**" not in estimates:
        raise PageError(f"docs/{name}.md:1: a page begins with `# {name[:2]} Title`, one paragraph with the new idea, "
                        "and `**Estimates** ...; **exact answer:** ...`")
    quantity, _, exact = estimates.removeprefix("**Estimates**").partition("**exact answer:**")
    return Chapter(name, title[2], paragraphs[1], quantity.strip(" ;."), exact.strip(" ;."))


def packages(root):
    """tools/packages.txt: `package  group  reason`, one a line."""
    found = []
    for line in (root / "tools" / "packages.txt").read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            name, group, reason = line.split(None, 2)
            found.append(Package(name, group, reason))
    return found
