#include "common/scene/gltf_placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace penumbra::gltf {

glm::dvec3 chooseOrigin(const glm::dvec3& view, double radius) {
    // The factor 1.37 and the shift 0.382 keep round numbers (a radius of 2, a camera at 4) away from where
    // the rounding flips, since such a number may be off by a rounding error in the moved scene.
    const double exponent = std::floor(std::log2(4.0 * 1.37 * std::max(radius, 1e-6)));
    const double step = std::exp2(std::min(exponent, 6.0));
    return glm::floor(view / step + 0.382) * step;
}

glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p) {
    return glm::dvec3(m * glm::dvec4(p, 1.0));
}

PartMesh placeMesh(LocalMesh&& local, const glm::dmat4& sceneFromMesh, const glm::dmat3& uvFromFile) {
    PartMesh mesh;
    mesh.indices = std::move(local.indices);
    mesh.positions = std::move(local.positions);
    for (glm::vec3& p : mesh.positions) p = glm::vec3(transformPoint(sceneFromMesh, p));
    const glm::dmat3 linear(sceneFromMesh);
    const bool mirrored = glm::determinant(linear) < 0.0;
    // The cofactor matrix takes normals along without an inverse; a mirror turns it inside out.
    glm::dmat3 normalMatrix(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
    if (mirrored) normalMatrix *= -1.0;
    // Kept in range of float whatever the scale of the node.
    const double size =
        std::max({glm::length(normalMatrix[0]), glm::length(normalMatrix[1]), glm::length(normalMatrix[2])});
    if (size > 0.0) normalMatrix /= size;
    mesh.normals = std::move(local.normals);
    for (glm::vec3& n : mesh.normals) n = glm::vec3(normalMatrix * glm::dvec3(n));
    mesh.ambient = std::move(local.ambient);
    // A bent vector is a mean of directions: it turns with the mesh, and does not grow with it.
    const double scale = std::cbrt(std::abs(glm::determinant(linear)));
    for (glm::vec4& a : mesh.ambient)
        a = glm::vec4(linear * glm::dvec3(a) / std::max(scale, 1e-300), double(a.w));
    mesh.uvs = std::move(local.uvs);
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(uvFromFile * glm::dvec3(uv, 1.0));
    for (std::size_t t = 0; mirrored && t < mesh.indices.size(); t += 3)
        std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
    return mesh;
}

}  // namespace penumbra::gltf
