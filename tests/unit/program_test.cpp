// Programs: includes, the file and line in errors, and uniforms that cannot be forgotten.
#include "common/gl/program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/error.h"
#include "common/gl/fullscreen.h"
#include "common/gl/render_target.h"
#include "common/gl/shader_source.h"
#include "tests/unit/gl_contexts.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

/// A shader root of its own, in a temporary folder.
class ShaderFolder {
 public:
    ShaderFolder() {
        char pattern[] = "/tmp/penumbra_shaders_XXXXXX";
        root_ = fs::path(mkdtemp(pattern)) / "shaders";
        fs::create_directories(root_ / "common");
        setenv("PENUMBRA_SHADERS", root_.c_str(), 1);
        write("full.vert",
              "void main() {\n"
              "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, "
              "1.0);\n"
              "}\n");
    }
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;
    ~ShaderFolder() {
        unsetenv("PENUMBRA_SHADERS");
        fs::remove_all(root_.parent_path());
    }
    void write(const std::string& name, const std::string& text) {
        std::ofstream(root_ / name) << text;
        touch(name);
    }
    void touch(const std::string& name) {
        // File times are coarse; each write must be seen as newer than the last.
        fs::last_write_time(root_ / name, fs::file_time_type::clock::now() + std::chrono::seconds(++writes_));
    }
    void remove(const std::string& name) { fs::remove(root_ / name); }

 private:
    fs::path root_;
    int writes_ = 0;
};

template <class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string compileError(const std::string& fragment, std::vector<std::string> defines = {}) {
    return errorOf([&] { Program("full.vert", fragment, defines); });
}

#define EXPECT_CONTAINS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

class ProgramTest : public ContextTest {
 protected:
    glm::vec4 draw(Program& program) {
        RenderTarget target({1, 1}, capabilities());
        target.bind();
        program.prepareToDraw();
        FullscreenTriangle().draw();
        const FloatImage image = target.read(4);
        checkGlErrors("drawing in a test");
        return {image.at(0, 0, 0), image.at(0, 0, 1), image.at(0, 0, 2), image.at(0, 0, 3)};
    }
    ShaderFolder shaders_;
};

TEST_P(ProgramTest, AnErrorNamesFileAndLine) {
    shaders_.write("bad.frag", "out vec4 color;\n\nvoid main() {\n    color = vec4(missing);\n}\n");
    EXPECT_CONTAINS(compileError("bad.frag"), "shaders/bad.frag:4: ");
    EXPECT_CONTAINS(compileError("bad.frag", {"SOMETHING 3"}), "shaders/bad.frag:4: ");
}

TEST_P(ProgramTest, AnErrorInOrAfterAnIncludeNamesTheRightFileAndLine) {
    shaders_.write("common/fine.glsl", "float one() {\n    return 1.0;\n}\n");
    shaders_.write("common/bad.glsl",
                   "#include \"common/fine.glsl\"\nfloat two() {\n    return one() + ghost;\n}\n");
    shaders_.write("in.frag",
                   "out vec4 color;\n#include \"common/bad.glsl\"\nvoid main() { color = vec4(two()); }\n");
    EXPECT_CONTAINS(compileError("in.frag"), "shaders/common/bad.glsl:3: ");
    shaders_.write(
        "after.frag",
        "out vec4 color;\n#include \"common/fine.glsl\"\n\nvoid main() {\n    color = vec4(ghost);\n}\n");
    EXPECT_CONTAINS(compileError("after.frag"), "shaders/after.frag:5: ");
}

TEST_P(ProgramTest, AMissingFileNamesTheIncluder) {
    shaders_.write("a.frag", "out vec4 color;\n#include \"common/gone.glsl\"\nvoid main() {}\n");
    const std::string message = compileError("a.frag");
    EXPECT_CONTAINS(message, "shaders/a.frag:2: ");
    EXPECT_CONTAINS(message, "shaders/common/gone.glsl");
    EXPECT_CONTAINS(compileError("nowhere.frag"), "no shader file shaders/nowhere.frag");
    EXPECT_CONTAINS(compileError("common"), "no shader file shaders/common");
}

