#include "common/app/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace penumbra {

KeyQueue::KeyQueue(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window, &presses_);
    glfwSetKeyCallback(window, [](GLFWwindow* source, int key, int, int action, int modifiers) {
        if (action == GLFW_RELEASE) return;
        static_cast<std::vector<KeyPress>*>(glfwGetWindowUserPointer(source))
            ->push_back({key, (modifiers & GLFW_MOD_SHIFT) != 0});
    });
}

KeyQueue::~KeyQueue() {
    glfwSetKeyCallback(window_, nullptr);
}

std::vector<KeyPress> KeyQueue::take() {
    return std::exchange(presses_, {});
}

glm::ivec2 framebufferSize(GLFWwindow* window) {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window, &size.x, &size.y);
    return size;
}

float interfaceScale(GLFWwindow* window) {
    glm::vec2 content(1.0f);
    glfwGetWindowContentScale(window, &content.x, &content.y);
    glm::ivec2 units(1);
    glfwGetWindowSize(window, &units.x, &units.y);
    const float pixelsPerUnit = float(framebufferSize(window).x) / float(std::max(units.x, 1));
    return std::max(1.0f, content.x / std::max(pixelsPerUnit, 1.0f));
}

}  // namespace penumbra
