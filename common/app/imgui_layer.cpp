#include "common/app/imgui_layer.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>

#include "common/app/window_input.h"
#include "common/gl/gl_object.h"

namespace penumbra {

ImGuiLayer::ImGuiLayer(const Context& context) : es_(context.capabilities().api == Api::es) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // leaves no file where the program happens to be started
    const float scale = interfaceScale(context.window());
    ImFontConfig font;
    font.SizePixels = std::round(13.0f * scale);
    io.Fonts->AddFontDefault(&font);
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImGui_ImplGlfw_InitForOpenGL(context.window(), true);
    io.KeyMap[ImGuiKey_Tab] = -1;  // Tab chooses a parameter; Dear ImGui would start to type into one
    ImGui_ImplOpenGL3_Init(es_ ? "#version 300 es" : "#version 330 core");
}

ImGuiLayer::~ImGuiLayer() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ImGuiLayer::begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void ImGuiLayer::draw() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (es_) discardGlErrors();  // it asks for the polygon mode, which ES does not have
}

}  // namespace penumbra
