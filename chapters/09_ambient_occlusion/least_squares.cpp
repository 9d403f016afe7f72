#include "chapters/09_ambient_occlusion/least_squares.h"

#include <cmath>
#include <cstddef>

#include "common/error.h"
#include "common/math/sampling.h"

namespace penumbra {

namespace {

/// Of the residual, relative to that of the start.
constexpr double goodEnough = 1e-11;
constexpr int mostIterations = 2000;

/// The normal equations, triangle by triangle: 9 numbers of M each, and the whole right-hand side. Nothing is
/// assembled: a product with M is a loop over the triangles.
class System {
 public:
    System(std::span<const std::uint32_t> indices, std::size_t vertices)
        : indices_(indices), blocks_(indices.size() / 3, glm::dmat3(0.0)), diagonal_(vertices, 0.0) {}

    void add(const SurfaceSample& sample, std::span<const double> values, std::vector<double>& right) {
        const glm::dvec3 weights(1.0 - sample.barycentric.x - sample.barycentric.y, sample.barycentric);
        blocks_[sample.triangle] += sample.area * glm::outerProduct(weights, weights);
        for (int k = 0; k < 3; ++k) {
            const std::size_t vertex = corner(sample.triangle, k);
            diagonal_[vertex] += sample.area * weights[k] * weights[k];
            for (std::size_t c = 0; c < values.size(); ++c)
                right[c * diagonal_.size() + vertex] += sample.area * weights[k] * values[c];
        }
    }

    void multiply(std::span<const double> x, std::vector<double>& product) const {
        product.assign(x.size(), 0.0);
        for (std::size_t t = 0; t < blocks_.size(); ++t) {
            const std::size_t a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
            const glm::dvec3 part = blocks_[t] * glm::dvec3(x[a], x[b], x[c]);
            product[a] += part.x;
            product[b] += part.y;
            product[c] += part.z;
        }
    }

    /// Jacobi's preconditioner: division by the diagonal. A vertex of no triangle stays 0.
    void precondition(std::span<const double> residual, std::vector<double>& result) const {
        result.resize(residual.size());
        for (std::size_t i = 0; i < residual.size(); ++i)
            result[i] = diagonal_[i] > 0.0 ? residual[i] / diagonal_[i] : 0.0;
    }

 private:
    std::size_t corner(std::size_t triangle, int k) const { return indices_[3 * triangle + std::size_t(k)]; }

    std::span<const std::uint32_t> indices_;
    std::vector<glm::dmat3> blocks_;
    std::vector<double> diagonal_;
};

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// [begin:conjugate-gradients]
/// Conjugate gradients (Hestenes & Stiefel 1952, J. Res. NBS 49), from x = 0.
std::vector<double> solve(const System& system, std::span<const double> right) {
    std::vector<double> x(right.size(), 0.0), residual(right.begin(), right.end()), conditioned, product;
    system.precondition(residual, conditioned);
    std::vector<double> direction = conditioned;
    double size = dot(residual, conditioned);
    const double enough = size * goodEnough * goodEnough;
    for (int i = 0; i < mostIterations; ++i) {
        if (size <= enough) return x;
        system.multiply(direction, product);
        const double step = size / dot(direction, product);
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] += step * direction[k];
            residual[k] -= step * product[k];
        }
        system.precondition(residual, conditioned);
        const double next = dot(residual, conditioned);
        for (std::size_t k = 0; k < x.size(); ++k) direction[k] = conditioned[k] + next / size * direction[k];
        size = next;
    }
    throw Error(
        "least-squares vertex values do not converge: is a triangle sampled in fewer than three places?");
}
// [end:conjugate-gradients]

}  // namespace

glm::dvec2 stratifiedBarycentric(int index, std::uint32_t seed) {
    return glm::dvec2(
        pointInTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, owenSobol(std::uint32_t(index), seed)));
}

std::vector<double> leastSquaresVertices(std::span<const std::uint32_t> indices, std::size_t vertices,
                                         std::span<const SurfaceSample> samples,
                                         std::span<const double> values, std::size_t channels) {
    System system(indices, vertices);
    std::vector<double> right(vertices * channels, 0.0);
    for (std::size_t s = 0; s < samples.size(); ++s)
        system.add(samples[s], values.subspan(s * channels, channels), right);
    std::vector<double> result(vertices * channels);
    for (std::size_t c = 0; c < channels; ++c) {
        const std::vector<double> x = solve(system, std::span(right).subspan(c * vertices, vertices));
        for (std::size_t i = 0; i < vertices; ++i) result[i * channels + c] = x[i];
    }
    return result;
}

}  // namespace penumbra
