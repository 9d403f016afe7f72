// One triangle under one light: every point of it is lit, whatever a bias has to make up for.
#pragma once

#include "chapters/01_depth_from_light/light_frustum.h"
#include "tests/stress/placement.h"

namespace penumbra::stress {

struct LoneSurface {
    Scene scene;
    bool fitToView = false;  ///< --fit view

    /// The light's frustum as the chapters fit it.
    LightFrustum frustum(const std::string& depthFormat) const;
    /// The point of the surface in the middle of pixel (x, y) of a square picture.
    glm::dvec3 point(int x, int y, int pictureSize) const;
    glm::dvec3 normal() const;
    /// Cosine of the angle between light and normal at `p`.
    double cosine(const glm::dvec3& p) const;
    /// A spot shines on nothing behind itself, and within half a degree of its plane rounding decides.
    bool behindSpot(const glm::dvec3& p) const;
};

/// A triangle of 8 metres and, to push the near plane to where near-far wants it, a small one close to a spot
/// or point light, or far out towards a sun. Axes: light-type, light-angle, scale, distance, aside, fov,
/// near-far, variant.
LoneSurface loneSurface(const Case& given);

/// The same ground and small triangle, seen from straight above by a flat camera that lies so low that
/// nothing else comes before it; triangles of any shape stand higher, where they shadow what is in the
/// picture. The ground is triangle 0. Axes: those of loneSurface, and shape.
LoneSurface shadowedSurface(const Case& given);
/// Does that camera see the ground and nothing else? Rounded to a grid that is coarser than the camera is
/// high, by doubles far from the origin of the file or by floats far aside, it may not.
bool seesGroundAlone(const LoneSurface& surface);
/// What is said of it then.
Verdict nothingSeen();

/// Pixels by which the vertex transform and a rasteriser that snaps by `snap` pixels may have what a square
/// picture shows at `p` beside its place.
double pixelsBeside(const Scene& scene, double snap, int pictureSize, const glm::dvec3& p);

/// Does the shadow of the small triangle come within `texels` of `p` on a map of that size?
bool besideSmallCaster(const LoneSurface& surface, const LightFrustum& frustum, int mapSize,
                       const glm::dvec3& p, double texels);

}  // namespace penumbra::stress
