"""A scene with as many area lights as one wants: a floor, posts that throw shadows, and the lights in a square above."""
import base64
import json
import math
import struct

FLOOR, POST, LIGHT = 8.0, (0.25, 1.2), 0.4  # metres: side; side and height; side
TOGETHER = 40.0  # radiance times number of lights: the picture is as bright with one as with sixteen


def box(x, y, z, wide, high):
    """Corners and triangles of a box that stands on y, outwards."""
    half = wide / 2
    around = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    corners = [(x + dx * half, y + dy * high, z + dz * half) for dy in (0, 1) for dx, dz in around]
    quads = [(0, 1, 2, 3), (7, 6, 5, 4), (4, 5, 1, 0), (5, 6, 2, 1), (6, 7, 3, 2), (7, 4, 0, 3)]
    return corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def panel(x, y, z, wide):
    """A square that faces down."""
    half = wide / 2
    corners = [(x - half, y, z - half), (x + half, y, z - half), (x + half, y, z + half), (x - half, y, z + half)]
    return corners, [(0, 1, 2), (0, 2, 3)]


def spots(count, side):
    """`count` places spread over a square."""
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    return [((i % columns + 0.5) / columns * side - side / 2, (i // columns + 0.5) / rows * side - side / 2)
            for i in range(count)]


class Writer:
    def __init__(self):
        self.data, self.views, self.accessors, self.meshes, self.nodes = b"", [], [], [], []

    def accessor(self, payload, kind, component, count, **more):
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(payload)})
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component, "count": count, "type": kind,
                               **more})
        self.data += payload
        return len(self.accessors) - 1

    def add(self, name, material, shape):
        corners, triangles = shape
        flat = [value for corner in corners for value in corner]
        positions = self.accessor(struct.pack(f"<{len(flat)}f", *flat), "VEC3", 5126, len(corners),
                                  min=[min(c[i] for c in corners) for i in range(3)],
                                  max=[max(c[i] for c in corners) for i in range(3)])
        indices = self.accessor(struct.pack(f"<{3 * len(triangles)}I", *[i for t in triangles for i in t]), "SCALAR", 5125,
                                3 * len(triangles))
        primitive = {"attributes": {"POSITION": positions}, "indices": indices, "material": material}
        self.meshes.append({"primitives": [primitive]})
        self.nodes.append({"name": name, "mesh": len(self.meshes) - 1})


def gltf(count):
    """The text of a .gltf with `count` area lights."""
    writer = Writer()
    writer.add("floor", 0, box(0.0, -0.2, 0.0, FLOOR, 0.2))
    for i, (x, z) in enumerate(spots(9, 0.6 * FLOOR)):
        writer.add(f"post {i}", 0, box(x, 0.0, z, *POST))
    for i, (x, z) in enumerate(spots(count, 0.8 * FLOOR)):
        writer.add(f"light {i}", 1, panel(x, 3.0, z, LIGHT))
    turned = math.radians(-35.0)
    writer.nodes.append({"name": "camera", "camera": 0, "translation": [0.0, 5.0, 7.0],
                         "rotation": [math.sin(turned / 2), 0.0, 0.0, math.cos(turned / 2)]})
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(writer.nodes)))}],
        "nodes": writer.nodes, "meshes": writer.meshes, "accessors": writer.accessors, "bufferViews": writer.views,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1, "zfar": 100.0}}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1.0], "metallicFactor": 0.0}},
                      {"emissiveFactor": [1.0, 1.0, 1.0], "pbrMetallicRoughness": {"baseColorFactor": [0.0, 0.0, 0.0, 1.0]},
                       "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": TOGETHER / count}}}],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "buffers": [{"byteLength": len(writer.data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(writer.data).decode()}]})
