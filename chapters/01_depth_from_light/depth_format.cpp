#include "chapters/01_depth_from_light/depth_format.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace penumbra {

const std::vector<std::string>& depthFormatNames() {
    static const std::vector<std::string> names{"16", "24", "32f", "32f-reversed"};
    return names;
}

DepthFormat depthFormat(const std::string& name, const Capabilities& capabilities) {
    const auto& names = depthFormatNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw UsageError("--depth-format " + name + ": choose 16, 24, 32f or 32f-reversed");
    const auto format = DepthFormat(found - names.begin());
    if (format == DepthFormat::float32Reversed && !capabilities.clipControl)
        throw UsageError(
            "--depth-format 32f-reversed: this OpenGL has no glClipControl (OpenGL 4.5 has); use 32f");
    return format;
}

DepthRange depthRange(DepthFormat format) {
    return format == DepthFormat::float32Reversed ? DepthRange::reversed : DepthRange::standard;
}

GLenum internalFormat(DepthFormat format) {
    switch (format) {
        case DepthFormat::fixed16:
            return GL_DEPTH_COMPONENT16;
        case DepthFormat::fixed24:
            return GL_DEPTH_COMPONENT24;
        default:
            return GL_DEPTH_COMPONENT32F;
    }
}

GLenum transferType(DepthFormat format) {
    switch (format) {
        case DepthFormat::fixed16:
            return GL_UNSIGNED_SHORT;
        case DepthFormat::fixed24:
            return GL_UNSIGNED_INT;
        default:
            return GL_FLOAT;
    }
}

double depthQuantum(DepthFormat format, double z) {
    switch (format) {
        case DepthFormat::fixed16:
            return 1.0 / 65535.0;
        case DepthFormat::fixed24:
            return 1.0 / 16777215.0;
        default:
            return std::ldexp(1.0, std::ilogb(std::max(z, 1e-30)) - 23);
    }
}

}  // namespace penumbra
