#include "common/truth/embree_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>
#include <type_traits>

#include "common/truth/segment_test.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

namespace {

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
void initialize(EmbreeContext& context) {
    rtcInitRayQueryContext(&context);
}
#else
using EmbreeContext = RTCIntersectContext;
void initialize(EmbreeContext& context) {
    rtcInitIntersectContext(&context);
}
#endif

/// What the filters need to know about the rays being traced. `embree` comes first: Embree hands back its
/// address.
struct Query {
    EmbreeContext embree;
    const Scene& scene;
    const IgnoredTriangles& ignored;
    const float* heights = nullptr;
    const ShadowRay* rays = nullptr;  ///< indexed by the id of an Embree ray
    const ShadowPacket* packet = nullptr;
    std::uint32_t doubtful = 0;

    Query(const Scene& s, const IgnoredTriangles& i) : scene(s), ignored(i) { initialize(embree); }
};

void ignorePartFilter(const RTCFilterFunctionNArguments* arguments) {
    const auto* query = reinterpret_cast<const Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != -1) continue;
        if (query->ignored.contains(RTCHitN_primID(arguments->hit, arguments->N, i))) arguments->valid[i] = 0;
    }
}

/// Is candidate `i` there in double? Notes the ray as doubtful if not.
bool blocks(const RTCFilterFunctionNArguments& arguments, unsigned i, Query& query) {
    const unsigned n = arguments.N;
    const std::uint32_t candidate = RTCHitN_primID(arguments.hit, n, i);
    const unsigned id = RTCRayN_id(arguments.ray, n, i);
    if (candidate == query.packet->ownTriangle[id] || query.ignored.contains(candidate)) return false;
    const float u = RTCHitN_u(arguments.hit, n, i), v = RTCHitN_v(arguments.hit, n, i);
    const glm::vec3 normal(RTCHitN_Ng_x(arguments.hit, n, i), RTCHitN_Ng_y(arguments.hit, n, i),
                           RTCHitN_Ng_z(arguments.hit, n, i));
    if (surelyBlocks(*query.packet, id, std::min({u, v, 1.0f - u - v}), RTCRayN_tfar(arguments.ray, n, i),
                     normal, query.heights[candidate]))
        return true;
    const ShadowRay& ray = query.rays[id];
    const Segment segment{ray.origin, ray.target, ray.towardsInfinity};
    if (crossTriangle(segment, cornersOf(query.scene, candidate)) == Crossing::inside) return true;
    query.doubtful |= 1u << id;
    return false;
}

/// Bit i for each lane with a candidate: most often one of many, and found without a branch for each.
template <unsigned n>
std::uint32_t candidates(const int* valid) {
    std::uint32_t lanes = 0;
    for (unsigned i = 0; i < n; ++i) lanes |= std::uint32_t(valid[i]) & 1u << i;
    return lanes;
}

std::uint32_t candidates(const RTCFilterFunctionNArguments& arguments) {
    switch (arguments.N) {
        case 16:
            return candidates<16>(arguments.valid);
        case 8:
            return candidates<8>(arguments.valid);
        default:
            return candidates<1>(arguments.valid);
    }
}

void exactShadowFilter(const RTCFilterFunctionNArguments* arguments) {
    auto* query = reinterpret_cast<Query*>(arguments->context);
    for (std::uint32_t lanes = candidates(*arguments); lanes != 0; lanes &= lanes - 1) {
        const auto i = unsigned(std::countr_zero(lanes));
        if (!blocks(*arguments, i, *query)) arguments->valid[i] = 0;
    }
}

std::uint32_t traceOne(RTCSceneTy* scene, const ShadowPacket& packet, Query& query) {
    RTCRay ray{};
    ray.org_x = packet.originX[0], ray.org_y = packet.originY[0], ray.org_z = packet.originZ[0];
    ray.dir_x = packet.directionX[0], ray.dir_y = packet.directionY[0], ray.dir_z = packet.directionZ[0];
    ray.tfar = packet.far[0];
    ray.mask = 0xffffffffu;
    if (ray.tfar < 0.0f) return 0;
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &query.embree;
    rtcOccluded1(scene, &ray, &arguments);
#else
    rtcOccluded1(scene, &query.embree, &ray);
#endif
    return ray.tfar < 0.0f ? 1u : 0u;
}

template <class Rays>
void askEmbree(const int* valid, RTCSceneTy* scene, Rays& rays, Query& query) {
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments how;
    rtcInitOccludedArguments(&how);
    how.context = &query.embree;
    how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    const auto ask = [&](auto occluded) { occluded(valid, scene, &rays, &how); };
#else
    query.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const auto ask = [&](auto occluded) { occluded(valid, scene, &query.embree, &rays); };
#endif
    if constexpr (std::is_same_v<Rays, RTCRay16>)
        ask(rtcOccluded16);
    else
        ask(rtcOccluded8);
}

