// make_assets OUTPUT_FOLDER: makes every scene and environment map of assets/, the same bytes each time.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "assets/make/environments.h"
#include "assets/make/scenes.h"
#include "common/error.h"

namespace {

using namespace penumbra::assets;

struct SceneMaker {
    const char* file;
    GlbWriter (*make)();
};

constexpr SceneMaker makers[] = {
    {"heckbert_herf.glb", makeHeckbertHerf},
    {"contact.glb", makeContact},
    {"contact_panel.glb", makeContactPanel},
    {"spheres.glb", makeSpheres},
    {"gully.glb", makeGully},
    {"room.glb", makeRoom},
    {"fence.glb", makeFence},
    {"knot.glb", makeKnot},
    {"courtyard.glb", makeCourtyard},
};

struct EnvironmentMaker {
    const char* file;
    Environment (*make)();
};

constexpr EnvironmentMaker environments[] = {
    {"clear_sky.hdr", makeClearSky},
    {"chapel.hdr", makeChapel},
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_assets OUTPUT_FOLDER (for instance: make_assets assets)\n");
        return penumbra::exitUsage;
    }
    try {
        const std::filesystem::path folder = argv[1];
        for (const SceneMaker& maker : makers) maker.make().write(folder / maker.file);
        for (const EnvironmentMaker& maker : environments) writeHdr(folder / maker.file, maker.make());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_assets: %s\n", error.what());
        return penumbra::exitFailed;
    }
    return penumbra::exitFine;
}