TEST_P(ProgramTest, AnIncludeCycleIsSpelledOut) {
    shaders_.write("common/a.glsl", "#include \"common/b.glsl\"\n");
    shaders_.write("common/b.glsl", "#include \"common/a.glsl\"\n");
    shaders_.write("cycle.frag", "#include \"common/a.glsl\"\nvoid main() {}\n");
    EXPECT_CONTAINS(compileError("cycle.frag"),
                    "shaders/common/a.glsl -> shaders/common/b.glsl -> shaders/common/a.glsl");
}

TEST_P(ProgramTest, AFileIsIncludedOnce) {
    shaders_.write("common/one.glsl", "float one() { return 1.0; }\n");
    shaders_.write("common/two.glsl",
                   "#include \"common/one.glsl\"\nfloat two() { return one() + one(); }\n");
    shaders_.write("ok.frag",
                   "#include \"common/one.glsl\"\n#include \"common/two.glsl\"  // twice\nout vec4 color;\n"
                   "void main() { color = vec4(one(), two(), 0.0, 1.0); }\n");
    Program program("full.vert", "ok.frag");
    EXPECT_EQ(draw(program), glm::vec4(1.0f, 2.0f, 0.0f, 1.0f));
    EXPECT_EQ(program.sourceFiles().size(), 4u);
    shaders_.write("also.vert", "#include \"common/one.glsl\"\nvoid main() { gl_Position = vec4(one()); }\n");
    EXPECT_EQ(Program("also.vert", "ok.frag").sourceFiles().size(), 4u) << "watched once, used by two stages";
}

TEST_P(ProgramTest, DefinesReachBothStages) {
    shaders_.write("d.frag", "out vec4 color;\nvoid main() { color = vec4(float(TAPS), 0.0, 0.0, 1.0); }\n");
    EXPECT_NE(compileError("d.frag"), "");
    Program program("full.vert", "d.frag", {"TAPS 16", "UNUSED"});
    EXPECT_EQ(draw(program).x, 16.0f);
    shaders_.write("none.vert", "void main() { gl_Position = vec4(float(TAPS)); }\n");
    EXPECT_NE(errorOf([] { Program("none.vert", "d.frag"); }), "");
    EXPECT_EQ(errorOf([] { Program("none.vert", "d.frag", {"TAPS 16"}); }), "");
}

TEST_P(ProgramTest, EveryTypeOfUniformArrives) {
    shaders_.write(
        "u.frag",
        "uniform int uInt;\nuniform float uFloat; uniform bool uBool;\nuniform vec2 uVec2;\n"
        "uniform vec3 uVec3;\nuniform highp vec4 uVec4;\nuniform ivec2 uIvec2;\nuniform mat3 uMat3;\n"
        "uniform mat4 uMat4;\nout vec4 color;\nvoid main() {\n"
        "    color = vec4(float(uInt) + uFloat + (uBool ? 1.0 : 0.0), uVec2.y + uVec3.z + uVec4.w,\n"
        "                 float(uIvec2.y) + uMat3[2].y, uMat4[3].x);\n}\n");
    Program program("full.vert", "u.frag");
    program.set("uInt", 2);
    program.set("uFloat", 0.5f);
    program.set("uBool", true);
    program.set("uVec2", glm::vec2(0, 1));
    program.set("uVec3", glm::vec3(0, 0, 2));
    program.set("uVec4", glm::vec4(0, 0, 0, 4));
    program.set("uIvec2", glm::ivec2(0, 8));
    glm::mat3 m3(0.0f);
    m3[2][1] = 16.0f;
    program.set("uMat3", m3);
    glm::mat4 m4(0.0f);
    m4[3][0] = 32.0f;
    program.set("uMat4", m4);
    EXPECT_EQ(draw(program), glm::vec4(3.5f, 7.0f, 24.0f, 32.0f));
}

