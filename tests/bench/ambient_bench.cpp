// The ray-traced bake of chapter 09 against a plain Embree loop at equal error, in one run, on three meshes
// of about 70 000 triangles and 35 000 vertices: the knot, a terrain with a sharp gully, and the bunny of
// Debian's package glmark2-data (left out if it is not installed). Then relighting from stored bits.
//
//     ambient_bench [RUNS]        (5) CPU time of all threads, the least of RUNS interleaved runs
//     ambient_bench MESH          knot, terrain or bunny alone; --benchmark_out=FILE also writes its figures
//                                 there, as Google Benchmark would: a page's table is made of them
//     ambient_bench million       instead: bits of 1 000 000 vertices x 256 directions, time and memory
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <span>
#include <sstream>
#include <string>

#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/vertex_bake_rays.h"
#include "chapters/09_ambient_occlusion/visibility_bits.h"
#include "common/error.h"
#include "common/math/hemisphere.h"
#include "common/math/sampling.h"
#include "common/scene/gltf_loader.h"
#include "common/truth/shadow_packet.h"
#include "tests/bench/clocks.h"
#include "tests/unit/embree_triangles.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {
namespace {

constexpr double wantedRmse = 0.0065;
constexpr int pointsAtOnce = 256;

double cpuSeconds() {
    return 1e-3 * cpuTime();
}

Scene terrain(int cells) {
    Scene scene = test_meshes::emptyScene();
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    for (int z = 0; z <= cells; ++z)
        for (int x = 0; x <= cells; ++x) {
            const double u = 2.0 * x / cells - 1.0, v = 2.0 * z / cells - 1.0;
            const double hills = 0.08 * (std::sin(7.0 * u + 3.0 * v) + 0.5 * std::sin(13.0 * v - 5.0 * u));
            points.emplace_back(u, hills - 3.0 * std::max(0.0, 0.06 - std::abs(u - 0.15 * std::sin(3.0 * v))),
                                v);
        }
    const auto row = std::uint32_t(cells + 1);
    for (std::uint32_t z = 0; z + 1 < row; ++z)
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t i = z * row + x;
            indices.insert(indices.end(), {i, i + row, i + 1, i + 1, i + row, i + row + 1});
        }
    test_meshes::addPart(scene, points, indices, test_meshes::scaledAndMoved(1.0, 0.0));
    return scene;
}

/// An .obj file of triangles, without its empty ones.
Scene objFile(const std::filesystem::path& file) {
    Scene scene = test_meshes::emptyScene();
    std::ifstream in(file);
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    for (std::string line, kind, word; std::getline(in, line);) {
        std::istringstream words(line);
        words >> kind;
        if (glm::dvec3 p; kind == "v" && words >> p.x >> p.y >> p.z) points.push_back(p);
        if (kind != "f") continue;
        std::uint32_t t[3] = {};
        for (std::uint32_t& corner : t)
            if (words >> word) corner = std::uint32_t(std::stoul(word)) - 1;
        const glm::dvec3 a = points.at(t[0]), b = points.at(t[1]), c = points.at(t[2]);
        if (glm::length(glm::cross(b - a, c - a)) > 0.0) indices.insert(indices.end(), t, t + 3);
    }
    test_meshes::addPart(scene, points, indices, test_meshes::scaledAndMoved(1.0, 0.0));
    return scene;
}

// --- the plain loop ----------------------------------------------------------------------------------------

/// Embree with its default flags, which are its fastest.
class PlainEmbree {
 public:
    explicit PlainEmbree(const Scene& s) : triangles_(s, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM) {}

    bool occluded(const glm::vec3& o, const glm::vec3& d) const {
        RTCRay ray{};
        ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
        ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
        ray.tfar = std::numeric_limits<float>::infinity();
        ray.mask = 0xffffffffu;
#if RTC_VERSION_MAJOR >= 4
        rtcOccluded1(triangles_.scene(), &ray);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(triangles_.scene(), &context, &ray);
#endif
        return ray.tfar < 0.0f;
    }

