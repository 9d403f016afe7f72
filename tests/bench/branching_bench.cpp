// What skipping saves: branching_bench [ROUNDS]. Three tables, each of one run:
//   layouts of the jitter texture against the lecture's look-up;
//   07 against 06 and against the model (classification + f x full), for shares f of the picture in penumbra;
//   the minimum-maximum map against the shadow map it is made from.
// Rounds are interleaved, so that a slow moment hits all alike; times are medians.
#define main chapter06Main
#include "chapters/06_jitter_texture/main.cpp"
#undef main
#define main chapter07Main
#include "chapters/07_branching/main.cpp"
#undef main

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "common/app/report.h"
#include "tests/bench/clocks.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/small_scenes.h"

namespace {

constexpr glm::ivec2 pictureSize(512, 512);

struct Way {
    std::string name;
    std::unique_ptr<ChapterHarness> harness;
    std::vector<double> times{}, cpuTimes{};
    double median() const { return statisticsOf(times).median; }
    double cpuMedian() const { return statisticsOf(cpuTimes).median; }
};

/// Draws once to warm up, then `rounds` times, in turns.
void measure(std::vector<Way>& ways, int rounds) {
    for (int round = -1; round < rounds; ++round)
        for (Way& way : ways) {
            const double wall = wallTime(), cpu = cpuTime();
            way.harness->render("visibility", pictureSize);
            if (round < 0) continue;
            way.times.push_back(wallTime() - wall);
            way.cpuTimes.push_back(cpuTime() - cpu);
        }
}

template <class Chapter>
Way way(const std::string& name, const Scene& scene, const Settings& settings) {
    Way made{name, std::make_unique<ChapterHarness>(std::make_unique<Chapter>(), scene)};
    made.harness->set(settings);
    return made;
}

/// Ground that fills the picture, a lamp straight above, and `edges` straight edges between them, which the
/// camera does not see.
Scene edges(int count) {
    SmallScene scene;
    scene.quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
    // The picture is a metre wide; half way up shadows are twice as large.
    const double band = 0.5 / (count + 1);
    for (int i = 0; i < (count + 1) / 2; ++i) {
        const double from = -0.25 + (2 * i + 1) * band, to = 2 * i + 2 > count ? 2.0 : from + band;
        scene.quad({-3, 2, to}, {6, 0, 0}, {0, 0, from - to});
    }
    return scene.light(LightType::spot, {0, 4, 0}, {0, -1, 0}, 0.5)
        .flatCamera({0, 1, 0}, {0, 0, 0}, 1.0)
        .take();
}

double penumbraShare(ChapterHarness& harness) {
    const FloatImage visibility = harness.scalar("visibility", pictureSize);
    const auto between = [](float v) { return v > 0.0f && v < 1.0f; };
    return double(std::count_if(visibility.values.begin(), visibility.values.end(), between)) /
           double(visibility.values.size());
}

Settings with(Settings settings, const Settings& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

void layouts(int rounds) {
    const Scene scene = edges(1);
    const Settings kinds[] = {{{"layout", "lecture"}},
                              {{"layout", "snorm8"}},
                              {{"layout", "packed16"}},
                              {{"layout", "packed8"}},
                              {{"method", "rotation"}}};
    std::vector<Way> ways;
    for (const Settings& kind : kinds) {
        const Settings settings = with({{"radius", "25.6"}}, kind);
        ways.push_back(way<JitterTextureChapter>(kind[0].second, scene, settings));
        ways.push_back(way<Branching>(kind[0].second, scene, settings));
    }
    measure(ways, rounds);
    fmt::print(
        "64 samples, {}x{}, {:.1f} % penumbra; ms       06  of the lecture's    07  06/07  the lecture's "
        "06/07\n",
        pictureSize.x, pictureSize.y, 100.0 * penumbraShare(*ways[0].harness));
    for (std::size_t i = 0; i < ways.size(); i += 2) {
        const double lecture = ways[0].median(), full = ways[i].median(), branched = ways[i + 1].median();
        fmt::print("  {:40} {:7.2f} {:14.0f} % {:7.2f} {:6.2f} {:20.2f}\n", ways[i].name, full,
                   100.0 * full / lecture, branched, full / branched, lecture / branched);
    }
}

void printShares(const char* radius, std::vector<Way>& ways) {
    const Way &full = ways[0], &branched = ways[1];
    const double f = penumbraShare(*full.harness);
    const double supersampled =
        double(ways[1].harness->work["pixels_supersampled"]) / (pictureSize.x * pictureSize.y);
    const double model = ways.back().median() + f * full.median();
    fmt::print("{:6.1f}% {:>6} |", 100.0 * f, radius);
    for (const Way& way : ways) fmt::print(" {:6.2f}", way.median());
    fmt::print(" | {:5.2f} {:5.2f} {:13.2f} {:12.1f}%\n", full.median() / branched.median(),
               full.cpuMedian() / branched.cpuMedian(), branched.median() / model, 100.0 * supersampled);
}

void shares(int rounds) {
    fmt::print(
        "07: 64 samples, f: share of the picture in penumbra; ms, class: the classification alone\n"
        "      f radius |     06     07     if  probe   none  class | 06/07   CPU  of the model  "
        "supersampled\n");
    struct Case {
        int edges;
        const char* radius;
    };
    for (const Case& c : {Case{1, "10"}, {1, "25.6"}, {2, "25.6"}, {4, "25.6"}, {8, "25.6"}, {16, "48"}}) {
        const Scene scene = edges(c.edges), empty = edges(0);
        const Settings radius{{"radius", c.radius}};
        std::vector<Way> ways;
        ways.push_back(way<JitterTextureChapter>("06", scene, radius));
        ways.push_back(way<Branching>("07", scene, radius));
        ways.push_back(way<Branching>("if", scene, with({{"branch", "if"}}, radius)));
        ways.push_back(way<Branching>("probe", scene, with({{"classify", "probe"}}, radius)));
        ways.push_back(way<Branching>("none", scene, with({{"classify", "none"}}, radius)));
        ways.push_back(way<Branching>("classification alone", empty, radius));
        measure(ways, rounds);
        printShares(c.radius, ways);
    }
}

void minMax(int rounds) {
    Way courtyard = way<Branching>("courtyard", testScene("courtyard"), {});
    PassTimer timer(true);
    courtyard.harness->passTimer = &timer;
    courtyard.harness->renderMapsAgain = true;
    for (int round = -1; round < rounds; ++round) {
        if (round == 0) timer.clear();
        courtyard.harness->render("visibility", pictureSize);
    }
    const auto depth = statisticsOf(timer.times().at("depth"));
    const auto built = statisticsOf(timer.times().at("min-max"));
    fmt::print(
        "minimum-maximum map of the courtyard: {:.2f} ms, {:.1f} % of the shadow map's {:.2f} ms; at best "
        "{:.2f} ms, {:.1f} % of {:.2f} ms\n",
        built.median, 100.0 * built.median / depth.median, depth.median, built.min,
        100.0 * built.min / depth.min, depth.min);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
        layouts(rounds);
        shares(rounds);
        minMax(rounds);
        return exitFine;
    } catch (const Error& error) {
        fmt::print(stderr, "branching_bench: {}\n", error.what());
        return error.status();
    }
}
