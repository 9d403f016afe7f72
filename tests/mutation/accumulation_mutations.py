"""Breaks what chapter 08 computes on the CPU on purpose, one break at a time, and demands that its unit tests notice.

As truth_mutations.py does for the closed forms. One alone:
    python3 tests/mutation/accumulation_mutations.py AccumulationMutations.testNoMarginAtTheReceiver
"""
import unittest

import mutants

LIBRARIES = ["-lgtest", "-lgtest_main", "-ltbb", "-lfmt", "-pthread"]
CHAPTER = "chapters/08_accumulation/"
SOURCES = [
    "common/math/polygon.cpp", "common/math/sampling.cpp", "common/scene/light.cpp",
    "chapters/00_ray_traced_truth/light_samples.cpp"] + [
    f"common/truth/{name}.cpp"
    for name in ("lambert_polygon", "light_pyramid", "cone_subtraction", "polygon_light", "shadow_polygon", "segment_test", "parallel",
                 "triangle_bvh", "exact_scene")] + [
    f"{CHAPTER}{name}.cpp"
    for name in ("flat_polygons", "receiver", "light_points", "projection", "reach", "occluder_tree", "block_map", "texel_blocks", "plane_light",
                 "exact_receiver", "unoccluded_texture")]

# name: (file, unit program that must fail, [(old, new), ...])
MUTATIONS = {
    "TexelCorners": (CHAPTER + "receiver.h", "receiver", [("(column + 0.5)", "(column + 0.0)")]),
    "FoldsAreFlat": (CHAPTER + "flat_polygons.cpp", "receiver", [("> tolerance_) return", "> 1e9 * tolerance_) return")]),
    "SmoothIsFlat": (CHAPTER + "flat_polygons.cpp", "receiver", [("> 1e-3) return", "> 1e3) return")]),
    "BoxAlongTheFirstEdge": (
        CHAPTER + "flat_polygons.cpp", "receiver", [("* (1.0 - 1e-9)) continue", "* (1.0 - 1e-9) || i > 0) continue")]),
    "EveryHullIsAParallelogram": (
        CHAPTER + "flat_polygons.cpp", "receiver", [("<= 1e-6 * glm::length(c - a)", "<= 1e6"), ("hull.size() == 4", "hull.size() >= 4")]),
    "BackKeepsItsEdges": (
        CHAPTER + "receiver.cpp", "receiver",
        [("receiver.uEdge = back ? v : u", "receiver.uEdge = u"), ("receiver.vEdge = back ? u : v", "receiver.vEdge = v")]),
    "LightsReceive": (CHAPTER + "receiver.cpp", "receiver", [("if (isLight(part)) continue;", "")]),
    "InsidesReceive": (CHAPTER + "receiver.cpp", "receiver", [("if (back && surface.closed) continue;", "")]),
    "RowsOfEqualHeight": (
        CHAPTER + "light_points.cpp", "light_points",
        [("(first + inCell.y * columns) / count", "(row + inCell.y) / rows")]),
    "UnshiftedLattice": (CHAPTER + "light_points.cpp", "light_points", [("goldenRatio) + shift", "goldenRatio) + 0.0 * shift")]),
    "FirstPolygonOfTheLightOnly": (
        "chapters/00_ray_traced_truth/light_samples.cpp", "light_points", [("if (u.x < below + share ||", "if (true ||")]),
    "NoMarginAtTheReceiver": (CHAPTER + "projection.cpp", "projection", [("std::max(1.0 - above,", "std::max(1.0 - 0.0 * above,")]),
    "HalfTheMarginAtTheReceiver": (
        CHAPTER + "projection.cpp", "projection", [("roundingsOfARow = 10.0", "roundingsOfARow = 0.1"), ("2.0 * floatRounding * largest", "0.0")]),
    "NegativeProjection": (
        CHAPTER + "projection.cpp", "projection", [("2.0 * projection.far * near / depth)", "0.0)")]),
    "WrongJacobian": (
        CHAPTER + "projection.cpp", "projection", [("uNormal / glm::dot(uNormal, receiver.uEdge)", "glm::normalize(uNormal)")]),
    "LightsBelowProject": (
        CHAPTER + "projection.cpp", "projection", [("if (receiver.height(point.position) <= rounding)", "if (false)")]),
    "OneCornerDecides": (CHAPTER + "reach.cpp", "reach", [("i < group.first + group.count", "i < group.first + 1")]),
    "EdgesSeenFromOneCorner": (
        CHAPTER + "reach.cpp", "reach", [("i < piece.area.count && all", "i < 1 && all")]),
    "OnePolygonMissedIsEnough": (CHAPTER + "reach.cpp", "reach", [("std::all_of(pieces_", "std::any_of(pieces_")]),
    "InwardIsOutward": (CHAPTER + "reach.cpp", "reach", [("glm::cross(b, a)", "glm::cross(a, b)")]),
    "BoxesAreTheirCentres": (CHAPTER + "reach.cpp", "reach", [("+ glm::dot(glm::abs(plane.inward), half)", "")]),
    "CentresForTexels": (CHAPTER + "block_map.cpp", "projection", [("first, size, 0.5)", "first, size, 0.0)")]),
    "NearCutsOccluders": (CHAPTER + "reach.cpp", "reach", [("0.9 * smallest", "1.1 * smallest")]),
    "OwnTrianglesShadow": (
        CHAPTER + "reach.cpp", "reach", [("-2.0 * 0x1p-24 * scale_", "0.0")]),
    "BlocksOverlap": (CHAPTER + "texel_blocks.cpp", "projection", [("middle[axis] += near[axis]", "middle[axis] += near[axis] - 1")]),
    "EmissionCountsTwice": (CHAPTER + "plane_light.cpp", "exact_receiver", [("facingIrradiance(unit_, x)", "facingIrradiance(light_, x)")]),
    "NoCosine": (
        CHAPTER + "plane_light.cpp", "exact_receiver",
        [("* std::max(0.0, glm::dot(n_, directionToLight(unit_, x)))", "")]),
    "LightsShineFromBelow": (CHAPTER + "plane_light.cpp", "exact_receiver", [("isAbove_ = isAbove_ &&", "isAbove_ = true ||")]),
    "OccludersBeyondALamp": (
        CHAPTER + "plane_light.cpp", "exact_receiver", [("light_.type == LightType::directional;", "true;")]),
    "HalfOfTheTree": (
        CHAPTER + "occluder_tree.cpp", "projection",
        [("return reachesInto(reach, 2 * node) || reachesInto(reach, 2 * node + 1);", "return reachesInto(reach, 2 * node);")]),
    "InterpolatedAnyway": (
        CHAPTER + "unoccluded_texture.cpp", "exact_receiver", [("<= 2e-8 * exact", "<= 1.0")]),
    "AcrossTheLightsPlane": (
        CHAPTER + "unoccluded_texture.cpp", "exact_receiver", [("!(value > 0.0)", "false"), ("<= 2e-8 * exact", "<= 1.0")]),
    "BandsOverwriteEachOther": (
        CHAPTER + "unoccluded_texture.cpp", "exact_receiver", [("int j = first - row; j < tile", "int j = 0; j < tile")]),
    "OddTexelsAreLeftOut": (
        CHAPTER + "unoccluded_texture.cpp", "exact_receiver", [("std::min(column, texels.x - tile)", "column / tile * tile * (column + tile <= texels.x)")]),
}


class AccumulationMutations(mutants.LinkedMutations):
    mutations, sources, libraries = MUTATIONS, SOURCES, LIBRARIES

    def unitTestsOf(self, program):
        return [f"tests/unit/accumulation_{program}_test.cpp"]

    def mayInclude(self, source, header):
        return source.startswith(("tests", CHAPTER))


mutants.addTests(AccumulationMutations)

if __name__ == "__main__":
    unittest.main(verbosity=2)