 private:
    EmbreeTriangles triangles_;
};

float radicalInverse(std::uint32_t i) {
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= (i >> bit & 1u) << (31 - bit);
    return float(reversed) * 0x1p-32f;
}

/// Per vertex: Hammersley points, the same for all, shifted by random numbers of the vertex (Cranley &
/// Patterson 1976), cosine-weighted directions, one ray after the other from a little above the vertex.
double loopVertex(const Scene& scene, const PlainEmbree& embree, std::size_t vertex,
                  std::span<const glm::vec2> hammersley, std::uint32_t seed) {
    const glm::vec3 normal = scene.normals[vertex];
    const glm::mat3 frame(frameAround(glm::normalize(glm::dvec3(normal))));
    const glm::vec3 origin = scene.positions[vertex] + 1e-4f * float(scene.bounds.radius()) * normal;
    const auto hash = std::uint32_t(vertex);
    const glm::vec2 shift(float(hashSeed(hash, seed, 1)) * 0x1p-32f,
                          float(hashSeed(hash, seed, 2)) * 0x1p-32f);
    int open = 0;
    for (glm::vec2 u : hammersley) {
        u += shift;
        u -= glm::floor(u);
        const float r = std::sqrt(u.x), angle = 6.2831853f * u.y;
        const glm::vec3 local(r * std::cos(angle), r * std::sin(angle),
                              std::sqrt(std::max(0.0f, 1.0f - u.x)));
        open += embree.occluded(origin, frame * local) ? 0 : 1;
    }
    return double(open) / double(hammersley.size());
}

std::vector<glm::vec2> hammersleyPoints(int count) {
    std::vector<glm::vec2> points;
    for (int i = 0; i < count; ++i)
        points.emplace_back((float(i) + 0.5f) / float(count), radicalInverse(std::uint32_t(i)));
    return points;
}

std::vector<double> plainLoop(const Scene& scene, const PlainEmbree& embree, int rays) {
    const std::vector<glm::vec2> hammersley = hammersleyPoints(rays);
    std::vector<double> values(scene.positions.size());
    const int count = int(values.size());
    parallelRows((count + pointsAtOnce - 1) / pointsAtOnce, [&](int row) {
        for (int i = row * pointsAtOnce; i < std::min(count, (row + 1) * pointsAtOnce); ++i)
            values[std::size_t(i)] = loopVertex(scene, embree, std::size_t(i), hammersley, 0);
    });
    return values;
}

// --- errors ------------------------------------------------------------------------------------------------

/// Some vertices with the values that 8192 rays give: each of the two with its own way to begin a ray, so
/// that neither is blamed for the difference.
struct Truth {
    std::vector<std::size_t> vertices;
    std::vector<double> ofLoop, ofBake;
    double halvesOverNoise = 0.0;  ///< SharedRays' constant, for 64 rays

    Truth(const Scene& scene, const PlainEmbree& embree, const RayBundle& bundle) {
        constexpr int rays = 8192, several = 64;
        std::mt19937 random(3);
        for (int i = 0; i < 2500; ++i) vertices.push_back(random() % scene.positions.size());
        ofLoop.resize(vertices.size()), ofBake.resize(vertices.size());
        std::vector<double> halves(vertices.size()), errors(vertices.size());
        const std::vector<glm::vec2> hammersley = hammersleyPoints(rays);
        const BakePoints points = vertexPoints(scene);
        parallelRows(int(vertices.size()), [&](int row) {
            const auto i = std::size_t(row);
            ofLoop[i] = loopVertex(scene, embree, vertices[i], hammersley, 7);
            const PointFan fan(scene, points, points.points[points.pointOf[vertices[i]]],
                               largestCoordinate(scene.bounds));
            std::int64_t traced = 0;
            ofBake[i] =
                tracePoint(bundle, fan, {rays, Weighting::cosine, {}}, 77, traced).mean(rays).visibility;
            const RaySums few =
                tracePoint(bundle, fan, {several, Weighting::cosine, {}}, std::uint32_t(row), traced);
            halves[i] = std::pow((2.0 * few.everyOther - few.visibility) / several, 2.0);
            errors[i] = std::pow(few.mean(several).visibility - ofBake[i], 2.0);
        });
        double above = 0.0, below = 0.0;
        for (std::size_t i = 0; i < halves.size(); ++i) above += halves[i], below += errors[i];
        halvesOverNoise = above / below;
    }

