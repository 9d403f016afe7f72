#include "common/app/window_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "common/app/parameter_step.h"

namespace penumbra {
namespace {

const ImVec4 chosenColour{1.0f, 0.85f, 0.4f, 1.0f};
const ImVec4 errorColour{1.0f, 0.5f, 0.45f, 1.0f};

struct HelpLine {
    const char* keys;
    const char* meaning;
};
const HelpLine helpLines[] = {
    {"drag, arrow keys", "turn the camera about the scene"},
    {"wheel, + and -", "move nearer or away"},
    {"right-button drag", "shift the picture"},
    {"Home", "the scene's own camera again"},
    {"Tab, Shift+Tab", "choose a parameter"},
    {", and .", "change it"},
    {"V, Shift+V", "next view, view before"},
    {"F2 or P", "save the picture as headless mode would"},
    {"H", "hide or show the panel"},
    {"F1", "hide or show this help"},
    {"Esc", "quit"},
};

void tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool combo(const char* id, std::string& value, const std::vector<std::string>& choices) {
    bool changed = false;
    if (!ImGui::BeginCombo(id, value.c_str())) return false;
    for (const std::string& choice : choices)
        if (ImGui::Selectable(choice.c_str(), choice == value) && choice != value) {
            value = choice;
            changed = true;
        }
    ImGui::EndCombo();
    return changed;
}

bool parameterWidget(const Parameter& parameter) {
    const std::string id = "##" + parameter.name;
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (isLogarithmic(parameter) ? ImGuiSliderFlags_Logarithmic : 0);
    if (auto* const* value = std::get_if<int*>(&parameter.value))
        return ImGui::SliderInt(id.c_str(), *value, int(parameter.low), int(parameter.high), "%d", flags);
    if (auto* const* real = std::get_if<float*>(&parameter.value))
        return ImGui::SliderFloat(id.c_str(), *real, float(parameter.low), float(parameter.high), "%.4g",
                                  flags);
    if (auto* const* flag = std::get_if<bool*>(&parameter.value)) return ImGui::Checkbox(id.c_str(), *flag);
    return combo(id.c_str(), *std::get<std::string*>(parameter.value), parameter.choices);
}

bool parameterRows(WindowState& state) {
    bool changed = false;
    for (std::size_t i = 0; i < state.parameters.size(); ++i) {
        const Parameter& parameter = state.parameters[i];
        const std::string label =
            parameter.unit.empty() ? parameter.name : fmt::format("{} ({})", parameter.name, parameter.unit);
        const bool chosen = i == state.chosen;
        if (chosen) ImGui::PushStyleColor(ImGuiCol_Text, chosenColour);
        ImGui::Text("%s %s", chosen ? ">" : " ", label.c_str());
        if (chosen) ImGui::PopStyleColor();
        tooltip(parameter.help);
        ImGui::SetNextItemWidth(-1.0f);
        if (parameterWidget(parameter)) {
            changed = true;
            state.chosen = i;
        }
        tooltip(parameter.help);
    }
    if (!state.parameters.empty() && ImGui::Button("Defaults")) {
        for (const Parameter& parameter : state.parameters) resetParameter(parameter);
        changed = true;
    }
    return changed;
}

bool viewRow(const ChapterSession& session, WindowState& state) {
    std::vector<std::string> names;
    for (const ViewInfo& view : session.info().views) names.push_back(view.name);
    ImGui::TextUnformatted("view");
    ImGui::SetNextItemWidth(-1.0f);
    const bool changed = combo("##view", state.view, names);
    tooltip(session.view(state.view).help);
    return changed;
}

void timesAndCounters(WindowState& state) {
    std::vector<double> sorted(state.frameMs.begin(), state.frameMs.end());
    std::sort(sorted.begin(), sorted.end());
    if (!sorted.empty())
        ImGui::Text("frame %.2f ms, median %.2f ms", state.frameMs.back(), sorted[sorted.size() / 2]);
    ImGui::Checkbox("redraw always", &state.redrawAlways);
    tooltip("Otherwise a frame is drawn only when something has changed.");
    for (const auto& [name, count] : state.work)
        ImGui::Text("%s %lld", name.c_str(), static_cast<long long>(count));
}

void helpWindow(WindowState& state) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    if (ImGui::Begin("Help", &state.showHelp,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoSavedSettings)) {
        const float column = ImGui::CalcTextSize("right-button drag  ").x;
        for (const HelpLine& line : helpLines) {
            ImGui::TextUnformatted(line.keys);
            ImGui::SameLine(column);
            ImGui::TextUnformatted(line.meaning);
        }
    }
    ImGui::End();
}

void errorWindow(const std::string& error) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, display.y}, ImGuiCond_Always, {0.5f, 1.0f});
    ImGui::SetNextWindowSize({display.x, 0.0f});
    ImGui::Begin("Error", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PushStyleColor(ImGuiCol_Text, errorColour);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(error.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::End();
}

}  // namespace

bool drawPanel(const ChapterSession& session, WindowState& state) {
    bool changed = false;
    if (state.showPanel) {
        const float unit = ImGui::GetFontSize();
        ImGui::SetNextWindowPos({0.7f * unit, 0.7f * unit}, ImGuiCond_FirstUseEver);
        ImGui::SetNextWindowSize({21.0f * unit, 0.0f}, ImGuiCond_FirstUseEver);
        ImGui::Begin(session.info().name.c_str(), nullptr, ImGuiWindowFlags_NoSavedSettings);
        ImGui::TextWrapped("%s", session.info().idea.c_str());
        ImGui::TextDisabled("%s; F1: help", session.scene().name.c_str());
        ImGui::Separator();
        changed |= viewRow(session, state);
        ImGui::Separator();
        changed |= parameterRows(state);
        ImGui::Separator();
        timesAndCounters(state);
        if (!state.note.empty()) ImGui::TextWrapped("%s", state.note.c_str());
        ImGui::End();
    }
    if (state.showHelp) helpWindow(state);
    if (!state.error.empty()) errorWindow(state.error);
    return changed;
}

}  // namespace penumbra
