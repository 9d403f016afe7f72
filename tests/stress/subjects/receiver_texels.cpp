#include "tests/stress/receiver_texels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "chapters/08_accumulation/accumulation_options.h"
#include "common/truth/polygon_light.h"

namespace penumbra::stress {

namespace {

/// With texel i's centre at i.
glm::dvec2 texelsAt(const Receiver& receiver, const glm::dvec3& p) {
    return receiver.uv(p) * glm::dvec2(receiver.texels) - 0.5;
}

/// The ends of [at - beside, at + beside], and the borders of cells between.
std::vector<double> cuts(double at, double beside) {
    std::vector<double> found{at - beside, at + beside};
    for (double border = std::ceil(at - beside); border < at + beside; ++border) found.push_back(border);
    return found;
}

}  // namespace

std::vector<Receiver> receiversOf(const Scene& scene, std::uint32_t triangle, double minimumArea,
                                  const glm::dvec3& normal) {
    AccumulationOptions options;
    options.texelBudget = 4;
    options.minimumArea = float(minimumArea);
    std::vector<Receiver> receivers = findReceivers(scene, options.receiverRequest(scene));
    std::erase_if(receivers, [&](const Receiver& r) {
        return glm::dot(r.normal, normal) < 0.0 ||
               std::find(r.triangles.begin(), r.triangles.end(), triangle) == r.triangles.end();
    });
    return receivers;
}

TexelBlend::TexelBlend(const Receiver& receiver, const glm::dvec3& p)
    : TexelBlend(receiver, texelsAt(receiver, p)) {}

TexelBlend::TexelBlend(const Receiver& receiver, const glm::dvec2& at) {
    const glm::dvec2 cell = glm::floor(at), t = at - cell;
    for (int i = 0; i < 4; ++i) {
        const glm::ivec2 corner(i % 2, i / 2);
        texels[std::size_t(i)] = glm::clamp(glm::ivec2(cell) + corner, glm::ivec2(0), receiver.texels - 1);
        weights[std::size_t(i)] = (corner.x ? t.x : 1.0 - t.x) * (corner.y ? t.y : 1.0 - t.y);
    }
}

double TexelBlend::of(const std::function<double(const glm::ivec2&)>& value) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * value(texels[i]);
    return sum;
}

double TexelBlend::range(const std::function<double(const glm::ivec2&)>& value) const {
    double least = value(texels[0]), most = least;
    for (const glm::ivec2& texel : texels)
        least = std::min(least, value(texel)), most = std::max(most, value(texel));
    return most - least;
}

Blended blendedWithin(const Receiver& receiver, const glm::dvec3& p, double beside,
                      const std::function<double(const glm::ivec2&)>& value) {
    // Bilinear in each cell: extreme at a corner of what of the cell lies within.
    const glm::dvec2 at = texelsAt(receiver, p);
    const double first = TexelBlend(receiver, at).of(value);
    Blended blended{first, first};
    for (const double x : cuts(at.x, beside))
        for (const double y : cuts(at.y, beside)) {
            const double there = TexelBlend(receiver, glm::dvec2(x, y)).of(value);
            blended.least = std::min(blended.least, there), blended.most = std::max(blended.most, there);
        }
    return blended;
}

double unoccluded(const Receiver& receiver, const Light& light, const glm::ivec2& texel) {
    const glm::dvec3 x = receiver.texelCentre(texel.x, texel.y);
    double sum = 0.0;
    for (const auto& polygon : light.polygons) sum += formFactor(x, receiver.normal, polygon);
    return std::numbers::pi * sum;
}

double halfSubpixel() {
    GLint bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    return std::ldexp(0.5, -std::max(bits, 4));  // both APIs promise at least 4
}

double texelsBeside(const Receiver& receiver, const glm::dvec3& p) {
    double most = 0.0;
    for (const auto& [edge, texels] :
         {std::pair(receiver.uEdge, receiver.texels.x), {receiver.vEdge, receiver.texels.y}}) {
        const double length = glm::length(edge);
        const double sizes = (glm::length(p) + glm::length(receiver.corner)) / length * texels;
        most = std::max(most, transformOperations * 0x1p-24 * 2.0 * sizes);
    }
    return most;
}

}  // namespace penumbra::stress
