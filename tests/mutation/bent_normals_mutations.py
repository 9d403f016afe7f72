"""Breaks what chapter 11 knows of a sky on purpose, one break at a time: its samples, its irradiance in nine numbers, in a picture
and as a linear function, and the rays that it is compared with. The unit tests must notice. Shaders are broken in the image tests.

As ambient_forms_mutations.py does, with a program of a finished build. One alone:
    python3 tests/mutation/bent_normals_mutations.py BentNormalsMutations.testColumnsDoNotWrap
"""
import unittest

import mutants

CHAPTER = "chapters/11_bent_normals/"
SAMPLES, HARMONICS, MAP = CHAPTER + "sky_samples.cpp", CHAPTER + "sh_irradiance.cpp", CHAPTER + "irradiance_map.cpp"
DENSITY, TRUTH = CHAPTER + "sky_density.cpp", CHAPTER + "irradiance_truth.cpp"

# name: (file, the test of irradiance_map that must fail, [(old, new), ...])
MUTATIONS = {
    "PolesCountAsMuchAsTheHorizon": (SAMPLES, "SkySamples.*", [("(halfHeight * dPhi)", "(dPhi / bands)")]),
    "OnePointForTwo": (SAMPLES, "ShIrradiance.IsExact*", [("(row % 2 == 0 ? gaussPoint : -gaussPoint)", "0.0")]),
    "ColumnsStartInFront": (SAMPLES, "SkyDensity.*", [("(column + 0.5) * dPhi - std::numbers::pi", "(column + 0.5) * dPhi")]),
    "WholeFirstOrder": (HARMONICS, "ShIrradiance.IsExact*", [("2.0 * pi / 3.0", "pi")]),
    "WholeSecondOrder": (HARMONICS, "ShIrradiance.IsExact*", [("pi / 4.0;", "pi;")]),
    "NegativeLight": (HARMONICS, "ShIrradiance.*Negative", [("return glm::max(sum, glm::dvec3(0.0));", "return sum;")]),
    "AThirdOfTheGradient": (HARMONICS, "LinearSky.IsFoundAgain", [("3.0 / (4.0 * pi) * sample", "1.0 / (4.0 * pi) * sample")]),
    "NormalisedPair": (HARMONICS, "LinearSky.ThePair*", [("gradient * bent)", "gradient * glm::normalize(bent))")]),
    "NormalOfNothing": (HARMONICS, "LinearSky.*Nothing", [("gradient * bent)", "gradient * glm::normalize(bent))")]),
    "CutGroupsAreWhole": (MAP, "CosineConvolution.Groups*", [("above >= group.sine", "above >= 0.0")]),
    "CutGroupsAreGone": (MAP, "CosineConvolution.Groups*", [("above <= -group.sine", "above <= 0.0")]),
    "ColumnsDoNotWrap": (MAP, "IrradianceMap.*Seam", [("i %= texels.width;", "i = std::min(i, texels.width - 1);")]),
    "NoRowAtThePole": (MAP, "IrradianceMap.*Seam", [("/ pi * (texels.height - 1)", "/ pi * texels.height")]),
    "SmallestWillDo": (MAP, "IrradianceMap.IsAsSmall*", [("map.rmse > tolerance", "false")]),
    "DensityOfACell": (DENSITY, "SkyDensity.IsADensity", [("(total_ * solidAngle)", "total_")]),
    "RowsAreChosenEvenly": (DENSITY, "SkyDensity.Finds*", [("choose(rowEnds_, u.x)", "Chosen{int(u.x * rows_), 0.5}")]),
    "OneDensityOfTwo": (TRUTH, "TracedIrradiance.*", [(" + (rays - byCosine) * density.at(w)", "")]),
    "NoCosine": (TRUTH, "TracedIrradiance.*", [("(facing / both)", "(1.0 / both)")]),
}


class BentNormalsMutations(mutants.ArchiveMutations):
    mutations = {name: (file, "irradiance_map", test, breaks) for name, (file, test, breaks) in MUTATIONS.items()}


mutants.addTests(BentNormalsMutations)

if __name__ == "__main__":
    unittest.main(verbosity=2)