    template <class Value>
    double rmse(const std::vector<double>& truth, const Value& value) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < vertices.size(); ++i) sum += std::pow(value(vertices[i]) - truth[i], 2.0);
        return std::sqrt(sum / double(vertices.size()));
    }
};

/// The smallest count, in steps of a sixteenth, whose error is small enough; and that error.
struct Found {
    int count = 0;
    double rmse = 0.0;
};

template <class Error>
Found leastCount(int first, const Error& errorOf) {
    for (double count = first; count < 2000.0; count *= 1.0625)
        if (const double rmse = errorOf(int(count)); rmse <= wantedRmse) return {int(count), rmse};
    return {};
}

BakeSettings settingsFor(int count) {
    BakeSettings settings;
    settings.rays.count = count;
    return settings;
}

/// A mesh by the plain loop, and by ours with as small an error.
struct Compared {
    Found loop, ours;
    double loopTime = 0.0, ourTime = 0.0;  ///< seconds of CPU
    double rays = 0.0;                     ///< of ours, a vertex

    double times() const { return loopTime / ourTime; }
    std::string json() const {
        return fmt::format(
            R"({{"benchmarks":[{{"loop_rays":{},"loop_rmse":{},"loop_ms":{},"rays":{},"rmse":{},"ms":{},"times":{}}}]}})",
            loop.count, loop.rmse, 1e3 * loopTime, rays, ours.rmse, 1e3 * ourTime, times());
    }
};

Compared compare(const std::string& name, const Scene& scene, int runs) {
    const PlainEmbree embree(scene);
    const RayBundle bundle(scene);
    const Truth truth(scene, embree, bundle);
    const Found loop = leastCount(120, [&](int rays) {
        const std::vector<double> values = plainLoop(scene, embree, rays);
        return truth.rmse(truth.ofLoop, [&](std::size_t i) { return values[i]; });
    });
    AmbientBake bake;
    const Found ours = leastCount(80, [&](int rays) {
        bake = bakeVertices(scene, bundle, settingsFor(rays));
        return truth.rmse(truth.ofBake, [&](std::size_t i) { return bake.values[i].visibility; });
    });
    double loopTime = 1e9, ourTime = 1e9;
    for (int run = 0; run < runs; ++run) {
        const double start = cpuSeconds();
        plainLoop(scene, embree, loop.count);
        const double middle = cpuSeconds();
        bakeVertices(scene, bundle, settingsFor(ours.count));
        ourTime = std::min(ourTime, cpuSeconds() - middle);
        loopTime = std::min(loopTime, middle - start);
    }
    const double vertices = double(scene.positions.size());
    const Compared found{loop, ours, loopTime, ourTime, double(bake.work.rays) / vertices};
    fmt::print(
        "{:8} {:6} vertices  loop: {:4} rays, RMSE {:.5f}, {:7.1f} ms   ours: {:5.1f} rays, RMSE {:.5f}, "
        "{:7.1f} ms, {:.1f} MB (as {} alone)   {:.2f} times faster   halves/noise {:.2f}\n",
        name, scene.positions.size(), loop.count, loop.rmse, 1e3 * loopTime, found.rays, ours.rmse,
        1e3 * ourTime, double(bake.work.bytes) * 1e-6, ours.count, found.times(), truth.halvesOverNoise);
    std::fflush(stdout);
    return found;
}

