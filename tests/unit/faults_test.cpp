// What goes wrong around a program: killed at any moment, a disk that is full or read-only, memory that is
// short, an environment full of nonsense, the largest pictures. Each time: the old file or the new one, one
// line, and the promised exit status. Drawn with real chapters; tests/unit/cli_test.cpp has the same for what
// all chapters share.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "common/error.h"
#include "common/image/file_write.h"
#include "common/image/image_file.h"
#include "tests/unit/killed_program.h"
#include "tests/unit/triangle_scene.h"

static int closeError = 0;  // what close says in this program, if not 0

/// Takes the place of the C library's.
extern "C" int close(int fd) {
    const int result = int(::syscall(SYS_close, fd));
    if (closeError == 0) return result;
    errno = closeError;
    return -1;
}

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

constexpr rlim_t megabyte = 1 << 20;

class FaultsSlow : public testing::Test {
 protected:
    FaultsSlow() { writeFile(folder / "triangle.gltf", triangleFile); }
    ProgramCall call(const std::string& chapter, Words arguments) const {
        arguments.insert(arguments.begin(), {"--headless", "--quiet", "--scene", "triangle.gltf"});
        return {
            .program = programFolder() / chapter, .arguments = std::move(arguments), .folder = folder.path()};
    }
    /// The same with these settings of the environment: "NAME=value", or "-u" and "NAME".
    ProgramCall callWith(Words environment, const std::string& chapter, Words arguments) const {
        ProgramCall plain = call(chapter, std::move(arguments));
        environment.push_back(plain.program);
        environment.insert(environment.end(), plain.arguments.begin(), plain.arguments.end());
        return {.program = "/usr/bin/env", .arguments = std::move(environment), .folder = folder.path()};
    }
    static void expectOneLine(const ProgramResult& result, int status, const std::string& part) {
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(result.out, "");
    }
    static void expectSilence(const ProgramResult& result) {
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.out + result.err, "");
    }
    static std::size_t unfinishedFiles(const fs::path& path) {
        std::size_t count = 0;
        for (const auto& entry : fs::directory_iterator(path))
            count += entry.path().string().find(".part-") != std::string::npos;
        return count;
    }
    /// Mounts made from now on are this process's alone, and gone with it. Who is not root may not have that.
    static bool mayMount() {
        return ::unshare(CLONE_NEWNS) == 0 &&
               ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
    }
    TemporaryFolder folder;
};

/// Puts `from` in the place of `to` while it lives, in this process and in those that it starts.
class InPlaceOf {
 public:
    InPlaceOf(const fs::path& to, const fs::path& from) : to_(to) {
        EXPECT_EQ(::mount(from.c_str(), to.c_str(), nullptr, MS_BIND, nullptr), 0)
            << to << ": " << std::strerror(errno);
    }
    ~InPlaceOf() { ::umount(to_.c_str()); }
    InPlaceOf(const InPlaceOf&) = delete;
    InPlaceOf& operator=(const InPlaceOf&) = delete;

 private:
    fs::path to_;
};

TEST_F(FaultsSlow, KilledAtAnyMomentTheOldFileOrTheNewOneIsThere) {
    const Words files{"a.exr", "b.glb"};
    const auto bake = [&](const std::string& samples) {
        return call("09_ambient_occlusion",
                    {"--scene", "spheres", "--size", "16x16", "--method", "vertices", "--samples", samples,
                     "--output", "a.exr", "--save", "b.glb", "--report", "r.json"});
    };
    std::map<std::string, std::set<std::string>> whole;  // what a file may hold
    for (const char* samples : {"16", "64"}) {
        expectSilence(runProgram(bake(samples)));
        for (const std::string& file : files) whole[file].insert(bytesOf(folder / file));
    }
    for (const std::string& file : files)
        ASSERT_EQ(whole[file].size(), 2u) << file << ": both would be the same";
    const int moments = killAtMoment(bake("64"), std::numeric_limits<int>::max());
    ASSERT_GT(moments, 20) << "three files are opened, written and renamed";
    const char* wanted = std::getenv("PENUMBRA_KILLS");
    const int kills = std::min(moments, wanted ? std::atoi(wanted) : 10);
    for (int i = 0; i < kills; ++i) {
        const int moment = (2 * i + 1) * moments / (2 * kills);
        killAtMoment(bake(i % 2 == 0 ? "16" : "64"), moment);
        for (const std::string& file : files)
            ASSERT_TRUE(whole[file].contains(bytesOf(folder / file)))
                << file << " after moment " << moment << " of " << moments;
        ASSERT_TRUE(Json::accept(bytesOf(folder / "r.json"))) << moment;
    }
    EXPECT_GT(unfinishedFiles(folder.path()), 0u) << "who was never killed while writing proves nothing";
    expectSilence(runProgram(bake("16")));
    EXPECT_EQ(unfinishedFiles(folder.path()), 0u) << "what kills left is cleared away by the next run";
}

