#include "common/truth/lambert_polygon.h"

#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

// atan(t)/t - 1 = z P(z)/Q(z) with z = t^2, for t <= 0.66; relative error of atan 2e-16 (S. Moshier, Cephes
// library, 1984).
double atanNumerator(double z) {
    return (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) *
                z -
            1.228866684490136173410e2) *
               z -
           6.485021904942025371773e1;
}
double atanDenominator(double z) {
    return ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
             4.328810604912902668951e2) *
                z +
            4.853903996359136964868e2) *
               z +
           1.945506571482613964425e2;
}

int farthestVertex(const Polygon3& polygon) {
    int farthest = 0;
    double most = 0.0;
    for (int i = 0; i < polygon.count; ++i) {
        const double squared = glm::dot(polygon[i], polygon[i]);
        if (squared > most) {
            most = squared;
            farthest = i;
        }
    }
    return farthest;
}

}  // namespace

// The formula is a sum over edges (a, b) of (n . a x b) theta/l, with l = |a x b| and theta = atan2(l, a .
// b). From far away the terms nearly cancel: size/distance of their digits would be lost. But the sum of (n .
// a x b) alone is twice an area, which is exact from vertex differences, so a constant k is taken out of
// every theta/l first:
//
//     sum (n . a x b) theta/l  =  sum (n . a x b) (theta/l - k)  +  k sum n . (a-c) x (b-c),      k = 1/|c|^2
//
// and the small difference theta/l - k is formed from the small quantity a.b - |c|^2, never by subtracting.
// With c the farthest vertex nothing grows: the result is good to a few units in the last place at any
// distance.
double lambertFormFactor(const glm::dvec3& n, const Polygon3& polygon) {
    if (polygon.count < 3) return 0.0;
    const int first = farthestVertex(polygon);
    const glm::dvec3 c = polygon[first];
    const double cc = glm::dot(c, c);
    const double k = 1.0 / cc;
    glm::dvec3 a = c;
    glm::dvec3 alpha(0.0);  // a - c
    double sum = 0.0;
    double twiceArea = 0.0;
    for (int i = 0, at = first; i < polygon.count; ++i) {
        at = polygon.next(at);
        const glm::dvec3 b = polygon[at];
        const glm::dvec3 beta = b - c;
        const glm::dvec3 edge = b - a;
        // Not cross(a, b), which loses the digits of a short edge far away; and exactly negated from b to a.
        const glm::dvec3 axb = 0.5 * glm::cross(a + b, edge);
        const double squared = glm::dot(axb, axb);
        const double adotb = glm::dot(a, b);
        const double excess = glm::dot(c, alpha + beta) + glm::dot(alpha, beta);  // a.b - |c|^2
        double weight = 0.0;                                                      // theta/l - k
        if (adotb > 0.0 && squared <= 0.4356 * adotb * adotb) {
            const double inverse = 1.0 / adotb;
            const double z = squared * inverse * inverse;
            const double q = atanDenominator(z);
            weight = (z * atanNumerator(z) - excess * k * q) * inverse / q;
        } else if (squared > 0.0) {
            const double l = std::sqrt(squared);
            weight = std::atan2(l, adotb) / l - k;
        }
        sum += glm::dot(n, axb) * weight;
        twiceArea += glm::dot(n, glm::cross(alpha, edge));
        a = b;
        alpha = beta;
    }
    return std::max(0.0, -(sum + k * twiceArea) / (2.0 * std::numbers::pi));
}

}  // namespace penumbra