TEST_P(ProgramTest, AFixedUniformIsAConstantAndFollowsItsValue) {
    shaders_.write("u.frag",
                   "uniform float uFloat;\nout vec4 color;\nvoid main() { color = vec4(uFloat); }\n");
    Program program("full.vert", "u.frag");
    program.fix({"uFloat"});
    EXPECT_CONTAINS(errorOf([&] { program.prepareToDraw(); }), "never set: uFloat");
    for (const float value : {0.1f, 3.0f, -1e-30f, 16777217.0f}) {
        program.set("uFloat", value);
        EXPECT_EQ(draw(program).x, value);
        EXPECT_EQ(glGetUniformLocation(program.id(), "uFloat"), -1);
    }
    EXPECT_EQ(program.reload(), "");
    EXPECT_EQ(draw(program).x, 16777217.0f);
    program.fix({});
    EXPECT_EQ(draw(program).x, 16777217.0f);
    EXPECT_NE(glGetUniformLocation(program.id(), "uFloat"), -1);
}

TEST_P(ProgramTest, FixedUniformsOfEveryTypeAndOfIncludes) {
    shaders_.write("common/f.glsl", "uniform bool uBool;  // of an include\nuniform vec2 uVec2;\n");
    shaders_.write("f.frag",
                   "#include \"common/f.glsl\"\nuniform int uInt;\nuniform vec3 uVec3;\nout vec4 color;\n"
                   "void main() { color = vec4(uBool ? float(uInt) : -1.0, uVec2, uVec3.x); }\n");
    Program program("full.vert", "f.frag");
    program.set("uBool", true);
    program.set("uInt", 7);
    program.set("uVec2", glm::vec2(0.3f, 2.0f));
    program.set("uVec3", glm::vec3(5.0f));
    program.fix({"uBool", "uInt", "uVec2"});
    EXPECT_EQ(draw(program), glm::vec4(7.0f, 0.3f, 2.0f, 5.0f));
    for (const char* name : {"uBool", "uInt", "uVec2"})
        EXPECT_EQ(glGetUniformLocation(program.id(), name), -1) << name;
    program.set("uBool", false);
    EXPECT_EQ(draw(program).x, -1.0f);
    EXPECT_CONTAINS(errorOf([&] { program.set("uInt", 1.0f); }), "is a int, but is set with a float");
    program.fix({"uVec3"});
    EXPECT_CONTAINS(errorOf([&] { program.prepareToDraw(); }), "cannot be fixed");
}

TEST_P(ProgramTest, ArraysArriveFromTheirFirstElement) {
    shaders_.write("u.frag",
                   "uniform vec4 uPoints[3];\nout vec4 color;\n"
                   "void main() { color = uPoints[0] + 10.0 * uPoints[1] + 100.0 * uPoints[2]; }\n");
    Program program("full.vert", "u.frag");
    program.set("uPoints", std::vector<glm::vec4>(3, glm::vec4(1.0f)));
    EXPECT_EQ(draw(program), glm::vec4(111.0f));
    program.set("uPoints", std::vector<glm::vec4>{glm::vec4(2.0f), glm::vec4(3.0f)});
    EXPECT_EQ(draw(program), glm::vec4(132.0f)) << "the last keeps its value";
    EXPECT_NE(errorOf([&] { program.set("uPoints", 1.0f); }), "");
}

