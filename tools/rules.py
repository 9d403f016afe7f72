"""The rules of the house as functions: each takes the project's root and returns what breaks it, one line each."""
import fnmatch
import re

import house
import regions
from fill import changedLines
from markers import PageError

INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')
CHAPTER = re.compile(r"(?:chapters|shaders)/(\d\d)_")
MAIN_LINES = (60, 180)
STEP_LINES = 90
LARGER_STEP = "**A larger step:**"

# Which folders of common/ a folder of common/ may include: "math <- image <- scene <- truth; gl; app <- all".
BELOW = {
    "system": {"system"},
    "text": {"text"},
    "math": {"math", "text"},
    "image": {"image", "math", "system", "text"},
    "scene": {"scene", "image", "math", "text"},
    "truth": {"truth", "scene", "image", "math", "text"},
    "gl": {"gl", "image", "math", "system", "text"},
    "app": {"app", "gl", "image", "math", "scene", "system", "text", "truth"},
}
GPU_SCENE = "common/scene/gpu_*"  # the one place where scene and OpenGL meet

# Where a library may be included: elsewhere it would cost compile time, or tie what draws to what it does not need.
LIBRARIES = {
    "embree*": ("common/truth/*.cpp",),
    "OpenImageIO/*": ("common/image/oiio/*.cpp",),
    "tiny_gltf.h": ("common/scene/gltf_*",),
    "meshoptimizer.h": ("common/scene/*.cpp", "assets/*.cpp"),
    "CLI/*": ("common/app/*.cpp",),
    "imgui*": ("common/app/*",),
    "GLFW/*": ("common/gl/*.cpp", "common/app/*.cpp"),
    "EGL/*": ("common/gl/*",),
    "GL/*": ("common/gl/*",),
    "GLES*": ("common/gl/*",),
    "nlohmann/*": ("common/*.cpp", "assets/*"),
    "*tbb/*": ("common/truth/*.cpp",),
    "thread": ("common/truth/*", "common/image/*", "common/app/*"),
    "gtest/*": (),
    "benchmark/*": (),
}

CODE_ADDED = re.compile(r"^\+(?!\+\+)\s*(?!//|#include|[{}\s]*$)\S")
TODO = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b")
ABSOLUTE = re.compile(r"(?<![\w.$~)}>])/(?:home|root|work|Users|mnt|srv)/\w")


def sources(root):
    """(path, line number, quote character, included name) of every include of the project."""
    for path in regions.trackedFiles(root, "common", "chapters", "assets", "shaders", "tests"):
        if regions.language(path) in ("cpp", "glsl"):
            for number, line in enumerate((root / path).read_text(errors="replace").splitlines(), 1):
                if include := INCLUDE.match(line):
                    yield path, number, include[1], include[2]


def mayInclude(path, target):
    """Does the include graph allow this arrow? Both paths from the root."""
    chapter, included = CHAPTER.match(path), CHAPTER.match(target)
    if path.startswith("tests/"):
        return True
    if target.startswith("tests/"):
        return False
    if included:
        return bool(chapter) and int(included[1]) <= int(chapter[1])
    if target.startswith("assets/"):
        return path.startswith("assets/")
    if path.startswith("common/") and target.count("/") == 2:
        allowed = BELOW.get(path.split("/")[1], set()) | ({"gl"} if fnmatch.fnmatch(path, GPU_SCENE) else set())
        return target.split("/")[1] in allowed
    return True


def includes(root):
    """common/ includes no chapter, a chapter only earlier ones, and no folder of common/ one that is built on it."""
    broken = []
    for path, number, quote, name in sources(root):
        if quote == "<":
            continue
        target = f"shaders/{name}" if path.startswith("shaders/") else name
        if not (root / target).is_file():
            broken.append(f"{path}:{number}: there is no {target}: includes are written from the root")
        elif not mayInclude(path, target):
            broken.append(f"{path}:{number}: may not include {target}: see the include rule in CONTRIBUTING.md")
    return broken


