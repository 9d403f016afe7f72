#include "tests/stress/lone_surface.h"

#include <algorithm>
#include <cmath>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "common/scene/light.h"
#include "tests/stress/triangle_shapes.h"

namespace penumbra::stress {
namespace {

constexpr double lightDistance = 3.0;

std::vector<Triangle> smallCaster(const Case& given, const glm::dvec3& toLight) {
    const glm::dvec3 shadowed(1.5, 0.0, 1.5), light = lightDistance * toLight;
    const double ratio = given.number("near-far");
    const bool sun = given.choice("light-type") == "directional";
    const glm::dvec3 towards = sun ? toLight : glm::normalize(light - shadowed);
    const double fromLight = ratio * glm::length(light - shadowed);
    const glm::dvec3 centre =
        sun ? shadowed + std::min(lightDistance / ratio, 1e4) * toLight : light - fromLight * towards;
    const double size = 0.02 * (sun ? lightDistance : fromLight);
    const glm::dvec3 a = glm::normalize(glm::cross(towards, glm::dvec3(0.3, 0.1, 1.0))),
                     b = glm::cross(towards, a);
    return {{centre + size * a, centre - size * a + size * b, centre - size * b}};
}

constexpr double cameraHeight = 0.005;  // metres
constexpr double seenGround = 1.5;      // metres, of a side of the picture

/// The small one, and those of the case's shape on the way from the middle of the picture to the light; above
/// the camera.
std::vector<Triangle> casters(const Case& given, const glm::dvec3& toLight, Dice& dice) {
    // Towards a light that grazes, what is high enough to be in the way is far away: there it hangs lower.
    const double away = std::min(dice.between(0.2, 0.8) / toLight.y, 1.5);
    const glm::dvec3 beside(dice.between(-0.3, 0.3), 0.0, dice.between(-0.3, 0.3));
    const TrianglePlace place{away * toLight + beside, dice.magnitude(0.05, 0.6), {0, 1, 0}};
    std::vector<Triangle> triangles = trianglesOf(given.choice("shape"), place, dice);
    for (const Triangle& t : smallCaster(given, toLight)) triangles.push_back(t);
    for (Triangle& t : triangles)
        for (glm::dvec3& p : t) p.y = std::max(p.y, 2.0 * cameraHeight);
    return triangles;
}

std::vector<Triangle> groundTriangle(double azimuth) {
    const auto corner = [azimuth](double turn) {
        return 4.0 * glm::dvec3(std::cos(azimuth + turn), 0.0, -std::sin(azimuth + turn));
    };
    return {{corner(0.0), corner(2.1), corner(4.2)}};
}

}  // namespace

LoneSurface loneSurface(const Case& given) {
    Dice dice(std::uint64_t(given.integer("variant")));
    const bool plain = given.integer("variant") == 0;
    const double azimuth = plain ? 1.0 : dice.between(0.0, 6.28), lean = plain ? 0.4 : dice.between(0.0, 1.2);
    const glm::dvec3 eye = 2.0 * glm::dvec3(std::sin(lean) * std::cos(azimuth), std::cos(lean),
                                            std::sin(lean) * std::sin(azimuth));
    const Placement placement(given, eye, dice);
    const double angle = given.number("light-angle") * radians, fov = given.number("fov") * radians;
    const glm::dvec3 toLight(std::sin(angle), std::cos(angle), 0.0);
    std::vector<Triangle> triangles = groundTriangle(azimuth);
    for (const Triangle& t : smallCaster(given, toLight)) triangles.push_back(t);
    LoneSurface surface;
    surface.scene = drawnScene(placement.triangles(std::move(triangles)));
    surface.scene.lights.push_back(lightOf(given, placement, {0, 0, 0}, toLight, lightDistance, 0.5 * fov));
    surface.scene.cameras.push_back(cameraOf(placement, eye, {0, 0, 0}, fov));
    surface.fitToView = given.integer("variant") % 2 == 1;
    return surface;
}

LoneSurface shadowedSurface(const Case& given) {
    Dice dice(std::uint64_t(given.integer("variant")));
    const double azimuth = given.integer("variant") == 0 ? 1.0 : dice.between(0.0, 6.28);
    const glm::dvec3 eye(0.0, cameraHeight, 0.0);
    const Placement placement(given, eye, dice);
    const double angle = given.number("light-angle") * radians;
    const glm::dvec3 toLight(std::sin(angle), std::cos(angle), 0.0);
    std::vector<Triangle> triangles = groundTriangle(azimuth);
    for (const Triangle& t : casters(given, toLight, dice)) triangles.push_back(t);
    LoneSurface surface;
    surface.scene = drawnScene(placement.triangles(std::move(triangles)));
    surface.scene.lights.push_back(
        lightOf(given, placement, {0, 0, 0}, toLight, lightDistance, 0.5 * given.number("fov") * radians));
    surface.scene.cameras.push_back(cameraOf(placement, eye, {0, 0, 0}, 1.0));
    Camera& camera = surface.scene.cameras[0];
    camera.orthographic = true;
    camera.height = placement.length(seenGround);
    camera.near = placement.length(0.1 * cameraHeight);
    camera.far = placement.length(1.5 * cameraHeight);
    surface.fitToView = given.integer("variant") % 2 == 1;
    return surface;
}

LightFrustum LoneSurface::frustum(const std::string& depthFormat) const {
    const DepthRange range = depthFormat == "32f-reversed" ? DepthRange::reversed : DepthRange::standard;
    return fitToView ? fitLightFrustum(scene, scene.lights[0], scene.cameras[0], 1.0, range)
                     : fitLightFrustum(scene, scene.lights[0], range);
}

glm::dvec3 LoneSurface::normal() const {
    const glm::dvec3 a(scene.positions[0]);
    return glm::normalize(glm::cross(glm::dvec3(scene.positions[1]) - a, glm::dvec3(scene.positions[2]) - a));
}

glm::dvec3 LoneSurface::point(int x, int y, int pictureSize) const {
    const Ray ray = cameraRay(scene.cameras[0], {x + 0.5, y + 0.5}, glm::ivec2(pictureSize));
    const glm::dvec3 n = normal();
    const double t = glm::dot(glm::dvec3(scene.positions[0]) - ray.origin, n) / glm::dot(ray.direction, n);
    return ray.origin + t * ray.direction;
}

double LoneSurface::cosine(const glm::dvec3& p) const {
    return std::abs(glm::dot(normal(), directionToLight(scene.lights[0], p)));
}

bool LoneSurface::behindSpot(const glm::dvec3& p) const {
    const Light& light = scene.lights[0];
    const glm::dvec3 v = p - light.position;
    return light.type == LightType::spot && !(glm::dot(v, light.direction) > 0.01 * glm::length(v));
}

bool seesGroundAlone(const LoneSurface& surface) {
    const Camera& camera = surface.scene.cameras[0];
    const auto depth = [&](const glm::dvec3& p) { return glm::dot(p - camera.position, camera.forward); };
    for (const glm::ivec2& pixel : {glm::ivec2(0, 0), {0, 1}, {1, 0}, {1, 1}}) {
        const double ground = depth(surface.point(pixel.x, pixel.y, 2));
        if (!(ground > 2.0 * camera.near && ground < 0.9 * camera.far)) return false;
    }
    for (std::size_t i = 3; i < surface.scene.positions.size(); ++i)
        if (!(depth(glm::dvec3(surface.scene.positions[i])) < 0.0)) return false;
    return true;
}

Verdict nothingSeen() {
    Verdict verdict;
    verdict.refusal = "nothing is compared: rounded, no camera fits between the ground and what is above it";
    return verdict;
}

double pixelsBeside(const Scene& scene, double snap, int pictureSize, const glm::dvec3& p) {
    const glm::dmat4 m = clipFromWorld(scene.cameras[0], 1.0);
    const double w = (m * glm::dvec4(p, 1.0)).w;
    const glm::dvec3 largest = glm::max(glm::abs(scene.bounds.lower), glm::abs(scene.bounds.upper));
    glm::dvec4 sizes = glm::abs(m[3]);
    for (int i = 0; i < 3; ++i) sizes += glm::abs(m[i]) * largest[i];
    const double rounding = transformOperations * 0x1p-24 * (std::max(sizes.x, sizes.y) + sizes.w) / w;
    return snap + 0.5 * pictureSize * rounding;
}

bool besideSmallCaster(const LoneSurface& surface, const LightFrustum& frustum, int mapSize,
                       const glm::dvec3& p, double texels) {
    const glm::dmat4 textureFromWorld = frustum.textureFromWorld();
    const auto onMap = [&](const glm::dvec3& x) {
        const glm::dvec4 h = textureFromWorld * glm::dvec4(x, 1.0);
        return glm::dvec2(h) / h.w;
    };
    const auto corner = [&](int i) { return onMap(glm::dvec3(surface.scene.positions[std::size_t(3 + i)])); };
    const double size = std::max(glm::length(corner(1) - corner(0)), glm::length(corner(2) - corner(0)));
    return !(glm::length(onMap(p) - corner(0)) > size + texels / mapSize);
}

}  // namespace penumbra::stress
