#include "tests/stress/gl_stage.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tests/stress/chapters.h"

namespace penumbra::stress {
namespace {

struct Stage {
    std::unique_ptr<Scene> scene;
    std::unique_ptr<ChapterHarness> harness;
};

/// Chapters that keep something of the scene they were loaded with.
bool keepsScene(const std::string& number) {
    return number == "00" || number == "07" || number == "08" || number == "09" || number == "11";
}

}  // namespace

ChapterHarness& shown(const std::string& number, const std::string& programs, Scene scene) {
    // Never destroyed, like the context: at exit the driver is gone first.
    static auto& stages = *new std::map<std::string, Stage>;
    Stage& stage = stages[number + " " + programs];
    // The scene before stays until the new one is there: chapters know scenes by their addresses.
    Stage next{std::make_unique<Scene>(std::move(scene)), nullptr};
    if (!stage.harness) {
        next.harness = std::make_unique<ChapterHarness>(makeChapter(number), *next.scene);
    } else {
        next.harness = std::make_unique<ChapterHarness>(*stage.harness, *next.scene);
        if (keepsScene(number)) next.harness->load();
    }
    std::swap(stage.harness, next.harness);
    std::swap(stage.scene, next.scene);
    next.harness.reset();  // before its scene
    return *stage.harness;
}

std::string notFinite(const FloatImage& picture) {
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        if (std::isfinite(picture.values[i])) continue;
        const std::size_t pixel = i / std::size_t(picture.channels);
        return fmt::format("{} in pixel ({}, {})", picture.values[i], pixel % std::size_t(picture.width),
                           pixel / std::size_t(picture.width));
    }
    return {};
}

}  // namespace penumbra::stress
