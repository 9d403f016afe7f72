#include "common/truth/ray_tracer.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "common/error.h"
#include "common/truth/exact_scene.h"
#include "common/truth/segment_test.h"

namespace penumbra {

namespace {

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
#else
using EmbreeContext = RTCIntersectContext;
#endif

constexpr int packetSize = 16;

/// What the filters need to know about the rays being traced. `embree` comes first: Embree hands back its
/// address.
struct Query {
    EmbreeContext embree;
    std::uint32_t ignoreBegin = 0;  ///< triangles [ignoreBegin, ignoreEnd) are not there
    std::uint32_t ignoreEnd = 0;
    const ShadowRay* rays = nullptr;  ///< indexed by the id of an Embree ray
    /// Float and double disagreed about a candidate of the ray of this id.
    std::array<bool, packetSize> doubtful{};
    const glm::vec3* vertices = nullptr;
    const std::uint32_t* indices = nullptr;

    bool ignores(std::uint32_t triangle) const { return triangle >= ignoreBegin && triangle < ignoreEnd; }
    std::array<glm::dvec3, 3> triangle(std::uint32_t index) const {
        const std::uint32_t* i = indices + 3 * std::size_t(index);
        return {glm::dvec3(vertices[i[0]]), glm::dvec3(vertices[i[1]]), glm::dvec3(vertices[i[2]])};
    }
};

void ignorePartFilter(const RTCFilterFunctionNArguments* arguments) {
    const auto* query = reinterpret_cast<const Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != -1) continue;
        if (query->ignores(RTCHitN_primID(arguments->hit, arguments->N, i))) arguments->valid[i] = 0;
    }
}

/// Embree's float arithmetic found a candidate; the double test decides. Where it says that the ray passes
/// the candidate by a hair, its neighbour may be the one that is hit, and float may have missed that: such a
/// ray is noted.
void exactShadowFilter(const RTCFilterFunctionNArguments* arguments) {
    auto* query = reinterpret_cast<Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != -1) continue;
        const std::uint32_t candidate = RTCHitN_primID(arguments->hit, arguments->N, i);
        const unsigned id = RTCRayN_id(arguments->ray, arguments->N, i);
        const ShadowRay& ray = query->rays[id];
        if (candidate == ray.triangle || query->ignores(candidate)) {
            arguments->valid[i] = 0;
            continue;
        }
        const Segment segment{ray.origin, ray.target, ray.towardsInfinity};
        if (crossTriangle(segment, query->triangle(candidate)) == Crossing::inside) continue;
        query->doubtful[id] = true;
        arguments->valid[i] = 0;
    }
}

double largestCoordinate(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// Barycentric coordinates (of b and c) where the line meets the plane of the triangle, forced into the
/// triangle: Embree found the hit with a ray rounded to float, so the exact ray may pass the edge by a hair.
glm::dvec2 exactBarycentrics(const Ray& ray, const std::array<glm::dvec3, 3>& t, const glm::dvec2& fallback) {
    const glm::dvec3 pa = t[0] - ray.origin, pb = t[1] - ray.origin, pc = t[2] - ray.origin;
    const double u = glm::dot(ray.direction, glm::cross(pb, pc));
    const double v = glm::dot(ray.direction, glm::cross(pc, pa));
    const double w = glm::dot(ray.direction, glm::cross(pa, pb));
    const double sum = u + v + w;
    if (!(std::abs(sum) > 0.0)) return fallback;  // edge-on: any point of the crossing line is as good
    const glm::dvec2 b = glm::clamp(glm::dvec2(v, w) / sum, 0.0, 1.0);
    return b.x + b.y > 1.0 ? b / (b.x + b.y) : b;
}

double distanceToEdges(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = t[(i + 1) % 3] - t[i];
        const double length = glm::length(edge);
        if (length > 0.0) least = std::min(least, glm::length(glm::cross(edge, p - t[i])) / length);
    }
    return least;
}

}  // namespace

struct RayTracer::State {
    explicit State(const Scene& s) : scene(s) {}
    ~State() {
        if (embree) rtcReleaseScene(embree);
        if (device) rtcReleaseDevice(device);
    }

