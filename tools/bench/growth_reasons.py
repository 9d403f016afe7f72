"""Why the work of a technique grows as it does, one sentence each: (axis, technique), or the axis for all others."""

REASONS = {
    "triangles":
        "Each triangle is drawn into the map and into the picture; what is done for each pixel does not grow with them.",
    ("triangles", "00 rays"):
        "A ray goes down a tree, whose depth is the logarithm of the triangles; loading them and building the tree is linear.",
    ("triangles", "09 rays"):
        "A ray goes down a tree, whose depth is the logarithm of the triangles; the picture draws each.",
    ("triangles", "08 masks"):
        "Each triangle that can come between is projected once for each light point, 32 points a draw call; the receivers' "
        "texels do not grow with them.",
    ("triangles", "10 maps"):
        "Each triangle is drawn into each of the maps; the look-ups of the pixels stay the same.",
    "pixels":
        "Each pixel is shaded once; the map, which does not know how large the picture is, is drawn once a frame.",
    ("pixels", "00 rays"):
        "Each pixel has its rays, and neighbours share what they touch of the tree in the caches.",
    ("pixels", "09 rays"):
        "Each pixel has its rays, and neighbours share what they touch of the tree in the caches.",
    ("pixels", "10 maps"):
        "Each pixel looks every map up once; drawing the maps does not grow with the picture.",
    ("pixels", "08 masks"):
        "The light is made in the receivers' textures, whose texels do not depend on the picture, which only looks them up.",
    "lights":
        "Each light's shadow is a picture of its own, added to those of the others.",
    ("lights", "00 rays"):
        "Each pixel sends rays to every light.",
    "samples":
        "Each sample is a ray.",
    ("samples", "00 rays"):
        "Each sample is a ray; the ray from the camera is shared.",
    ("samples", "07 branching"):
        "Each sample is a tap, but only where the minima and maxima of the map leave any doubt.",
    ("samples", "08 masks"):
        "Each sample is another projection of every triangle in between, 32 in a draw call; texels on which all points agree "
        "need no weights.",
    ("samples", "08 accumulated"):
        "Each sample clears, draws and adds a texture; what the receivers would get without shadows is computed once.",
    ("samples", "10 maps"):
        "Each sample is a map to draw and to look up; the receivers' positions are drawn once.",
    ("samples", "09 bake"):
        "Each sample is a ray, but loading, the tree and asking the neighbours cost the same for any number.",
    "vertices":
        "Each vertex has its rays, down a tree whose depth is the logarithm; loading and building the tree are linear.",
    ("vertices", "10 maps, at vertices"):
        "Each vertex looks every map up once, and its triangles are drawn into each of them.",
}
