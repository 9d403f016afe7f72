// Closed forms of ambient visibility, and of the coverage of a filter's kernel by an edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/math/polygon.h"
#include "common/truth/ambient_forms.h"
#include "common/truth/edge_coverage.h"
#include "common/truth/polygon_light.h"
#include "common/truth/segment_test.h"
#include "common/truth/shadow_polygon.h"
#include "tests/stress/bent_bound.h"
#include "tests/stress/case.h"
#include "tests/stress/dice.h"

namespace penumbra::stress {
namespace {

constexpr double pi = std::numbers::pi;
/// Of numbers about 1 that a few dozen operations made.
constexpr double few = 64.0 * 0x1p-53;

/// Visibilities in [0,1], bent vectors that they allow. `error`: of the form.
void inRange(Verdict& verdict, const std::string& name, const AmbientForm& form, double error) {
    const double beyond = std::max({-form.cosine, form.cosine - 1.0, -form.uniform, form.uniform - 1.0});
    verdict.expectAtMost(name + ": visibility outside of [0,1], over its error", beyond / error, 1.0);
    const double bent =
        std::max(glm::length(form.cosineBent) - longestBent(form.cosine, Weighting::cosine),
                 glm::length(form.uniformBent) - longestBent(form.uniform, Weighting::uniform));
    verdict.expectAtMost(name + ": bent vector too long, over its error", bent / error, 1.0);
}

void compare(Verdict& verdict, const std::string& name, double a, double b, double bound) {
    verdict.expectAtMost(name + ", over the bound", std::abs(a - b) / bound, 1.0);
}

/// A sphere at the case's angle from the normal, and as large as it is seen.
void sphere(Verdict& verdict, const Case& given, Dice& dice) {
    const double angle = given.number("light-angle") * pi / 180.0 * (dice.oneIn(2) ? 1.0 : 2.0);
    const double distance = given.number("scale"),
                 radius = distance * std::min(1.0, 0.5 * given.number("light-size"));
    const glm::dvec3 centre = distance * glm::dvec3(std::sin(angle), 0.0, std::cos(angle));
    const AmbientForm form = ambientUnderSphere(centre, radius);
    inRange(verdict, "sphere", form, few);
    if (std::cos(angle) > radius / distance + 1e-9)
        compare(verdict, "sphere: whole cap", 1.0 - form.cosine,
                std::cos(angle) * (radius / distance) * (radius / distance), few);
    const double two = std::exp2(double(dice.below(60) - 30));
    compare(verdict, "sphere: scaled by a power of two",
            ambientUnderSphere(two * centre, two * radius).cosine, form.cosine, 1e-300);
}

/// A rectangle overhead, as one, in four parts, and by Lambert's formula.
void rectangle(Verdict& verdict, const Case& given, Dice& dice) {
    const double height = given.number("scale"), size = height * given.number("light-size");
    const glm::dvec2 middle = size * glm::dvec2(dice.between(-2.0, 2.0), dice.between(-2.0, 2.0));
    const glm::dvec2 half = size * glm::dvec2(dice.magnitude(1e-9, 1.0), dice.magnitude(1e-3, 1.0));
    const glm::dvec2 lower = middle - half, upper = middle + half;
    const AmbientForm form = ambientUnderRectangle(lower, upper, height);
    inRange(verdict, "rectangle", form, few);
    double parts = 0.0;
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 from(i % 2 ? middle.x : lower.x, i / 2 ? middle.y : lower.y);
        const glm::dvec2 to(i % 2 ? upper.x : middle.x, i / 2 ? upper.y : middle.y);
        parts += 1.0 - ambientUnderRectangle(from, to, height).cosine;
    }
    compare(verdict, "rectangle: in four parts", parts, 1.0 - form.cosine, few);
    const std::array<glm::dvec3, 4> light = {
        glm::dvec3(lower, height), {lower.x, upper.y, height}, {upper, height}, {upper.x, lower.y, height}};
    compare(verdict, "rectangle: by Lambert's formula", formFactor(glm::dvec3(0.0), {0, 0, 1}, light),
            1.0 - form.cosine, few);
}

/// A disk overhead by quadrature against the form of Hamilton & Morgan, and from within a pit.
void disk(Verdict& verdict, const Case& given, Dice& dice) {
    const double height = given.number("scale"), r = height * std::max(1e-3, given.number("light-size")),
                 a = 2.0 * r * dice.unit();
    const AmbientForm form = ambientUnderDisk(r, height, a);
    inRange(verdict, "disk", form, 1e-13);
    const double sum = height * height + a * a + r * r;
    const double root =
        std::sqrt((height * height + (a - r) * (a - r)) * (height * height + (a + r) * (a + r)));
    // r^2 of the sum is what is left of sum - root, so that no digits are lost.
    compare(verdict, "disk: by Hamilton and Morgan", 1.0 - form.cosine,
            0.5 * (root - sum + 2.0 * r * r) / root, 1e-13);
}

/// Profiles of any opening, however nearly closed: as one, and in two.
void profile(Verdict& verdict, const Case& given, Dice& dice) {
    const double angle = given.number("light-angle") * pi / 180.0, width = dice.magnitude(1e-12, 1.0);
    inRange(verdict, "wall", ambientBesideWall(width, dice.magnitude(1e-9, 1e9)), few);
    inRange(verdict, "slope", ambientOnSlope(2.0 * angle), few);
    inRange(verdict, "gully", ambientOnGullyFloor(width * dice.unit(), width, dice.magnitude(1e-9, 1e9)),
            few);
    inRange(verdict, "trench", ambientInTrench(0.001 + angle, angle * dice.unit()), few);
    inRange(verdict, "wall within a range", ambientBesideWallWithin(width, dice.magnitude(1e-12, 10.0)), few);
    inRange(verdict, "fading wall", ambientBesideFadingWall(width, width * dice.magnitude(1.0, 1e6)), few);
    const double from = angle, to = from + (pi - from) * dice.unit(), cut = from + (to - from) * dice.unit();
    compare(verdict, "profile: in two parts",
            ambientInProfile(from, cut).cosine + ambientInProfile(cut, to).cosine,
            ambientInProfile(from, to).cosine, few);
}

/// A kernel across a straight edge: as clipping cuts it, and the same from both sides.
void coverage(Verdict& verdict, const Case& given, Dice& dice) {
    const double width = given.number("scale"), distance = width * dice.between(-1.0, 1.0);
    const double angle = given.number("light-angle") * pi / 180.0;
    const glm::dvec2 normal(std::cos(angle), std::sin(angle));
    const double h = 0.5 * width;
    const Polygon2 box(std::array<glm::dvec2, 4>{glm::dvec2(-h, -h), {h, -h}, {h, h}, {-h, h}});
    const double lit = area(clip(box, [&](const glm::dvec2& p) { return glm::dot(normal, p) + distance; })) /
                       (width * width);
    const double magnitude = given.number("light-size");
    compare(verdict, "box: by clipping", boxCoverage(distance, width, magnitude * normal), lit, few);
    for (const auto& [name, sum] :
         {std::pair("box", boxCoverage(distance, width, normal) + boxCoverage(-distance, width, normal)),
          std::pair("disk kernel", diskCoverage(distance, h) + diskCoverage(-distance, h))})
        compare(verdict, std::string(name) + ": both sides", sum, 1.0, few);
    verdict.expectAtMost("disk kernel: more light nearer to the edge",
                         diskCoverage(distance, h) - diskCoverage(distance + 1e-3 * h, h), few);
    verdict.expectAtMost("bar: outside of [0,1]",
                         std::abs(barCoverage(width * dice.unit(), width) - 0.5) - 0.5, few);
}

/// A shadow on a grid of cells: the cells hold the whole.
void cells(Verdict& verdict, const Case& given, Dice& dice) {
    const double scale = given.number("scale");
    PlanarReceiver receiver;
    receiver.corner = given.number("distance") / std::sqrt(3.0) * glm::dvec3(1.0);
    receiver.uEdge = {scale, 0.0, 0.0}, receiver.vEdge = {0.0, scale, 0.0};
    const glm::dvec3 light =
        receiver.corner + scale * glm::dvec3(dice.unit(), dice.unit(), dice.magnitude(1e-3, 1e3));
    Triangle t;
    for (glm::dvec3& p : t)
        p = receiver.corner +
            scale * glm::dvec3(dice.between(-1.0, 2.0), dice.between(-1.0, 2.0), dice.between(-0.5, 2.0));
    const Polygon2 shadow = shadowPolygon(t, light, receiver);
    constexpr int n = 6;
    double sum = 0.0, outside = 0.0, otherwise = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const glm::dvec2 lower = glm::dvec2(i % n, i / n) / double(n),
                         upper = glm::dvec2(i % n + 1, i / n + 1) / double(n);
        const double covered = cellCoverage(shadow, lower, upper);
        outside = std::max({outside, -covered, covered - 1.0});
        const bool blocked =
            crossTriangle({receiver.at(0.5 * (lower + upper)), light}, t) == Crossing::inside;
        otherwise += (covered == 0.0 && blocked) || (covered == 1.0 && !blocked) ? 1.0 : 0.0;
        sum += covered / (n * n);
    }
    verdict.expectAtMost("cells: coverage outside of [0,1]", outside, few);
    // A light a thousandth of the receiver high moves a shadow by a thousand times the rounding of its
    // corners.
    if (scale > 1e-8 * given.number("distance"))
        verdict.expectAtMost("cells: seen otherwise by a ray from their middle", otherwise, 0.0);
    compare(verdict, "cells: their sum and the whole", sum, shadow.count < 3 ? 0.0 : std::abs(area(shadow)),
            few);
    for (const glm::dvec2& p : shadow.span())
        verdict.expectAtMost("shadow: corner off the receiver", std::max({-p.x, -p.y, p.x - 1.0, p.y - 1.0}),
                             0.0);
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(std::uint64_t(given.integer("variant")));
    sphere(verdict, given, dice);
    rectangle(verdict, given, dice);
    disk(verdict, given, dice);
    profile(verdict, given, dice);
    coverage(verdict, given, dice);
    cells(verdict, given, dice);
    return verdict;
}

const AddSubject ambientForm(
    {.name = "ambient-form",
     .claim = "closed forms of ambient visibility, kernels and shadow polygons are in range, and the "
              "same by another formula and in parts",
     .axes = {"light-angle", "light-size", "scale", "distance", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