TEST_F(FaultsSlow, AfterCtrlCABakeGoesOnWhereItWas) {
    const std::string core =
        std::to_string(::sched_getcpu());  // with dozens of them it would be over before Ctrl-C
    struct Kind {
        std::string method, samples;
        Words saved;
    };
    for (const Kind& kind :
         std::vector<Kind>{{"bits", "640", {}}, {"vertices", "192", {"--save", "a.glb"}}}) {
        SCOPED_TRACE(kind.method);
        const auto bake = [&] {
            Words words{"--scene",  "knot",   "--size",    "16x16",      "--method", kind.method,
                        "--report", "r.json", "--samples", kind.samples, "--output", "a.png"};
            words.insert(words.end(), kind.saved.begin(), kind.saved.end());
            return callWith({"PENUMBRA_TRUTH_CACHE=cache", "taskset", "-c", core}, "09_ambient_occlusion",
                            words);
        };
        const auto partial = [&] {
            if (!fs::exists(folder / "cache")) return false;
            const auto entries = fs::directory_iterator(folder / "cache");
            return std::any_of(begin(entries), end(entries),
                               [](const auto& e) { return e.path().extension() == ".bake"; });
        };
        ProgramCall interrupted = bake();
        interrupted.signal = SIGINT;
        const auto tooLate = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        interrupted.signalWhen = [&] { return partial() || std::chrono::steady_clock::now() > tooLate; };
        expectOneLine(runProgram(interrupted), 130, "interrupted");
        EXPECT_FALSE(fs::exists(folder / "a.png"));
        ASSERT_TRUE(partial());
        const auto rays = [&] {
            expectSilence(runProgram(bake()));
            EXPECT_FALSE(partial()) << "what is finished need not wait";
            return Json::parse(bytesOf(folder / "r.json"))["work"]["rays_baked"].get<std::int64_t>();
        };
        const std::int64_t rest = rays();
        const std::string resumed = bytesOf(folder / "a.png") + bytesOf(folder / "a.glb");
        EXPECT_LT(rest, rays()) << "it began anew";
        EXPECT_EQ(resumed, bytesOf(folder / "a.png") + bytesOf(folder / "a.glb"));
        fs::remove(folder / "a.png");
    }
}

