#include "assets/make/foliage.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace penumbra::assets {
namespace {

Vec3 randomDirection(Random& random) {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, glm::two_pi<double>());
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), z, r * std::sin(angle)};
}

// A frame at `origin` whose y axis is `up` and whose turn around it is random.
Mat4 growing(Random& random, const Vec3& origin, const Vec3& up) {
    const Vec3 y = glm::normalize(up);
    Vec3 x = glm::cross(y, randomDirection(random));
    x = glm::length(x) > 1e-3 ? glm::normalize(x) : glm::normalize(glm::cross(y, Vec3(0.3, 0.5, 0.8)));
    const Vec3 z = glm::cross(x, y);
    return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
}

void growBranch(Random& random, Tree& tree, const Vec3& from, const Vec3& direction, double length,
                double radius, int generation) {
    std::vector<Vec3> control{from};
    Vec3 heading = glm::normalize(direction);
    for (int i = 0; i < 3; ++i) {
        heading = glm::normalize(heading + 0.22 * randomDirection(random) + Vec3(0.0, 0.1, 0.0));
        control.push_back(control.back() + heading * (length / 3.0));
    }
    const int perSpan = generation == 0 ? 5 : 2;
    const std::vector<Vec3> curve = smoothCurve(control, perSpan);
    const double endRadius = radius * 0.62;
    std::vector<double> radii;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(curve.size() - 1);
        const double foot = generation == 0 ? 0.6 * radius * std::pow(1.0 - t, 8.0) : 0.0;
        radii.push_back(radius + (endRadius - radius) * t + foot);
    }
    tree.wood.append(tube(curve, radii, generation == 0 ? 14 : generation < 3 ? 7 : 4));

    if (generation >= 2) {
        for (const double t : {0.5, 1.0}) {
            const Vec3 place = curve[static_cast<std::size_t>(t * static_cast<double>(curve.size() - 1))];
            tree.tufts.push_back(growing(random, place, heading + 0.6 * randomDirection(random)));
        }
    }
    if (generation == 4) return;
    const int children = generation == 0 ? 4 : 3;
    const double turn = random.uniform(0.0, glm::two_pi<double>());
    for (int i = 0; i < children; ++i) {
        const double angle = turn + glm::two_pi<double>() * i / children + random.uniform(-0.4, 0.4);
        const Vec3 sideways(std::cos(angle), 0.0, std::sin(angle));
        const double opening = random.uniform(0.55, 0.95);
        const Vec3 next = heading + opening * sideways + Vec3(0.0, generation < 2 ? 0.15 : -0.05, 0.0);
        growBranch(random, tree, curve.back() - heading * endRadius * 0.5, next,
                   length * random.uniform(0.55, 0.74), endRadius * random.uniform(0.62, 0.8),
                   generation + 1);
    }
}

}  // namespace

Mesh leaf(double length, double width) {
    const Vec3 base(0.0), tip(0.0, length, 0.12 * length);
    const Vec3 rib(0.0, 0.45 * length, 0.1 * length);
    const Vec3 left(-0.5 * width, 0.42 * length, 0.0), right(0.5 * width, 0.42 * length, 0.0);
    Mesh mesh;
    mesh.triangle(base, right, rib);
    mesh.triangle(right, tip, rib);
    mesh.triangle(tip, left, rib);
    mesh.triangle(left, base, rib);
    return mesh;
}

Mesh ivyLeaf(double size) {
    // Right half of the outline, from the stalk to the tip; the left half mirrors it.
    const std::vector<Vec2> half{{0.0, 0.0},   {0.34, -0.12}, {0.26, 0.2},
                                 {0.52, 0.46}, {0.2, 0.56},   {0.0, 1.0}};
    const Vec3 rib(0.0, 0.3 * size, 0.12 * size);
    Mesh mesh;
    for (std::size_t i = 0; i + 1 < half.size(); ++i) {
        const Vec3 a(size * half[i], 0.0), b(size * half[i + 1], 0.0);
        mesh.triangle(a, b, rib);
        mesh.triangle({-b.x, b.y, 0.0}, {-a.x, a.y, 0.0}, rib);
    }
    return mesh;
}

Mesh leafCluster(Random& random, int count, double radius, double length) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3 direction = randomDirection(random);
        const double distance = radius * std::cbrt(random.uniform());
        const double size = length * random.uniform(0.7, 1.25);
        mesh.append(leaf(size, 0.5 * size),
                    growing(random, distance * direction, direction + Vec3(0.0, -0.25, 0.0)));
    }
    return mesh;
}

Mesh bladePlant(Random& random, int count, double length, double width) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const double angle = random.uniform(0.0, glm::two_pi<double>());
        const double size = length * random.uniform(0.6, 1.1), lean = random.uniform(0.15, 0.75);
        const Vec3 out(std::cos(angle), 0.0, std::sin(angle)), side(-std::sin(angle), 0.0, std::cos(angle));
        Vec3 middle(0.0), left, right;
        for (int k = 0; k < 4; ++k) {
            const double bend = lean * (0.4 + 0.5 * k);
            const Vec3 next =
                middle + size / 4.0 * glm::normalize(out * std::tan(std::min(bend, 1.4)) + Vec3(0, 1, 0));
            const double half = 0.5 * width * (k == 0 ? 1.0 : 0.95 - 0.22 * k);
            const Vec3 nextLeft = next - half * side, nextRight = next + half * side;
            if (k == 0) {
                mesh.triangle(middle, nextLeft, nextRight);
            } else if (k == 3) {
                mesh.triangle(left, next, right);
            } else {
                mesh.quad(left, nextLeft, nextRight, right);
            }
            middle = next;
            left = nextLeft;
            right = nextRight;
        }
    }
    return mesh;
}

void growIvy(Random& random, const std::vector<Vec3>& path, double leafSize, double spread, int leafCount,
             Mesh& stems, Mesh& leaves) {
    const std::vector<Vec3> stem = smoothCurve(path, 6);
    std::vector<double> radii;
    for (std::size_t i = 0; i < stem.size(); ++i)
        radii.push_back(0.2 * leafSize *
                        (1.0 - 0.8 * static_cast<double>(i) / static_cast<double>(stem.size())));
    stems.append(tube(stem, radii, 5));
    for (int i = 0; i < leafCount; ++i) {
        const Vec3 anchor = stem[static_cast<std::size_t>(random.below(static_cast<int>(stem.size())))];
        const double angle = random.uniform(0.0, glm::two_pi<double>());
        const double reach = spread * random.uniform() * random.uniform();
        const Vec3 place = anchor + Vec3(reach * std::cos(angle), reach * std::sin(angle),
                                         random.uniform(0.1, 0.9) * leafSize);
        const Mat4 pose = translation(place) * rotation(random.uniform(-180.0, 180.0), {0, 0, 1}) *
                          rotation(random.uniform(-35.0, 35.0), {1, 0, 0}) *
                          rotation(random.uniform(-30.0, 30.0), {0, 1, 0});
        leaves.append(ivyLeaf(leafSize * random.uniform(0.6, 1.2)), pose);
    }
}

Tree growTree(Random& random, double height, double trunkRadius) {
    Tree tree;
    growBranch(random, tree, Vec3(0.0, -0.05, 0.0), {0.12, 1.0, 0.08}, 0.38 * height, trunkRadius, 0);
    return tree;
}

}  // namespace penumbra::assets
