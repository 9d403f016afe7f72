"""Finds the generated pieces of a page: `<!-- kind: argument -->` body `<!-- end digest -->`."""
import hashlib
import re
from dataclasses import dataclass

KINDS = ("code", "diff", "picture", "pictures", "table", "value", "plot", "parameters", "chapters", "dependencies")
OPENING = re.compile(r"<!-- *(%s)\b *:?(.*?)-->" % "|".join(KINDS), re.DOTALL)
CLOSING = re.compile(r"<!-- *end\b *([0-9a-f]*) *-->")
LOOKALIKE = re.compile(r"<!-- *([\w-]+) *:")
FENCE = re.compile(r"^(```+|~~~+)[^\n]*\n.*?^\1`*~*\s*$", re.DOTALL | re.MULTILINE)


class PageError(Exception):
    """A page is wrong in a way its author has to mend; the message says where and how."""


@dataclass
class Marker:
    kind: str
    argument: str
    body: str
    digest: str
    where: str    # "docs/03_x.md:17"
    begin: int    # of the body, in the page's text
    end: int      # end of the closing comment
    column: int   # at which the opening comment starts in its line

    def freshDigest(self):
        """Of the argument: spacing does not matter, everything else does."""
        return hashlib.sha256((self.kind + " ".join(self.argument.split())).encode()).hexdigest()[:8]


def find(text, name):
    """All markers of a page in order. Fenced blocks outside markers (which show the syntax) are left alone."""
    markers, at = [], 0
    while opening := OPENING.search(text, at):
        fence = FENCE.search(text, at)
        if fence and fence.start() < opening.start():
            at = fence.end()
            continue
        where = "%s:%d" % (name, text.count("\n", 0, opening.start()) + 1)
        closing = CLOSING.search(text, opening.end())
        following = OPENING.search(text, opening.end())
        if not closing or (following and following.start() < closing.start()):
            raise PageError(f"{where}: `{opening[1]}` has no `<!-- end -->`: write one below it")
        markers.append(Marker(opening[1], opening[2].strip(), text[opening.end():closing.start()], closing[1], where,
                              opening.end(), closing.end(), opening.start() - text.rfind("\n", 0, opening.start()) - 1))
        at = closing.end()
    checkUnknown(text, name, markers)
    return markers


def checkUnknown(text, name, markers):
    """A misspelt kind would otherwise be skipped in silence, for ever."""
    outside = FENCE.sub(lambda fence: "\n" * fence[0].count("\n"), blank(text, markers))
    for comment in LOOKALIKE.finditer(outside):
        if comment[1] not in KINDS:
            line = outside.count("\n", 0, comment.start()) + 1
            raise PageError(f"{name}:{line}: unknown marker `{comment[1]}`: it is one of {', '.join(KINDS)}")


def blank(text, markers):
    for marker in markers:
        body = text[marker.begin:marker.end]
        text = text[:marker.begin] + re.sub(r"[^\n]", " ", body) + text[marker.end:]
    return text


def replaceBodies(text, replacements):
    """`replacements`: (marker, new body) in page order."""
    for marker, body in reversed(replacements):
        closing = f"<!-- end {marker.freshDigest()} -->"
        text = text[:marker.begin] + body + closing + text[marker.end:]
    return text
