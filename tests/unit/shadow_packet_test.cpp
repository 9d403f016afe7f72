// How far the float answers of Embree are from the exact ones, at worst: what the decision in float
// (surelyBlocks) is derived for must never be exceeded.
#include "common/truth/shadow_packet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "common/truth/surface_hit.h"
#include "tests/unit/embree_triangles.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {
namespace {

using LongVec = glm::vec<3, long double>;

/// What Embree finds along the rays of a packet.
RTCRayHit16 nearest(const EmbreeTriangles& triangles, const ShadowPacket& packet) {
    alignas(64) RTCRayHit16 found{};
    alignas(64) int valid[16];
    for (unsigned i = 0; i < 16; ++i) {
        valid[i] = packet.far[i] >= 0.0f ? -1 : 0;
        found.ray.org_x[i] = packet.originX[i], found.ray.dir_x[i] = packet.directionX[i];
        found.ray.org_y[i] = packet.originY[i], found.ray.dir_y[i] = packet.directionY[i];
        found.ray.org_z[i] = packet.originZ[i], found.ray.dir_z[i] = packet.directionZ[i];
        found.ray.tfar[i] = packet.far[i];
        found.ray.mask[i] = 0xffffffffu;
        found.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid, triangles.scene(), &found, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid, triangles.scene(), &context, &found);
#endif
    return found;
}

/// How far from the border of a triangle a line crosses it, along the triangle, and how far off its plane the
/// start and the end of a segment are; metres. Negative: outside, or on the wrong side.
struct Margins {
    long double inside = 0.0L, start = 0.0L, end = 0.0L;
};

Margins exactMargins(const ShadowRay& ray, const std::array<glm::dvec3, 3>& t, double height) {
    const LongVec o(ray.origin), d = ray.towardsInfinity ? LongVec(ray.target) : LongVec(ray.target) - o;
    const LongVec a = LongVec(t[0]) - o, b = LongVec(t[1]) - o, c = LongVec(t[2]) - o;
    const LongVec n = glm::normalize(glm::cross(b - a, c - a));
    const long double u = glm::dot(d, glm::cross(b, c)), v = glm::dot(d, glm::cross(c, a)),
                      w = glm::dot(d, glm::cross(a, b)), sum = u + v + w;
    const long double along = glm::dot(a, n) / glm::dot(d, n), descent = std::abs(glm::dot(d, n));
    return {std::min({u / sum, v / sum, w / sum}) * height, along * descent,
            ray.towardsInfinity ? std::numeric_limits<long double>::infinity() : (1.0L - along) * descent};
}

/// A hit as Embree found it, in the words of surelyBlocks.
struct FloatHit {
    std::uint32_t triangle;
    float leastBarycentric, t;
    glm::vec3 normal;

    FloatHit(const RTCRayHit16& found, unsigned i)
        : triangle(found.hit.primID[i]),
          leastBarycentric(
              std::min({found.hit.u[i], found.hit.v[i], 1.0f - found.hit.u[i] - found.hit.v[i]})),
          t(found.ray.tfar[i]),
          normal(found.hit.Ng_x[i], found.hit.Ng_y[i], found.hit.Ng_z[i]) {}

    Margins margins(const ShadowPacket& packet, unsigned i, float height) const {
        const long double descent =
            std::abs(glm::dot(direction(packet, i), LongVec(normal))) / length(normal);
        return {static_cast<long double>(leastBarycentric) * static_cast<long double>(height), t * descent,
                (static_cast<long double>(packet.end[i]) - t) * descent};
    }
    long double cosine(const ShadowPacket& packet, unsigned i) const {
        const LongVec d = direction(packet, i);
        return std::abs(glm::dot(d, LongVec(normal))) / (length(normal) * glm::length(d));
    }

 private:
    static long double length(const glm::vec3& v) { return glm::length(LongVec(v)); }
    static LongVec direction(const ShadowPacket& packet, unsigned i) {
        return {packet.directionX[i], packet.directionY[i], packet.directionZ[i]};
    }
};

class WorstErrors : public testing::Test {
 protected:
    double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
    glm::dvec3 point() { return {uniform(), uniform(), uniform()}; }
    /// From `least` ulps to the size of the scene, evenly over the magnitudes.
    double length(double least) { return std::exp2((std::abs(uniform()) - 1.0) * (23.0 - std::log2(least))); }

