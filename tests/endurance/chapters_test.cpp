// Thousands of frames of all chapters in one process, with everything that a long afternoon in a window does
// to them: other sizes, scenes, views, parameters and places of the camera, and shaders that change on disk,
// some of them broken. Nothing may be left behind, in memory or in the driver.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <random>
#include <span>

#include "common/app/orbit_camera.h"
#include "common/app/parameter_step.h"
#include "common/error.h"
#include "tests/endurance/chapter_programs.h"
#include "tests/endurance/live_objects.h"
#include "tests/image/chapter_harness.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

int numberFrom(const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atoi(text) : otherwise;
}

/// A copy of all shaders, to be changed at will, which programs use while this lives.
class OwnShaders {
 public:
    OwnShaders() {
        fs::copy(PENUMBRA_SOURCE_DIR "/shaders", folder_.path(),
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        ::setenv("PENUMBRA_SHADERS", folder_.path().c_str(), 1);
    }
    ~OwnShaders() { ::unsetenv("PENUMBRA_SHADERS"); }
    OwnShaders(const OwnShaders&) = delete;
    OwnShaders& operator=(const OwnShaders&) = delete;
    void write(const fs::path& file, const std::string& text) {
        std::ofstream(file) << text;
        fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(++writes_));
    }

 private:
    TemporaryFolder folder_;
    int writes_ = 0;
};

/// A chapter that shows what the harness hides: its parameters.
class Watched : public Chapter {
 public:
    explicit Watched(std::unique_ptr<Chapter> chapter) : chapter_(std::move(chapter)) {}
    void declare(Parameters& declared) override {
        chapter_->declare(declared);
        parameters = &declared;
    }
    void load(const Scene& scene, const Context* context) override { chapter_->load(scene, context); }
    void render(const Frame& frame) override { chapter_->render(frame); }
    TruthImage truth(const TruthRequest& request) override { return chapter_->truth(request); }
    std::vector<Program*> programs() override { return chapter_->programs(); }
    Parameters* parameters = nullptr;

 private:
    std::unique_ptr<Chapter> chapter_;
};

/// What is kept between two visits of a chapter.
struct Kept {
    std::map<std::string, int> objects;  ///< of the driver, by kind
    double heapMegabytes = 0.0;
    double residentMegabytes = 0.0;
};

Kept keptNow() {
    ::malloc_trim(0);
    constexpr double megabyte = 1 << 20;
    const struct mallinfo2 heap = ::mallinfo2();
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return {liveObjects(), double(heap.uordblks + heap.hblkhd) / megabyte,
            double(resident) * double(::sysconf(_SC_PAGESIZE)) / megabyte};
}

class Endurance {
 public:
    explicit Endurance(unsigned seed) : random_(seed) {}

    /// One chapter with one scene, for some frames; everything is gone afterwards.
    void visit(const ChapterProgram& program, int frames) {
        const std::string scene = pick<std::string>({"contact", "heckbert_herf", "contact_panel"});
        SCOPED_TRACE(program.info.name + " of " + scene);
        auto owned = std::make_unique<Watched>(program.make());
        Watched& chapter = *owned;
        ChapterHarness harness(std::move(owned), testScene(scene));
        makeCheap(*chapter.parameters);
        OrbitCamera orbit(harness.camera, harness.scene.bounds);
        for (int i = 0; i < frames && !testing::Test::HasFailure(); ++i) {
            if (chance(3)) changeOne(*chapter.parameters);
            if (chance(3)) orbit.orbit(0.2 * number(-3, 3), 0.1 * number(-3, 3));
            if (chance(12)) changeShader(chapter);
            harness.camera = orbit.camera();
            harness.skip = !chance(4);
            harness.renderMapsAgain = chance(2);
            frame(harness, pick(program.info.views));
        }
    }

    int refused = 0;  ///< frames for which a chapter said that these parameters do not go together

 private:
    int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    bool chance(int oneIn) { return number(1, oneIn) == 1; }
    template <class T>
    T pick(const std::vector<T>& from) {
        return from[std::size_t(number(0, int(from.size()) - 1))];
    }

    /// Small maps and few samples: what may be left behind is left behind all the same.
    static void makeCheap(Parameters& parameters) {
        for (const Parameter& parameter : parameters.all()) {
            if (parameter.name == "map-size") parameters.set("map-size", "128");
            if (parameter.name == "samples" && parameter.low <= 16) parameters.set("samples", "16");
        }
    }

