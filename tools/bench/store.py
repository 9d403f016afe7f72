"""out/bench/results.jsonl: one line for each time that a point was measured, appended as it happens.

A line counts only as long as nothing that made it has changed: it carries a digest of the program, of the shaders and
assets, and of the command line. So a run that was interrupted goes on where it was, and what was built anew is measured
again.
"""
import hashlib
import json

import build
import reports

LAYOUT = "1"  # of a line: what is older is measured again


def path():
    return build.ROOT / "out" / "bench" / "results.jsonl"


def digest(point):
    """Of all that decides what is measured. A section without a program of its own gives what it has."""
    program = build.folder("release") / "bin" / point.chapter
    made = reports.fileDigest(program) if program.is_file() else point.chapter
    key = "\0".join([LAYOUT, made, reports.inputsDigest(build.ROOT), *point.command()])
    return hashlib.sha256(key.encode()).hexdigest()[:16]


def load():
    """{(id, digest): [sample, ...]} in the order in which they were measured."""
    found = {}
    if not path().is_file():
        return found
    for line in path().read_text().splitlines():
        try:
            entry = json.loads(line)
            found.setdefault((entry["id"], entry["digest"]), []).append(entry["sample"])
        except (ValueError, KeyError):
            continue  # the line that an interrupted run did not finish
    return found


def append(point, key, sample):
    path().parent.mkdir(parents=True, exist_ok=True)
    with path().open("a+b") as file:
        # After a line that was cut off, this one begins on a new line, or both would be lost.
        torn = file.seek(0, 2) > 0 and (file.seek(-1, 2), file.read(1))[1] != b"\n"
        line = json.dumps({"id": point.id, "digest": key, "sample": sample}, separators=(",", ":"))
        file.write(("\n" if torn else "").encode() + line.encode() + b"\n")
