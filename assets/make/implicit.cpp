#include "assets/make/implicit.h"

#include <algorithm>
#include <cmath>

namespace penumbra::assets {
namespace {

Vec3 gradient(const DistanceField& field, const Vec3& p, double step) {
    const auto along = [&](const Vec3& d) { return field(p + d) - field(p - d); };
    return Vec3(along({step, 0, 0}), along({0, step, 0}), along({0, 0, step})) / (2.0 * step);
}

class Grid {
 public:
    Grid(const DistanceField& field, const Vec3& lower, const Vec3& upper, double cell)
        : lower_(lower), cell_(cell), size_(glm::ivec3(glm::ceil((upper - lower) / cell)) + 1) {
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x) values_.push_back(field(point({x, y, z})));
    }
    glm::ivec3 size() const { return size_; }
    // A face whose corners alternate inside and outside would give an edge shared by four triangles. Fills
    // the corner that is nearest to inside, until there is no such face: crevices thinner than a cell close.
    void fillAlternatingFaces() {
        bool changed = true;
        while (changed) {
            changed = false;
            for (int z = 0; z + 1 < size_.z; ++z)
                for (int y = 0; y + 1 < size_.y; ++y)
                    for (int x = 0; x + 1 < size_.x; ++x)
                        for (int axis = 0; axis < 3; ++axis)
                            changed = fillIfAlternating({x, y, z}, axis) || changed;
        }
    }
    Vec3 point(const glm::ivec3& i) const { return lower_ + cell_ * Vec3(i); }
    double value(const glm::ivec3& i) const { return values_[index(i)]; }
    std::size_t index(const glm::ivec3& i) const {
        return (std::size_t(i.z) * std::size_t(size_.y) + std::size_t(i.y)) * std::size_t(size_.x) +
               std::size_t(i.x);
    }

 private:
    bool fillIfAlternating(const glm::ivec3& c, int axis) {
        glm::ivec3 u(0), v(0);
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 1;
        double* a = &values_[index(c)];
        double* b = &values_[index(c + u)];
        double* d = &values_[index(c + u + v)];
        double* e = &values_[index(c + v)];
        if ((*a < 0.0) != (*d < 0.0) || (*b < 0.0) != (*e < 0.0) || (*a < 0.0) == (*b < 0.0)) return false;
        if (*a < 0.0) {
            a = b;
            d = e;
        }
        (*a < *d ? *a : *d) = -1e-3 * cell_;
        return true;
    }

    Vec3 lower_;
    double cell_;
    glm::ivec3 size_;
    std::vector<double> values_;
};

// Mean of the points where the surface cuts the twelve edges of the cell at `c`; false if it cuts none.
bool cellVertex(const Grid& grid, const glm::ivec3& c, Vec3& vertex) {
    Vec3 sum(0.0);
    int cuts = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 4; ++k) {
            glm::ivec3 a = c, step(0);
            a[(axis + 1) % 3] += k & 1;
            a[(axis + 2) % 3] += k >> 1;
            step[axis] = 1;
            const double va = grid.value(a), vb = grid.value(a + step);
            if ((va < 0.0) == (vb < 0.0)) continue;
            sum += glm::mix(grid.point(a), grid.point(a + step), va / (va - vb));
            ++cuts;
        }
    vertex = cuts > 0 ? sum / double(cuts) : sum;
    return cuts > 0;
}

}  // namespace

double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - glm::mix(a, b, t)) - (ra + (rb - ra) * t);
}

double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
    const Vec3 q = p - centre;
    const double k0 = glm::length(q / radii), k1 = glm::length(q / (radii * radii));
    return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min({radii.x, radii.y, radii.z});
}

double melt(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - 0.25 * h * h * blend;
}

Mesh surfaceOf(const DistanceField& field, const Vec3& lower, const Vec3& upper, double cell) {
    Grid grid(field, lower, upper, cell);
    grid.fillAlternatingFaces();
    const glm::ivec3 size = grid.size();
    Mesh mesh;
    std::vector<std::uint32_t> vertexOf(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), 0);
    for (int z = 0; z + 1 < size.z; ++z)
        for (int y = 0; y + 1 < size.y; ++y)
            for (int x = 0; x + 1 < size.x; ++x) {
                Vec3 vertex;
                if (!cellVertex(grid, {x, y, z}, vertex)) continue;
                for (int pass = 0; pass < 2; ++pass) {
                    const Vec3 g = gradient(field, vertex, 0.05 * cell);
                    vertex -= 0.7 * field(vertex) * g / std::max(glm::dot(g, g), 0.25);
                }
                vertexOf[grid.index({x, y, z})] = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back(vertex);
            }
    // Every grid edge that crosses the surface gives one quad between the four cells around it.
    for (int z = 1; z + 1 < size.z; ++z)
        for (int y = 1; y + 1 < size.y; ++y)
            for (int x = 1; x + 1 < size.x; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    const glm::ivec3 a(x, y, z);
                    glm::ivec3 step(0), u(0), v(0);
                    step[axis] = 1;
                    u[(axis + 1) % 3] = 1;
                    v[(axis + 2) % 3] = 1;
                    const bool insideA = grid.value(a) < 0.0;
                    if (insideA == (grid.value(a + step) < 0.0)) continue;
                    std::uint32_t q[4] = {vertexOf[grid.index(a - u - v)], vertexOf[grid.index(a - v)],
                                          vertexOf[grid.index(a)], vertexOf[grid.index(a - u)]};
                    if (!insideA) std::swap(q[1], q[3]);
                    mesh.triangles.push_back({q[0], q[1], q[2]});
                    mesh.triangles.push_back({q[0], q[2], q[3]});
                }
    return mesh;
}

}  // namespace penumbra::assets