    /// Triangles of all sizes, as slender as may be, anywhere; most in a corner of the scene, where
    /// coordinates are largest.
    Scene scatter(double scale) {
        Scene scene = test_meshes::emptyScene();
        std::vector<glm::dvec3> points = {{-1, -1, -1}, {1, 1, 1}, {1, 1, 1}};  // the reach
        std::vector<std::uint32_t> indices = {0, 1, 2};
        for (std::uint32_t k = 0; k < 64; ++k) {
            const bool needle = k % 4 == 3;
            const double size = needle ? 0.9 : length(1024.0);
            const double width = k % 2 == 0 ? size : size * length(1024.0);
            const glm::dvec3 along = test_meshes::randomDirection(random_);
            const glm::dvec3 across = glm::normalize(glm::cross(along, point()));
            const glm::dvec3 centre = needle       ? 0.1 * point()
                                      : k % 4 == 0 ? point()
                                                   : 0.9 * glm::sign(point());
            for (const glm::dvec3& p : {centre - size * along, centre + size * along,
                                        centre + size * uniform() * along + width * across}) {
                indices.push_back(std::uint32_t(points.size()));
                points.push_back(glm::clamp(p, -1.0, 1.0));
            }
        }
        test_meshes::addPart(scene, points, indices, test_meshes::scaledAndMoved(scale, 0.0));
        return scene;
    }

    /// Through `triangle` near its border or not; from near its plane or not; grazing or not.
    ShadowRay towards(const Scene& scene, std::uint32_t triangle, double scale) {
        const double u = random_() % 2 == 0 ? length(64.0) : 0.5 + 0.5 * uniform();
        const double v = (1.0 - u) * (0.5 + 0.5 * uniform());
        const glm::dvec3 crossing = test_meshes::pointOn(scene, triangle, u, v);
        glm::dvec3 d = test_meshes::randomDirection(random_);
        const glm::dvec3 n = test_meshes::faceNormal(scene, triangle);
        if (random_() % 4 == 0) d -= glm::dot(d, n) * (1.0 - length(64.0)) * n;
        const auto far = [&] { return scale * (random_() % 2 == 0 ? std::abs(uniform()) : length(16.0)); };
        ShadowRay ray;
        ray.origin = crossing - far() * d;
        ray.target = crossing + far() * d;
        ray.normal = glm::normalize(random_() % 2 == 0 ? glm::cross(d, point()) + 1e-3 * d : point());
        ray.towardsInfinity = random_() % 4 == 0;
        if (ray.towardsInfinity) ray.target = d;
        return ray;
    }

    std::mt19937_64 random_{11};
};

/// In ulps; of the hits that float decides.
struct Worst {
    long double sideways = 0.0L, start = 0.0L, end = 0.0L;
    std::size_t decided = 0, wrong = 0;

    void take(const ShadowRay& ray, const Scene& scene, double reach, const ShadowPacket& packet, unsigned i,
              const FloatHit& hit) {
        const auto corners = cornersOf(scene, hit.triangle);
        const float height = decisiveHeight(corners, reach);
        if (!surelyBlocks(packet, i, hit.leastBarycentric, hit.t, hit.normal, height)) return;
        const long double ulp = ulpOf(ray, reach);
        const Margins seen = hit.margins(packet, i, height), exact = exactMargins(ray, corners, height);
        ++decided;
        wrong += exact.inside <= 0.0L || exact.start <= 0.0L || exact.end <= 0.0L ? 1 : 0;
        sideways = std::max(sideways, (seen.inside - exact.inside) * hit.cosine(packet, i) / ulp);
        start = std::max(start, (0.94L * seen.start - exact.start) / ulp);
        if (!ray.towardsInfinity) end = std::max(end, (0.94L * seen.end - exact.end) / ulp);
    }
};

TEST_F(WorstErrors, StayBelowWhatTheDecisionIsDerivedFor) {
    Worst worst;
    for (int trial = 0; trial < 300; ++trial) {
        const double scale = trial % 3 == 0 ? 1.0 : trial % 3 == 1 ? 1e3 : 3e-3;
        const Scene scene = scatter(scale);
        const EmbreeTriangles floats(scene);
        const double reach = largestCoordinate(scene.bounds);
        for (std::uint32_t t = 1; t < scene.triangleCount(); ++t) {
            std::array<ShadowRay, ShadowPacket::size> rays;
            for (ShadowRay& ray : rays) ray = towards(scene, t, scale);
            ShadowPacket packet;
            roundToFloat(rays, reach, packet);
            const RTCRayHit16 found = nearest(floats, packet);
            for (unsigned i = 0; i < rays.size(); ++i)
                if (found.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
                    worst.take(rays[i], scene, reach, packet, i, FloatHit(found, i));
        }
    }
    EXPECT_EQ(worst.wrong, 0u);
    EXPECT_GT(worst.decided, 20000u);
    // Found: 16.5, 14.3 and 0. It did look: the lift alone is 16.
    EXPECT_LE(worst.sideways, 63.0L);
    EXPECT_LE(worst.start, 50.0L);
    EXPECT_LE(worst.end, 50.0L);
    EXPECT_GT(worst.sideways, 16.0L);
    EXPECT_GT(worst.start, 14.0L);
}

}  // namespace
}  // namespace penumbra
