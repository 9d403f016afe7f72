#include "common/gl/program.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/error.h"
#include "common/gl/program_link.h"
#include "common/gl/program_uniforms.h"
#include "common/gl/shader_source.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

fs::file_time_type timeOf(const fs::path& file) {
    std::error_code missing;  // an editor may be replacing the file at this moment
    const auto time = fs::last_write_time(file, missing);
    return missing ? fs::file_time_type::min() : time;
}

/// A program deleted while in use would live on until another is used; putting it back into use then fails.
void deleteProgram(GLuint id) {
    GLint current = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &current);
    if (GLuint(current) == id) glUseProgram(0);
    glDeleteProgram(id);
}

}  // namespace

struct Program::State {
    std::string vertexFile;
    std::string fragmentFile;
    std::vector<std::string> defines;
    ProgramUniforms uniforms{vertexFile + " + " + fragmentFile};
    std::vector<fs::path> files{};
    std::vector<fs::file_time_type> times{};  // of `files`, when they were read
    std::vector<std::string> fixed{};
    std::map<std::string, std::string> constants{};  // of `fixed`, as compiled

    /// The values that the fixed uniforms have now, in GLSL; those never set are left out.
    std::map<std::string, std::string> fixedValues() const {
        std::map<std::string, std::string> values;
        for (const std::string& name : fixed) {
            const std::string value = uniforms.literal(name);
            if (!value.empty()) values[name] = value;
        }
        return values;
    }

    /// The same as build() if one of the fixed uniforms has another value than it was compiled with. When
    /// that throws, the next draw tries again.
    std::optional<GLuint> buildIfChanged() {
        const auto before = std::exchange(constants, fixedValues());
        if (constants == before) return std::nullopt;
        try {
            return build();
        } catch (...) {
            constants = before;
            throw;
        }
    }

    /// A new program to which the uniforms are attached. When it throws, the uniforms stay with the old one,
    /// and what was opened is watched besides what was watched before.
    GLuint build() {
        std::vector<fs::path> opened;
        try {
            const Api api = currentApi();
            const ShaderSource vertex = loadShaderSource(vertexFile, defines, api, opened, constants);
            const ShaderSource fragment = loadShaderSource(fragmentFile, defines, api, opened, constants);
            const GLuint program = linkProgram(vertex, fragment, vertexFile + " + " + fragmentFile);
            auto declared = declaredUniforms(vertex.text);
            declared.merge(declaredUniforms(fragment.text));
            declared.insert(vertex.constants.begin(), vertex.constants.end());
            declared.insert(fragment.constants.begin(), fragment.constants.end());
            uniforms.attach(program, declared);
            watch(std::move(opened));
            return program;
        } catch (...) {
            opened.insert(opened.end(), files.begin(), files.end());
            watch(std::move(opened));
            throw;
        }
    }

    void watch(std::vector<fs::path> opened) {
        std::sort(opened.begin(), opened.end());
        opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
        files = std::move(opened);
        times.clear();
        for (const fs::path& file : files) times.push_back(timeOf(file));
    }
};

Program::Program(const std::string& vertexFile, const std::string& fragmentFile,
                 std::vector<std::string> defines)
    : state_(new State{vertexFile, fragmentFile, std::move(defines)}) {
    id_ = state_->build();
}

Program::Program(Program&& other) noexcept
    : id_(std::exchange(other.id_, 0)), state_(std::move(other.state_)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(state_, other.state_);
    return *this;
}

Program::~Program() {
    if (id_ != 0) deleteProgram(id_);
}

void Program::use() {
    glUseProgram(id_);
}

void Program::set(const std::string& name, int value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, float value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, bool value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, const glm::vec2& value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, const glm::vec3& value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, const glm::vec4& value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, const glm::ivec2& value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, const glm::mat3& value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, const glm::mat4& value) {
    state_->uniforms.set(name, value);
}
void Program::set(const std::string& name, const std::vector<glm::vec4>& values) {
    state_->uniforms.set(name, values);
}

void Program::setTexture(const std::string& sampler, GLenum target, GLuint texture, GLuint samplerObject) {
    state_->uniforms.setTexture(sampler, target, texture, samplerObject);
}

void Program::fix(std::vector<std::string> names) {
    state_->fixed = std::move(names);
}

void Program::prepareToDraw() {
    if (const auto built = state_->buildIfChanged()) deleteProgram(std::exchange(id_, *built));
    state_->uniforms.requireComplete();
    use();
    state_->uniforms.bindTextures();
}

bool Program::sourcesChanged() const {
    for (std::size_t i = 0; i < state_->files.size(); ++i) {
        const auto time = timeOf(state_->files[i]);
        if (time != state_->times[i] && time != fs::file_time_type::min()) return true;
    }
    return false;
}

std::string Program::reload() {
    try {
        deleteProgram(std::exchange(id_, state_->build()));
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

const std::vector<std::filesystem::path>& Program::sourceFiles() const {
    return state_->files;
}

}  // namespace penumbra
