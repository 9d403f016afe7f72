// How fast the exact answers are. Rates are per core and per CPU second, so that a busy machine does not blur
// them.
//   build/release/bin/truth_bench [--benchmark_filter=NAME]
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "common/truth/exact_scene.h"
#include "common/truth/polygon_light.h"
#include "tests/unit/figure_two.h"

namespace penumbra {
namespace {

using glm::dvec3;

using figure_two::light, figure_two::triangle;
const dvec3 up(0, 0, 1);
const PlanarReceiver receiver = {{-1.2, -1.2, 0}, {2.4, 0, 0}, {0, 2.4, 0}};

void countEvaluations(benchmark::State& state, std::size_t perIteration) {
    state.counters["evaluations/s"] =
        benchmark::Counter(double(state.iterations()) * double(perIteration), benchmark::Counter::kIsRate);
}

std::vector<dvec3> gridPoints(int size) {
    std::vector<dvec3> points;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            points.push_back(receiver.cellCentre(column, row, {size, size}));
    return points;
}

void unoccluded(benchmark::State& state) {
    const std::vector<dvec3> points = gridPoints(64);
    for (auto _ : state)
        for (const dvec3& x : points) benchmark::DoNotOptimize(formFactor(x, up, light));
    countEvaluations(state, points.size());
}
BENCHMARK(unoccluded);

/// Target: 2 million a second.
void oneTriangleOverThePicture(benchmark::State& state) {
    const std::vector<dvec3> points = gridPoints(64);
    for (auto _ : state)
        for (const dvec3& x : points)
            benchmark::DoNotOptimize(visibleFormFactor(x, up, light, {&triangle, 1}));
    countEvaluations(state, points.size());
}
BENCHMARK(oneTriangleOverThePicture);

/// Every point sees some, not all, of the light: nothing to skip.
void oneTrianglePenumbraOnly(benchmark::State& state) {
    std::vector<dvec3> points;
    for (const dvec3& x : gridPoints(64)) {
        const double visible = visibleFormFactor(x, up, light, {&triangle, 1});
        if (visible > 0.0 && visible < formFactor(x, up, light)) points.push_back(x);
    }
    for (auto _ : state)
        for (const dvec3& x : points)
            benchmark::DoNotOptimize(visibleFormFactor(x, up, light, {&triangle, 1}));
    countEvaluations(state, points.size());
}
BENCHMARK(oneTrianglePenumbraOnly);

void manyTriangles(benchmark::State& state) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Triangle> soup(std::size_t(state.range(0)));
    for (Triangle& t : soup) {
        const dvec3 centre(0.7 * uniform(random), 0.7 * uniform(random), 1 + 0.5 * uniform(random));
        for (dvec3& p : t) p = centre + 0.1 * dvec3(uniform(random), uniform(random), uniform(random));
    }
    for (auto _ : state) benchmark::DoNotOptimize(visibleFormFactor({0.1, 0.2, 0}, up, light, soup));
    countEvaluations(state, 1);
}
BENCHMARK(manyTriangles)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000);

void addTriangle(Scene& scene, const Triangle& t) {
    for (const dvec3& p : t) {
        scene.indices.push_back(std::uint32_t(scene.positions.size()));
        scene.positions.push_back(glm::vec3(p));
    }
    Part part;
    part.firstTriangle = std::uint32_t(scene.triangleCount() - 1);
    part.triangleCount = 1;
    scene.parts.push_back(part);
}

/// Target: 60 ms on two cores, wall time.
void exactImageOfHeckbertAndHerf(benchmark::State& state) {
    Scene scene;
    addTriangle(scene, triangle);
    addTriangle(scene, {light[0], light[1], light[2]});
    addTriangle(scene, {light[0], light[2], light[3]});
    addTriangle(scene, {receiver.at({0, 0}), receiver.at({1, 0}), receiver.at({1, 1})});
    addTriangle(scene, {receiver.at({0, 0}), receiver.at({1, 1}), receiver.at({0, 1})});
    const ExactScene exact(scene);
    for (auto _ : state) benchmark::DoNotOptimize(exact.formFactorImage(receiver, {256, 256}, light));
    countEvaluations(state, 256 * 256);
}
BENCHMARK(exactImageOfHeckbertAndHerf)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace penumbra

BENCHMARK_MAIN();
