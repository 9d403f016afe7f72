"""./run: builds the course and renders it.

    ./run                        render every chapter of the scene `courtyard` into out/, with a page to compare them:
                                 out/index.html
    ./run 03                     chapter 03 in a window; without a display, its picture in out/
    ./run 03 FLAGS               the same with the chapter's own flags; ./run 03 --help lists them
    ./run 03 --headless --scene contact --output a.png
    ./run --scene FILE --size WxH   every chapter of another scene (a name in assets/, or any .gltf or .glb file)
    ./run bench                  run time against error of every technique: docs/benchmark.md; ./run bench --help
    ./run --build                only install, configure and build; the programs are build/release/bin/NN_name
    ./run --help

The first run installs what is missing (as root, or with sudo) and builds, which takes some minutes; after that, only
what changed. Change a number in chapters/ or shaders/ and type the same command again.
"""
import argparse
import os
import sys

import build
import gallery
import house
from bench import command as bench


def parse(words):
    """(chapter's name or None, its flags, options of ./run itself or None for help). Leaves with status 2 when wrong."""
    if words and words[0] in ("-h", "--help"):
        return None, [], None
    if words and words[0] == "bench":
        return None, words[1:], bench.parse(words[1:])
    parser = argparse.ArgumentParser(prog="./run", add_help=False, allow_abbrev=False)
    if words and not words[0].startswith("-"):
        name = house.findChapter(build.ROOT, words[0])
        if not name:
            parser.error(f"there is no chapter {words[0]}; there are {', '.join(house.chapterNames(build.ROOT))}")
        return name, words[1:], None
    parser.add_argument("--build", action="store_true")
    parser.add_argument("--scene", default="courtyard")
    parser.add_argument("--size", default="512x512")
    parser.set_defaults(bench=False)
    return None, [], parser.parse_args(words)


def main(words):
    chapter, flags, options = parse(words)
    if not chapter and not options:
        print(__doc__.strip())
        return 0
    build.install("run")
    chapters = house.chapterNames(build.ROOT)
    if options and options.bench:
        return bench.main(options, chapters)
    build.build("release", [chapter] if chapter else [*chapters, "make_assets"])
    if chapter:
        program = build.folder("release") / "bin" / chapter
        os.execv(program, [str(program), *flags])
    return 0 if options.build else gallery.render(chapters, options.scene, options.size)


def guarded(words):
    try:
        return main(words)
    except (build.BuildError, OSError) as problem:
        print(build.reason(problem), file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(guarded(sys.argv[1:]))
