#include "chapters/01_depth_from_light/depth_truth.h"

#include <atomic>
#include <cmath>

namespace penumbra {

namespace {

struct CastDepth {
    double window = 1.0;  ///< the far plane's where there is no surface before it
    bool surface = false;
};

CastDepth castDepth(const RayTracer& tracer, const LightFrustum& frustum, const glm::dvec2& uv,
                    int lightPart) {
    const Hit hit = tracer.nearest(frustum.ray(uv), lightPart);
    const double eyeDepth = hit.valid ? frustum.axisDistance(hit.position) : frustum.far;
    const bool surface = hit.valid && eyeDepth < frustum.far;
    return {frustum.windowDepth(surface ? eyeDepth : frustum.far), surface};
}

}  // namespace

glm::ivec2 texelShownAt(const glm::ivec2& pixel, const glm::ivec2& pictureSize, int mapSize) {
    const double side = std::min(pictureSize.x, pictureSize.y);
    const glm::dvec2 fromBottom(pixel.x + 0.5, pictureSize.y - pixel.y - 0.5);
    const glm::dvec2 uv = (fromBottom - 0.5 * glm::dvec2(pictureSize)) / side + 0.5;
    const glm::ivec2 texel(glm::floor(uv * double(mapSize)));
    const bool inside = texel.x >= 0 && texel.y >= 0 && texel.x < mapSize && texel.y < mapSize;
    return inside ? texel : glm::ivec2(-1);
}

TexelDepth exactTexelDepth(const RayTracer& tracer, const LightFrustum& frustum, const glm::ivec2& texel,
                           int mapSize, DepthFormat format, int lightPart) {
    // Rasterisers snap vertices to 1/256 of a texel: that near to an edge, both of its sides are right.
    const auto cast = [&](double dx, double dy) {
        const glm::dvec2 uv = (glm::dvec2(texel) + 0.5 + glm::dvec2(dx, dy) / 256.0) / double(mapSize);
        return castDepth(tracer, frustum, uv, lightPart);
    };
    const CastDepth centre = cast(0, 0);
    TexelDepth exact{centre.window, true, centre.surface};
    for (const double up : {1.0, -1.0}) {
        const CastDepth left = cast(-1, -up), right = cast(1, up);
        // On one plane the depths of three points in a row are in a row.
        const double bend = std::abs(0.5 * (left.window + right.window) - centre.window);
        if (bend > 2.0 * depthQuantum(format, centre.window) || left.surface != centre.surface ||
            right.surface != centre.surface)
            exact.defined = false;
    }
    return exact;
}

TruthImage depthTruth(const RayTracer& tracer, const LightFrustum& frustum, const glm::ivec2& pictureSize,
                      int mapSize, DepthFormat format, int lightPart, bool linear,
                      const ProgressCallback& progress) {
    TruthImage truth;
    truth.value = FloatImage(pictureSize.x, pictureSize.y, 1);
    truth.mask = FloatImage(pictureSize.x, pictureSize.y, 1);
    truth.quantity = linear ? "distance along the light's axis" : "window depth";
    truth.method = "ray traced";
    truth.against = "texel centres";
    std::atomic<std::size_t> offMap = 0, undefined = 0;
    const auto row = [&](int y) {
        for (int x = 0; x < pictureSize.x; ++x) {
            const glm::ivec2 texel = texelShownAt({x, y}, pictureSize, mapSize);
            if (texel.x < 0) {
                ++offMap;
                continue;
            }
            const TexelDepth exact = exactTexelDepth(tracer, frustum, texel, mapSize, format, lightPart);
            truth.value.at(x, y) = float(linear ? frustum.eyeDepth(exact.value) : exact.value);
            truth.mask.at(x, y) = exact.defined ? 1.0f : 0.0f;
            if (!exact.defined) ++undefined;
        }
    };
    parallelRows(pictureSize.y, row, progress);
    truth.background = offMap;
    truth.straddling = undefined;
    return truth;
}

}  // namespace penumbra
