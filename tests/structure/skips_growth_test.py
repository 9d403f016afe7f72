"""./run bench: the sections skips and growth. What they say of figures, and that they notice when a skip is not exact."""
import json
import random
import struct
import unittest
import zlib
from unittest import mock

from temporary_tree import TreeTest

from bench import exr, growth, growth_fit, growth_points, growth_reasons, many_lights, skips


def exrBytes(size, channels, compression=3):
    """An .exr as OpenImageIO writes it: `channels` name -> floats, top row first."""
    width, height = size
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for name in sorted(channels)) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    attribute = lambda name, kind, value: name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value  # noqa: E731
    header = exr.MAGIC + struct.pack("<i", 2) + b"".join([
        attribute(b"channels", b"chlist", listed), attribute(b"compression", b"compression", bytes([compression])),
        attribute(b"dataWindow", b"box2i", box), attribute(b"displayWindow", b"box2i", box)]) + b"\0"
    blocks = []
    for top in range(0, height, exr.ZIP[compression]):
        rows = range(top, min(top + exr.ZIP[compression], height))
        raw = b"".join(struct.pack(f"<{width}f", *channels[name][y * width:(y + 1) * width])
                       for y in rows for name in sorted(channels))
        split = raw[0::2] + raw[1::2]
        packed = zlib.compress(bytes([split[0]] + [(b - a + 128) & 255 for a, b in zip(split, split[1:])]))
        blocks.append(struct.pack("<2i", top, min(len(packed), len(raw))) + min(packed, raw, key=len))
    at, offsets = len(header) + 8 * len(blocks), []
    for block in blocks:
        offsets.append(at)
        at += len(block)
    return header + struct.pack(f"<{len(offsets)}q", *offsets) + b"".join(blocks)


class ExrTest(unittest.TestCase):
    def setUp(self):
        self.noise = [random.Random(1).uniform(-1e3, 1e3) for _ in range(33 * 20)]
        self.flat = [0.25] * (33 * 20)

    def testReadsTheBitsThatWereWritten(self):
        for compression in exr.ZIP:  # noise does not shrink and is stored as it is, the rest does
            picture = exr.decoded(exrBytes((33, 20), {"R": self.flat, "G": self.noise, "B": self.flat}, compression))
            self.assertEqual((picture.size, list(picture.channels)), ((33, 20), ["B", "G", "R"]))
            read = struct.unpack(f"<{len(self.noise)}f", picture.channels["G"].tobytes())
            self.assertEqual(list(read), [struct.unpack("<f", struct.pack("<f", v))[0] for v in self.noise])

    def testCountsPixelsNotValues(self):
        one = exr.decoded(exrBytes((33, 20), {"R": self.flat, "G": self.flat}))
        changed = list(self.flat)
        changed[5] = changed[600] = 0.25000003
        both = exr.decoded(exrBytes((33, 20), {"R": changed, "G": changed}))
        self.assertEqual((one.differing(one), one.differing(both)), (0, 2))
        with self.assertRaisesRegex(exr.ExrError, "cannot be compared"):
            one.differing(exr.decoded(exrBytes((33, 20), {"R": self.flat})))

    def testRefusesWhatItCannotRead(self):
        good = exrBytes((33, 20), {"R": self.flat})
        for bad, why in ((b"PNG" + good[3:], "not an .exr"), (good[:-9], "damaged"), (good[:60], "damaged"),
                         (good.replace(b"compression\0" + b"\1\0\0\0\3", b"compression\0" + b"\1\0\0\0\4"), "not ZIP"),
                         (good.replace(b"R\0\2", b"R\0\1"), "32-bit")):
            with self.assertRaisesRegex(exr.ExrError, why):
                exr.decoded(bad)


def result(point, **more):
    return {"id": point.id, "technique": point.technique, "quantity": point.quantity, "axis": point.axis,
            "value": point.value, "cpu_ms": 10.0, "cpu_min_ms": 10.0, "total_cpu_ms": 100.0, "memory_mb": 50.0, "work": {}, **more}


class SkipsTest(unittest.TestCase):
    def results(self, differing):
        case = next(c for c in skips.CASES if c.label == "a lantern, and half of the scene in sight")
        on, off = case.points(True)[:2]
        return [result(on, work={"triangles_submitted": 4000}),
                result(off, cpu_ms=25.0, work={"triangles_submitted": 102900}, counter="triangles_submitted", help="why",
                       differing=differing, pixels=4096)]

    def testEveryPointIsItsOwn(self):
        for quick in (True, False):
            ids = [point.id for point in skips.points(quick)]
            self.assertEqual(len(ids), len(set(ids)))
        self.assertLess(len(skips.points(True)), len(skips.points(False)) / 2)

    def testTheTableSaysWhatWasSavedAndThatNothingChanged(self):
        text = "\n".join(skips.page(self.results(0))[0])
        self.assertIn("None of those that claim to be exact changed a bit", text)
        for cell in ("`clusters-unseen`", "| 10.0 | 25.0 | 2.50 |", "triangles_submitted 4 000 → 102 900", "0 of 4 096",
                     "| why |"):
            self.assertIn(cell, text)

    def testASkipThatChangesThePictureIsSaidAloud(self):
        text = "\n".join(skips.page(self.results(3))[0])
        self.assertIn("**1 of them changed the picture**", text)
        self.assertIn("**3 of 4 096**", text)

    def testAGuessIsNotCalledExact(self):
        case = next(c for c in skips.CASES if c.label == "a light's rays")
        on, _, off = case.points(False)
        text = "\n".join(skips.page([result(on), result(off, counter="", help="", differing=7, pixels=9)])[0])
        self.assertIn("None of those that claim", text)
        self.assertIn("7 of 9 (not claimed)", text)

    def testNothingMeasuredIsNoTableOfNothing(self):
        self.assertNotIn("NaN", "\n".join(skips.page([])[0]))


