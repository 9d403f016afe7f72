"""Breaks common/ on purpose, one break at a time, and demands that the unit test named with the break notices.

As truth_mutations.py does for the exact answers, but these programs need the whole library (mutants.ArchiveMutations). One alone:
    python3 tests/mutation/framework_mutations.py FrameworkMutations.testPictureUpsideDown
"""
import unittest

import mutants

APP, GL, IMAGE, SCENE = "common/app/", "common/gl/", "common/image/", "common/scene/"

# name: (file, unit program, the test of it that must fail, [(old, new), ...])
MUTATIONS = {
    # OpenGL
    "LaterErrorsHideTheCause": (
        GL + "gl_errors.cpp", "context", "*ReportsAnErrorOnce*", [(" || pendingMessage[0] != '\\0'", "")]),
    "GivesUpAfterTheFirstBackend": (
        GL + "context.cpp", "context", "*AutomaticGoesOnToEgl*",
        [("reasons.push_back(error.what());", "reasons.push_back(error.what());\nbreak;")]),
    "LinesAfterAnIncludeAreOneOff": (
        GL + "shader_source.cpp", "program", "*NamesTheRightFileAndLine*", [("lineNumber + 1, number", "lineNumber, number")]),
    "DefinesReachOneStage": (
        GL + "program.cpp", "program", "*DefinesReachBothStages*",
        [("loadShaderSource(vertexFile, defines,", "loadShaderSource(vertexFile, {},")]),
    "UnsetUniformsAreDrawnWith": (
        GL + "program_uniforms.cpp", "program", "*UniformMistakes*", [("if (!missing.empty())", "if (false)")]),
    "SamplerObjectsStayBound": (
        GL + "program_uniforms.cpp", "program", "*ASamplerObject*",
        [("glBindSampler(GLuint", "if (binding.samplerObject != 0) glBindSampler(GLuint")]),
    "AFailedReloadLosesTheProgram": (
        GL + "program.cpp", "program", "*ReloadKeeps*",
        [("deleteProgram(std::exchange(id_, state_->build()));", "deleteProgram(std::exchange(id_, 0)), id_ = state_->build();")]),
    "PictureUpsideDown": (
        GL + "render_target.cpp", "gpu_scene", "*ReadsTopRowFirst*", [("size.y - 1 - low - row", "low + row")]),
    "OpenPartsAreCulled": (
        SCENE + "gpu_scene.cpp", "gpu_scene", "*CullingClosedParts*", [("return part.closed;", "return true;")]),
    "OneVertexForEveryNormalInTheDepthPass": (
        SCENE + "gpu_scene.cpp", "gpu_scene", "*OnePositionAreOne*",
        [("if (!indices.empty())", "indices = scene.indices;\nif (false)")]),
    "TexturesAreNotDecoded": (
        SCENE + "gpu_scene.cpp", "gpu_scene", "*AtVZeroAndDecoded*", [("GL_SRGB8_ALPHA8", "GL_RGBA8")]),
    "DarkColoursAreEncodedLikeLightOnes": (
        "shaders/common/present.frag", "present", "*ColoursAreToneMapped*", [("vec3(0.0031308)", "vec3(0.0)")]),
    # scenes
    "APartLeftOutTakesAClusterOfTheNext": (
        SCENE + "culling.cpp", "culling", "*VisibleClusters*",
        [("scene.clusters[i + 1].part == cluster.part", "scene.clusters[i].part == cluster.part")]),
    "RowsOfPixelsRunUp": (SCENE + "camera.cpp", "camera", "*", [("1.0 - 2.0 * pixel.y", "2.0 * pixel.y - 1.0")]),
    "SpotsAreDimmedLinearly": (SCENE + "light.cpp", "light", "*SpotCone*", [("ramp * ramp", "ramp")]),
    "ShellsAddUpTheirVolumes": (
        SCENE + "closed.cpp", "clusters", "Closed.*",
        [("volume[rootOf(parent, t)]", "volume[0]"), ("parent[t] == t &&", "t == 0 &&")]),
    "InterleavedAttributesAreReadAsPacked": (
        SCENE + "gltf_accessor.cpp", "gltf_loader", "*Interleaved*", [("declared == 0 ? elementBytes : declared", "elementBytes")]),
    "CountsOverflow": (
        SCENE + "gltf_accessor.cpp", "gltf_hostile", "*CountsAndOffsets*",
        [("count - 1 <= (room - elementBytes) / stride", "(count - 1) * stride <= room - elementBytes")]),
    "MirrorsTurnSurfacesInsideOut": (
        SCENE + "gltf_placement.cpp", "gltf_loader", "*Mirrored*", [("mirrored && t < mesh", "false && t < mesh")]),
    "NodesAreReachedTwice": (
        SCENE + "gltf_nodes.cpp", "gltf_hostile", "*CyclesAndShared*", [("if (reached[std::size_t(node.node)])", "if (placed.size() > 99)")]),
    "FilesOutsideTheFolderAreRead": (
        SCENE + "gltf_uri.cpp", "gltf_hostile", "*NothingOutside*", [('part == ".."', "part.empty()")]),
    "EmittersLookBackwards": (
        SCENE + "area_lights.cpp", "gltf_views", "*AFlatEmissiveMesh*", [("light.direction = *normal", "light.direction = -*normal")]),
    # pictures
    "NotANumberIsNoDifference": (
        IMAGE + "compare.cpp", "compare", "*NotANumber*", [("std::isfinite(d) ? d : worstPossible", "std::isfinite(d) ? d : 0.0")]),
    "AnImageTestWithoutABoundPasses": (
        "tests/image/image_check.cpp", "image_check", "*MissingBounds*", [("if (verdicts.empty()) throw", "if (false) throw")]),
    "FilesCarryTheTimeOfDay": (
        IMAGE + "oiio/oiio_codec.cpp", "image", "*TwoWrites*", [('spec.attribute("DateTime", "");', "")]),
    "WritingReplacesALink": (
        IMAGE + "file_write.cpp", "image", "*ALinkStaysALink*", [("return error ? file : target;", "return file;")]),
    # command line, window, report
    "NotANumberIsInEveryRange": (
        APP + "parameters.cpp", "parameters", "*WhatIsNotAllowed*",
        [("!(rounded >= float(p.low) && rounded <= float(p.high))", "rounded < float(p.low) || rounded > float(p.high)")]),
    "AnySizeIsTaken": (
        APP + "command_line.cpp", "command_line", "*SizesFromOnePixel*", [(" || size.x > largestSize || size.y > largestSize", "")]),
    "EveryFailureIsStatusOne": (
        APP + "chapter_runner.cpp", "cli", "*AWrongCommandLine*", [("error.what(), error.status()", "error.what(), exitFailed")]),
    "HomeForgetsWhatItTurnsAbout": (APP + "orbit_camera.cpp", "orbit_camera", "*", [("target_ = startTarget_;", "")]),
    "TheAreaLightsErrorIsTheFilters": (
        APP + "report.cpp", "report", "*AreaLights*", [("toJson(*report.areaLightError)", "toJson(*report.error)")]),
}


class FrameworkMutations(mutants.ArchiveMutations):
    mutations = MUTATIONS


mutants.addTests(FrameworkMutations)

if __name__ == "__main__":
    unittest.main(verbosity=2)
