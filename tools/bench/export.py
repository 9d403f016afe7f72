"""Scenes in a form that other programs read: triangles as PLY, camera and area light as JSON.

Of glTF it knows what our own files use (buffers inside the .glb, transforms, indexed triangles). Coordinates stay as
they are: Y up, metres, nodes' transforms applied, lights that are meshes kept apart from what they shine on.
"""
import array
import json
import math
import re
import struct
import sys
from dataclasses import dataclass, field
from pathlib import Path

IDENTITY = [[float(row == column) for column in range(4)] for row in range(4)]
ELEMENTS = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
AMBIENT = "_AMBIENT_VISIBILITY"  # the attribute that chapters 09 and 10 save


class ExportError(Exception):
    """What is wrong with a file, in one line."""


@dataclass
class Mesh:
    """Flat lists: three floats a vertex in positions and normals, three indices a triangle, one float a vertex in values."""
    positions: array.array = field(default_factory=lambda: array.array("f"))
    normals: array.array = field(default_factory=lambda: array.array("f"))
    indices: array.array = field(default_factory=lambda: array.array("I"))
    values: array.array = field(default_factory=lambda: array.array("f"))

    @property
    def vertices(self):
        return len(self.positions) // 3

    @property
    def triangles(self):
        return len(self.indices) // 3

    def bounds(self):
        """[lower corner, upper corner]"""
        axes = [self.positions[axis::3] for axis in range(3)]
        return [[min(axis) for axis in axes], [max(axis) for axis in axes]]

    def add(self, other):
        self.indices.extend(self.vertices + index for index in other.indices)
        self.positions += other.positions
        self.normals += other.normals
        self.values += other.values

    def summary(self):
        """What two programs must agree on if they have the same mesh."""
        return {"vertices": self.vertices, "triangles": self.triangles, "bounds": self.bounds()}


@dataclass
class Light:
    corners: list   # of the rectangle, counter-clockwise seen from the side that shines
    radiance: list  # W / (m^2 sr)


@dataclass
class Scene:
    surfaces: Mesh = field(default_factory=Mesh)
    shining: Mesh = field(default_factory=Mesh)  # the meshes of area lights
    lights: list = field(default_factory=list)   # index as --light takes it; None where it is no rectangle
    cameras: list = field(default_factory=list)


def product(a, b):
    return [[sum(a[row][k] * b[k][column] for k in range(4)) for column in range(4)] for row in range(4)]


def transform(node):
    """parentFromNode, rows first."""
    if "matrix" in node:
        return [[node["matrix"][4 * column + row] for column in range(4)] for row in range(4)]
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    scale, move = node.get("scale", (1, 1, 1)), node.get("translation", (0, 0, 0))
    return [[turn[row][column] * scale[column] for column in range(3)] + [move[row]] for row in range(3)] + [[0, 0, 0, 1]]


def apply(matrix, p, w=1.0):
    return [row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] * w for row in matrix[:3]]


