// Error of every pattern of chapter 05 against its number of samples, as counters; the time is that of making
// one.
//
//     disk_pattern_bench --benchmark_filter=samples/64/    rms over 600 random straight edges
#include <benchmark/benchmark.h>

#include "tests/unit/disk_pattern_errors.h"

namespace {

using namespace penumbra;

void bySamples(benchmark::State& state, int samples) {
    constexpr int trials = 600;
    const auto rms = [&](SquarePattern pattern, DiskMap map) {
        return patternErrors(pattern, map, samples, trials).rms;
    };
    for (auto _ : state)
        benchmark::DoNotOptimize(diskPattern(SquarePattern::jittered, DiskMap::concentric, samples,
                                             std::uint32_t(state.iterations())));
    state.counters["random"] = rms(SquarePattern::random, DiskMap::concentric);
    state.counters["regular"] = rms(SquarePattern::regular, DiskMap::concentric);
    state.counters["jittered"] = rms(SquarePattern::jittered, DiskMap::concentric);
    state.counters["fibonacci"] = rms(SquarePattern::fibonacci, DiskMap::concentric);
    state.counters["sobol"] = rms(SquarePattern::sobol, DiskMap::concentric);
    state.counters["jittered_polar"] = rms(SquarePattern::jittered, DiskMap::polar);
    state.counters["jittered_polar_linear"] = rms(SquarePattern::jittered, DiskMap::polarLinear);
}

}  // namespace

int main(int argc, char** argv) {
    for (int samples = 4; samples <= 1024; samples *= 4)
        benchmark::RegisterBenchmark(("samples/" + std::to_string(samples) + "/").c_str(), bySamples,
                                     samples);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
