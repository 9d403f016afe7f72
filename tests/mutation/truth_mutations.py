"""Breaks the exact answers on purpose, one break at a time, and demands that their unit tests notice.

A test that cannot fail proves nothing. Each mutation below is a bug that somebody could make; if the program named with
it still passes, the test is too weak. Slow (a minute or two): part of the full ./test, not of --fast. One alone:
    python3 tests/mutation/truth_mutations.py TruthMutations.testNoHorizonClip
"""
import unittest

import mutants

SOURCES = ["common/math/polygon.cpp"] + [
    f"common/truth/{name}.cpp"
    for name in ("lambert_polygon", "light_pyramid", "cone_subtraction", "polygon_light", "shadow_polygon",
                 "edge_coverage", "triangle_bvh", "exact_scene")]
LIBRARIES = ["-lgtest", "-lgtest_main", "-ltbb", "-lfmt", "-pthread"]

# name: (file, unit program that must fail, [(old, new), ...])
MUTATIONS = {
    "NoHorizonClip": (
        "common/truth/light_pyramid.cpp", "polygon_light",
        [("clip(light, [&](const glm::dvec3& p) { return glm::dot(n, p); })", "light")]),
    "OccluderNotCutAtTheLight": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction", [("plane < 4", "plane < 3")]),
    "TrianglesBehindTheLightShadow": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction",
        [("<= pyramid.rounding) return true;", "<= -1e300) return true;"),
         ("isOutside(cone, pyramid.light, 3, tolerance) || ", ""),
         ("plane < 4", "plane < 3")]),
    "SurfacesShadowThemselves": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction",
        [("if (std::abs(offset) <= tolerance) return;", "")]),
    "OneWindingOnly": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction", [("offset > 0.0 ? 1.0 : -1.0", "1.0")]),
    "RoundingAddsLight": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction", [("std::min(sum, whole)", "sum")]),
    "NoQuadrants": (
        "common/truth/light_pyramid.cpp", "cone_subtraction", [("pyramid.wide = isWide(pyramid, light);", "")]),
    "AQuadrantIsMissing": (
        "common/truth/light_pyramid.h", "polygon_light",
        [("Quadrant::second, Quadrant::third, Quadrant::fourth}", "Quadrant::second, Quadrant::third}")]),
    "CutFromTheFarEnd": ("common/math/polygon.h", "cone_subtraction", [("sIn < -sOut ?", "sIn > -sOut ?")]),
    "CutFromTheKeptSide": ("common/math/polygon.h", "cone_subtraction", [("sIn < -sOut ?", "true ?")]),
    "CornersAtTheirOwnDistances": (
        "common/truth/light_pyramid.cpp", "cone_subtraction",
        [("if (pyramid.wide) return lambertFormFactor", "if (false) return lambertFormFactor")]),
    "PlanesInDouble": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction", [("planeOf<long double>", "planeOf<double>")]),
    "FullPiecesAreNotHalved": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction",
        [("Polygon3::capacity / 2) halve(", "1000) halve(")]),
    "HalvesForgetCones": (
        "common/truth/cone_subtraction.cpp", "cone_subtraction",
        [("work.listed.resize(begin);", "work.listed.resize(begin), last = std::min(last, first + 40);")]),
    "BothSidesEmit": (
        "common/truth/light_pyramid.cpp", "polygon_light",
        [("if (pyramid.height <= pyramid.rounding) return", "if (false) return")]),
    "PlainCrossProduct": (
        "common/truth/lambert_polygon.cpp", "polygon_light", [("0.5 * glm::cross(a + b, edge)", "glm::cross(a, b)")]),
    "NothingTakenOut": ("common/truth/lambert_polygon.cpp", "polygon_light", [("k = 1.0 / cc", "k = 0.0 * cc")]),
    "ArcCosine": (
        "common/truth/lambert_polygon.cpp", "polygon_light",
        [("adotb > 0.0 && squared <=", "false && squared <="),
         ("std::atan2(l, adotb)", "std::acos(adotb / std::sqrt(glm::dot(a, a) * glm::dot(b, b)))")]),
    "CutFromTheFirstCorner": (
        "common/math/polygon.h", "polygon",
        [(": crossing(*current, side, *previous, previousSide)",
          ": crossing(*previous, previousSide, *current, side)")]),
    "CornersOnTheLineAreLost": (
        "common/math/polygon.h", "polygon", [("if (side <= 0.0) outside", "if (side < 0.0) outside")]),
    "ShadowOfWhatIsBelowThePlane": (
        "common/truth/shadow_polygon.cpp", "shadow_polygon",
        [("clip(Polygon3(triangle), heightOf)", "Polygon3(triangle)")]),
    "NegativeProjection": (
        "common/truth/shadow_polygon.cpp", "shadow_polygon",
        [("lightHeight - h}", "std::abs(lightHeight - h)}")]),
    "MisAreaOfAxisAlignedEdges": (
        "common/truth/shadow_polygon.cpp", "shadow_polygon", [(" + s * s / (12.0 * c)", "")]),
    "BoxWithoutCorners": ("common/truth/edge_coverage.cpp", "edge_coverage", [("2.0 * a * b", "a * b")]),
    "HierarchyForgetsCorners": (
        "common/truth/triangle_bvh.cpp", "exact_scene",
        [("for (const glm::dvec3& corner : entries_[i].corners) bounds.extend(corner);",
          "bounds.extend(entries_[i].corners[0]);")]),
    "OrderOfTheHierarchy": (
        "common/truth/exact_scene.cpp", "exact_scene", [("return a->triangle < b->triangle;", "return a < b;")]),
    "LeaksAtVertices": (
        "common/truth/exact_scene.cpp", "exact_scene",
        [("q.x * r.y - q.y * r.x", "glm::dot(along_, glm::cross(b + c, c - b))"),
         ("r.x * p.y - r.y * p.x", "glm::dot(along_, glm::cross(c + a, a - c))"),
         ("p.x * q.y - p.y * q.x", "glm::dot(along_, glm::cross(a + b, b - a))")]),
    "TouchingCountsAsBlocking": (
        "common/truth/exact_scene.cpp", "exact_scene",
        [("end < 0.0) || (start < 0.0 && end > 0.0)", "end <= 0.0) || (start < 0.0 && end >= 0.0)")]),
}


class TruthMutations(mutants.LinkedMutations):
    mutations, sources, libraries = MUTATIONS, SOURCES, LIBRARIES


mutants.addTests(TruthMutations)

if __name__ == "__main__":
    unittest.main(verbosity=2)
