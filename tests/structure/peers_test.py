"""What `./run bench --peers` does before and after other programs run: export, scripts, comparison at equal error."""
import json
import math
import struct
import sys
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parent))
from temporary_tree import ROOT, TreeTest  # noqa: E402

from bench import export, peers, peers_jobs, peers_meshlab  # noqa: E402
from bench.curves import Curve  # noqa: E402
from bench.peers_curves import atEqualError, curveOf, figures  # noqa: E402
from bench.runner import PointError  # noqa: E402

ASSETS = ROOT / "assets"


def line(*points):
    return Curve("line", [(ms, error, {}) for ms, error in points])


def result(technique, value, rmse, cpu, whole, quantity="soft shadow", **further):
    return {"technique": technique, "quantity": quantity, "scene": "heckbert_herf", "axis": "samples", "value": value,
            "cpu_ms": cpu, "wall_ms": cpu, "process_cpu_ms": whole, "error": {"rmse": rmse, "bias": 0.0}, **further}


def facing(mesh):
    """The least cosine between a triangle's own normal and those of its corners: an index that is off points elsewhere."""
    corner = lambda values, i: values[3 * i:3 * i + 3]  # noqa: E731
    least = 1.0
    for at in range(0, len(mesh.indices), 3):
        a, b, c = (corner(mesh.positions, i) for i in mesh.indices[at:at + 3])
        normal = export.unit(export.cross(export.difference(b, a), export.difference(c, a)))
        least = min([least, *(export.dot(normal, corner(mesh.normals, i)) for i in mesh.indices[at:at + 3])])
    return least


def glb(root, binary):
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text), 0x4E4F534A)
    return head + text + struct.pack("<II", len(binary), 0x004E4942) + binary