    const Scene& scene;
    std::once_flag embreeOnce, exactOnce;
    RTCDevice device = nullptr;
    RTCScene embree = nullptr;
    std::unique_ptr<ExactScene> exact;
    double reach = 0.0;  ///< largest coordinate of the scene, metres

    void build();
    RTCScene built() {
        std::call_once(embreeOnce, [this] { build(); });
        return embree;
    }
    Query query(int ignorePart) const;
    std::uint32_t partOf(std::uint32_t triangle) const;
    Hit hitAt(std::uint32_t triangle, const glm::dvec2& barycentric) const;
    bool occludedExactly(const ShadowRay& ray, int ignorePart, double part);
    void traceOne(const ShadowRay& ray, std::uint8_t& blocked, Query& query) const;
    void traceSixteen(std::span<const ShadowRay> rays, std::uint8_t* blocked, Query& query) const;
};

/// The slow answer, wholly in double, for the few rays that float cannot settle; about the first `part` of
/// the ray.
bool RayTracer::State::occludedExactly(const ShadowRay& ray, int ignorePart, double part) {
    std::call_once(exactOnce, [this] { exact = std::make_unique<ExactScene>(scene); });
    glm::dvec3 target = ray.target;
    if (ray.towardsInfinity && part >= 1.0) {
        const double beyond = 4.0 * (reach + largestCoordinate(ray.origin)) + 1.0;
        target = ray.origin + beyond * glm::normalize(ray.target);
    } else if (part < 1.0) {
        target = ray.origin + part * (ray.towardsInfinity ? ray.target : ray.target - ray.origin);
    }
    return exact->occluded(ray.origin, ray.triangle, target, ignorePart);
}

void RayTracer::State::build() {
    device = rtcNewDevice(nullptr);
    if (!device)
        throw Error("Embree does not start (error " + std::to_string(rtcGetDeviceError(nullptr)) + ")");
    embree = rtcNewScene(device);
    rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree keeps its own copy: it reads 16 bytes at a time, past the end of a tight array of vec3.
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), scene.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                            scene.triangleCount());
    if (vertices && indices) {
        std::copy(scene.positions.begin(), scene.positions.end(), static_cast<glm::vec3*>(vertices));
        std::copy(scene.indices.begin(), scene.indices.end(), static_cast<std::uint32_t*>(indices));
        rtcSetGeometryIntersectFilterFunction(geometry, ignorePartFilter);
        rtcSetGeometryOccludedFilterFunction(geometry, exactShadowFilter);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(embree, geometry);
    }
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree);
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE) {
        throw Error("Embree cannot build scene '" + scene.name + "' (" +
                    std::to_string(scene.triangleCount()) + " triangles): error " + std::to_string(error) +
                    "; is memory short?");
    }
    if (!scene.bounds.empty()) {
        reach = std::max(largestCoordinate(scene.bounds.lower), largestCoordinate(scene.bounds.upper));
    }
}

Query RayTracer::State::query(int ignorePart) const {
    Query query;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query.embree);
#else
    rtcInitIntersectContext(&query.embree);
#endif
    if (ignorePart >= 0 && std::size_t(ignorePart) < scene.parts.size()) {
        query.ignoreBegin = scene.parts[ignorePart].firstTriangle;
        query.ignoreEnd = query.ignoreBegin + scene.parts[ignorePart].triangleCount;
    }
    query.vertices = scene.positions.data();
    query.indices = scene.indices.data();
    return query;
}

std::uint32_t RayTracer::State::partOf(std::uint32_t triangle) const {
    const auto after =
        std::upper_bound(scene.parts.begin(), scene.parts.end(), triangle,
                         [](std::uint32_t t, const Part& part) { return t < part.firstTriangle; });
    return after == scene.parts.begin() ? 0u : std::uint32_t(after - scene.parts.begin() - 1);
}

