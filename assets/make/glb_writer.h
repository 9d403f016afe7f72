// Collects one scene and writes it as binary glTF 2.0 (.glb). Uses the core format and two ratified
// extensions: KHR_lights_punctual and KHR_materials_emissive_strength.
#pragma once

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/make/mesh.h"

namespace penumbra::assets {

/// Translation, rotation, scale of a node relative to its parent.
struct Pose {
    Vec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    Vec3 scale{1.0};
};
Pose at(const Vec3& position);
/// At `position`, turned by `degrees` around `axis`, scaled evenly.
Pose turned(const Vec3& position, double degrees, const Vec3& axis = {0, 1, 0}, double scale = 1.0);
/// At `position`, -Z (where glTF's cameras and lights look) towards `target`.
Pose looking(const Vec3& position, const Vec3& target);

struct MaterialDescription {
    std::string name;
    Vec3 colour{0.8};  ///< linear diffuse reflectance
    double roughness = 0.9;
    bool doubleSided = false;
    Vec3 radiance{0.0};  ///< emitted from the front, W / (m^2 sr); a planar mesh of it is an area light
};

enum class Surface { closed, open };

/// One part of a mesh. `creaseDegrees` 0: flat shading, no normals in the file.
struct PartDescription {
    Mesh mesh;
    int material = 0;
    double creaseDegrees = 0.0;
    Surface surface = Surface::closed;
};

class GlbWriter {
 public:
    explicit GlbWriter(const std::string& about);
    GlbWriter(GlbWriter&& other) noexcept;
    ~GlbWriter();

    int material(const MaterialDescription& description);
    /// Welds each part; throws if a part that should be closed has a hole or is inside out.
    int mesh(const std::string& name, const std::vector<PartDescription>& parts);

    /// Nodes return their index, for use as a parent; -1 is the scene itself. A scene's lights are numbered
    /// in the order in which their nodes are made, emissive meshes included.
    int group(const std::string& name, const Pose& pose, int parent = -1);
    int place(const std::string& name, int mesh, const Pose& pose = {}, int parent = -1);
    /// The same with a matrix, which may shear.
    int placeByMatrix(const std::string& name, int mesh, const Mat4& parentFromMesh, int parent = -1);
    /// A mesh of its own for one part that is used once.
    int add(const std::string& name, const PartDescription& part, const Pose& pose = {}, int parent = -1);

    /// Irradiance on a plane facing the sun, W/m^2.
    void sun(const std::string& name, const Vec3& direction, const Vec3& irradiance);
    /// Radiant intensity, W/sr.
    void point(const std::string& name, const Vec3& position, const Vec3& intensity);
    void spot(const std::string& name, const Pose& pose, const Vec3& intensity, double innerDegrees,
              double outerDegrees);

    /// `verticalFovDegrees`: full angle.
    void camera(const std::string& name, const Pose& pose, double verticalFovDegrees, double nearDistance,
                double farDistance);
    /// `height` metres are seen from top to bottom of a square picture.
    void orthographicCamera(const std::string& name, const Pose& pose, double height, double nearDistance,
                            double farDistance);

    /// Facts about the scene for those who compute with it: glTF "extras" of the scene, from JSON text.
    void extras(const std::string& json);
    void write(const std::filesystem::path& file) const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra::assets
