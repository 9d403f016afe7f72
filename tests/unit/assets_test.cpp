// The committed scenes: reproducible, as promised in assets/README.md, and read by the loader as they were
// meant.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "common/scene/gltf_loader.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

const fs::path assets = fs::path(PENUMBRA_SOURCE_DIR) / "assets";

std::string bytesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Scene load(const std::string& name) {
    return loadGltf(assets / (name + ".glb"));
}

std::vector<LightType> lightTypes(const Scene& scene) {
    std::vector<LightType> types;
    for (const Light& light : scene.lights) types.push_back(light.type);
    return types;
}

const Part& partNamed(const Scene& scene, const std::string& name) {
    for (const Part& part : scene.parts)
        if (part.name.find(name) != std::string::npos) return part;
    throw std::runtime_error("no part " + name);
}

/// Height above the file's y = 0, exact up to the float rounding of coordinates relative to the origin.
double lowestPoint(const Scene& scene, const Part& part) {
    return part.bounds.lower.y + scene.origin.y;
}

TEST(Assets, TheProgramMakesTheCommittedFilesByteForByte) {
    const fs::path maker = fs::read_symlink("/proc/self/exe").parent_path() / "make_assets";
    ASSERT_TRUE(fs::exists(maker)) << "build the target make_assets first";
    const fs::path folder = fs::temp_directory_path() / ("assets_test_" + std::to_string(getpid()));
    ASSERT_EQ(std::system((maker.string() + " " + folder.string()).c_str()), 0);
    std::size_t made = 0, total = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string fresh = bytesOf(entry.path());
        EXPECT_TRUE(fresh == bytesOf(assets / entry.path().filename()))
            << entry.path().filename() << " differs: run make_assets assets and commit";
        total += fresh.size();
        ++made;
    }
    fs::remove_all(folder);
    std::size_t committed = 0;
    for (const auto& entry : fs::directory_iterator(assets))
        committed += entry.path().extension() == ".glb" || entry.path().extension() == ".hdr";
    EXPECT_EQ(made, committed);
    EXPECT_LT(total, 6u << 20);
}

