// make_assets OUTPUT_FOLDER: makes every scene and environment map of assets/, the same bytes each time.
// make_assets --knot TRIANGLES FILE: the scene knot with another number of triangles.
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

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
    {"knot.glb", [] { return makeKnot(); }},
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

constexpr const char* help =
    "make_assets FOLDER                  makes every scene and environment map of assets/ in FOLDER\n"
    "make_assets --knot TRIANGLES FILE   makes the scene knot with 100 to 5000000 triangles, as a .glb, to\n"
    "                                    see how time and memory grow with them; that of assets/ has 70000\n";

void makeAll(const std::filesystem::path& folder) {
    for (const SceneMaker& maker : makers) maker.make().write(folder / maker.file);
    for (const EnvironmentMaker& maker : environments) writeHdr(folder / maker.file, maker.make());
}

int trianglesFrom(const std::string& text) {
    int triangles = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, triangles);
    if (error != std::errc() || stop != end || triangles < 100 || triangles > 5'000'000)
        throw penumbra::UsageError("--knot " + text + ": must be a whole number from 100 to 5000000");
    return triangles;
}

void makeOneKnot(const std::string& triangles, const std::filesystem::path& file) {
    if (file.extension() != ".glb") throw penumbra::UsageError(file.string() + ": must end in .glb");
    makeKnot(trianglesFrom(triangles)).write(file);
}

int run(const std::vector<std::string>& arguments) {
    const bool knot = !arguments.empty() && arguments[0] == "--knot";
    if (arguments.size() == 1 && (arguments[0] == "--help" || arguments[0] == "-h")) {
        std::printf("%s", help);
    } else if (knot && arguments.size() == 3) {
        makeOneKnot(arguments[1], arguments[2]);
    } else if (arguments.size() == 1 && arguments[0].rfind('-', 0) != 0) {
        makeAll(arguments[0]);
    } else {
        throw penumbra::UsageError("wants a folder, or --knot TRIANGLES FILE (--help says more)");
    }
    return penumbra::exitFine;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const penumbra::Error& error) {
        std::fprintf(stderr, "make_assets: %s\n", error.what());
        return error.status();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_assets: %s\n", error.what());
        return penumbra::exitFailed;
    }
}
