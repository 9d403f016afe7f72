#!/usr/bin/env python3
"""Makes docs/stress.md of the report of a stress sweep.

    ./test --stress                        leaves its report in out/stress.json
    tools/stress_page.py out/stress.json   keeps it as docs/stress.json, and writes docs/stress.md
"""
import json
import pathlib
import shutil
import sys

import files

ROOT = pathlib.Path(__file__).resolve().parents[1]
REPORT, PAGE = "docs/stress.json", "docs/stress.md"

HEAD = """# Numerical stress

What the chapters and the exact answers promise must hold for every scene, not for the ones that somebody thought of. `./test
--stress` draws cases by a seed, half of them anywhere in the ranges below, half at the ends of the ranges, at powers of two and
one rounding beside them; `./test` tries the first 2000. A case that fails is shrunk to its simplest form and printed as a
command that runs it again. This page is written by `tools/stress_page.py` from a report of such a run.
"""

FLOAT_ENDS = """## Where float32 ends

The loader subtracts an origin near the first camera in double, so the distance of a scene from the origin of its file costs
nothing until doubles end: at 1e8 metres they are 1.5e-8 metres apart, and a scene of 1e-6 metres stands on a grid of 67 steps.
Its shape is then that of the rounded file, and everything below still holds for it. Scale costs nothing either.

What floats cannot hold is a scene far *aside*: one whose first camera is many times its size away. Positions are then rounded
to 2^-24 of that distance, and slopes and normals come from the difference of neighbouring pixels' positions. A picture n pixels
high, through the full angle f, has steps of 2 tan(f/2) / n of the camera's distance between them, so these differences lose
all meaning where aside reaches 2^24 times that step, and a share of aside / (2^24 step) of their digits before. The bounds are
held, and tested, up to a thousand scene sizes aside, from where a scene is three pixels of 64 through one degree; what happens
farther out is measured:
"""

EXACT = """## Against exact geometry

Pictures are not compared with pictures. Of each pixel the same tests are made that the chapter makes - the same taps, the
same rays, the same light points - but each is decided in double, from the triangles themselves: lit, dark, or open, if an
edge comes nearer than float arithmetic and the rasteriser's grid can tell, or the gap is less than twice the derived bias.
What a chapter draws must lie between the share that is surely lit and that with all open tests lit, to the rounding of the
sum. So far from any edge it must be equal. The figures *of which every test is known* say that there are such pixels in
half-shadow, where an error would show: a disk that is a thirtieth too small, or a bias that is a third too large, fails a
case in some hundred.
"""

ACNE = """## Acne, by the angle of the light

The derived bias is that of the receiver's slope, and slopes are followed up to 85 degrees: beyond them the bound has no end, and
a twelfth of the light is left to shadow. Below, nothing may shadow itself, and nothing does (subjects `bias` and `filter`); from
there on a surface may, and then all of it. Of the pieces of the angle's range in which anything does, the share of the picture, at
worst:
"""

LEAKS = """## Leaks, by the angle of the light

A sheet hangs over the ground, as far off as the bias may reach and what the depths of texel and ground may be off by;
everything under it must be dark, up to 89.9 degrees. The more the light grazes, the more often that distance is more than
the scene holds (its shadow falls beside the picture): then nothing is promised, and nothing is compared. The largest gap, in
scene sizes, is what a bias costs at worst there:
"""

ENERGY = """## No light is made

Chapter 08 may nowhere draw more light than arrives with nothing in between: Lambert's formula in double at the centres of
the texels that a pixel is blended from, or at the point itself where a surface has no texture. What is more than that must
be less than the derived rounding of the sums and of the blend. Without a texture Lambert's formula is worked out in floats,
in which the edges of a small light all but cancel: what is left is off by a fixed number of roundings of the *light's
radiance*, however little of it arrives. The last figure is that, as a multiple of what does.
"""


def number(value):
    return value if isinstance(value, str) else f"{value:.3g}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def summary(report):
    state = "nothing failed" if report["failed"] == 0 else f"{report['failed']} failed"
    return (f"Seed {report['seed']}: {report['cases']} cases, {report['refused']} refused or without a promise, {state}; "
            f"{report['cpu_seconds']:.0f} s of CPU, {report['cases_per_second']:.0f} cases a second.\n")


def subjects(report):
    rows = [(f"`{one['name']}`", one["claim"], one["cases"], one["refused"], one["failed"]) for one in report["subjects"]]
    return "## What must hold\n\n" + table(("subject", "what must hold", "cases", "refused", "failed"), rows)


def coverage(report):
    """Cases of all subjects together for each piece of each axis."""
    text = "## Coverage\n\nCases by the value of each axis; a piece reaches from its number to the next.\n"
    for axis in report["axes"]:
        counted = {}
        for one in report["subjects"]:
            for piece in one["bins"].get(axis["name"], []):
                counted[piece["from"]] = counted.get(piece["from"], 0) + piece["cases"]
        if counted:
            unit = f" ({axis['unit']})" if axis["unit"] else ""
            text += f"\n**`--{axis['name']}`**{unit}: {axis['help']}\n\n" + table(counted.keys(), [counted.values()])
    return text


