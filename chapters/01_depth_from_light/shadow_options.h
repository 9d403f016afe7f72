// The parameters that every chapter with a shadow map shares, and what they make.
#pragma once

#include <optional>
#include <string>

#include "chapters/01_depth_from_light/shadow_map.h"
#include "common/app/parameters.h"

namespace penumbra {

inline constexpr Skip clustersUnseen{"clusters-unseen", "triangles_shaded",
                                     "clusters of triangles outside the camera's view are not drawn into "
                                     "the picture: every one of them would be clipped"};

struct ShadowOptions {
    int light = 0;
    int mapSize = 1024;
    std::string depthFormat = "24";
    std::string fit = "scene";

    /// Declares --light, --map-size, --depth-format and --fit, and the skips of map and picture.
    void declare(Parameters& parameters);
    /// The chosen light. Throws UsageError when the scene has fewer.
    const Light& chosenLight(const Scene& scene) const;
    /// `map` as it is if it has the wanted size and format, else a new one in its place.
    ShadowMap& provide(std::optional<ShadowMap>& map, const Capabilities& capabilities) const;
    /// The chosen light as a camera for a map of that format, fitted anew only when something it depends on
    /// changed.
    const LightFrustum& frustum(const Scene& scene, const Camera& camera, const glm::ivec2& pictureSize,
                                DepthFormat format) const;
    const LightFrustum& frustum(const Frame& frame, const ShadowMap& map) const {
        return frustum(frame.scene, frame.camera, frame.size, map.format());
    }

 private:
    /// All that a fit depends on. Scenes are immutable once loaded, so the pointer stands for its surfaces.
    struct Fitted {
        const Scene* scene;
        int light;
        DepthRange range;
        std::optional<Camera> camera;  ///< none: fitted to the scene, whatever the camera sees
        double aspect;
        LightFrustum frustum{};
        bool sameAs(const Fitted& other) const;
    };
    mutable std::optional<Fitted> fitted_;
};

/// Of a chapter with maps that declares parameters of its own: the skips of ShadowMap::render and
/// drawPicture.
void declareMapSkips(Skips& skips);

/// Sets the uniforms of lit.vert and lit.frag that don't belong to a material: camera, light, ambient term.
void setCameraAndLight(Program& program, const Frame& frame, const ShadowOptions& options);

/// Clears depth and picture: the views of radiance to the ambient term seen itself, a uniform sky; others to
/// 0.
void clearPicture(const Frame& frame, const ShadowOptions& options);

/// Draws what the camera of the frame can see (clustersUnseen) with `program`.
/// Counts triangles_shaded, triangles_unseen and draw_calls.
void drawPicture(Program& program, const Frame& frame);
/// The same from `gpu`, whose triangles are those of the frame's scene in the same order.
void drawPicture(Program& program, const Frame& frame, const GpuScene& gpu);

/// Ambient radiance as a share of what key light gives a facing surface: dark enough for shadows to read,
/// bright enough to see into them.
inline constexpr double ambientShare = 0.08;

}  // namespace penumbra
