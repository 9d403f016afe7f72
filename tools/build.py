"""Installs, configures and builds; quick and silent when there is nothing to do."""
import os
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRESS = re.compile(r"^\[(\d+)/(\d+)\] ")


class BuildError(Exception):
    """Already explained in its message; the command ends with status 1."""


def reason(problem):
    """One line for a file that cannot be read or written; a BuildError says it itself."""
    if isinstance(problem, OSError) and problem.filename:
        return f"{problem.filename}: {problem.strerror}; make it accessible, or free the place"
    return str(problem)


def install(group):
    if subprocess.run([ROOT / "tools" / "install.sh", group]).returncode != 0:
        raise BuildError("nothing was built: packages are missing")


def folder(preset):
    return ROOT / "build" / preset


def configure(preset):
    made, presets = folder(preset) / "build.ninja", ROOT / "CMakePresets.json"
    if made.exists() and made.stat().st_mtime > presets.stat().st_mtime:
        return  # ninja itself configures again when a CMakeLists.txt changed
    flags = [] if preset == "no-osmesa" or Path("/usr/include/GL/osmesa.h").exists() else ["-DPENUMBRA_WITH_OSMESA=OFF"]
    ran = subprocess.run(["cmake", "--preset", preset, *flags], cwd=ROOT, capture_output=True, text=True)
    if ran.returncode != 0:
        made.unlink(missing_ok=True)
        raise BuildError(f"{ran.stdout}{ran.stderr}cmake --preset {preset} failed: its messages are above")


def build(preset, targets=()):
    """Builds `targets` (none: everything) of a preset. Shows progress, and of the compiler's words only complaints."""
    configure(preset)
    started, said = time.monotonic(), []
    # The status format is set so that a reader's own NINJA_STATUS does not hide the progress from us.
    environment = {**os.environ, "NINJA_STATUS": "[%f/%t] "}
    ninja = subprocess.Popen(["ninja", "-C", folder(preset), *targets], stdout=subprocess.PIPE, text=True,
                             stderr=subprocess.STDOUT, env=environment, errors="replace")
    for line in ninja.stdout:
        step = PROGRESS.match(line)
        if step and sys.stderr.isatty():
            print(f"\rbuilding {preset}: {step[1]} of {step[2]} ", end="", file=sys.stderr, flush=True)
        elif not step:
            said.append(line)
    seconds = time.monotonic() - started
    if sys.stderr.isatty() and seconds > 1:
        print("\r", end="", file=sys.stderr)
    if ninja.wait() != 0:
        raise BuildError("".join(said) + f"the build of {preset} failed: the messages are above")
    if seconds > 1:
        print(f"built {preset} in {seconds:.0f} s", file=sys.stderr, flush=True)
