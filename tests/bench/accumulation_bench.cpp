// Error against time on Heckbert & Herf's scene, 256x256, of light points drawn as shadows (chapter 08), of
// shadow rays (chapter 00), and of the exact answer, all in one run and in turns, so that a slow moment hits
// all alike.
//
//     accumulation_bench [--benchmark_filter=/256]     each row: one number of light points
//
// ms are medians of wall times, cpu_ms of the CPU time of all cores; rmse is of visibility, that is of
// irradiance over unoccluded irradiance, over all pixels that see a part of the light.
#include <benchmark/benchmark.h>

#define main chapter00Main
#include "chapters/00_ray_traced_truth/main.cpp"
#undef main
#define main chapter08Main
#include "chapters/08_accumulation/main.cpp"
#undef main

#include <cmath>
#include <functional>

#include "common/app/report.h"
#include "tests/bench/clocks.h"
#include "tests/image/chapter_harness.h"

namespace {

constexpr glm::ivec2 pictureSize(256);

/// One way to the picture, and how long it took each time.
struct Way {
    std::string name;
    std::function<FloatImage()> draw;
    std::vector<double> wall{}, cpu{};
    double rmse = 0.0;

    FloatImage timed() {
        const double before = cpuTime(), start = wallTime();
        FloatImage picture = draw();
        wall.push_back(wallTime() - start);
        cpu.push_back(cpuTime() - before);
        return picture;
    }
};

/// Chapter 08, looking straight at the receiver: a texel for each pixel.
std::unique_ptr<ChapterHarness> accumulation(const std::string& method) {
    auto harness =
        std::make_unique<ChapterHarness>(std::make_unique<Accumulation>(), testScene("heckbert_herf"));
    harness->camera = harness->scene.cameras.at(1);
    harness->renderMapsAgain = true;
    harness->set("method", method);
    harness->set("texels-per-metre", "106.66667");
    return harness;
}

/// Chapter 00 with the same camera.
class Rays {
 public:
    Rays() {
        rays_.declare(parameters_);
        rays_.load(testScene("heckbert_herf"), nullptr);
    }
    FloatImage draw(int samples, ChapterHarness& likeThis) {
        parameters_.set("samples", std::to_string(samples));
        FloatImage picture;
        likeThis.skips().declare(raysFacingAway);  // the frame is chapter 08's, and chapter 00 asks it
        Frame frame = likeThis.frame("visibility", pictureSize);
        frame.cpuPicture = &picture;
        rays_.render(frame);
        return picture;
    }

 private:
    RayTracedTruth rays_;
    Parameters parameters_;
};

/// Root mean square difference where `exact` is neither lit nor dark.
double penumbraRmse(const FloatImage& picture, const FloatImage& exact) {
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x) {
            const double V = exact.at(x, y, 0);
            if (V <= 0.0 || V >= 1.0) continue;
            sum += std::pow(picture.at(x, y, 0) - V, 2.0);
            count += 1.0;
        }
    return std::sqrt(sum / count);
}

void errorAndTime(benchmark::State& state) {
    const int samples = int(state.range(0));
    constexpr int rounds = 7, mostRays = 256;  // more rays take minutes
    const auto mask = accumulation("mask"), accumulate = accumulation("accumulate"),
               exact = accumulation("exact");
    for (ChapterHarness* harness : {mask.get(), accumulate.get()})
        harness->set("samples", std::to_string(samples));
    Rays rays;
    std::vector<Way> ways = {
        {"mask", [&] { return mask->scalar("visibility", pictureSize); }},
        {"accumulate", [&] { return accumulate->scalar("visibility", pictureSize); }},
        {"exact", [&] { return exact->scalar("visibility", pictureSize); }},
    };
    const FloatImage truth = ways[2].draw();
    for (Way& way : ways) way.rmse = penumbraRmse(way.draw(), truth);  // warms up too
    for (auto _ : state) {
        for (int round = 0; round < rounds; ++round)
            for (Way& way : ways) way.timed();
        if (samples <= mostRays) {
            ways.push_back({"rays", [&] { return rays.draw(samples, *exact); }});
            ways.back().rmse = penumbraRmse(ways.back().timed(), truth);
        }
    }
    for (const Way& way : ways) {
        state.counters[way.name + "_ms"] = statisticsOf(way.wall).median;
        state.counters[way.name + "_cpu_ms"] = statisticsOf(way.cpu).median;
        state.counters[way.name + "_rmse"] = way.rmse;
    }
    // Of the same error or a smaller one, how much sooner than by rays.
    if (samples <= mostRays)
        state.counters["rays_over_mask"] =
            statisticsOf(ways[3].cpu).median / statisticsOf(ways[0].cpu).median;
}
BENCHMARK(errorAndTime)->RangeMultiplier(4)->Range(4, 4096)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