def worst(report):
    text = "## Worst cases\n\nThe largest value of each figure, and the case that gave it.\n"
    for one in report["subjects"]:
        if one["worst"]:
            rows = [(figure["name"], number(figure["value"]), f"`{figure['command']}`") for figure in one["worst"]]
            text += f"\n### {one['name']}\n\n" + table(("figure", "worst", "case"), rows)
    return text


def subjectNamed(report, name):
    return next((one for one in report["subjects"] if one["name"] == name), None)


def exactGeometry(report):
    """What the figures of tests decided in double mean, and how many pixels were settled."""
    rows = []
    for name in ("depth", "kernel", "light-points", "sky-rays", "sky-tests"):
        for figure in (subjectNamed(report, name) or {"worst": []})["worst"]:
            rows.append((f"`{name}`", figure["name"], number(figure["value"])))
    return EXACT + "\n" + table(("subject", "figure", "largest"), rows) if rows else ""


def acne(report):
    """What shadows itself where the bias is capped, by the angle at which the light meets the surface's middle."""
    faint = "share of pixels that shadow themselves where light comes in at 85 degrees or more"
    found = {name: (subjectNamed(report, name) or {"bins": {}})["bins"].get("light-angle", []) for name in ("bias", "filter")}
    rows = [(one["from"], one["cases"], number(one["worst"].get(faint, 0.0)), other["cases"],
             number(other["worst"].get(faint, 0.0))) for one, other in zip(found["bias"], found["filter"])
            if faint in one["worst"] and (one["worst"][faint] or other["worst"].get(faint))]
    return ACNE + "\n" + table(("degrees, from", "cases of `bias`", "share", "cases of `filter`", "share"), rows) if rows else ""


def leaks(report):
    """How deep a bias may reach under a grazing light, and how often that is deeper than the scene."""
    pieces = (subjectNamed(report, "leak") or {"bins": {}})["bins"].get("light-angle", [])
    gap, lit = "gap that shadows, of the scene's size", "pixels lit through a sheet farther off than the bound"
    rows = [(piece["from"], piece["cases"], piece["refused"], number(piece["worst"].get(gap, 0.0)),
             number(piece["worst"].get(lit, 0.0))) for piece in pieces]
    return LEAKS + "\n" + table(("degrees, from", "cases", "nothing promised", gap, lit), rows) if rows else ""


def energy(report):
    """What chapter 08 draws beyond what arrives."""
    figures = (subjectNamed(report, "accumulation") or {"worst": []})["worst"]
    rows = [(figure["name"], number(figure["value"])) for figure in figures
            if figure["name"].startswith("light gained")]
    return ENERGY + "\n" + table(("figure", "largest"), rows) if rows else ""


def refusals(report):
    rows = [(f"`{one['name']}`", why, times) for one in report["subjects"] for why, times in one["refusals"].items()]
    return "## What is refused, or says nothing\n\n" + table(("subject", "the line", "times"), rows) if rows else ""


def failures(report):
    text = ""
    for one in report["subjects"]:
        for failure in one["failures"]:
            text += f"* {failure['what']}\n  `{failure['command']}`\n"
    return "## What failed\n\n" + text if text else ""


def floatEnds(report):
    """The figures that are measured however far aside a scene is, by how far it is."""
    text = FLOAT_ENDS
    for one in report["subjects"]:
        pieces = one["bins"].get("aside", [])
        names = sorted({name for piece in pieces for name in piece["worst"] if "however far aside" in name})
        if names:
            rows = [(piece["from"], piece["cases"], *(number(piece["worst"].get(name, 0.0)) for name in names)) for piece in pieces]
            text += f"\n`{one['name']}`:\n\n" + table(("aside, from", "cases", *names), rows)
    return text


def pageOf(report):
    parts = [HEAD, summary(report), failures(report), subjects(report), exactGeometry(report), acne(report), leaks(report),
             energy(report), floatEnds(report), worst(report), refusals(report), coverage(report)]
    return "\n".join(part for part in parts if part)


def main(words):
    if len(words) != 1 or words[0].startswith("-"):
        print(__doc__.strip())
        return 0 if words in (["--help"], ["-h"]) else 2
    try:
        report = json.loads(pathlib.Path(words[0]).read_text())
        page = pageOf(report)
    except (OSError, ValueError, KeyError) as problem:
        print(f"{words[0]}: no report of bin/stress: {problem}", file=sys.stderr)
        return 1
    if pathlib.Path(words[0]).resolve() != ROOT / REPORT:
        shutil.copyfile(words[0], ROOT / REPORT)
    files.write(ROOT / PAGE, page)
    print(f"wrote {REPORT} and {PAGE}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
