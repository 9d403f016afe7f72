// Dear ImGui on a window, as a value.
#pragma once

#include "common/gl/context.h"

namespace penumbra {

class ImGuiLayer {
 public:
    explicit ImGuiLayer(const Context& context);
    ImGuiLayer(const ImGuiLayer&) = delete;
    ImGuiLayer& operator=(const ImGuiLayer&) = delete;
    ~ImGuiLayer();

    /// Between these two the interface is described.
    void begin();
    /// Draws it into the framebuffer that is bound.
    void draw();

 private:
    bool es_;
};

}  // namespace penumbra