class Exporter(TreeTest):
    def testHeckbertAndHerfsSceneIsWhatItsFileSays(self):
        scene = export.load(ASSETS / "heckbert_herf.glb")
        self.assertEqual(3, scene.surfaces.triangles)
        self.assertEqual(2, scene.shining.triangles)
        for found, wanted in zip(scene.surfaces.bounds(), ([-1.2, 0.0, -1.2], [1.2, 1.0, 1.2])):
            for a, b in zip(found, wanted):
                self.assertAlmostEqual(a, b, 6)
        self.assertAlmostEqual(2.4, scene.cameras[1]["height"])
        # The camera above looks down: its axis -z is the world's -y.
        self.assertAlmostEqual(1.0, scene.cameras[1]["world"][1][2], 6)
        a, b, c, d = scene.lights[0].corners
        self.assertEqual([8.0, 8.0, 8.0], scene.lights[0].radiance)
        self.assertAlmostEqual(-1.0, export.cross(export.difference(b, a), export.difference(d, a))[1])  # 1 m^2, down
        self.assertEqual(c, tuple(p + q - r for p, q, r in zip(b, d, a)))

    def testLightsAreNumberedAsTheChaptersNumberThem(self):
        kinds = [light is not None for light in export.load(ASSETS / "contact_panel.glb").lights]
        self.assertEqual([True], kinds)
        self.assertEqual([None, None], export.load(ASSETS / "contact.glb").lights)  # a spot and a point

    def testNodesTurnAndMoveWhatTheyHold(self):
        turn = [0.0, math.sin(math.pi / 4), 0.0, math.cos(math.pi / 4)]  # a quarter turn about y: x becomes -z
        parent = export.transform({"translation": [1, 2, 3]})
        world = export.product(parent, export.transform({"rotation": turn, "scale": [2, 2, 2]}))
        for a, b in zip(export.apply(world, [1, 0, 0]), [1, 2, 1]):
            self.assertAlmostEqual(a, b)
        for a, b in zip(export.apply(world, [0, 0, 1]), [3, 2, 3]):
            self.assertAlmostEqual(a, b)
        matrix = [2.0, 0, 0, 0, 0, 2.0, 0, 0, 0, 0, 2.0, 0, 5, 6, 7, 1]  # columns first, as in glTF
        self.assertEqual([7.0, 6.0, 7.0], export.apply(export.transform({"matrix": matrix}), [1, 0, 0]))

    def testChildrenMoveWithTheirParents(self):
        root = {"scenes": [{"nodes": [1]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
                                                                         "material": 0}]}], "materials": [{}],
                "nodes": [{"mesh": 0, "translation": [0, 1, 0]}, {"children": [0], "translation": [5, 0, 0]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                              {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
                "bufferViews": [{"byteOffset": 0}, {"byteOffset": 36}]}
        data = struct.pack("<9f3H2x", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)
        (self.root / "a.glb").write_bytes(glb(root, data))
        mesh = export.load(self.root / "a.glb").surfaces
        self.assertEqual([[5.0, 1.0, 0.0], [6.0, 2.0, 0.0]], mesh.bounds())
        self.assertEqual([0.0, 0.0, 1.0], list(mesh.normals[:3]))  # of a mesh without any: its triangles' own

    def testAPlyFileHoldsTheSameVerticesInTheSameOrder(self):
        scene = export.load(ASSETS / "contact_panel.glb")
        mesh = scene.surfaces
        mesh.add(scene.shining)
        self.assertGreater(facing(mesh), 0.7)
        mesh.values.extend(i / 7 for i in range(mesh.vertices))
        path = self.root / "mesh.ply"
        export.writePly(path, mesh)
        read = export.readPly(path)
        for name in ("positions", "normals", "values"):
            self.assertEqual(list(getattr(mesh, name)), list(getattr(read, name)), name)
        head, body = path.read_bytes().split(b"end_header\n", 1)
        self.assertIn(f"element face {mesh.triangles}\n".encode(), head)
        faces = body[mesh.vertices * 28:]
        self.assertEqual(13 * mesh.triangles, len(faces))
        self.assertEqual((3, *mesh.indices[-3:]), struct.unpack("<B3i", faces[-13:]))
        self.assertEqual(mesh.vertices - 1, max(mesh.indices))

    def testFilesThatAreNoneAreRefusedInOneLine(self):
        self.write("a.glb", "no glb at all, and longer than its head")
        for what, path in ((export.load, self.root / "a.glb"), (export.load, self.root / "none.glb"),
                           (export.readPly, self.root / "a.glb")):
            with self.assertRaises(export.ExportError) as refused:
                what(path)
            self.assertIn(path.name, str(refused.exception))
            self.assertNotIn("\n", str(refused.exception))
        mesh = export.load(ASSETS / "heckbert_herf.glb").surfaces
        export.writePly(self.root / "cut.ply", mesh)
        cut = (self.root / "cut.ply").read_bytes()
        (self.root / "cut.ply").write_bytes(cut[:cut.index(b"end_header\n") + 11 + 24 * mesh.vertices - 2])
        self.assertRaisesRegex(export.ExportError, "last vertex", export.readPly, self.root / "cut.ply")

    def testOnlyRectanglesAreLights(self):
        square = [0.0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1]
        self.assertEqual(4, len(export.rectangle(square, [0, 1, 2, 0, 2, 3])))
        # Wherever the diagonal's triangles begin, corners stay in order around the edge.
        for indices in ([1, 2, 0, 3, 0, 2], [2, 0, 1, 2, 3, 0]):
            a, b, _, d = export.rectangle(square, indices)
            self.assertAlmostEqual(-1.0, export.cross(export.difference(b, a), export.difference(d, a))[1])
        self.assertIsNone(export.rectangle([0.0, 0, 0, 1, 0, 0, 1.5, 0, 1, 0, 0, 1], [0, 1, 2, 0, 2, 3]))
        self.assertIsNone(export.rectangle(square, [0, 1, 2]))


class EqualError(unittest.TestCase):
    def testStraightLinesInLogarithms(self):
        # Errors fall as 1 / time; the second one takes twelve times as long for the same.
        met = atEqualError(line((1, 0.1), (10, 0.01), (100, 0.001)), line((12, 0.1), (480, 0.0025)))
        self.assertAlmostEqual(0.0025, met.error)
        self.assertAlmostEqual(40.0, met.ours)
        self.assertAlmostEqual(12.0, met.ratio)
        self.assertEqual("", met.bound)

    def testAPeerThatIsFasterIsSaidToBe(self):
        self.assertAlmostEqual(0.25, atEqualError(line((4, 0.1), (40, 0.01)), line((1, 0.1), (10, 0.01))).ratio)

    def testWhatHasLessErrorAlreadyIsABound(self):
        met = atEqualError(line((5, 1e-5)), line((1, 0.1), (10, 0.01)))
        self.assertEqual(("ours", 0.01, 5), (met.bound, met.error, met.ours))
        self.assertEqual("theirs", atEqualError(line((1, 0.1), (10, 0.01)), line((5, 1e-5))).bound)

    def testASlowerSettingWithMoreErrorIsPassedOver(self):
        met = atEqualError(line((1, 0.1), (5, 0.2), (10, 0.01)), line((1, 0.01)))
        self.assertAlmostEqual(10.0, met.ours)

    def testNothingMeasuredIsNothingToCompare(self):
        self.assertIsNone(atEqualError(line(), line((1, 0.1))))
        self.assertEqual([], curveOf([], "cpu_ms").points)

    def testFigures(self):
        found = figures([3.0, -4.0])
        self.assertAlmostEqual(math.sqrt(12.5), found["rmse"])
        self.assertEqual((-0.5, 3.5, 4.0, 2), tuple(found[name] for name in ("bias", "mean_abs", "max_abs", "pixels")))


class Points(TreeTest):
    def testEveryPointIsThereOnceAndQuickOnesAreAmongThem(self):
        every, quick = ([point.id for point in peers.points(q)] for q in (False, True))
        self.assertEqual(len(every), len(set(every)))
        self.assertLess(set(quick), set(every))
        self.assertTrue({"Cycles", "Cycles bake", "MeshLab"} < {point.technique for point in peers.points(True)})

    def testAPeerThatIsNotToBeHadIsLeftOutInOneLine(self):
        with mock.patch.object(peers, "absent", set()), mock.patch("builtins.print") as said, \
                mock.patch("shutil.which", lambda name: None if name == "blender" else name), \
                mock.patch("build.install", side_effect=peers.build.BuildError("no")):
            peers.prepare()
            self.assertEqual(1, said.call_count)
            self.assertIn("Blender", said.call_args[0][0])
            chapters = {point.chapter for point in peers.points(False)}
        self.assertNotIn("blender", chapters)
        self.assertIn("meshlabserver", chapters)

    def testWhatAPeerSaysLastIsTheReason(self):
        said = ("Blender 3.4.1\nTraceback\nModuleNotFoundError: No module named 'x'\n\n"
                "Error: script failed, file: 'y', exiting.\n")
        self.assertEqual("ModuleNotFoundError: No module named 'x'", peers_jobs.reason(said))
        self.assertEqual("no message", peers_jobs.reason("\n"))
        with self.assertRaisesRegex(PointError, "^sh ended with status 3: error: so$"):
            peers_jobs.run(["sh", "-c", "echo one; echo error: so >&2; exit 3"])

    def testCpuOfAProcessIsCounted(self):
        used = peers_jobs.run([sys.executable, "-S", "-c", "sum(range(3000000)); print(7)"])
        self.assertGreater(used.cpu_s, 0.0)
        self.assertEqual("7", used.said.strip())

    def testAFileIsMadeOnceAndNeverHalf(self):
        made = []
        with mock.patch.object(peers_jobs, "folder", lambda: self.root):
            def fails(new):
                new.write_text("half")
                raise PointError("no")
            self.assertRaises(PointError, peers_jobs.made, "a", ".x", ["key"], fails)
            for key in ("key", "key", "other"):
                peers_jobs.made("a", ".x", [key], lambda new: (made.append(new), new.write_text("whole")))
            self.assertEqual(2, len(made))
            self.assertEqual([], list(self.root.glob("new.*")))
            self.assertEqual({"whole"}, {path.read_text() for path in self.root.glob("a.*")})

    def testTheFiltersScriptIsXmlWithAllOfItsParameters(self):
        script = peers_meshlab.filterScript(64, 1024)
        filters = xml.fromstring(script.split("\n", 1)[1]).findall("filter")
        given = {one.get("name"): one.get("value") for one in filters[0]}
        self.assertEqual("Ambient Occlusion", filters[0].get("name"))
        self.assertEqual(7, len(given))  # without all of them it aborts
        self.assertEqual(("64", "1024"), (given["reqViews"], given["depthTexSize"]))

    def testScriptsForBlenderAreSoundPython(self):
        for path in sorted((ROOT / "tools" / "bench").glob("blender_*.py")):
            compile(path.read_text(), str(path), "exec")


class Page(unittest.TestCase):
    RESULTS = [result("08 masks", 4, 0.1, 10.0, 100.0), result("08 masks", 64, 0.01, 20.0, 110.0),
               result("Cycles", 4, 0.1, 200.0, 2000.0, version="Blender 9.9", ours={"rmse": 0.01}),
               result("Cycles", 64, 0.01, 2000.0, 4400.0, version="Blender 9.9", ours={"rmse": 0.01})]

    def testItSaysWhoIsFasterByHowMuchAndMeasuredWithWhat(self):
        lines, drawn = peers.page(json.loads(json.dumps(self.RESULTS)))
        text = "\n".join(lines)
        self.assertIn("| 08 masks | Cycles | 0.01 | 20 | 2000 | 08 masks, 100 times | 40 |", text)
        self.assertIn("Measured beside Blender 9.9.", text)
        self.assertIn("finds an error of 0.01000", text)
        self.assertEqual([False, True], [curve.dashed for curve in drawn[0].curves])

    def testAPeerThatIsFasterIsNamed(self):
        slow = [{**r, "cpu_ms": 1e4 * r["cpu_ms"]} if r["technique"] == "08 masks" else r for r in self.RESULTS]
        self.assertIn("Cycles, 100 times", "\n".join(peers.page(slow)[0]))

    def testOursAloneIsAPageToo(self):
        text = "\n".join(peers.page(self.RESULTS[:2])[0])
        self.assertNotIn("least error that both reach", text)


if __name__ == "__main__":
    unittest.main()
