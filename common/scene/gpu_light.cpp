#include "common/scene/gpu_light.h"

#include <cmath>

namespace penumbra {

void setLight(Program& program, const Light& light) {
    const bool area = light.type == LightType::area;
    program.set("uLightType", int(light.type));
    program.set("uLightPosition", glm::vec3(light.position));
    program.set("uLightDirection", glm::vec3(light.direction));
    program.set("uLightEmission", glm::vec3(light.emission * (area ? light.area : 1.0)));
    program.set("uLightCosines", glm::vec2(std::cos(light.innerCone), std::cos(light.outerCone)));
}

}  // namespace penumbra
