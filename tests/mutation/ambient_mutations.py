"""Breaks how chapter 09 asks the sky on purpose, one break at a time, and demands that the test named with it notices.

As framework_mutations.py does for common/. One alone:
    python3 tests/mutation/ambient_mutations.py AmbientMutations.testUniformRaysAreTakenForCosine
"""
import unittest

import mutants

CHAPTER = "chapters/09_ambient_occlusion/"
ESTIMATE, SKY, PLANES = CHAPTER + "ambient_estimate.cpp", CHAPTER + "sky.cpp", CHAPTER + "open_planes.cpp"
EDGES = CHAPTER + "edge_rays.cpp"

# name: (file, unit program, the test of it that must fail, [(old, new), ...])
MUTATIONS = {
    # rays
    "UniformRaysAreTakenForCosine": (
        ESTIMATE, "ambient_exactness", "*InsideCorner*", [("rays.weighting == Weighting::cosine", "false")]),
    "CosineRaysAreTakenForUniform": (
        ESTIMATE, "ambient_exactness", "*InsideCorner*", [("rays.weighting == Weighting::cosine", "true")]),
    "RaysBeginTooFarAway": (
        ESTIMATE, "sky", "*Contact*",
        [("ShadowRay::from(from, limited ? from.position + reach.range * w : w, !limited)",
          "ShadowRay{from.position + 0.01 * w, limited ? from.position + reach.range * w : w, from.geometricNormal, "
          "from.edgeDistance, from.triangle, !limited}")]),
    "DirectionsBelowTheSurfaceAreOpen": (ESTIMATE, "sky", "*BelowTheSurface*", [("< -tangent) continue;", "< -2.0) continue;")]),
    "TheHorizonIsBelow": (
        ESTIMATE, "ambient_exactness", "*ExactlyOne*", [("< -tangent) continue;", "< 0.01) continue;")]),
    "RangesAreForgotten": (ESTIMATE, "ambient_exactness", "*BeyondItsRange*", [("std::isfinite(reach.range)", "false")]),
    "FalloffTheWrongWayRound": (
        ESTIMATE, "sky", "*Falloff*", [("1.0 - (1.0 - t) * (1.0 - t)", "(1.0 - t) * (1.0 - t)")]),
    "BlockedDirectionsBendTheNormal": (
        ESTIMATE, "ambient_exactness", "*LinearSkies*", [("d.open * d.direction", "d.direction")]),
    # rays at edges
    "TheirOwnRayIsAsked": (EDGES, "edge_rays", "*/Trench:*/Slope:*/Wall", [("if (i != 0 || j != 0) hear(", "hear(")]),
    "NeighboursAreAlwaysRight": (EDGES, "edge_rays", "*/Trench:*/Slope:*/Wall", [("unlikely += (own.open - *said) * own.direction;", "")]),
    # skies
    "OvercastIsUniform": (SKY, "sky", "*Overcast*", [("(1.0 + 2.0 * sine) / 3.0", "1.0 + 0.0 * sine")]),
    "OvercastShinesFromBelow": (SKY, "sky", "*Overcast*", [("sine > 0.0 ?", "sine > -2.0 ?")]),
    "EastIsWest": (SKY, "sky", "*RightWayRound*", [("std::atan2(direction.x,", "std::atan2(-direction.x,")]),
    "AheadIsBehind": (SKY, "sky", "*RightWayRound*", [("-direction.z)", "direction.z)")]),
    "DownIsUp": (SKY, "sky", "*RightWayRound*", [("std::clamp(direction.y,", "std::clamp(-direction.y,")]),
    "TheSkyHasASeam": (SKY, "sky", "*RightWayRound*", [("(i % picture.width + picture.width) % picture.width", "std::clamp(i, 0, picture.width - 1)")]),
    "HalfATexelOff": (SKY, "sky", "*RightWayRound*", [("uv.x * picture.width - 0.5", "uv.x * picture.width")]),
    "NotANumberShines": (SKY, "sky", "*NoSky*", [("value >= 0.0f && std::isfinite(value)", "!(value < 0.0f)")]),
    # where no ray is needed
    "BoxesForTriangles": (PLANES, "sky", "*NotTheirBoxes*", [("if (above(corner, foot", "if (true || above(corner, foot")]),
    "OneCornerOfABox": (PLANES, "sky", "*RisesAbove*", [("cluster.bounds.farthestAlong(from.geometricNormal)", "cluster.bounds.lower")]),
    "RangesFromTheMiddle": (PLANES, "sky", "*RisesAbove*", [("cluster.bounds.squaredDistance(from.position)", "glm::dot(from.position - cluster.bounds.centre(), from.position - cluster.bounds.centre())"),
         ("boxes_[t].squaredDistance(from.position)", "glm::dot(from.position - boxes_[t].centre(), from.position - boxes_[t].centre())")]),
    "ClustersForTriangles": (PLANES, "sky", "*RisesAbove*", [("if (boxes_[t].squaredDistance(from.position) > range * range) continue;", "")]),
    "BothSidesAreOne": (PLANES, "sky", "*RisesAbove*", [("(from.fromBehind ? 1 : 0)", "0")]),
}


class AmbientMutations(mutants.ArchiveMutations):
    mutations = MUTATIONS


mutants.addTests(AmbientMutations)

if __name__ == "__main__":
    unittest.main(verbosity=2)