    void changeOne(const Parameters& parameters) {
        std::vector<Parameter> some;
        for (const Parameter& parameter : parameters.all())
            if (!parameter.orFile && parameter.name != "save" && parameter.name != "light")
                some.push_back(parameter);
        const Parameter parameter = pick(some);
        // Back as often as on: a walk would end at pictures that take seconds.
        if (chance(2))
            resetParameter(parameter);
        else
            stepParameter(parameter, chance(2) ? 1 : -1);
        makeCheap(const_cast<Parameters&>(parameters));
    }

    void changeShader(Watched& chapter) {
        const std::vector<Program*> programs = chapter.programs();
        if (programs.empty()) return;
        Program& program = *pick(programs);
        const fs::path file = pick(program.sourceFiles());
        const std::string text = bytesOf(file);
        if (chance(2)) {
            shaders_.write(
                file, text + "\n#endif\n");  // an error also where the file is included by no active line
            EXPECT_TRUE(program.sourcesChanged());
            EXPECT_NE(program.reload(), "") << file;
        }
        shaders_.write(file, text);
        for (Program* user : programs) {
            if (!user->sourcesChanged()) continue;
            EXPECT_EQ(user->reload(), "") << file;
        }
    }

    void frame(ChapterHarness& harness, const ViewInfo& view) {
        const glm::ivec2 size{number(1, 96), number(1, 96)};
        try {
            const FloatImage picture = harness.picture(view.name, size, view.scalar ? 1 : 3);
            for (const float value : picture.values)
                if (!std::isfinite(value))
                    return void(ADD_FAILURE() << "NaN or infinity in view " << view.name);
        } catch (const UsageError&) {
            ++refused;
        } catch (const Error& error) {
            ADD_FAILURE() << "view " << view.name << ": " << error.what();
        }
    }

    std::mt19937 random_;
    OwnShaders shaders_;
};

TEST(EnduranceSlow, NothingIsLeftBehindByManyFramesOfEveryChapter) {
    const int frames = numberFrom("PENUMBRA_ENDURANCE_FRAMES", 220);
    const unsigned seed = unsigned(numberFrom("PENUMBRA_ENDURANCE_SEED", 1));
    constexpr int framesOfAVisit = 10;
    SCOPED_TRACE("again with PENUMBRA_ENDURANCE_SEED=" + std::to_string(seed) +
                 " PENUMBRA_ENDURANCE_FRAMES=" + std::to_string(frames) + " " + PENUMBRA_SOURCE_DIR +
                 "/build/release/bin/endurance_chapters");
    const TemporaryFolder bakes;
    ::setenv("PENUMBRA_TRUTH_CACHE", bakes.path().c_str(), 1);
    ASSERT_GE(chapterPrograms().size(), 11u);
    testContext();
    Endurance endurance(seed);
    std::vector<Kept> rounds;
    int drawn = 0;
    // Rounds, each of which visits every chapter once: what is kept is compared between rounds.
    while (drawn < frames && !HasFailure()) {
        for (const ChapterProgram& program : chapterPrograms()) {
            endurance.visit(program, framesOfAVisit);
            drawn += framesOfAVisit;
        }
        rounds.push_back(keptNow());
        std::printf("%6d frames: heap %.1f MB, resident %.1f MB\n", drawn, rounds.back().heapMegabytes,
                    rounds.back().residentMegabytes);
        std::fflush(stdout);
    }
    ASSERT_GE(rounds.size(), 2u) << "one round is only a warm-up";
    const std::size_t warm = (rounds.size() + 2) / 3 - 1;  // the last round of the warm-up
    for (const Kept& later : rounds) {
        if (&later <= &rounds[warm]) continue;
        EXPECT_EQ(later.objects, rounds[warm].objects);
    }
    // A round keeps more or less by what it happened to draw last; what grows, grows at its least too.
    constexpr double most =
        8.0;  // megabytes; a picture of 96 x 96 left behind by each visit would be 140 at the end
    const std::span<const Kept> measured = std::span(rounds).subspan(warm);
    const std::span<const Kept> early = measured.first((measured.size() + 1) / 2);
    const std::span<const Kept> late = measured.last(measured.size() / 2);
    for (const auto member : {&Kept::heapMegabytes, &Kept::residentMegabytes}) {
        const auto least = [&](std::span<const Kept> some) {
            return (*std::ranges::min_element(some, {}, member)).*member;
        };
        EXPECT_LT(least(late), least(early) + most)
            << (member == &Kept::heapMegabytes ? "heap" : "resident memory") << " grows";
    }
    EXPECT_LT(endurance.refused, drawn / 4) << "frames that were not drawn test nothing";
}

}  // namespace
}  // namespace penumbra