Hit RayTracer::State::hitAt(std::uint32_t triangle, const glm::dvec2& barycentric) const {
    const std::uint32_t* i = &scene.indices[3 * std::size_t(triangle)];
    const glm::dvec3 a(scene.positions[i[0]]), b(scene.positions[i[1]]), c(scene.positions[i[2]]);
    const double u = barycentric.x, v = barycentric.y;
    Hit hit;
    hit.valid = true;
    hit.triangle = triangle;
    hit.part = partOf(triangle);
    hit.barycentric = barycentric;
    // a + differences, not a weighted sum: on an axis-aligned plane the coordinate then comes out exactly.
    hit.position = a + u * (b - a) + v * (c - a);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    hit.edgeDistance = distanceToEdges(hit.position, {a, b, c});
    hit.geometricNormal = glm::length(n) > 0.0 ? glm::normalize(n) : glm::dvec3(0, 1, 0);
    const glm::dvec3 shading = (1.0 - u - v) * glm::dvec3(scene.normals[i[0]]) +
                               u * glm::dvec3(scene.normals[i[1]]) + v * glm::dvec3(scene.normals[i[2]]);
    hit.shadingNormal = glm::length(shading) > 0.0 ? glm::normalize(shading) : hit.geometricNormal;
    const glm::dvec2 uvA(scene.uvs[i[0]]);
    hit.uv = uvA + u * (glm::dvec2(scene.uvs[i[1]]) - uvA) + v * (glm::dvec2(scene.uvs[i[2]]) - uvA);
    return hit;
}

RayTracer::RayTracer(const Scene& scene) : state_(std::make_unique<State>(scene)) {}
RayTracer::~RayTracer() = default;
const Scene& RayTracer::scene() const {
    return state_->scene;
}

Hit RayTracer::nearest(const Ray& ray, int ignorePart) const {
    RTCScene embree = state_->built();
    Query query = state_->query(ignorePart);
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
    rtcIntersect1(embree, &found, &arguments);
#else
    rtcIntersect1(embree, &query.embree, &found);
#endif
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const std::uint32_t triangle = found.hit.primID;
    const glm::dvec2 fallback(found.hit.u, found.hit.v);
    return state_->hitAt(triangle, exactBarycentrics(ray, query.triangle(triangle), fallback));
}

/// One float ulp of the largest coordinate in play.
static double ulpOf(const ShadowRay& ray, double reach) {
    return 0x1p-23 * std::max(reach, largestCoordinate(ray.origin));
}

/// The float ray that Embree gets. Its origin is lifted off the surface by 16 float ulps; from there it aims
/// at the target, but begins 12 ulps further back (still off the surface, so that the surface itself is not
/// met again and again) and ends further on. Rounding moves an end by at most half an ulp along each axis. So
/// lifted, the ray cannot slip under an occluder that stands on the surface, and begun further back it cannot
/// start beyond one, unless it meets it at a grazing angle below 1/24 within a few ulps of where it starts.
/// The price is a silhouette that is moved by at most 16 ulps, 2e-6 of the scene's size. Who needs it exacter
/// asks ExactScene, as the truth pictures do.
static RTCRay floatRay(const ShadowRay& ray, double reach, unsigned id) {
    const double ulp = ulpOf(ray, reach);
    const glm::dvec3 exactDirection = ray.towardsInfinity ? ray.target : ray.target - ray.origin;
    const double lift = glm::dot(exactDirection, ray.normal) < 0.0 ? -16.0 * ulp : 16.0 * ulp;
    const glm::dvec3 lifted = ray.origin + lift * ray.normal;
    const glm::dvec3 direction = ray.towardsInfinity ? ray.target : ray.target - lifted;
    const glm::vec3 d(direction);
    const float length2 = glm::dot(d, d);
    const double back = 12.0 * ulp / double(std::sqrt(length2));  // in units of the direction's length
    const glm::vec3 o(lifted - back * direction);
    const float far = ray.towardsInfinity ? std::numeric_limits<float>::infinity() : float(1.0 + 4.0 * back);
    // A ray of no length has nothing strictly between its ends; a negative far end tells Embree to leave it
    // out.
    return {o.x, o.y, o.z, 0.0f, d.x, d.y, d.z, 0.0f, length2 > 0.0f ? far : -1.0f, 0xffffffffu, id, 0};
}

