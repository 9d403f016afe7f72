"""Breaks the reference ray tracer on purpose, one break at a time, and demands that its unit tests notice.

As truth_mutations.py does for the closed forms. One alone:
    python3 tests/mutation/ray_tracer_mutations.py RayTracerMutations.testOwnTriangleBlocks
"""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPILER = os.environ.get("CXX", "c++")
FLAGS = ["-std=c++20", "-O1", "-ffp-contract=off", f'-DPENUMBRA_SOURCE_DIR="{ROOT}"']
EMBREE = "-lembree4" if pathlib.Path("/usr/include/embree4").exists() else "-lembree3"
LIBRARIES = ["-lgtest", "-lgtest_main", "-ltbb", "-lfmt", EMBREE, "-pthread"]
TRUTH = "common/truth/"
TESTS = ["tests/unit/ray_tracer_test.cpp", "tests/unit/shadow_packet_test.cpp"]  # linked into one program
SOURCES = ["common/math/polygon.cpp"] + [
    f"{TRUTH}{name}.cpp" for name in ("ray_tracer", "embree_scene", "shadow_packet", "surface_hit", "segment_test",
                                      "lambert_polygon", "light_pyramid", "cone_subtraction", "triangle_bvh",
                                      "exact_scene")]

# name: (file, [(old, new), ...])
MUTATIONS = {
    "OwnTriangleBlocks": (
        TRUTH + "embree_scene.cpp", [("candidate == query.packet->ownTriangle[id] || ", "")]),
    "FloatDecidesAlone": (TRUTH + "embree_scene.cpp", [("if (surelyBlocks(", "if (true || surelyBlocks(")]),
    "FloatIsTooSure": (TRUTH + "shadow_packet.cpp", [("decisiveUlps * ulp", "0.0f * ulp")]),
    "SlenderTrianglesAreTrusted": (TRUTH + "shadow_packet.cpp", [("mostSlender = 4.0", "mostSlender = 1e9")]),
    "HalfAPacket": (TRUTH + "embree_scene.cpp", [("rays.id[i] = first + i", "rays.id[i] = i")]),
    "IgnoredPartIsSeen": (
        TRUTH + "embree_scene.h", [("return triangle >= begin && triangle < end;", "return triangle != triangle;")]),
    "TouchingIsBlocking": (TRUTH + "segment_test.cpp", [("if (start * end >= 0) return Crossing::none;", "")]),
    "DoubtIsForgotten": (TRUTH + "embree_scene.cpp", [("query.doubtful |= 1u << id;", "")]),
    "EdgesAreForgotten": (TRUTH + "shadow_packet.cpp", [("packet.nearOwnEdge |=", "packet.nearOwnEdge &=")]),
    "NoLift": (TRUTH + "shadow_packet.cpp", [("16.0f * ulp", "0.0f * ulp")]),
    "LiftToTheWrongSide": (TRUTH + "shadow_packet.cpp", [("? -1.0f : 1.0f", "? 1.0f : -1.0f")]),
}


def compile_(source, output, *include):
    folders = [f"-I{folder}" for folder in (*include, ROOT)]
    subprocess.run([COMPILER, *FLAGS, *folders, "-c", source, "-o", output], check=True)


class RayTracerMutations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.objects = {}
        for source in [*TESTS, *SOURCES]:
            cls.objects[source] = cls.folder / (pathlib.Path(source).name + ".o")
            compile_(ROOT / source, cls.objects[source])

    def passes(self, objects, binary):
        subprocess.run([COMPILER, *objects.values(), *LIBRARIES, "-o", binary], check=True)
        return subprocess.run([binary, "--gtest_fail_fast"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              timeout=120).returncode == 0

    def check(self, name):
        file, replacements = MUTATIONS[name]
        text = (ROOT / file).read_text()
        for old, new in replacements:
            self.assertTrue(old in text, f"{name}: {file} no longer contains '{old}'; adapt the mutation")
            text = text.replace(old, new)
        broken = self.folder / name
        (broken / file).parent.mkdir(parents=True)
        (broken / file).write_text(text)
        objects = dict(self.objects)
        # A broken header is seen by whoever includes it by its path from the root.
        for source in [TRUTH + "embree_scene.cpp", TRUTH + "ray_tracer.cpp"] if file.endswith(".h") else [file]:
            objects[source] = broken / (pathlib.Path(source).name + ".o")
            compile_((broken if source == file else ROOT) / source, objects[source], broken)
        self.assertFalse(self.passes(objects, broken / "test"), f"{name}: unit_ray_tracer and unit_shadow_packet do not notice")

    def testUnbroken(self):
        self.assertTrue(self.passes(self.objects, self.folder / "test"), "the tests fail without any mutation")


for name_ in MUTATIONS:
    setattr(RayTracerMutations, f"test{name_}", lambda self, name=name_: self.check(name))

if __name__ == "__main__":
    unittest.main(verbosity=2)
