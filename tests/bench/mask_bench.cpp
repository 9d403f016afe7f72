// What 32 light points in one draw call save: mask_bench [ROUNDS]. Masks against clear-draw-add of the same
// points, in the four channels of an accumulation buffer and in two, on Heckbert & Herf's receiver of 512x512
// texels and under the knot of 70 000 triangles. Rounds are interleaved, so that a slow moment hits all
// alike; times are medians of wall times of the shadow passes (what both share, the picture, is left out) in
// frames in which the light moves.
#include <fmt/format.h>

#include <cstdlib>

#include "common/app/report.h"
#include "common/error.h"
#include "tests/image/chapter_harness.h"

#define main chapterMain
#include "chapters/08_accumulation/main.cpp"
#undef main

namespace {

struct Way {
    std::unique_ptr<ChapterHarness> harness;
    PassTimer timer{true};

    double milliseconds(const char* pass) const {
        const auto found = timer.times().find(pass);
        return found == timer.times().end() ? 0.0 : statisticsOf(found->second).median;
    }
};

std::unique_ptr<Way> way(const std::string& method, const std::string& target, const std::string& scene,
                         const char* light, int samples) {
    auto made = std::make_unique<Way>();
    made->harness = std::make_unique<ChapterHarness>(std::make_unique<Accumulation>(), testScene(scene));
    made->harness->set("method", method);
    made->harness->set("target", target);
    made->harness->set("light", light);
    made->harness->set("samples", std::to_string(samples));
    made->harness->set("texels-per-metre", "213.33333");
    made->harness->set("texel-budget", "512");
    made->harness->set("others", "unshadowed");
    made->harness->renderMapsAgain = true;
    return made;
}

void compare(const std::string& scene, const char* light, int samples, int rounds) {
    std::vector<std::unique_ptr<Way>> ways;
    ways.push_back(way("accumulate", "32f", scene, light, samples));
    ways.push_back(way("mask", "32f", scene, light, samples));
    ways.push_back(way("accumulate", "rg32f", scene, light, samples));
    for (int round = -1; round < rounds; ++round)
        for (const auto& w : ways) {
            w->harness->passTimer = &w->timer;
            w->harness->render("visibility", glm::ivec2(64));
            if (round < 0) w->timer.clear();
        }
    const double accumulate = ways[0]->milliseconds("accumulate");
    const double occluders = ways[1]->milliseconds("occluders"), resolve = ways[1]->milliseconds("resolve");
    const double two = ways[2]->milliseconds("accumulate"), mask = occluders + resolve;
    fmt::print("{:14} {:7} | {:10.1f} {:10.1f} | {:9.1f} {:8.1f} | {:7.1f} {:7.1f}\n", scene, samples,
               accumulate, two, occluders, resolve, accumulate / mask, two / mask);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
        fmt::print("{:14} {:>7} | {:>10} {:>10} | {:>9} {:>8} | {:>7} {:>7}\n", "ms", "points", "accumulate",
                   "2 channels", "occluders", "resolve", "ratio", "ratio 2");
        compare("heckbert_herf", "0", 32, rounds);
        compare("heckbert_herf", "0", 128, rounds);
        compare("heckbert_herf", "0", 1024, rounds);
        compare("knot", "1", 128, rounds);
        return exitFine;
    } catch (const Error& error) {
        fmt::print(stderr, "mask_bench: {}\n", error.what());
        return error.status();
    }
}