def libraries(root):
    """Each library is included where it belongs. A test may ask any library for a second opinion."""
    broken = []
    for path, number, quote, name in sources(root):
        if path.startswith("tests/"):
            continue
        for library, places in LIBRARIES.items():
            if quote == "<" and fnmatch.fnmatch(name, library) and not any(fnmatch.fnmatch(path, p) for p in places):
                broken.append(f"{path}:{number}: <{name}> belongs in {' or '.join(places) or 'tests/'}")
    return broken


def names(root):
    """A chapter's program, shaders, page and image test share its name, and none of these is left without a chapter."""
    chapters, broken = house.chapterNames(root), []
    for name in chapters:
        broken += [f"chapters/{name}: {path} is missing" for path in (f"docs/{name}.md", f"tests/image/{name}_test.cpp")
                   if not (root / path).is_file()]
    for pattern, suffix in (("shaders/[0-9][0-9]_*", ""), ("docs/[0-9][0-9]_*.md", ".md"),
                            ("tests/image/[0-9][0-9]_*_test.cpp", "_test.cpp"), ("chapters/[0-9][0-9]_*", "")):
        broken += [f"{path.relative_to(root)}: there is no chapters/{path.name.removesuffix(suffix)}/main.cpp"
                   for path in sorted(root.glob(pattern)) if path.name.removesuffix(suffix) not in chapters]
    numbers = [name[:2] for name in chapters]
    return broken + [f"two chapters have the number {number}" for number in sorted({n for n in numbers if numbers.count(n) > 1})]


def mainLength(root):
    """A main.cpp is a lesson that is read from top to bottom."""
    broken = []
    for name in house.chapterNames(root):
        length = len((root / "chapters" / name / "main.cpp").read_text().splitlines())
        if not MAIN_LINES[0] <= length <= MAIN_LINES[1]:
            broken.append(f"chapters/{name}/main.cpp has {length} lines, not {MAIN_LINES[0]} to {MAIN_LINES[1]}")
    return broken


def stepLines(root, old, new):
    """Lines of code, new or changed, that a reader of chapter `old` has to learn for chapter `new`. Comments are free."""
    pairs = [(f"chapters/{old}/main.cpp", f"chapters/{new}/main.cpp")]
    pairs += [(path.replace(new, old), path) for path in regions.trackedFiles(root, f"chapters/{new}", f"shaders/{new}")
              if regions.language(path) in ("cpp", "glsl") and not path.endswith("/main.cpp")]
    changed = [line for pair in pairs for line in changedLines(root, *pair)]
    return sum(bool(CODE_ADDED.match(line)) for line in changed)


def steps(root):
    """What changes from one chapter to the next is about 90 lines, or the page says why."""
    chapters, broken = house.chapterNames(root), []
    for old, new in zip(chapters, chapters[1:]):
        lines, page = stepLines(root, old, new), root / "docs" / f"{new}.md"
        if lines > STEP_LINES and not (page.is_file() and LARGER_STEP in page.read_text()):
            broken.append(f"docs/{new}.md: {lines} lines are new since {old}: say why in a paragraph that begins "
                          f"with `{LARGER_STEP}`")
    return broken


def heads(root):
    """Every page begins as docs/refresh wants it."""
    broken = []
    for name in house.chapterNames(root):
        try:
            house.chapter(root, name)
        except PageError as error:
            broken.append(str(error))
    return broken


def leftovers(root):
    """Nothing is left for later, and nothing depends on where the project lies."""
    broken = []
    for path in regions.trackedFiles(root):
        if path == "tools/rules.py" or path.startswith("assets/") and not path.endswith((".cpp", ".h", ".txt")):
            continue
        try:
            lines = (root / path).read_text().splitlines()
        except UnicodeDecodeError:
            continue
        for number, line in enumerate(lines, 1):
            for pattern, what in ((TODO, "something is left to do"), (ABSOLUTE, "an absolute path")):
                if pattern.search(line):
                    broken.append(f"{path}:{number}: {what}: {line.strip()[:80]}")
    return broken


ALL = (includes, libraries, names, mainLength, steps, heads, leftovers)
