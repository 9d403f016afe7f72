// What a chapter draws: triangles, materials, lights, cameras. Plain data; no OpenGL, no files.
//
// Everything is stored relative to `Scene::origin`, a point near the first camera that is subtracted in
// double while the node tree is flattened. Only the small differences are rounded to float, so a scene a
// million metres from its file's origin gives the same floats, and the same picture, as one at the origin.
// The floats below ARE the scene: the GPU and the reference ray tracer read the same ones.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/math/aabb.h"

namespace penumbra {

/// 8-bit RGBA texture, sRGB-encoded colour with linear alpha, rows top first (glTF: v = 0 is the top row).
struct Texture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height
};

/// Blinn-Phong material, derived from glTF's metallic-roughness model.
///
/// Which way a surface faces, on the CPU and in GLSL alike: no face is culled from the picture, and every
/// face casts a shadow from both sides. Where the camera sees the back of a face (geometric normal, by
/// winding, away from the eye), shading and geometric normal are both flipped, so it is lit on the side one
/// looks at. Emission comes from the front only.
struct Material {
    std::string name;
    glm::vec3 diffuse{0.8f};    ///< linear diffuse reflectance, 0..1 (times the texture, if any)
    glm::vec3 specular{0.04f};  ///< linear reflectance at normal incidence
    float shininess = 30.0f;    ///< Blinn-Phong exponent, 1 (dull) .. 10000 (mirror-like)
    glm::vec3 emission{0.0f};   ///< radiance emitted from the front side, W / (m^2 sr)
    int diffuseTexture = -1;    ///< index into Scene::textures, -1: none
    bool doubleSided = false;   ///< glTF: draw (and light) both sides
};

/// One glTF primitive instance: a contiguous run of triangles with one material.
struct Part {
    std::string name;
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
    int material = 0;
    Aabb bounds;
    /// Every edge is shared by exactly two triangles of opposite direction. Then the surface nearest to any
    /// outside eye or light faces it, so back faces may be culled from a depth map without changing it.
    bool closed = false;
};

/// A run of neighbouring triangles (at most a few hundred) inside one part: the unit of culling.
struct Cluster {
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
    std::uint32_t part = 0;
    Aabb bounds;
};

enum class LightType { point, spot, directional, area };

/// A light. Positions are relative to Scene::origin.
struct Light {
    std::string name;
    LightType type = LightType::directional;
    glm::dvec3 position{0.0};  ///< point, spot; area: centroid. Unused for directional.
    glm::dvec3 direction{0.0, -1.0,
                         0.0};  ///< unit, the way the light travels (spot axis; area: front normal)
    /// point, spot: radiant intensity, W/sr. directional: irradiance on a plane facing it, W/m^2.
    /// area: radiance, W/(m^2 sr). Linear RGB.
    glm::dvec3 emission{1.0};
    double innerCone = 0.0;  ///< spot: half angle in radians up to which it is at full strength
    double outerCone = 0.7853981633974483;  ///< spot: half angle in radians beyond which it is dark
    /// area: coplanar convex polygons, counter-clockwise seen from the front (the lit side).
    std::vector<std::vector<glm::dvec3>> polygons;
    double area = 0.0;  ///< area: m^2
    int part = -1;      ///< area: its own Part, which never shadows it; -1: none
};

/// A camera. Pose relative to Scene::origin.
struct Camera {
    std::string name;
    glm::dvec3 position{0.0, 1.6, 5.0};
    glm::dvec3 forward{0.0, 0.0, -1.0};  ///< unit
    glm::dvec3 up{0.0, 1.0, 0.0};        ///< unit, perpendicular to forward
    bool orthographic = false;
    double verticalFov = 0.8;  ///< radians, full angle (perspective)
    double height = 2.0;       ///< metres, full height of the view (orthographic)
    double near = 0.05;        ///< metres
    double far = 100.0;        ///< metres

    bool operator==(const Camera&) const = default;
};

struct Scene {
    std::string name;                  ///< e.g. "courtyard", or the file's stem
    std::string source;                ///< path of the file it came from
    glm::dvec3 origin{0.0};            ///< file-space position of (0,0,0) of everything below
    std::vector<glm::vec3> positions;  ///< metres, relative to origin
    std::vector<glm::vec3> normals;    ///< unit shading normals; one per position
    std::vector<glm::vec2> uvs;        ///< texture coordinates; one per position
    /// Baked ambient light, one per position: the bent vector, and the ambient visibility in w; empty unless
    /// the file has it, on all of its meshes (vertex attributes _AMBIENT_BENT and _AMBIENT_VISIBILITY).
    std::vector<glm::vec4> ambient;
    std::vector<std::uint32_t> indices;  ///< 3 per triangle, counter-clockwise seen from the front
    std::vector<Part> parts;             ///< cover all triangles, in order
    std::vector<Cluster> clusters;       ///< cover all triangles, in order
    std::vector<Material> materials;     ///< at least one
    std::vector<Texture> textures;
    std::vector<Light> lights;       ///< at least one
    std::vector<Camera> cameras;     ///< at least one
    Aabb bounds;                     ///< of all positions
    std::vector<std::string> notes;  ///< what the loader decided for the file: "no light: a sun was added"

    std::size_t triangleCount() const { return indices.size() / 3; }
};

}  // namespace penumbra