TEST_P(ProgramTest, UniformMistakesAreErrors) {
    shaders_.write("u.frag",
                   "uniform float uUsed;\nuniform vec3 uUnused, uAlsoUnused;\n// uniform float uCommented;\n"
                   "/* uniform float uCommentedToo; */ uniform sampler2D uMap;\nout vec4 color;\n"
                   "void main() { color = vec4(uUsed) + texture(uMap, vec2(0.5)); }\n");
    Program program("full.vert", "u.frag");
    EXPECT_CONTAINS(errorOf([&] { program.set("uUsd", 1.0f); }),
                    "no uniform uUsd is declared in full.vert + u.frag");
    EXPECT_NE(errorOf([&] { program.set("uCommented", 1.0f); }), "");
    EXPECT_NE(errorOf([&] { program.set("uCommentedToo", 1.0f); }), "");
    EXPECT_CONTAINS(errorOf([&] { program.set("uUsed", 1); }),
                    "uUsed of full.vert + u.frag is a float, but is set with a int");
    EXPECT_NE(errorOf([&] { program.set("uUnused", 1.0f); }), "")
        << "the type counts also where it is optimised away";
    EXPECT_CONTAINS(errorOf([&] { program.setTexture("uUsed", GL_TEXTURE_2D, 0); }), "not a sampler");
    EXPECT_NE(errorOf([&] { program.set("uMap", 0); }), "");
    EXPECT_CONTAINS(errorOf([&] { program.prepareToDraw(); }), "never set: uMap uUsed");
    program.set("uUsed", 0.25f);
    program.set("uAlsoUnused", glm::vec3(0.0f));
    EXPECT_CONTAINS(errorOf([&] { program.prepareToDraw(); }), "never set: uMap");
    RenderTarget map({1, 1}, capabilities());
    map.bind();
    glClearColor(0.5f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    program.setTexture("uMap", GL_TEXTURE_2D, map.colorTexture());
    EXPECT_EQ(draw(program).x, 0.75f);
}

TEST_P(ProgramTest, AnArrayGoesByItsName) {
    shaders_.write("a.frag",
                   "uniform float uWeights[2];\nout vec4 color;\n"
                   "void main() { color = vec4(uWeights[0] + uWeights[1]); }\n");
    Program program("full.vert", "a.frag");
    EXPECT_EQ(errorOf([&] { program.prepareToDraw(); }),
              "full.vert + a.frag would draw with uniforms that were never set: uWeights");
    program.set("uWeights", 2.0f);
    EXPECT_EQ(draw(program).x, 2.0f);
}

TEST_P(ProgramTest, TexturesOfOneProgramGetUnitsOfTheirOwn) {
    shaders_.write("t.frag",
                   "uniform sampler2D uA;\nuniform sampler2D uB;\nout vec4 color;\n"
                   "void main() { color = texture(uA, vec2(0.5)) + 10.0 * texture(uB, vec2(0.5)); }\n");
    RenderTarget a({1, 1}, capabilities());
    a.bind();
    glClearColor(1.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    RenderTarget b({1, 1}, capabilities());
    b.bind();
    glClearColor(2.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    Program program("full.vert", "t.frag");
    program.setTexture("uB", GL_TEXTURE_2D, b.colorTexture());
    program.setTexture("uA", GL_TEXTURE_2D, a.colorTexture());
    EXPECT_EQ(draw(program).x, 21.0f);
    program.setTexture("uA", GL_TEXTURE_2D, b.colorTexture());
    EXPECT_EQ(draw(program).x, 22.0f);
    Program other("full.vert", "t.frag");
    other.setTexture("uA", GL_TEXTURE_2D, a.colorTexture());
    other.setTexture("uB", GL_TEXTURE_2D, b.colorTexture());
    other.prepareToDraw();
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    EXPECT_EQ(active, GL_TEXTURE0) << "the caller's next glBindTexture must not take a unit of the program";
}

TEST_P(ProgramTest, ASamplerObjectCountsForItsOwnTextureOnly) {
    shaders_.write("t.frag",
                   "uniform sampler2D uMap;\nout vec4 color;\n"
                   "void main() { color = texture(uMap, vec2(0.5, 0.5)); }\n");
    const GlTexture map;  // black and white side by side: the middle is one of them, or grey
    const std::uint8_t texels[] = {0, 0, 0, 255, 255, 255, 255, 255};
    glBindTexture(GL_TEXTURE_2D, map.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const GlSampler linear;
    glSamplerParameteri(linear.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(linear.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    Program filtered("full.vert", "t.frag"), plain("full.vert", "t.frag");
    filtered.setTexture("uMap", GL_TEXTURE_2D, map.id(), linear.id());
    plain.setTexture("uMap", GL_TEXTURE_2D, map.id());
    EXPECT_NEAR(draw(filtered).x, 0.5f, 0.01f);
    const float own = draw(plain).x;
    EXPECT_TRUE(own == 0.0f || own == 1.0f) << "the sampler object is still bound";
    EXPECT_EQ(filtered.reload(), "");
    EXPECT_NEAR(draw(filtered).x, 0.5f, 0.01f) << "reload forgot the sampler object";
}

TEST_P(ProgramTest, SettingLeavesTheProgramInUseAlone) {
    shaders_.write("u.frag", "uniform float uX;\nout vec4 color;\nvoid main() { color = vec4(uX); }\n");
    Program first("full.vert", "u.frag");
    Program second("full.vert", "u.frag");
    first.use();
    second.set("uX", 1.0f);
    GLint current = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &current);
    EXPECT_EQ(GLuint(current), first.id());
    Program("full.vert", "u.frag").use();  // and is deleted while in use
    second.set("uX", 2.0f);
    EXPECT_NO_THROW(checkGlErrors("setting a uniform after the program in use is gone"));
}

TEST_P(ProgramTest, ReloadKeepsTheLastGoodProgramAndItsValues) {
    shaders_.write("common/part.glsl", "float part() { return 1.0; }\n");
    const std::string body =
        "#include \"common/part.glsl\"\nuniform float uX;\nout vec4 color;\nvoid main() { color = vec4(uX * "
        "part()); }\n";
    shaders_.write("r.frag", body);
    Program program("full.vert", "r.frag");
    program.set("uX", 3.0f);
    EXPECT_EQ(draw(program).x, 3.0f);
    EXPECT_FALSE(program.sourcesChanged());

    shaders_.write("common/part.glsl", "float part() { return 2.0 }\n");
    EXPECT_TRUE(program.sourcesChanged());
    EXPECT_CONTAINS(program.reload(), "shaders/common/part.glsl:1: ");
    EXPECT_FALSE(program.sourcesChanged()) << "an error is reported once, not every frame";
    EXPECT_EQ(draw(program).x, 3.0f);

    shaders_.write("common/part.glsl", "float part() { return 2.0; }\n");
    EXPECT_TRUE(program.sourcesChanged());
    EXPECT_EQ(program.reload(), "");
    EXPECT_EQ(draw(program).x, 6.0f);

    shaders_.write("r.frag", "#include \"common/new.glsl\"\n" + body);
    EXPECT_CONTAINS(program.reload(), "no shader file shaders/common/new.glsl");
    shaders_.write("common/new.glsl", "\n");
    EXPECT_TRUE(program.sourcesChanged()) << "the missing file is watched too";
    EXPECT_EQ(program.reload(), "");
    EXPECT_EQ(draw(program).x, 6.0f);

    for (const char* name : {"full.vert", "r.frag", "common/part.glsl", "common/new.glsl"}) {
        shaders_.touch(name);
        EXPECT_TRUE(program.sourcesChanged()) << name;
        EXPECT_EQ(program.reload(), "");
        EXPECT_FALSE(program.sourcesChanged()) << name;
    }
    shaders_.write("r.frag", "#include \"common/gone.glsl\"\n" + body);
    EXPECT_CONTAINS(program.reload(), "no shader file shaders/common/gone.glsl");
    shaders_.touch("common/part.glsl");
    EXPECT_TRUE(program.sourcesChanged()) << "what lies behind the error is watched still";
    shaders_.write("r.frag", "#include \"common/new.glsl\"\n" + body);
    EXPECT_EQ(program.reload(), "");

    shaders_.write("r.frag", "uniform float uNew;\n#include \"common/new.glsl\"\n" + body + "// uNew\n");
    EXPECT_EQ(program.reload(), "");
    EXPECT_EQ(errorOf([&] { program.prepareToDraw(); }), "") << "declared, and not used";
    shaders_.write("common/part.glsl", "float part() { return 2.0 + uNew; }\n");
    shaders_.write("r.frag", "uniform float uNew;\n#include \"common/new.glsl\"\n" + body);
    EXPECT_EQ(program.reload(), "");
    EXPECT_CONTAINS(errorOf([&] { program.prepareToDraw(); }), "never set: uNew");

    shaders_.remove("common/new.glsl");
    EXPECT_FALSE(program.sourcesChanged()) << "an editor is replacing the file: wait for the new one";
}

TEST_P(ProgramTest, StagesThatDisagreeAreNamed) {
    shaders_.write("l.vert",
                   "out vec2 vUv;\nvoid main() {\n    vUv = vec2(0.0);\n    gl_Position = vec4(0.0);\n}\n");
    shaders_.write("l.frag", "in vec3 vUv;\nout vec4 color;\nvoid main() { color = vec4(vUv, 1.0); }\n");
    EXPECT_CONTAINS(errorOf([] { Program("l.vert", "l.frag"); }), "l.vert + l.frag do not link");
}

TEST_P(ProgramTest, Moves) {
    shaders_.write("m.frag", "out vec4 color;\nvoid main() { color = vec4(7.0); }\n");
    Program first("full.vert", "m.frag");
    Program second(std::move(first));
    EXPECT_EQ(draw(second).x, 7.0f);
    EXPECT_EQ(first.id(), 0u);  // NOLINT(bugprone-use-after-move): that it is empty is what is tested
}

INSTANTIATE_TEST_SUITE_P(Backends, ProgramTest, allContextKinds(), contextKindName);

TEST(ShaderLog, NotationsOfTheDrivers) {
    const std::vector<std::string> files{"shaders/a.frag", "shaders/b.glsl"};
    EXPECT_EQ(nameFilesInLog("1:12(5): error: `x' undeclared", files),
              "shaders/b.glsl:12: error: `x' undeclared");
    EXPECT_EQ(nameFilesInLog("ERROR: 0:3: 'x' : undeclared\n", files),
              "shaders/a.frag:3: ERROR: 'x' : undeclared");
    EXPECT_EQ(nameFilesInLog("1(7) : error C1503: undefined", files),
              "shaders/b.glsl:7: error C1503: undefined");
    EXPECT_EQ(nameFilesInLog("something else\n\n9:1: no such file", files),
              "something else\n9:1: no such file");
}

TEST(ShaderSource, InEsEverySamplerIsGivenFullPrecision) {
    // Most samplers have no default precision there: strict drivers refuse the shader, others use 16 bits.
    const ShaderFolder shaders;
    std::vector<fs::path> opened;
    const std::string text = loadShaderSource("full.vert", {}, Api::es, opened).text;
    EXPECT_EQ(text.rfind("#version 300 es\n", 0), 0u);
    for (const GLenum type :
         {GL_SAMPLER_2D, GL_SAMPLER_3D, GL_SAMPLER_CUBE, GL_SAMPLER_2D_ARRAY, GL_SAMPLER_2D_SHADOW,
          GL_SAMPLER_CUBE_SHADOW, GL_SAMPLER_2D_ARRAY_SHADOW, GL_INT_SAMPLER_2D, GL_UNSIGNED_INT_SAMPLER_2D,
          GL_UNSIGNED_INT_SAMPLER_3D, GL_FLOAT, GL_INT})
        EXPECT_CONTAINS(text, "precision highp " + glslTypeName(type) + ";\n");
}

TEST(ShaderSource, UniformsAreFoundWhateverTheLayout) {
    const auto uniforms = declaredUniforms(
        "uniform float uA;\n  uniform   mediump vec3 uB , uC[4];\nuniform\nmat4 uD; uniform Block { float "
        "inside; };\n"
        "layout(std140) uniform Other { vec4 alsoInside; } other;\nuniform highp sampler2DShadow uMap;\n");
    const std::map<std::string, GLenum> expected{{"uA", GL_FLOAT},
                                                 {"uB", GL_FLOAT_VEC3},
                                                 {"uC", GL_FLOAT_VEC3},
                                                 {"uD", GL_FLOAT_MAT4},
                                                 {"uMap", GL_SAMPLER_2D_SHADOW}};
    EXPECT_EQ(uniforms, expected);
}

}  // namespace
}  // namespace penumbra
