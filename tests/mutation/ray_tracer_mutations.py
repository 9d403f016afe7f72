"""Breaks the reference ray tracer on purpose, one break at a time, and demands that its unit tests notice.

As truth_mutations.py does for the closed forms. One alone:
    python3 tests/mutation/ray_tracer_mutations.py RayTracerMutations.testOwnTriangleBlocks
"""
import pathlib
import unittest

import mutants

EMBREE = "-lembree4" if pathlib.Path("/usr/include/embree4").exists() else "-lembree3"
LIBRARIES = ["-lgtest", "-lgtest_main", "-ltbb", "-lfmt", EMBREE, "-pthread"]
TRUTH = "common/truth/"
TESTS = ["tests/unit/ray_tracer_test.cpp", "tests/unit/shadow_packet_test.cpp"]  # linked into one program
SOURCES = ["common/math/polygon.cpp"] + [
    f"{TRUTH}{name}.cpp" for name in ("ray_tracer", "embree_scene", "embree_hierarchy", "shadow_packet", "surface_hit", "segment_test",
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


class RayTracerMutations(mutants.LinkedMutations):
    mutations = {name: (file, "ray_tracer", replacements) for name, (file, replacements) in MUTATIONS.items()}
    sources, libraries = SOURCES, LIBRARIES

    def unitTestsOf(self, program):
        return TESTS

    def mayInclude(self, source, header):
        return source in (TRUTH + "embree_scene.cpp", TRUTH + "ray_tracer.cpp")


mutants.addTests(RayTracerMutations)

if __name__ == "__main__":
    unittest.main(verbosity=2)