/// The parts of Embree's packet that never change.
template <class Rays>
Rays blankPacket() {
    Rays rays{};
    std::fill(std::begin(rays.mask), std::end(rays.mask), 0xffffffffu);
    return rays;
}

/// Traces the rays of `packet` from `first` on, up to `count` of all; bit i for ray i that is blocked.
template <class Rays>
std::uint32_t traceWide(RTCSceneTy* scene, unsigned first, unsigned count, const ShadowPacket& packet,
                        Query& query) {
    constexpr unsigned width = std::extent_v<decltype(Rays::tfar)>;
    thread_local Rays rays = blankPacket<Rays>();
    alignas(64) int valid[width];
    for (unsigned i = 0; i < width; ++i) {
        rays.id[i] = first + i;
        valid[i] = first + i < count && packet.far[first + i] >= 0.0f ? -1 : 0;
    }
    std::copy_n(packet.originX + first, width, rays.org_x);
    std::copy_n(packet.originY + first, width, rays.org_y);
    std::copy_n(packet.originZ + first, width, rays.org_z);
    std::copy_n(packet.directionX + first, width, rays.dir_x);
    std::copy_n(packet.directionY + first, width, rays.dir_y);
    std::copy_n(packet.directionZ + first, width, rays.dir_z);
    std::copy_n(packet.far + first, width, rays.tfar);
    askEmbree(valid, scene, rays, query);
    std::uint32_t blocked = 0;
    for (unsigned i = 0; i < width; ++i) blocked |= std::uint32_t(valid[i] == -1 && rays.tfar[i] < 0.0f) << i;
    return blocked << first;
}

/// The rays of one point stay together down to the leaves, and go sixteen side by side; those of neighbouring
/// pixels part sooner, and are 5 % faster in eights (tests/bench/ray_tracer_bench.cpp).
std::uint32_t tracePacket(RTCSceneTy* scene, unsigned count, const ShadowPacket& packet, Query& query) {
    if (packet.oneOrigin) return traceWide<RTCRay16>(scene, 0, count, packet, query);
    const std::uint32_t blocked = traceWide<RTCRay8>(scene, 0, count, packet, query);
    return count <= 8 ? blocked : blocked | traceWide<RTCRay8>(scene, 8, count, packet, query);
}

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene) : scene_(scene) {
    rtcSetSceneFlags(embree_.scene(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree_.scene(), RTC_BUILD_QUALITY_HIGH);
    embree_.add(scene.positions, scene.indices, [](RTCGeometry geometry) {
        rtcSetGeometryIntersectFilterFunction(geometry, ignorePartFilter);
        rtcSetGeometryOccludedFilterFunction(geometry, exactShadowFilter);
    });
    embree_.build(scene);
    heights_.reserve(scene.triangleCount());
    const double reach = largestCoordinate(scene.bounds);
    for (std::size_t t = 0; t < scene.triangleCount(); ++t)
        heights_.push_back(decisiveHeight(cornersOf(scene, std::uint32_t(t)), reach));
}

std::optional<std::uint32_t> EmbreeScene::nearest(const Ray& ray, const IgnoredTriangles& ignored) const {
    Query query(scene_, ignored);
    RTCRayHit found{};
    const glm::vec3 origin(ray.origin), direction(ray.direction);
    found.ray.org_x = origin.x, found.ray.org_y = origin.y, found.ray.org_z = origin.z;
    found.ray.dir_x = direction.x, found.ray.dir_y = direction.y, found.ray.dir_z = direction.z;
    found.ray.tfar = std::numeric_limits<float>::infinity();
    found.ray.mask = 0xffffffffu;
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &query.embree;
    rtcIntersect1(embree_.scene(), &found, &arguments);
#else
    rtcIntersect1(embree_.scene(), &query.embree, &found);
#endif
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return found.hit.primID;
}

PacketAnswer EmbreeScene::occluded(std::span<const ShadowRay> rays, const ShadowPacket& packet,
                                   const IgnoredTriangles& ignored) const {
    Query query(scene_, ignored);
    query.heights = heights_.data();
    query.rays = rays.data();
    query.packet = &packet;
    const std::uint32_t blocked = rays.size() == 1
                                      ? traceOne(embree_.scene(), packet, query)
                                      : tracePacket(embree_.scene(), unsigned(rays.size()), packet, query);
    return {blocked, query.doubtful & ~blocked};
}

}  // namespace penumbra
