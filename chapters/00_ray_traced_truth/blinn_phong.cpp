#include "chapters/00_ray_traced_truth/blinn_phong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/image/srgb.h"

namespace penumbra {

namespace {

glm::dvec3 texel(const Texture& texture, long x, long y) {
    const auto wrap = [](long i, long n) { return (i % n + n) % n; };
    const std::size_t index = std::size_t(wrap(y, texture.height)) * texture.width + wrap(x, texture.width);
    const std::uint8_t* p = &texture.rgba[4 * index];
    return {decodeSrgb(p[0] / 255.0f), decodeSrgb(p[1] / 255.0f), decodeSrgb(p[2] / 255.0f)};
}

/// Bilinear, repeating, linear light; without mipmaps, so the GPU's distant texels are smoother than these.
glm::dvec3 sampleTexture(const Texture& texture, const glm::dvec2& uv) {
    if (texture.width == 0 || texture.height == 0) return glm::dvec3(1.0);
    const glm::dvec2 p = (uv - glm::floor(uv)) * glm::dvec2(texture.width, texture.height) - 0.5;
    const glm::dvec2 cell = glm::floor(p), t = p - cell;
    const long x = long(cell.x), y = long(cell.y);
    return glm::mix(glm::mix(texel(texture, x, y), texel(texture, x + 1, y), t.x),
                    glm::mix(texel(texture, x, y + 1), texel(texture, x + 1, y + 1), t.x), t.y);
}

}  // namespace

Surface surfaceAt(const Scene& scene, const Hit& hit) {
    const Material& material = scene.materials[std::size_t(scene.parts[hit.part].material)];
    Surface surface;
    surface.normal = hit.shadingNormal;
    surface.diffuse = material.diffuse;
    if (material.diffuseTexture >= 0)
        surface.diffuse *= sampleTexture(scene.textures[std::size_t(material.diffuseTexture)], hit.uv);
    surface.specular = material.specular;
    surface.shininess = material.shininess;
    if (!hit.fromBehind) surface.emission = material.emission;
    return surface;
}

// [begin:blinn-phong]
glm::dvec3 blinnPhong(const Surface& surface, const glm::dvec3& toLight, const glm::dvec3& toEye) {
    const glm::dvec3 halfway = glm::normalize(toLight + toEye);
    const double highlight = (surface.shininess + 8.0) / (8.0 * std::numbers::pi) *
                             std::pow(std::max(glm::dot(surface.normal, halfway), 0.0), surface.shininess);
    const double facing = std::max(glm::dot(surface.normal, toLight), 0.0);
    return (surface.diffuse / std::numbers::pi + surface.specular * highlight) * facing;
}
// [end:blinn-phong]

}  // namespace penumbra
