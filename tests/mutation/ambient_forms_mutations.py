"""Breaks the closed forms of ambient visibility on purpose, one break at a time, and what is directions and light around
them. The unit test named with the break must notice.

As truth_mutations.py does, but with programs of a finished build; the rays have ambient_mutations.py. One alone:
    python3 tests/mutation/ambient_forms_mutations.py AmbientFormsMutations.testForgottenPi
"""
import unittest

import mutants

HEMISPHERE = "common/math/hemisphere.cpp"
MOMENTS, FORMS = "common/truth/direction_moments.cpp", "common/truth/ambient_forms.cpp"
ESTIMATE = "chapters/09_ambient_occlusion/ambient_estimate.cpp"

# name: (file, unit program, the test of it that must fail, [(old, new), ...])
MUTATIONS = {
    # directions
    "DiskWithoutConcentricSquares": (
        HEMISPHERE, "hemisphere", "*", [("concentricDisk(u)", "(2.0 * u - 1.0) * std::sqrt(0.5)")]),
    "LatticeFromThePole": (HEMISPHERE, "hemisphere", "*", [("(index + 0.5) / count", "double(index) / count")]),
    "FrameOfTheNorthOnly": (HEMISPHERE, "hemisphere", "*", [("std::copysign(1.0, n.z)", "1.0")]),
    # closed forms
    "ForgottenPi": (FORMS, "ambient_forms", "*", [("region.first.z / pi", "region.first.z")]),
    "HalfForTwoThirds": (MOMENTS, "ambient_forms", "*", [("2.0 / 3.0 * glm::dvec3(s1", "0.5 * glm::dvec3(s1")]),
    "CapsKeepWhatIsBelowTheHorizon": (
        MOMENTS, "ambient_forms", "*", [("std::max(0.0, squared)", "0.0")]),
    "TooFewPointsOfARim": (MOMENTS, "ambient_forms", "*", [("> 1e-14", "> 1e-5")]),
    "SlopesSeeTheirHill": (
        FORMS, "ambient_forms", "*Slopes*", [("ambientInProfile(tilt, pi)", "ambientInProfile(0.0, pi - tilt)")]),
    # what is stored of a sky seen
    "NormalisedBentVector": (
        ESTIMATE, "ambient_exactness", "*LinearSkies*", [("sum.bent / count}", "glm::normalize(sum.bent)}")]),
    "BentVectorOfNothing": (
        ESTIMATE, "ambient_exactness", "*WhereNothingIsSeen*", [("length > 0.0 ?", "true ?")]),
    "IrradianceWithoutPi": (
        "chapters/11_bent_normals/sh_irradiance.cpp", "ambient_exactness", "*LinearSkies*",
        [("pi * (visibility * mean", "(visibility * mean")]),
    # rays
    "AStartRoundedOffTheSurface": (
        ESTIMATE, "ambient_exactness", "*/LowWallNearby",
        [("std::vector<ShadowRay> asked;",
          "Hit raised = from; raised.position += 1e-3 * from.geometricNormal;\nstd::vector<ShadowRay> asked;"),
         ("asked.push_back(ShadowRay::from(from,", "asked.push_back(ShadowRay::from(raised,")]),
    "BakedUniformForCosine": (
        "chapters/09_ambient_occlusion/vertex_bake_rays.cpp", "ambient_bake_exactness", "*VerticesAlone*",
        [("byCosine = asked.weighting == Weighting::cosine", "byCosine = asked.count < 0")]),
    "BakedRaysStartFarInside": (
        "chapters/09_ambient_occlusion/vertex_bake_points.cpp", "ambient_bake_exactness", "*VerticesAlone*",
        [("inside = 1e-3", "inside = 0.1")]),
    "LinearFalloff": (
        ESTIMATE, "ambient_exactness", "*/FadingWall", [("1.0 - (1.0 - t) * (1.0 - t)", "t")]),
}


class AmbientFormsMutations(mutants.ArchiveMutations):
    mutations = MUTATIONS


mutants.addTests(AmbientFormsMutations)

if __name__ == "__main__":
    unittest.main(verbosity=2)
