// The bias of a filter: what chapters 04 to 07 offer on the command line, and the uniforms of receiver.glsl.
#pragma once

#include "chapters/03_polygon_offset/depth_bias.h"
#include "common/app/parameters.h"
#include "common/gl/program.h"

namespace penumbra {

struct ReceiverBias {
    bool receiverPlane = false;
    float bias = 1.0f;

    /// Declares --receiver-plane and --bias.
    void declare(Parameters& parameters);
    /// Sets all uniforms of receiver.glsl but those of setShadowMap.
    void set(Program& program, const ShadowMap& map, const LightFrustum& frustum, const Scene& scene) const;
};

}  // namespace penumbra
