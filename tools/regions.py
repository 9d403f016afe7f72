"""Named regions of sources and shaders: `// [begin:name]` ... `// [end:name]`."""
import re
import subprocess
from pathlib import Path

from markers import PageError

ROOT = Path(__file__).resolve().parent.parent
MARK = re.compile(r"^\s*(?://|#)\s*\[(begin|end):([\w-]+)\]\s*$")
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".glsl": "glsl", ".vert": "glsl", ".frag": "glsl", ".py": "python",
             ".json": "json", ".txt": "text"}


def language(path):
    return LANGUAGES.get(Path(path).suffix, "")


def trackedFiles(root, *patterns):
    """Files of the project that match (a folder stands for all below it): what git knows and what is new, not what is ignored."""
    if (root / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "--", *patterns], cwd=root,
                                capture_output=True, text=True, check=True).stdout.split("\n")
        return sorted(path for path in set(listed) if path and (root / path).is_file())
    found = set()
    for pattern in patterns or ["."]:
        found |= set((root / pattern).rglob("*") if (root / pattern).is_dir() else root.glob(pattern))
    return sorted(str(path.relative_to(root)) for path in found if path.is_file())


def readLines(root, path, where):
    try:
        return (root / path).read_text().splitlines()
    except OSError:
        raise PageError(f"{where}: there is no file {path}") from None


def dedent(lines):
    indents = [len(line) - len(line.lstrip()) for line in lines if line.strip()]
    cut = min(indents, default=0)
    return [line[cut:].rstrip() for line in lines]


def extract(root, path, region, where):
    """The lines of a region (None: of the whole file) without marker lines, moved to the left margin."""
    lines = readLines(root, path, where)
    inside, shown, found = region is None, [], region is None
    for line in lines:
        mark = MARK.match(line)
        if not mark:
            shown += [line] if inside else []
        elif mark[2] == region:
            if mark[1] == "begin" and found:
                raise PageError(f"{where}: region {region} begins twice in {path}")
            found, inside = True, mark[1] == "begin"
    if not found:
        known = sorted({mark[2] for line in lines if (mark := MARK.match(line))})
        raise PageError(f"{where}: no region {region} in {path}; it has: {', '.join(known) or 'none'}")
    if inside and region is not None:
        raise PageError(f"{where}: region {region} of {path} has no // [end:{region}]")
    while shown and not shown[0].strip():
        shown.pop(0)
    while shown and not shown[-1].strip():
        shown.pop()
    return dedent(shown)


def allRegions(root):
    """Every (file, region) that exists."""
    found = []
    for path in trackedFiles(root, "chapters", "shaders", "common", "tests", "assets"):
        if language(path) in ("cpp", "glsl"):
            for line in (root / path).read_text(errors="replace").splitlines():
                mark = MARK.match(line)
                if mark and mark[1] == "begin":
                    found.append((path, mark[2]))
    return found
