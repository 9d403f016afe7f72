// Key presses, and how many pixels the window has.
#pragma once

#include <glm/glm.hpp>
#include <vector>

struct GLFWwindow;

namespace penumbra {

struct KeyPress {
    int key = 0;  ///< GLFW_KEY_...
    bool shift = false;
};

/// Collects key presses (and repeats) of a window. Nothing is lost between two slow frames, as it would be by
/// polling. Made before Dear ImGui, which passes key events on.
class KeyQueue {
 public:
    explicit KeyQueue(GLFWwindow* window);
    KeyQueue(const KeyQueue&) = delete;
    KeyQueue& operator=(const KeyQueue&) = delete;
    ~KeyQueue();
    /// All since the last call.
    std::vector<KeyPress> take();

 private:
    GLFWwindow* window_;
    std::vector<KeyPress> presses_;
};

/// Pixels, not screen units: on a HiDPI screen these differ. Zero while minimised.
glm::ivec2 framebufferSize(GLFWwindow* window);

/// What one point of user interface measures in screen units: 1 normally; 2 where the window system counts
/// pixels of a dense screen (X11, Windows), 1 where it counts points (macOS, Wayland).
float interfaceScale(GLFWwindow* window);

}  // namespace penumbra
