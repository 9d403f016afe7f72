#include "chapters/04_pcf/receiver_bias.h"

namespace penumbra {

void ReceiverBias::declare(Parameters& parameters) {
    parameters.add(
        "receiver-plane", receiverPlane,
        "compare each tap with the receiver's plane at its texel; false: a bias that grows with the "
        "kernel, and shadows that detach");
    parameters.add("bias", bias, 0.0f, 32.0f, "",
                   "multiple of the derived bound; 0: stripes of acne, 8: shadows detach");
}

void ReceiverBias::set(Program& program, const ShadowMap& map, const LightFrustum& frustum,
                       const Scene& scene) const {
    setDepthErrors(program, bothPassesErrors(map, frustum, scene.bounds), frustum);
    program.set("uFollowPlane", receiverPlane ? 1.0f : 0.0f);
    program.set("uBias", bias);
}

}  // namespace penumbra
