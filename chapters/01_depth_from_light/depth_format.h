// The formats a depth map can have, and what each does to a depth.
#pragma once

#include <string>
#include <vector>

#include "common/gl/context.h"
#include "common/gl/gl.h"
#include "common/math/transforms.h"

namespace penumbra {

/// fixed16, fixed24: window depth in steps of 1/(2^bits - 1). float32: 24 significant bits, which standard
/// depth wastes near 1, where perspective puts nearly everything. float32Reversed: near = 1, far = 0, so that
/// float's fine steps near 0 meet the coarse end of perspective (needs glClipControl).
enum class DepthFormat { fixed16, fixed24, float32, float32Reversed };

/// "16", "24", "32f", "32f-reversed": the choices of --depth-format, in order.
const std::vector<std::string>& depthFormatNames();
/// From one of those names. Throws UsageError for another name, and for 32f-reversed where the context has no
/// glClipControl (OpenGL ES 3.0, OpenGL before 4.5 without the extension).
DepthFormat depthFormat(const std::string& name, const Capabilities& capabilities);

DepthRange depthRange(DepthFormat format);
/// GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F, with the transfer type that ES 3.0
/// pairs with each.
GLenum internalFormat(DepthFormat format);
GLenum transferType(DepthFormat format);
/// Distance between neighbouring storable depths about window depth `z`: what is stored differs by less from
/// what was computed, whichever way the implementation rounds.
double depthQuantum(DepthFormat format, double z);

}  // namespace penumbra