def difference(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    length = math.sqrt(dot(v, v))
    return [x / length for x in v] if length > 0 else [0.0, 1.0, 0.0]


class Glb:
    def __init__(self, path):
        try:
            data = Path(path).read_bytes()
            magic, _, _, size, kind = struct.unpack_from("<4sIII4s", data)
            if magic != b"glTF" or kind != b"JSON":
                raise ValueError("no .glb")
            self.root = json.loads(data[20:20 + size])
            self.binary = data[28 + size:]
        except (OSError, ValueError, struct.error) as problem:
            raise ExportError(f"cannot read {path}: {problem}") from None

    def accessor(self, index):
        described = self.root["accessors"][index]
        view = self.root["bufferViews"][described["bufferView"]]
        values = array.array(ELEMENTS[described["componentType"]])
        start = view.get("byteOffset", 0) + described.get("byteOffset", 0)
        width = WIDTHS[described["type"]] * values.itemsize
        if view.get("byteStride", width) != width:
            raise ExportError("interleaved vertices are not read: our files have none")
        values.frombytes(self.binary[start:start + described["count"] * width])
        if sys.byteorder == "big":
            values.byteswap()
        return values

    def nodes(self):
        """(node, worldFromNode) in the order of the tree, as the course's own loader walks it."""
        waiting = [(index, IDENTITY) for index in reversed(self.root["scenes"][self.root.get("scene", 0)]["nodes"])]
        while waiting:
            index, parent = waiting.pop()
            node = self.root["nodes"][index]
            world = product(parent, transform(node))
            yield node, world
            waiting.extend((child, world) for child in reversed(node.get("children", ())))


def append(mesh, glb, primitive, world):
    attributes, base = primitive["attributes"], mesh.vertices
    positions, indices = glb.accessor(attributes["POSITION"]), glb.accessor(primitive["indices"])
    count = len(positions) // 3
    # Transforms of our scenes turn and move, and scale evenly at most: normals need no inverse.
    points = [apply(world, positions[3 * i:3 * i + 3]) for i in range(count)]
    if "NORMAL" in attributes:
        given = glb.accessor(attributes["NORMAL"])
        normals = [unit(apply(world, given[3 * i:3 * i + 3], 0.0)) for i in range(count)]
        for point, normal in zip(points, normals):
            mesh.positions.extend(point)
            mesh.normals.extend(normal)
        mesh.indices.extend(base + index for index in indices)
    else:  # glTF 2.0, 3.7.2.1: flat; every triangle gets corners of its own
        for i in range(0, len(indices), 3):
            corners = [points[index] for index in indices[i:i + 3]]
            flat = unit(cross(difference(corners[1], corners[0]), difference(corners[2], corners[0])))
            mesh.indices.extend(range(mesh.vertices, mesh.vertices + 3))
            for corner in corners:
                mesh.positions.extend(corner)
                mesh.normals.extend(flat)
    if AMBIENT in attributes:
        mesh.values.extend(glb.accessor(attributes[AMBIENT]))


def emission(material):
    strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
    return [strength * c for c in material.get("emissiveFactor", (0, 0, 0))]


def rectangle(positions, indices):
    """Corners of the rectangle that two triangles make, None if they make none."""
    corners = [tuple(positions[3 * i:3 * i + 3]) for i in indices]
    if len(corners) != 6 or len(set(corners)) != 4:
        return None
    alone = next(corner for corner in corners[3:] if corner not in corners[:3])
    across = next(i for i in range(3) if corners[i] not in corners[3:])  # the other end of its diagonal
    a, b, c, d = corners[across], corners[(across + 1) % 3], alone, corners[(across + 2) % 3]
    u, v = difference(b, a), difference(d, a)
    size = math.sqrt(dot(u, u) * dot(v, v))
    closed = max(abs(x) for x in difference(difference(c, a), [p + q for p, q in zip(u, v)]))
    return [a, b, c, d] if size > 0 and abs(dot(u, v)) < 1e-5 * size and closed < 1e-5 * math.sqrt(size) else None


def cameraOf(glb, node, world):
    described = glb.root["cameras"][node["camera"]]
    lens = described[described["type"]]
    return {"world": world, "near": lens["znear"],
            **({"height": 2 * lens["ymag"]} if described["type"] == "orthographic" else {"fov": lens["yfov"]})}


def load(path):
    """Scene of one of our .glb files."""
    glb, scene, areas = Glb(path), Scene(), []
    for node, world in glb.nodes():
        if "camera" in node:
            scene.cameras.append(cameraOf(glb, node, world))
        if "light" in node.get("extensions", {}).get("KHR_lights_punctual", {}):
            scene.lights.append(None)
        for primitive in glb.root["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            radiance = emission(glb.root["materials"][primitive["material"]])
            mesh = scene.shining if any(radiance) else scene.surfaces
            first = len(mesh.indices)
            append(mesh, glb, primitive, world)
            if any(radiance):
                corners = rectangle(mesh.positions, mesh.indices[first:])
                areas.append(Light(corners, radiance) if corners else None)
    scene.lights += areas
    return scene


def writePly(path, mesh):
    """Binary, in float, vertices in their order."""
    fields = "xyz" if not mesh.values else ("x", "y", "z", "quality")
    names = [*fields[:3], "nx", "ny", "nz", *fields[3:]]
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {mesh.vertices}",
            *(f"property float {name}" for name in names), f"element face {mesh.triangles}",
            "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as out:
        out.write("\n".join(head).encode())
        for i in range(mesh.vertices):
            out.write(struct.pack(f"<{len(names)}f", *mesh.positions[3 * i:3 * i + 3], *mesh.normals[3 * i:3 * i + 3],
                                  *mesh.values[i:i + 1]))
        for i in range(0, len(mesh.indices), 3):
            out.write(struct.pack("<B3i", 3, *mesh.indices[i:i + 3]))


def readPly(path):
    """The vertices of a binary PLY file whose vertices are floats, as writePly and MeshLab write them; no triangles."""
    data = Path(path).read_bytes()
    end = data.find(b"end_header\n")
    head = data[:end].decode(errors="replace")
    count, block = re.search(r"element vertex (\d+)\n((?:property .*\n)+)", head + "\n").groups() if end > 0 else (0, "")
    names = re.findall(r"property float (\w+)\n", block)
    if not names or len(names) != block.count("\n") or "binary_little_endian" not in head:
        raise ExportError(f"{path}: no binary PLY file with vertices of floats")
    body = data[end + 11:end + 11 + 4 * len(names) * int(count)]
    if len(body) < 4 * len(names) * int(count):
        raise ExportError(f"{path}: ends before its last vertex")
    floats = array.array("f", body)
    column = {name: floats[i::len(names)] for i, name in enumerate(names)}

    def woven(wanted):
        present = [column[name] for name in wanted if name in column]
        return array.array("f", [value for row in zip(*present) for value in row])
    return Mesh(positions=woven("xyz"), normals=woven(("nx", "ny", "nz")), values=column.get("quality", array.array("f")))
