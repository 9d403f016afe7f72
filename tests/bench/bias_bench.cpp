// Acne and leak of every method of chapter 03, as counters; the time is that of a frame.
//
//     bias_bench --benchmark_filter=method/slope/   acne % on planes tilted 0 to 85 degrees and leak under a
//     wall in mm, by format bias_bench --benchmark_filter=tilt/60/        acne % on planes at 60 degrees, by
//     method (24 bits) bias_bench --benchmark_filter=contact/slope/  scene `contact`: lit pixels shown dark,
//     dark ones shown lit, in %
#include <benchmark/benchmark.h>

#define main chapterMain
#include "chapters/03_polygon_offset/main.cpp"
#undef main

#include "tests/image/bias_scenes.h"

namespace {

constexpr const char* formats[] = {"16", "24", "32f"};

std::string counterName(const std::string& prefix, std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return prefix + name;
}

/// Over three kinds of light, one plane each.
double acnePercent(const std::string& method, const std::string& format, double tiltDegrees) {
    constexpr LightType types[] = {LightType::spot, LightType::point, LightType::directional};
    AcneCount total;
    for (int i = 0; i < 3; ++i) {
        std::mt19937 random(std::uint32_t(100 * i + int(tiltDegrees)));
        const Scene scene = tiltedPlane(tiltDegrees * radiansPerDegree, types[i], random);
        ChapterHarness harness(std::make_unique<PolygonOffset>(), scene);
        harness.set("method", method);
        harness.set("depth-format", format);
        harness.set("map-size", "256");
        harness.set("fit", "view");  // to the scene, the seen part of the plane is a few texels
        total += countAcne(harness, 192);
    }
    return 100.0 * total.fraction();
}

void drawFrames(benchmark::State& state, ChapterHarness& harness) {
    harness.render("color", glm::ivec2(256));
    for (auto _ : state) harness.render("color", glm::ivec2(256));
}

void byMethod(benchmark::State& state, const std::string& method) {
    const Scene scene = wallOnGround(LightType::spot, 2.0);
    ChapterHarness harness(std::make_unique<PolygonOffset>(), scene);
    harness.set("method", method);
    harness.set("map-size", "256");
    harness.set("fit", "view");
    for (const char* format : formats) {
        harness.set("depth-format", format);
        state.counters[counterName("leak_mm_", format)] = 1e3 * leakLength(harness, 1024);
        double acne = 0.0;
        for (const double tilt : {0.0, 20.0, 40.0, 60.0, 75.0, 85.0})
            acne += acnePercent(method, format, tilt) / 6.0;
        state.counters[counterName("acne_", format)] = acne;
    }
    drawFrames(state, harness);
}

void byTilt(benchmark::State& state, double tilt) {
    for (const std::string& method : biasMethodNames())
        if (method != "front-face" &&
            method != "midpoint")  // those are about closed bodies, and a plane is none
            state.counters[counterName("", method)] = acnePercent(method, "24", tilt);
    std::mt19937 random(1);
    const Scene scene = tiltedPlane(tilt * radiansPerDegree, LightType::spot, random);
    ChapterHarness harness(std::make_unique<PolygonOffset>(), scene);
    drawFrames(state, harness);
}

void onContact(benchmark::State& state, const std::string& method) {
    ChapterHarness harness(std::make_unique<PolygonOffset>(), testScene("contact"));
    harness.set("method", method);
    const glm::ivec2 size(384);
    const TruthImage truth = harness.truth("visibility", size);
    const FloatImage visibility = harness.scalar("visibility", size);
    double lit = 0, litShownDark = 0, dark = 0, darkShownLit = 0;
    for (std::size_t i = 0; i < visibility.values.size(); ++i) {
        if (truth.mask.values[i] == 0.0f) continue;
        const bool isLit = truth.value.values[i] > 0.5f, shownLit = visibility.values[i] > 0.5f;
        (isLit ? lit : dark) += 1;
        litShownDark += isLit && !shownLit;
        darkShownLit += !isLit && shownLit;
    }
    state.counters["acne"] = 100.0 * litShownDark / lit;
    state.counters["leak"] = 100.0 * darkShownLit / dark;
    drawFrames(state, harness);
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string& method : biasMethodNames()) {
        benchmark::RegisterBenchmark(("method/" + method).c_str(), byMethod, method)->Iterations(3);
        benchmark::RegisterBenchmark(("contact/" + method).c_str(), onContact, method)->Iterations(3);
    }
    for (const int tilt : {0, 30, 45, 60, 75, 85})
        benchmark::RegisterBenchmark(("tilt/" + std::to_string(tilt)).c_str(), byTilt, double(tilt))
            ->Iterations(3);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