/// Is the origin so near to an edge of its triangle that the lifted ray may start beyond the neighbour across
/// a fold?
static bool nearOwnEdge(const ShadowRay& ray, double reach) {
    return ray.triangle != ShadowRay::noTriangle && ray.edgeDistance <= 128.0 * ulpOf(ray, reach);
}

void RayTracer::State::traceOne(const ShadowRay& ray, std::uint8_t& blocked, Query& query) const {
    RTCRay single = floatRay(ray, reach, 0);
    if (single.tfar < 0.0f) {
        blocked = 0;
        return;
    }
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &query.embree;
    rtcOccluded1(embree, &single, &arguments);
#else
    rtcOccluded1(embree, &query.embree, &single);
#endif
    blocked = single.tfar < 0.0f ? 1 : 0;
}

void RayTracer::State::traceSixteen(std::span<const ShadowRay> rays, std::uint8_t* blocked,
                                    Query& query) const {
    alignas(64) int valid[packetSize] = {};
    alignas(64) RTCRay16 packet;
    for (unsigned i = 0; i < rays.size(); ++i) {
        const RTCRay ray = floatRay(rays[i], reach, i);
        packet.org_x[i] = ray.org_x, packet.org_y[i] = ray.org_y, packet.org_z[i] = ray.org_z;
        packet.dir_x[i] = ray.dir_x, packet.dir_y[i] = ray.dir_y, packet.dir_z[i] = ray.dir_z;
        packet.tnear[i] = ray.tnear, packet.tfar[i] = ray.tfar, packet.time[i] = ray.time;
        packet.mask[i] = ray.mask, packet.id[i] = ray.id, packet.flags[i] = ray.flags;
        valid[i] = ray.tfar >= 0.0f ? -1 : 0;
    }
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &query.embree;
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, embree, &packet, &arguments);
#else
    query.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid, embree, &query.embree, &packet);
#endif
    for (std::size_t i = 0; i < rays.size(); ++i)
        blocked[i] = valid[i] == -1 && packet.tfar[i] < 0.0f ? 1 : 0;
}

void RayTracer::occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                         int ignorePart) const {
    state_->built();
    Query query = state_->query(ignorePart);
    for (std::size_t first = 0; first < rays.size(); first += packetSize) {
        const auto packet = rays.subspan(first, std::min<std::size_t>(packetSize, rays.size() - first));
        query.rays = packet.data();
        query.doubtful.fill(false);
        if (packet.size() == 1) {
            state_->traceOne(packet[0], blocked[first], query);
        } else {
            state_->traceSixteen(packet, &blocked[first], query);
        }
        for (std::size_t i = 0; i < packet.size(); ++i) {
            if (blocked[first + i]) continue;
            if (query.doubtful[i]) {
                blocked[first + i] = state_->occludedExactly(packet[i], ignorePart, 1.0) ? 1 : 0;
            } else if (nearOwnEdge(packet[i], state_->reach)) {
                // Only the first stretch is in doubt: 4096 ulps, a short walk through the hierarchy.
                const glm::dvec3 whole =
                    packet[i].towardsInfinity ? packet[i].target : packet[i].target - packet[i].origin;
                const double stretch = 4096.0 * ulpOf(packet[i], state_->reach) / glm::length(whole);
                blocked[first + i] =
                    state_->occludedExactly(packet[i], ignorePart, std::min(1.0, stretch)) ? 1 : 0;
            }
        }
    }
}

bool RayTracer::occluded(const Hit& from, const glm::dvec3& target, int ignorePart) const {
    const ShadowRay ray = ShadowRay::from(from, target);
    std::uint8_t blocked = 0;
    occluded(std::span(&ray, 1), std::span(&blocked, 1), ignorePart);
    return blocked != 0;
}

bool RayTracer::occludedTowards(const Hit& from, const glm::dvec3& direction, int ignorePart) const {
    const ShadowRay ray = ShadowRay::from(from, direction, true);
    std::uint8_t blocked = 0;
    occluded(std::span(&ray, 1), std::span(&blocked, 1), ignorePart);
    return blocked != 0;
}

}  // namespace penumbra
