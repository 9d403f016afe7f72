// Errors of single bent normals in every closed form, as counters: degrees, root mean square over 240 turns
// of the scene and seeds, 4096 rays spread evenly or half of them at edges; the time is that of all four.
//
//     bent_bench --benchmark_filter=form/Trench/
#include <benchmark/benchmark.h>

#include <array>

#include "chapters/09_ambient_occlusion/edge_rays.h"
#include "tests/unit/ambient_errors.h"

namespace {

using namespace penumbra;

void inForm(benchmark::State& state, const Situation& situation) {
    const auto degrees = [&](Weighting weighting, const Estimator& estimate) {
        const std::array<int, 1> rays = {4096};
        return errorsOf(situation, weighting, rays, estimate).errors.front().rmsDegrees();
    };
    for (auto _ : state) {
        state.counters["even_cosine"] = degrees(Weighting::cosine, estimateAmbient);
        state.counters["even_uniform"] = degrees(Weighting::uniform, estimateAmbient);
        state.counters["edges_cosine"] = degrees(Weighting::cosine, estimateAtEdges);
        state.counters["edges_uniform"] = degrees(Weighting::uniform, estimateAtEdges);
    }
}

}  // namespace

int main(int argc, char** argv) {
    for (const Situation& situation : situations())
        benchmark::RegisterBenchmark(("form/" + situation.name + "/").c_str(), inForm, situation)
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
