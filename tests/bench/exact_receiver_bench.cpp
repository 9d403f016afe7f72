// How fast chapter 08 answers exactly, and how much each thing that it leaves out is worth. CPU time is of
// all cores together; the figure on two cores takes half of it.
//   build/release/bin/exact_receiver_bench [--benchmark_filter=NAME]
#include <benchmark/benchmark.h>

#include "chapters/08_accumulation/block_map.h"
#include "chapters/08_accumulation/exact_receiver.h"
#include "chapters/08_accumulation/unoccluded_texture.h"
#include "common/scene/find_scene.h"
#include "common/scene/gltf_loader.h"

namespace penumbra {
namespace {

/// The largest receiver of a scene, and what stands between it and the last light.
struct Setting {
    Scene scene;
    Receiver receiver;
    Occluders occluders;

    Setting(const char* name, int texels) : scene(loadGltf(findScene(name))) {
        ReceiverRequest request;
        request.lights = {int(scene.lights.size()) - 1};
        receiver = findReceivers(scene, request).front();
        receiver.texels = {texels, texels};
        occluders = occludersBetween(scene, receiver, light());
    }
    const Light& light() const { return scene.lights.back(); }
};

void countTexels(benchmark::State& state, const Receiver& receiver) {
    const double texels = double(receiver.texels.x) * receiver.texels.y;
    state.counters["texels/s"] =
        benchmark::Counter(double(state.iterations()) * texels, benchmark::Counter::kIsRate);
}

/// Lambert's formula alone.
void unoccluded(benchmark::State& state) {
    const Setting setting("heckbert_herf", int(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(unoccludedIrradiance(setting.receiver, setting.light()));
    countTexels(state, setting.receiver);
}
BENCHMARK(unoccluded)->Arg(512)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

/// The same for a texture of floats, where a plane may be interpolated.
void unoccludedFloats(benchmark::State& state) {
    const Setting setting("heckbert_herf", int(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(unoccludedTexture(setting.receiver, setting.light()));
    countTexels(state, setting.receiver);
}
BENCHMARK(unoccludedFloats)
    ->Arg(256)
    ->Arg(512)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void exact(benchmark::State& state, const char* scene, bool cull) {
    const Setting setting(scene, int(state.range(0)));
    ExactIrradiance result;
    for (auto _ : state)
        result = exactIrradiance(setting.receiver, setting.light(), setting.occluders.reaching, cull);
    countTexels(state, setting.receiver);
    const double texels = double(result.values.size());
    state.counters["shadow texels"] = double(result.shadowTexels) / texels;
    state.counters["triangles/texel"] = double(result.triangleTests) / texels;
}

/// Target: well below 15 ms on two cores, wall time.
BENCHMARK_CAPTURE(exact, heckbert_herf, "heckbert_herf", true)
    ->Arg(256)
    ->Arg(512)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(exact, heckbert_herf_without_culling, "heckbert_herf", false)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(exact, contact, "contact", true)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(exact, contact_without_culling, "contact", false)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

/// What is worked out once for a receiver and a light.
void occluders(benchmark::State& state, const char* scene) {
    const Setting setting(scene, 512);
    for (auto _ : state)
        benchmark::DoNotOptimize(occludersBetween(setting.scene, setting.receiver, setting.light()));
    state.counters["triangles"] = double(setting.scene.triangleCount());
    state.counters["reaching"] = double(setting.occluders.reaching.size());
}
BENCHMARK_CAPTURE(occluders, heckbert_herf, "heckbert_herf")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(occluders, knot, "knot")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(occluders, courtyard, "courtyard")->Unit(benchmark::kMicrosecond);

void blocks(benchmark::State& state, const char* scene) {
    const Setting setting(scene, 512);
    BlockMap map;
    for (auto _ : state) map = mixedBlocks(setting.receiver, setting.light(), setting.occluders.reaching, 16);
    state.counters["mixed"] = double(map.mixedTexels) / (512.0 * 512.0);
}
BENCHMARK_CAPTURE(blocks, heckbert_herf, "heckbert_herf")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(blocks, knot, "knot")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(blocks, courtyard, "courtyard")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace penumbra

BENCHMARK_MAIN();