class GrowthTest(unittest.TestCase):
    def testFindsTheExponentOfTheUpperHalf(self):
        law = lambda p: [(x, 1.0 + x ** p) for x in (1e3, 1e4, 1e5, 1e6, 1e7, 1e8)]  # noqa: E731
        for p in (0.5, 1.0, 1.3):
            self.assertAlmostEqual(growth_fit.exponent(law(p)), p, places=2)
        self.assertAlmostEqual(growth_fit.exponent([(1, 4), (10, 4)]), 0.0)
        self.assertIsNone(growth_fit.exponent([(1, 4)]))
        self.assertIsNone(growth_fit.exponent([(1, 0), (2, 0)]))

    def page(self, power):
        one = next(g for g in growth_points.GROWTHS if (g.axis, g.technique) == ("triangles", "03 one map"))
        return growth.page([result(p, cpu_min_ms=1e-4 * p.value ** power) for p in one.points(False)])

    def testWorseThanLinearIsMarkedAndNamed(self):
        lines, figures = self.page(1.2)
        text = "\n".join(lines)
        self.assertIn("Worse than linear: 03 one map over triangles", text)
        self.assertIn("**1.20**", text)
        self.assertEqual([f.name for f in figures], ["growth_triangles", "growth_memory"])
        text = "\n".join(self.page(1.05)[0])
        self.assertIn("Nothing grows worse than linearly", text)
        self.assertIn("| 1.05 |", text)

    def testTheLinearGuideGoesThroughTheHighestEndAndStaysInTheFigure(self):
        curves = [growth.Curve("a", [(1, 10.0), (100, 20.0)]), growth.Curve("b", [(1, 50.0), (100, 4000.0)])]
        guide = growth.linear(curves)
        (x0, y0), end = guide.points
        self.assertEqual((end, guide.guide), ((100, 4000.0), True))
        self.assertAlmostEqual(y0 / x0, 40.0)
        self.assertGreaterEqual(y0, 10.0)
        self.assertGreaterEqual(x0, 1)

    def testATechniqueLooksAlikeInEveryFigure(self):
        results = [result(p, cpu_min_ms=p.value) for g in growth_points.GROWTHS for p in g.points(False)]
        looks = {}
        for figure in growth.page(results)[1]:
            for curve in figure.curves:
                if not curve.guide:
                    looks.setdefault(curve.label.partition(", ")[0], set()).add(curve.look)
        looks.pop("10 maps")  # which is also how the memory of "10 maps, at vertices" begins
        self.assertEqual({len(found) for found in looks.values()}, {1})

    def testEveryGrowthHasAReasonAndPointsOfItsOwn(self):
        for g in growth_points.GROWTHS:
            self.assertTrue((g.axis, g.technique) in growth_reasons.REASONS or g.axis in growth_reasons.REASONS, g)
        for quick in (True, False):
            ids = [point.id for point in growth.points(quick)]
            self.assertEqual(len(ids), len(set(ids)))
        known = {(g.axis, g.technique) for g in growth_points.GROWTHS} | {g.axis for g in growth_points.GROWTHS}
        self.assertLessEqual(set(growth_reasons.REASONS), known, "a reason for what is not measured")

    def testAsManyLightsAsWanted(self):
        for count in (1, 5, 16):
            scene = json.loads(many_lights.gltf(count))
            lights = [n for n in scene["nodes"] if n["name"].startswith("light")]
            self.assertEqual(len(lights), count)
            strength = scene["materials"][1]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"]
            self.assertAlmostEqual(strength * count, many_lights.TOGETHER)


class SceneTest(TreeTest):
    def testASceneThatCannotBeMadeSaysWhy(self):
        self.write("build/release/bin/make_assets", "#!/bin/sh\necho make_assets: the disk is full >&2\nexit 1\n", True)
        point = next(p for p in growth.points(True) if p.axis == "triangles")
        with mock.patch.object(growth_points.build, "ROOT", self.root), \
                mock.patch.object(growth_points.build, "folder", lambda _: self.root / "build/release"):
            with self.assertRaisesRegex(growth_points.PointError, "knot_1000.glb: make_assets: the disk is full"):
                growth_points.provideScene(point)


if __name__ == "__main__":
    unittest.main()
