// What the shadow look-up costs: the shading pass of chapters 02 and 03 against the same pass without it, in
// one run.
//
//     shadow_bench [SCENE] [ROUNDS]     (courtyard, 25; 512x512 pixels, 1024 map)
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "common/error.h"
#include "tests/bench/clocks.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/mutated_shaders.h"

#define main chapter02Main
#include "chapters/02_shadow_test/main.cpp"
#undef main
#define main chapter03Main
#include "chapters/03_polygon_offset/main.cpp"
#undef main

namespace {

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

struct Variant {
    std::string name;
    std::unique_ptr<ChapterHarness> harness;
    std::vector<double> wall{}, cpu{};  ///< milliseconds
};

Variant variant(const std::string& name, std::unique_ptr<Chapter> chapter, const std::string& method,
                const std::string& scene) {
    Variant v{.name = name,
              .harness = std::make_unique<ChapterHarness>(std::move(chapter), testScene(scene))};
    v.harness->set("map-size", "1024");
    if (!method.empty()) v.harness->set("method", method);
    v.harness->render("color", glm::ivec2(512));  // compiles
    return v;
}

void run(const std::string& scene, int rounds) {
    std::vector<Variant> variants;
    {
        const MutatedShaders noLookUp("02_shadow_test/shadowed.frag", "float S = shadowTest(strq);",
                                      "float S = 1.0;");
        variants.push_back(variant("02 without the look-up", std::make_unique<ShadowTest>(), "", scene));
    }
    {
        const MutatedShaders noLookUp("03_polygon_offset/biased.frag", "float S = shadowTest(strq, dx, dy);",
                                      "float S = 1.0;");
        variants.push_back(
            variant("03 without the look-up", std::make_unique<PolygonOffset>(), "slope", scene));
    }
    variants.push_back(variant("02", std::make_unique<ShadowTest>(), "", scene));
    for (const std::string& method : biasMethodNames())
        variants.push_back(variant("03 " + method, std::make_unique<PolygonOffset>(), method, scene));

    // Interleaved, so that a slow moment of the machine hits all alike; the first rounds warm up.
    for (int round = -3; round < rounds; ++round) {
        for (Variant& v : variants) {
            // Nothing moves, so the map of the first round is kept and the frame is the shading pass alone.
            const double cpu = cpuTime(), wall = wallTime();
            v.harness->render("color", glm::ivec2(512));
            if (round < 0) continue;
            v.wall.push_back(wallTime() - wall);
            v.cpu.push_back(cpuTime() - cpu);
        }
    }
    fmt::print("{}: 512x512 pixels, 1024 map, {}\n", scene, testContext().renderer());
    fmt::print("{:24} {:>16} {:>16}\n", "shading pass", "ms (ratio)", "CPU ms (ratio)");
    for (const Variant& v : variants) {
        const double wall = median(v.wall), cpu = median(v.cpu);
        fmt::print("{:24} {:8.2f} ({:5.2f}) {:8.2f} ({:5.2f})\n", v.name, wall,
                   wall / median(variants[0].wall), cpu, cpu / median(variants[0].cpu));
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc > 1 ? argv[1] : "courtyard", argc > 2 ? std::max(1, std::atoi(argv[2])) : 25);
        return exitFine;
    } catch (const Error& error) {
        fmt::print(stderr, "shadow_bench: {}\n", error.what());
        return error.status();
    }
}