TEST_F(FaultsSlow, AFullOrReadOnlyDiskIsOneLineAndTheOldFilesStay) {
    const std::string disk = (folder / "disk").string();
    fs::create_directory(disk);
    if (!mayMount() || ::mount("penumbra", disk.c_str(), "tmpfs", 0, "size=16k") != 0)
        GTEST_SKIP() << "no disk can be mounted here (" << std::strerror(errno)
                     << "): run as root; cli_test has /dev/full and ulimit -f";
    writeFile(disk + "/a.png", "the old picture");
    writeFile(disk + "/fill", std::string(12 << 10, 'x'));
    const auto expectFailures = [&](const std::string& why) {
        expectOneLine(runProgram(call("02_shadow_test", {"--output", "disk/a.png"})), 1, why);
        expectOneLine(runProgram(call("02_shadow_test", {"--output", "disk/new/a.exr"})), 1, why);
        expectOneLine(runProgram(call("09_ambient_occlusion",
                                      {"--scene", "spheres", "--size", "16x16", "--samples", "16", "--method",
                                       "vertices", "--save", "disk/a.glb", "--output", "b.png"})),
                      1, why);
        EXPECT_EQ(bytesOf(disk + "/a.png"), "the old picture");
        EXPECT_EQ(unfinishedFiles(disk), 0u);
        EXPECT_FALSE(fs::exists(disk + "/a.glb"));
        expectSilence(runProgram(callWith({"PENUMBRA_TRUTH_CACHE=disk"}, "02_shadow_test",
                                          {"--size", "64x64", "--compare-truth", "--output", "b.png"})));
        EXPECT_EQ(unfinishedFiles(disk), 0u);
    };
    expectFailures("No space left on device");
    ASSERT_EQ(::mount("none", disk.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
    expectFailures("Read-only file system");
    expectOneLine(
        runProgram(
            {.program = programFolder() / "make_assets", .arguments = {"disk"}, .folder = folder.path()}),
        1, "disk/heckbert_herf.glb: cannot be written: Read-only file system");
    ::umount(disk.c_str());
}

TEST_F(FaultsSlow, AFileThatCannotBeReplacedIsOneLineAndStays) {
    if (!mayMount())
        GTEST_SKIP() << "nothing can be mounted here (" << std::strerror(errno) << "): run as root";
    writeFile(folder / "a.png", "the old picture");
    {
        const InPlaceOf itself(folder / "a.png", folder / "a.png");  // as a container mounts one file
        expectOneLine(runProgram(call("02_shadow_test", {"--size", "16x16", "--output", "a.png"})), 1,
                      "a.png: cannot be written: Device or resource busy");
    }
    EXPECT_EQ(bytesOf(folder / "a.png"), "the old picture");
    EXPECT_EQ(unfinishedFiles(folder.path()), 0u);
}

// As networks and quotas do.
TEST(Faults, ADiskThatRefusesWhenTheFileIsClosedLeavesTheOldOne) {
    const TemporaryFolder folder;
    writeFile(folder / "a.png", "the old picture");
    std::string said;
    closeError = EDQUOT;
    try {
        writeFile(folder / "a.png", "the new picture");
    } catch (const Error& error) {
        said = error.what();
    }
    closeError = 0;
    EXPECT_NE(said.find("a.png: cannot be written: Disk quota exceeded"), std::string::npos) << said;
    EXPECT_EQ(bytesOf(folder / "a.png"), "the old picture");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST_F(FaultsSlow, NonsenseInTheEnvironmentIsIgnored) {
    const Words picture{"--size", "16x16", "--output", "a.png"};
    const std::vector<Words> ignored{
        {"DISPLAY=:77"},  // nobody there: without a window then
        {"WAYLAND_DISPLAY=nowhere", "XDG_RUNTIME_DIR=/nowhere", "XDG_CONFIG_HOME=/nowhere/x"},
        {"-i"},
        {"LC_ALL=nonsense", "LANG=xx_YY.UTF-9", "TZ=:nonsense", "TERM=nonsense", "TMPDIR=/nowhere",
         "COLUMNS=-1"},
        {"LIBGL_ALWAYS_SOFTWARE=nonsense", "MESA_DEBUG=nonsense", "LP_NUM_THREADS=-5",
         "EGL_PLATFORM=nonsense"},
        {"PENUMBRA_TRUTH_CACHE=/dev/null/x"},
    };
    for (const Words& environment : ignored) {
        SCOPED_TRACE(environment.front());
        expectSilence(runProgram(callWith(environment, "02_shadow_test", picture)));
    }
    // Mesa itself warns that it cannot keep its shaders, and goes on.
    const ProgramResult homeless =
        runProgram(callWith({"HOME=/nowhere", "XDG_CACHE_HOME=/nowhere/x"}, "02_shadow_test", picture));
    EXPECT_EQ(homeless.status, 0);
    EXPECT_LE(homeless.errorLines(), 1) << homeless.err;
}

TEST_F(FaultsSlow, NonsenseInTheEnvironmentIsNamedWhereItCannotBeIgnored) {
    const Words picture{"--size", "16x16", "--output", "a.png"};
    const std::vector<std::pair<Words, std::string>> named{
        {{"GALLIUM_DRIVER=nonsense"}, "GALLIUM_DRIVER is \"nonsense\""},
        {{"LP_NATIVE_VECTOR_WIDTH=7"}, "LP_NATIVE_VECTOR_WIDTH is \"7\""},
        {{"PENUMBRA_SHADERS=/nowhere"}, "PENUMBRA_SHADERS"},
        {{"PENUMBRA_IMAGE_CODEC=/nowhere.so"}, "/nowhere.so"},
        {{"PENUMBRA_OSMESA_LIBRARY=/nowhere.so", "PENUMBRA_EGL_LIBRARY=/nowhere.so"}, "/nowhere.so"},
        {{"LIBGL_DRIVERS_PATH=/nowhere", "PENUMBRA_OSMESA_LIBRARY=/nowhere.so"},
         "EGL could not be initialised"},
    };
    for (const auto& [environment, part] : named) {
        SCOPED_TRACE(environment.front());
        expectOneLine(runProgram(callWith(environment, "02_shadow_test", picture)), 1, part);
    }
    expectOneLine(
        runProgram(callWith({"PENUMBRA_ASSETS=/nowhere"}, "02_shadow_test", {"--scene", "contact"})), 2,
        "PENUMBRA_ASSETS");
}

TEST_F(FaultsSlow, WithLittleMemoryItIsOneLineAndNeverACrash) {
    for (const std::string chapter : {"00_ray_traced_truth", "02_shadow_test", "09_ambient_occlusion"})
        for (const rlim_t megabytes : {64, 200, 400, 1000}) {
            SCOPED_TRACE(chapter + " with " + std::to_string(megabytes) + " MB");
            ProgramCall poor = call(chapter, {"--size", "64x64", "--output", "a.png"});
            poor.addressSpace = megabytes * megabyte;
            expectOneLine(runProgram(poor), 1, "not enough memory for this picture");
            EXPECT_FALSE(fs::exists(folder / "a.png"));
        }
    ProgramCall enough = call("02_shadow_test", {"--size", "64x64", "--output", "a.png"});
    enough.addressSpace = 1600 * megabyte + 128 * megabyte * std::thread::hardware_concurrency();
    expectSilence(runProgram(enough));
}

TEST_F(FaultsSlow, APictureThatTheMachineHasNoMemoryForIsRefused) {
    if (!mayMount())
        GTEST_SKIP() << "nothing can be mounted here (" << std::strerror(errno) << "): run as root";
    // Enough for what a container has left, too little for the picture with what the libraries take.
    writeFile(folder / "meminfo", "MemTotal: 9000000 kB\nMemAvailable: 1024000 kB\nSwapFree: 1024 kB\n");
    fs::create_directory(folder / "cgroup");
    writeFile(folder / "cgroup/memory.max", "2097152000");
    writeFile(folder / "cgroup/memory.current", "1048576000");
    writeFile(folder / "cgroup/memory.stat", "anon 1\ninactive_file 524288000\n");
    const auto expectRefused = [&](const std::string& free) {
        expectOneLine(runProgram(call("02_shadow_test", {"--size", "8192x8192", "--output", "new/a.png"})), 1,
                      "and " + free + " MB are free; use a smaller --size");
        EXPECT_FALSE(fs::exists(folder / "new"));
    };
    {
        const InPlaceOf machine("/proc/meminfo", folder / "meminfo");
        expectRefused("1001");
        expectSilence(runProgram(call("02_shadow_test", {"--size", "64x64", "--output", "a.png"})));
    }
    if (!fs::exists("/sys/fs/cgroup")) return;
    const InPlaceOf container("/sys/fs/cgroup", folder / "cgroup");
    expectRefused("1500");
}

TEST_F(FaultsSlow, WhatAPictureTakesIsNotMoreThanWasForeseen) {
    // Foreseen: of a picture that is refused, by how much more one of twice as many pixels would need.
    const auto foreseen = [&](const std::string& chapter, const std::string& size) {
        ProgramCall refused = call(chapter, {"--size", size, "--output", "a.png"});
        refused.addressSpace = 2000 * megabyte;
        const std::string said = runProgram(refused).err, before = "it needs about ";
        const std::size_t at = said.find(before);
        EXPECT_NE(at, std::string::npos) << said;
        return at == std::string::npos ? 0.0 : std::atof(said.c_str() + at + before.size());
    };
    const auto taken = [&](const std::string& chapter, const std::string& size, const Words& cheap) {
        ProgramCall of = call(chapter, {"--size", size, "--output", "a.exr"});
        of.arguments.insert(of.arguments.end(), cheap.begin(), cheap.end());
        std::replace(of.arguments.begin(), of.arguments.end(), std::string("triangle.gltf"),
                     std::string("contact"));  // which has what chapter 08 draws: an area light
        const ProgramResult drawn = runProgram(of);
        expectSilence(drawn);
        return drawn.megabytes;
    };
    const Words map{"--map-size", "256"}, two{"--samples", "2"}, disk{"--map-size", "256", "--samples", "8"};
    const std::vector<std::pair<std::string, Words>> chapters{{"00_ray_traced_truth", two},
                                                              {"01_depth_from_light", map},
                                                              {"02_shadow_test", map},
                                                              {"03_polygon_offset", map},
                                                              {"04_pcf", map},
                                                              {"05_jittered_disk", disk},
                                                              {"06_jitter_texture", disk},
                                                              {"07_branching", disk},
                                                              {"08_accumulation", two},
                                                              {"09_ambient_occlusion", two},
                                                              {"10_accumulated_occlusion", two},
                                                              {"11_bent_normals", two}};
    for (const auto& [chapter, cheap] : chapters) {
        const double promised =
            (foreseen(chapter, "16384x16384") - foreseen(chapter, "8192x16384")) / (8192.0 * 16384.0);
        const double measured = (taken(chapter, "768x768", cheap) - taken(chapter, "64x64", cheap)) /
                                (768.0 * 768.0 - 64.0 * 64.0);
        EXPECT_LE(measured, promised) << chapter << ": in megabytes a pixel";
        EXPECT_LT(promised, 2.0 * measured) << chapter << ": pictures are refused that would fit";
    }
}

TEST_F(FaultsSlow, ThePictureOfEightThousandPixelsASideIsTheSmallOneInMorePixels) {
    const auto visibility = [&](const std::string& size) {
        expectSilence(runProgram(call("03_polygon_offset", {"--size", size, "--view", "visibility",
                                                            "--report", "r.json", "--output", "a.png"})));
        return readImage(folder / "a.png");
    };
    const FloatImage small = visibility("1024x1024"), large = visibility("8192x8192");
    EXPECT_EQ(Json::parse(bytesOf(folder / "r.json"))["size"], Json::parse("[8192, 8192]"));
    ASSERT_EQ(large.width, 8192);
    ASSERT_EQ(large.height, 8192);
    int others = 0, lit = 0;
    for (int y = 0; y < 1024; ++y)
        for (int x = 0; x < 1024; ++x) {
            lit += small.at(x, y) > 0.5f;
            others += small.at(x, y) != large.at(8 * x + 4, 8 * y + 4);
        }
    EXPECT_GT(lit, 1024 * 1024 / 10) << "nothing to see";
    EXPECT_LT(lit, 1024 * 1024 * 9 / 10) << "nothing to see";
    EXPECT_LT(others, 1024 * 1024 / 100) << "along the edges alone";
}

TEST_F(FaultsSlow, ThePictureOfEightThousandPixelsASideIsRefusedUnderALimit) {
    ProgramCall poor = call("02_shadow_test", {"--size", "8192x8192", "--output", "new/a.png"});
    poor.addressSpace = 4000 * megabyte;
    expectOneLine(runProgram(poor), 1, "the limit of ulimit -v, 4000 MB, leaves ");
    EXPECT_FALSE(fs::exists(folder / "new"));
}

}  // namespace
}  // namespace penumbra
