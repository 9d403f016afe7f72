#include "assets/make/figure.h"

#include <algorithm>
#include <cmath>

#include "assets/make/implicit.h"

namespace penumbra::assets {
namespace {

// Long folds that open towards the hem; the weight is on one leg, so the robe bulges at the other knee.
double robe(const Vec3& p) {
    const double t = std::clamp(p.y / 1.0, 0.0, 1.0);
    const double angle = std::atan2(p.x, p.z);
    const double folds = 0.022 * (1.0 - t) * std::cos(11.0 * angle + 1.5 * std::sin(3.0 * p.y)) +
                         0.008 * (1.0 - t) * std::cos(23.0 * angle - 4.0 * p.y);
    const Vec3 flat(p.x, p.y, p.z * 1.18);
    double d = capsule(flat, {0.0, 0.1, 0.0}, {0.02, 0.98, 0.0}, 0.25, 0.14) + folds;
    d = melt(d, capsule(p, {-0.09, 0.28, 0.1}, {-0.07, 0.62, 0.13}, 0.08, 0.085) + 0.5 * folds, 0.12);
    return std::max(d, 0.02 - p.y);
}

double body(const Vec3& p) {
    double d = ellipsoid(p, {0.02, 0.97, 0.0}, {0.175, 0.15, 0.14});          // hips
    d = melt(d, ellipsoid(p, {0.01, 1.24, 0.0}, {0.155, 0.2, 0.115}), 0.12);  // chest
    d = melt(d, ellipsoid(p, {-0.065, 1.25, 0.09}, {0.06, 0.06, 0.05}), 0.05);
    d = melt(d, ellipsoid(p, {0.075, 1.255, 0.09}, {0.06, 0.06, 0.05}), 0.05);
    d = melt(d, capsule(p, {-0.16, 1.37, -0.01}, {0.17, 1.39, -0.01}, 0.058, 0.058), 0.08);  // shoulders
    return melt(d, capsule(p, {0.0, 1.38, 0.0}, {-0.01, 1.5, 0.02}, 0.047, 0.042), 0.05);    // neck
}

double head(const Vec3& p) {
    double d = ellipsoid(p, {-0.015, 1.595, 0.025}, {0.075, 0.105, 0.092});
    d = melt(d, ellipsoid(p, {-0.02, 1.545, 0.06}, {0.045, 0.045, 0.045}), 0.04);     // chin
    d = melt(d, ellipsoid(p, {-0.02, 1.59, 0.118}, {0.011, 0.026, 0.018}), 0.02);     // nose
    d = melt(d, ellipsoid(p, {-0.01, 1.635, -0.005}, {0.088, 0.088, 0.098}), 0.025);  // hair
    return melt(d, ellipsoid(p, {0.0, 1.63, -0.115}, {0.05, 0.05, 0.045}), 0.03);     // bun
}

double arms(const Vec3& p) {
    // Her left arm (+x) is raised and holds the jug, her right hand gathers the robe.
    double d = capsule(p, {0.19, 1.37, -0.01}, {0.38, 1.29, 0.05}, 0.052, 0.042);
    d = melt(d, capsule(p, {0.38, 1.29, 0.05}, {0.31, 1.53, 0.1}, 0.04, 0.03), 0.03);
    d = melt(d, ellipsoid(p, {0.3, 1.57, 0.1}, {0.03, 0.05, 0.035}), 0.03);
    d = std::min(d, capsule(p, {-0.19, 1.36, -0.01}, {-0.27, 1.1, -0.02}, 0.052, 0.042));
    d = melt(d, capsule(p, {-0.27, 1.1, -0.02}, {-0.17, 0.93, 0.12}, 0.04, 0.03), 0.03);
    return melt(d, ellipsoid(p, {-0.14, 0.9, 0.14}, {0.035, 0.04, 0.035}), 0.03);
}

double jug(const Vec3& p) {
    const Vec3 q = p - Vec3(0.2, 1.6, -0.02);
    double d = ellipsoid(q, {0.0, 0.0, 0.0}, {0.115, 0.14, 0.115});
    d = melt(d, capsule(q, {0.0, 0.1, 0.0}, {0.0, 0.21, 0.0}, 0.048, 0.04), 0.05);
    return melt(d, ellipsoid(q, {0.0, 0.225, 0.0}, {0.066, 0.018, 0.066}), 0.02);
}

double figure(const Vec3& p) {
    double d = melt(robe(p), body(p), 0.08);
    d = melt(d, capsule(p, {-0.15, 1.34, 0.1}, {0.17, 0.98, 0.1}, 0.025, 0.03), 0.05);  // the robe's sash
    d = melt(d, arms(p), 0.035);
    d = melt(d, head(p), 0.02);
    d = std::min(d, jug(p));
    return melt(d, capsule(p, {-0.1, 0.05, 0.2}, {-0.11, 0.04, 0.27}, 0.035, 0.028), 0.03);  // toes
}

}  // namespace

Mesh waterCarrier() {
    Mesh mesh = surfaceOf(figure, {-0.45, -0.06, -0.4}, {0.55, 1.95, 0.42}, 0.021);
    // The hem stands on the ground: flatten what the last grid cells rounded.
    for (Vec3& p : mesh.positions)
        if (p.y < 0.03) p.y = 0.0;
    return mesh;
}

}  // namespace penumbra::assets
