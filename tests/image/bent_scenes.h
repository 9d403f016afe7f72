// Scenes whose bent vectors are known at every point that the camera sees.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "common/truth/ambient_forms.h"
#include "tests/image/small_scenes.h"

namespace penumbra {

/// Seen from straight above, without perspective.
struct FormScene {
    struct Expected {
        AmbientForm form;
        glm::dmat3 worldFromForm;
    };
    Scene scene;
    std::function<Expected(double x, double z)> at;
};

/// The frame of a form: its x along `tangent`, its z along `normal`.
inline glm::dmat3 formFrame(const glm::dvec3& tangent, const glm::dvec3& normal) {
    return {tangent, glm::cross(normal, tangent), normal};
}

/// A floor and a wall at x = 0, both endless as seen from half a metre away.
inline FormScene cornerScene() {
    const double far = 2000.0;
    Scene scene = SmallScene()
                      .quad({0, 0, far}, {far, 0, 0}, {0, 0, -2.0 * far})
                      .quad({0, 0, far}, {0, 0, -2.0 * far}, {0, far, 0})
                      .light(LightType::directional, {0, 0, 0}, {-1, -1, 0})
                      .flatCamera({0.5, 1, 0}, {0.5, 0, 0}, 0.5)
                      .take();
    const AmbientForm form = ambientInProfile(0.0, 0.5 * std::numbers::pi);
    return {std::move(scene), [form](double, double) {
                return FormScene::Expected{form, formFrame({1, 0, 0}, {0, 1, 0})};
            }};
}

/// An endless trench whose section is half a circle of radius 1.
inline FormScene trenchScene() {
    constexpr int facets = 256;
    const double far = 400.0;
    SmallScene made;
    const auto onArc = [&](int i) {
        const double angle = std::numbers::pi * (double(i) / facets - 0.5);
        return glm::dvec3(std::sin(angle), -std::cos(angle), far);
    };
    for (int i = 0; i < facets; ++i) made.quad(onArc(i), onArc(i + 1) - onArc(i), {0, 0, -2.0 * far});
    made.quad({1, 0, far}, {far, 0, 0}, {0, 0, -2.0 * far});
    made.quad({-1.0 - far, 0, far}, {far, 0, 0}, {0, 0, -2.0 * far});
    Scene scene = made.light(LightType::directional, {0, 0, 0}, {0, -1, 0})
                      .flatCamera({0, 1, 0}, {0, 0, 0}, 1.8)
                      .take();
    return {std::move(scene), [](double x, double) {
                const double t = std::asin(x);
                const glm::dvec3 normal(-std::sin(t), std::cos(t), 0.0),
                    tangent(std::cos(t), std::sin(t), 0.0);
                return FormScene::Expected{ambientInTrench(0.5 * std::numbers::pi, t),
                                           formFrame(tangent, normal)};
            }};
}

/// Corners of a ball of `radius` with its middle at `centre`: `rows` x 2 `rows` flat facets.
inline void addBall(SmallScene& scene, const glm::dvec3& centre, double radius, int rows) {
    const auto point = [&](int i, int j) {
        const double theta = std::numbers::pi * i / rows, phi = std::numbers::pi * j / rows;
        return centre + radius * glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                            -std::sin(theta) * std::sin(phi));
    };
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < 2 * rows; ++j) {
            if (i > 0) triangles.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
            if (i + 1 < rows) triangles.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
        }
    scene.part(triangles, true);
}

/// A ball that floats over an endless floor; the camera is below it.
inline FormScene sphereScene() {
    const glm::dvec3 centre(0.2, 1.5, 0.1);
    SmallScene made;
    made.quad({-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000});
    addBall(made, centre, 1.0, 64);
    Scene scene = made.light(LightType::directional, {0, 0, 0}, {0, -1, 0})
                      .flatCamera({0, 0.3, 0}, {0, 0, 0}, 2.4)
                      .take();
    return {std::move(scene), [centre](double x, double z) {
                const glm::dmat3 frame = formFrame({1, 0, 0}, {0, 1, 0});
                const glm::dvec3 to = glm::transpose(frame) * (centre - glm::dvec3(x, 0.0, z));
                return FormScene::Expected{ambientUnderSphere(to, 1.0), frame};
            }};
}

/// A ball alone.
inline Scene ballScene() {
    SmallScene made;
    addBall(made, {0, 0, 0}, 1.0, 12);
    return made.light(LightType::directional, {0, 0, 0}, {0.3, -1, -0.2})
        .camera({1.5, 1.1, 3.2}, {0, 0, 0})
        .take();
}

}  // namespace penumbra