TEST(Assets, MakerSaysHowItIsUsedAndWhatWentWrong) {
    const std::string maker = (fs::read_symlink("/proc/self/exe").parent_path() / "make_assets").string();
    EXPECT_EQ(WEXITSTATUS(std::system((maker + " 2>/dev/null").c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((maker + " /proc/nowhere 2>/dev/null").c_str())), 1);
}

/// make_assets --knot in a folder of its own.
class KnotMaker {
 public:
    ~KnotMaker() { fs::remove_all(folder); }
    int make(const std::string& triangles, const fs::path& file) const {
        const std::string command = maker_ + " --knot " + triangles + " " + file.string() + " 2>/dev/null";
        return WEXITSTATUS(std::system(command.c_str()));
    }
    const fs::path folder = fs::temp_directory_path() / ("assets_knot_test_" + std::to_string(getpid()));

 private:
    const std::string maker_ = (fs::read_symlink("/proc/self/exe").parent_path() / "make_assets").string();
};

TEST(Assets, TheKnotIsMadeWithAsManyTrianglesAsAreWanted) {
    const KnotMaker knots;
    for (const int wanted : {100, 1000, 12345}) {
        const fs::path file = knots.folder / "new" / (std::to_string(wanted) + ".glb");
        ASSERT_EQ(knots.make(std::to_string(wanted), file), 0);
        const Scene scene = loadGltf(file);
        const Part& knot = partNamed(scene, "knot");
        EXPECT_NEAR(double(knot.triangleCount), wanted, 0.02 * wanted);
        EXPECT_TRUE(knot.closed);
        EXPECT_EQ(scene.triangleCount() - knot.triangleCount, 14u) << "the floor and the light";
    }
}

TEST(Assets, AKnotOfSeventyThousandTrianglesIsTheSceneByteForByte) {
    const KnotMaker knots;
    ASSERT_EQ(knots.make("70000", knots.folder / "same.glb"), 0);
    EXPECT_TRUE(bytesOf(knots.folder / "same.glb") == bytesOf(assets / "knot.glb"));
}

TEST(Assets, AWrongKnotIsRefused) {
    const KnotMaker knots;
    for (const char* wrong : {"99", "5000001", "-1000", "1e4", "many", "''"})
        EXPECT_EQ(knots.make(wrong, knots.folder / "wrong.glb"), 2) << wrong;
    EXPECT_FALSE(fs::exists(knots.folder / "wrong.glb"));
    EXPECT_EQ(knots.make("1000", knots.folder / "knot.obj"), 2);
    ASSERT_EQ(knots.make("1000", knots.folder / "file.glb"), 0);
    EXPECT_EQ(knots.make("1000", knots.folder / "file.glb" / "inside.glb"), 1) << "a file is no folder";
}

TEST(Assets, HeckbertHerfIsTheSceneOfTheClosedForm) {
    const Scene scene = load("heckbert_herf");
    EXPECT_EQ(scene.triangleCount(), 5u);  // light 2, receiver 2, triangle 1
    ASSERT_EQ(lightTypes(scene), std::vector<LightType>{LightType::area});
    const Light& light = scene.lights[0];
    EXPECT_NEAR(light.area, 1.0, 1e-6);
    EXPECT_NEAR(glm::length(light.direction - glm::dvec3(0, -1, 0)), 0.0, 1e-9);
    EXPECT_NEAR(glm::length(light.position + scene.origin - glm::dvec3(0, 2, 0)), 0.0, 1e-6);
    ASSERT_EQ(light.polygons.size(), 1u);
    ASSERT_EQ(light.polygons[0].size(), 4u);
    for (const glm::dvec3& corner : light.polygons[0]) {
        const glm::dvec3 p = corner + scene.origin;
        EXPECT_NEAR(std::abs(p.x), 0.5, 1e-6);
        EXPECT_NEAR(p.y, 2.0, 1e-6);
        EXPECT_NEAR(std::abs(p.z), 0.5, 1e-6);
    }
    // (x, y, z) of the closed form is (x, z, -y) here.
    const Part& triangle = partNamed(scene, "triangle");
    ASSERT_EQ(triangle.triangleCount, 1u);
    const glm::dvec3 expected[] = {{-0.4, 1.0, 0.35}, {0.45, 1.0, 0.3}, {0.0, 1.0, -0.45}};
    for (const glm::dvec3& corner : expected) {
        double nearest = 1.0;
        for (std::uint32_t i = 0; i < 3; ++i) {
            const glm::dvec3 p(scene.positions[scene.indices[3 * triangle.firstTriangle + i]]);
            nearest = std::min(nearest, glm::length(p + scene.origin - corner));
        }
        EXPECT_LT(nearest, 1e-6);
    }
    const Aabb& receiver = partNamed(scene, "receiver").bounds;
    EXPECT_NEAR(glm::length(receiver.size() - glm::dvec3(2.4, 0.0, 2.4)), 0.0, 1e-6);
}

TEST(Assets, ContactHasNoGap) {
    const Scene scene = load("contact");
    const double ground = partNamed(scene, "floor").bounds.upper.y;
    for (const char* name : {"wall", "box", "plank", "post"})
        EXPECT_EQ(partNamed(scene, name).bounds.lower.y, ground) << name;
    EXPECT_EQ(partNamed(scene, "plank").bounds.lower.x, partNamed(scene, "wall").bounds.upper.x);
    EXPECT_EQ(lightTypes(scene), (std::vector<LightType>{LightType::spot, LightType::point}));
}

TEST(Assets, SolidsAreClosedSoThatTheirBackFacesMayBeCulled) {
    for (const char* name : {"contact", "spheres", "gully", "room", "fence", "knot", "courtyard"}) {
        const Scene scene = load(name);
        for (const Part& part : scene.parts) {
            const Material& material = scene.materials[static_cast<std::size_t>(part.material)];
            const bool isSheet = material.doubleSided || material.emission != glm::vec3(0.0f);
            EXPECT_EQ(part.closed, !isSheet) << name << ": " << part.name;
        }
    }
}

TEST(Assets, TriangleCountsAsPromised) {
    EXPECT_EQ(load("knot").triangleCount(), 70'000u + 12u + 2u);
    const std::size_t courtyard = load("courtyard").triangleCount();
    EXPECT_GE(courtyard, 50'000u);
    EXPECT_LE(courtyard, 150'000u);
}

// `gully` | 9 842 | ... of the table in assets/README.md.
TEST(Assets, TriangleCountsAsTheTableSays) {
    std::ifstream readme(assets / "README.md");
    int rows = 0;
    for (std::string line; std::getline(readme, line);) {
        std::smatch row;
        if (!std::regex_search(line, row, std::regex(R"(^\| `(\w+)` \| ([\d ]+) \|)"))) continue;
        std::string count = row[2];
        count.erase(std::remove(count.begin(), count.end(), ' '), count.end());
        EXPECT_EQ(load(row[1]).triangleCount(), std::stoul(count)) << row[1];
        ++rows;
    }
    EXPECT_EQ(rows, 9);
}

TEST(Assets, LightsAsPromised) {
    using enum LightType;
    EXPECT_EQ(lightTypes(load("courtyard")), (std::vector<LightType>{directional, point, area}));
    EXPECT_EQ(lightTypes(load("spheres")), (std::vector<LightType>{directional, point, area}));
    EXPECT_EQ(lightTypes(load("knot")), (std::vector<LightType>{directional, area}));
    EXPECT_EQ(lightTypes(load("room")), (std::vector<LightType>{area, area}));
    EXPECT_EQ(lightTypes(load("fence")), (std::vector<LightType>{directional, point}));
    EXPECT_EQ(lightTypes(load("gully")), (std::vector<LightType>{directional, point}));
    const Scene courtyard = load("courtyard");
    const double elevation = glm::degrees(std::asin(-courtyard.lights[0].direction.y));
    EXPECT_GT(elevation, 20.0);  // a low sun
    EXPECT_LT(elevation, 35.0);
}

TEST(Assets, FirstFourBallsRestOnThePlaneAndTheOthersFloat) {
    const Scene scene = load("spheres");
    for (int ball = 1; ball <= 7; ++ball) {
        const double low = lowestPoint(scene, partNamed(scene, "ball " + std::to_string(ball)));
        if (ball <= 4) {
            EXPECT_NEAR(low, 0.0, 1e-6) << ball;
        } else {
            EXPECT_GT(low, 0.05) << ball;
        }
    }
}

TEST(Assets, GulliesHaveTheDimensionsOfTheirClosedForms) {
    const Scene scene = load("gully");
    double lowestOfRectangle = 0.0, lowestOfV = 0.0, lowestOfTrench = 0.0, lowestOfPit = 0.0;
    for (const glm::vec3& relative : scene.positions) {
        const glm::dvec3 p = glm::dvec3(relative) + scene.origin;
        if (p.y < -1.2) continue;  // the underside
        if (p.x > -4.01 && p.x < -2.99) lowestOfRectangle = std::min(lowestOfRectangle, p.y);
        if (std::abs(p.x) < 0.751) {
            lowestOfV = std::min(lowestOfV, p.y);
            EXPECT_NEAR(p.y, -(0.75 - std::abs(p.x)) / 0.75, 1e-5);
        }
        if (p.x > 2.251 && p.x < 3.749) {
            lowestOfTrench = std::min(lowestOfTrench, p.y);
            EXPECT_NEAR(std::hypot(p.x - 3.0, p.y), 0.75, 1e-5);
        }
        const double fromAxis = std::hypot(p.x - 6.5, p.z);
        if (fromAxis < 0.799) {
            lowestOfPit = std::min(lowestOfPit, p.y);
            EXPECT_NEAR(std::hypot(fromAxis, p.y - 0.6), 1.0, 1e-5);
        }
    }
    EXPECT_NEAR(lowestOfRectangle, -1.0, 1e-5);
    EXPECT_NEAR(lowestOfV, -1.0, 1e-5);
    EXPECT_NEAR(lowestOfTrench, -0.75, 1e-5);
    EXPECT_NEAR(lowestOfPit, -0.4, 1e-5);
}

TEST(Assets, EverySceneHasANamedCamera) {
    for (const char* name :
         {"heckbert_herf", "contact", "spheres", "gully", "room", "fence", "knot", "courtyard"}) {
        const Scene scene = load(name);
        ASSERT_FALSE(scene.cameras.empty()) << name;
        EXPECT_EQ(scene.cameras[0].name, "camera") << name;
    }
}

}  // namespace
}  // namespace penumbra