void relighting(const Scene& scene) {
    const BakedBits baked = bakeBits(scene, RayBundle(scene), 256, {});
    const auto radiance = skyRadiance(Sky::overcast(glm::dvec3(1.0)), baked.bits.directions);
    double wall = 1e9, cpu = 1e9;
    for (int run = 0; run < 50; ++run) {
        const double start = wallTime(), before = cpuTime();
        relight(baked.bits, scene.normals, radiance);
        cpu = std::min(cpu, cpuTime() - before);
        wall = std::min(wall, wallTime() - start);
    }
    fmt::print(
        "relight  {} vertices x 256 directions: {:.2f} ms, {:.2f} ms of CPU (at most 5 ms is asked for); "
        "{:.2f} MB of bits\n",
        scene.positions.size(), wall, cpu, double(baked.bits.bytes()) * 1e-6);
}

double megabytesAtMost() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) * 1e-3;
}

void million() {
    const Scene scene = terrain(999);
    const RayBundle bundle(scene);
    const double before = megabytesAtMost(), start = cpuSeconds();
    const BakedBits baked = bakeBits(scene, bundle, 256, {}, "million.part", [](double fraction) {
        fmt::print(stderr, "\r{:3.0f} %", 100.0 * fraction);
    });
    fmt::print(
        "\n{} vertices x 256 directions: {:.1f} s of CPU, {:.0f} MB of bits, {:.0f} MB for the bake "
        "(at most 200 are asked for); hierarchy {:.0f} MB, process before {:.0f} MB, at most {:.0f} MB\n",
        scene.positions.size(), cpuSeconds() - start, double(baked.bits.bytes()) * 1e-6,
        double(baked.work.bytes) * 1e-6, double(bundle.bytes()) * 1e-6, before, megabytesAtMost());
}

const char* const bunnyFile = "/usr/share/glmark2/models/bunny.obj";

Scene mesh(const std::string& name) {
    if (name == "terrain") return terrain(187);
    if (name == "bunny") return objFile(bunnyFile);
    return loadGltf(std::filesystem::path(PENUMBRA_SOURCE_DIR) / "assets" / "knot.glb");
}

void compareAll(int runs) {
    std::vector<std::string> names{"knot", "terrain"};
    if (std::filesystem::exists(bunnyFile)) {
        names.emplace_back("bunny");
    } else {
        fmt::print("bunny: left out, there is no {} (package glmark2-data)\n", bunnyFile);
    }
    double logarithms = 0.0;
    for (const std::string& name : names) logarithms += std::log(compare(name, mesh(name), runs).times());
    fmt::print("geometric mean: {:.2f} times faster at RMSE <= {} (at least 2.5 is asked for)\n",
               std::exp(logarithms / double(names.size())), wantedRmse);
    relighting(mesh(names.back()));
}

/// Figures of one mesh, for a page. `out`: a file, or none. Returns the exit status.
int compareOne(const std::string& name, const std::string& out) {
    if (name == "bunny" && !std::filesystem::exists(bunnyFile)) {
        fmt::print(stderr, "ambient_bench: there is no {}; install the package glmark2-data\n", bunnyFile);
        return exitFailed;
    }
    const std::string json = compare(name, mesh(name), 3).json();
    if (!out.empty()) std::ofstream(out) << json << '\n';
    return exitFine;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
    const std::string outFlag = "--benchmark_out=";
    std::string argument = "5", out;
    for (const std::string word : std::span(argv, std::size_t(argc)).subspan(1)) {
        if (word.starts_with(outFlag))
            out = word.substr(outFlag.size());
        else if (!word.starts_with("--benchmark_out_format"))
            argument = word;
    }
    if (argument == "million")
        penumbra::million();
    else if (argument == "knot" || argument == "terrain" || argument == "bunny")
        return penumbra::compareOne(argument, out);
    else
        penumbra::compareAll(std::max(1, std::atoi(argument.c_str())));
    return 0;
}
