"""Why the work of a technique grows as it does, one sentence each: (axis, technique), or the axis for all others."""

REASONS = {
    "triangles": "",
    "pixels": "",
    "lights": "",
    "samples": "",
    "vertices": "",
}
