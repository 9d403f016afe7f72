// Every skip of every chapter: switched off alone, the picture stays the same to the bit and more is done.
// The chapters' own classes are tested, so their main.cpp are part of this file.
#define main main00
#include "chapters/00_ray_traced_truth/main.cpp"
#undef main
#define main main01
#include "chapters/01_depth_from_light/main.cpp"
#undef main
#define main main02
#include "chapters/02_shadow_test/main.cpp"
#undef main
#define main main03
#include "chapters/03_polygon_offset/main.cpp"
#undef main
#define main main04
#include "chapters/04_pcf/main.cpp"
#undef main
#define main main05
#include "chapters/05_jittered_disk/main.cpp"
#undef main
#define main main06
#include "chapters/06_jitter_texture/main.cpp"
#undef main
#define main main07
#include "chapters/07_branching/main.cpp"
#undef main
#define main main08
#include "chapters/08_accumulation/main.cpp"
#undef main
#define main main09
#include "chapters/09_ambient_occlusion/main.cpp"
#undef main
#define main main10
#include "chapters/10_accumulated_occlusion/main.cpp"
#undef main
#define main main11
#include "chapters/11_bent_normals/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/image/chapter_harness.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(64, 64);

/// A scene and parameters in which a chapter's skips have something to leave out.
struct Situation {
    const char* scene;
    Settings settings;
    std::vector<const char*> views;
};

template <class C>
std::unique_ptr<Chapter> make() {
    return std::make_unique<C>();
}

struct Tested {
    const char* name;
    std::unique_ptr<Chapter> (*chapter)();
    std::vector<Situation> situations;
};

const Settings map{{"map-size", "256"}, {"fit", "view"}};
const std::vector<const char*> shown{"color"};

Settings with(Settings settings, const Settings& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

const std::vector<Tested>& chapters() {
    const Settings coarse{{"samples", "16"}, {"texels-per-metre", "20"}, {"others", "unshadowed"}};
    static const std::vector<Tested> all{
        {"00_ray_traced_truth",
         make<RayTracedTruth>,
         {{"contact", {{"samples", "16"}}, {"color", "irradiance"}},
          {"courtyard", {{"samples", "32"}, {"light", "2"}}, {"visibility"}}}},
        {"01_depth_from_light", make<DepthFromLight>, {{"courtyard", map, {"color", "depth"}}}},
        {"02_shadow_test", make<ShadowTest>, {{"courtyard", map, shown}}},
        {"03_polygon_offset", make<PolygonOffset>, {{"courtyard", map, shown}}},
        {"04_pcf", make<Pcf>, {{"courtyard", map, shown}}},
        {"05_jittered_disk", make<JitteredDisk>, {{"courtyard", map, shown}}},
        {"06_jitter_texture", make<JitterTextureChapter>, {{"courtyard", map, shown}}},
        {"07_branching", make<Branching>, {{"courtyard", map, shown}}},
        {"08_accumulation",
         make<Accumulation>,
         {{"heckbert_herf", coarse, {"irradiance", "visibility"}},
          {"contact", coarse, {"irradiance"}},
          {"heckbert_herf", with(coarse, {{"method", "accumulate"}}), {"irradiance"}},
          {"heckbert_herf", with(coarse, {{"method", "exact"}}), {"irradiance"}},
          {"spheres", {{"method", "shadow-maps"}, {"samples", "1"}, {"map-size", "64"}}, shown}}},
        {"09_ambient_occlusion",
         make<AmbientOcclusion>,
         {{"gully", {{"samples", "16"}, {"method", "rays"}}, {"ambient", "irradiance"}},
          {"gully", {{"samples", "16"}, {"method", "vertices"}}, {"bent-normal"}},
          {"gully", {{"samples", "16"}, {"method", "triangles"}}, {"ambient"}},
          {"gully", {{"samples", "64"}, {"method", "bits"}}, {"irradiance"}}}},
        {"10_accumulated_occlusion",
         make<AccumulatedOcclusionChapter>,
         {{"gully", {{"samples", "64"}, {"map-size", "64"}}, {"ambient", "irradiance"}},
          {"gully", {{"samples", "64"}, {"map-size", "64"}, {"method", "vertices"}}, {"bent-normal"}}}},
        {"11_bent_normals",
         make<BentNormals>,
         {{"gully", {{"samples", "16"}, {"source", "rays"}}, {"irradiance", "diffuse"}},
          {"knot", {{"samples", "16"}, {"source", "vertices"}, {"combine", "none"}}, {"color"}},
          {"gully", {{"samples", "16"}, {"source", "vertices"}}, {"irradiance"}},
          {"gully", {{"samples", "32"}, {"source", "maps"}, {"map-size", "64"}}, {"irradiance"}}}}};
    return all;
}

struct Drawn {
    std::vector<FloatImage> pictures;
    WorkCounters work;
};

/// Of a view, and their work together: a frame that draws its maps again, and one after it in which nothing
/// has changed.
Drawn twoFrames(ChapterHarness& harness, const char* view) {
    Drawn drawn;
    for (const bool again : {true, false}) {
        harness.renderMapsAgain = again;
        drawn.pictures.push_back(harness.picture(view, size, 3));
        for (const auto& [counter, value] : harness.work) drawn.work[counter] += value;
    }
    return drawn;
}

/// Switches the skips of one chapter off, one after the other; adds the names of all to `declared` and of
/// those that made a difference to their counter to `effective`.
void expectExact(const Tested& tested, const Situation& situation, std::set<std::string>& declared,
                 std::set<std::string>& effective) {
    ChapterHarness harness(tested.chapter(), testScene(situation.scene));
    harness.set(situation.settings);
    const Skips all = harness.skips();
    for (const char* view : situation.views) {
        const Drawn usual = twoFrames(harness, view);
        EXPECT_EQ(differing(usual.pictures[0], usual.pictures[1]), 0u);
        for (const Skip& skip : all.all()) {
            SCOPED_TRACE(std::string(tested.name) + " --scene " + situation.scene + " --view " + view +
                         " --no-skip " + skip.name);
            declared.insert(skip.name);
            harness.skips().switchOff(skip.name);
            Drawn other = twoFrames(harness, view);
            harness.skips() = all;
            for (const FloatImage& picture : other.pictures)
                EXPECT_EQ(differing(usual.pictures[0], picture), 0u);
            const auto before = usual.work.find(skip.counter);
            const std::int64_t change =
                other.work[skip.counter] - (before == usual.work.end() ? 0 : before->second);
            EXPECT_GE(change, 0);
            if (change > 0 || !*skip.counter) effective.insert(skip.name);
        }
    }
}

TEST(SkipsSlow, EachSwitchedOffAloneTheSamePictureIsMoreWork) {
    std::set<std::string> declared, effective;
    for (const Tested& tested : chapters())
        for (const Situation& situation : tested.situations)
            expectExact(tested, situation, declared, effective);
    EXPECT_EQ(declared, effective)
        << "a skip that leaves nothing out in any of these situations is not tested";
}

TEST(Skips, EveryChapterIsTestedHere) {
    std::set<std::string> tested, present;
    for (const Tested& one : chapters()) tested.insert(one.name);
    for (const auto& entry : std::filesystem::directory_iterator(PENUMBRA_SOURCE_DIR "/chapters"))
        if (std::filesystem::exists(entry.path() / "main.cpp"))
            present.insert(entry.path().filename().string());
    EXPECT_EQ(tested, present);
}

}  // namespace
}  // namespace penumbra
