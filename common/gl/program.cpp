#include "common/gl/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "common/error.h"
#include "common/gl/shader_source.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

struct TextureBinding {
    GLint unit = 0;
    GLenum target = GL_TEXTURE_2D;
    GLuint texture = 0;
};

using UniformValue =
    std::variant<int, float, bool, glm::vec2, glm::vec3, glm::vec4, glm::ivec2, glm::mat3, glm::mat4>;

struct Uniform {
    GLenum type = 0;
    GLint location = -1;  // -1: declared, but optimised away
    bool assigned = false;
};

void upload(GLint at, int v) {
    glUniform1i(at, v);
}
void upload(GLint at, float v) {
    glUniform1f(at, v);
}
void upload(GLint at, bool v) {
    glUniform1i(at, v ? 1 : 0);
}
void upload(GLint at, const glm::vec2& v) {
    glUniform2fv(at, 1, glm::value_ptr(v));
}
void upload(GLint at, const glm::vec3& v) {
    glUniform3fv(at, 1, glm::value_ptr(v));
}
void upload(GLint at, const glm::vec4& v) {
    glUniform4fv(at, 1, glm::value_ptr(v));
}
void upload(GLint at, const glm::ivec2& v) {
    glUniform2iv(at, 1, glm::value_ptr(v));
}
void upload(GLint at, const glm::mat3& v) {
    glUniformMatrix3fv(at, 1, GL_FALSE, glm::value_ptr(v));
}
void upload(GLint at, const glm::mat4& v) {
    glUniformMatrix4fv(at, 1, GL_FALSE, glm::value_ptr(v));
}

GLenum typeOf(const UniformValue& value) {
    static const GLenum types[] = {GL_INT,        GL_FLOAT,    GL_BOOL,       GL_FLOAT_VEC2, GL_FLOAT_VEC3,
                                   GL_FLOAT_VEC4, GL_INT_VEC2, GL_FLOAT_MAT3, GL_FLOAT_MAT4};
    return types[value.index()];
}

bool isSampler(GLenum type) {
    return std::string_view(glslTypeName(type)).find("sampler") != std::string_view::npos;
}

/// glUniform* acts on the program in use; the caller's must still be in use afterwards.
class InUse {
 public:
    explicit InUse(GLuint program) : program_(program) {
        glGetIntegerv(GL_CURRENT_PROGRAM, &before_);
        if (GLuint(before_) != program_) glUseProgram(program_);
    }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;
    ~InUse() {
        if (GLuint(before_) != program_) glUseProgram(GLuint(before_));
    }

 private:
    GLuint program_;
    GLint before_ = 0;
};

Api currentApi() {
    const std::string_view version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    return version.substr(0, 9) == "OpenGL ES" ? Api::es : Api::desktop;
}

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
    return log.c_str();
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, GLsizei(log.size()), nullptr, log.data());
    return log.c_str();
}

/// A shader or program that is deleted unless it is released.
struct ShaderGuard {
    GLuint id;
    explicit ShaderGuard(GLenum stage) : id(glCreateShader(stage)) {}
    ShaderGuard(const ShaderGuard&) = delete;
    ShaderGuard& operator=(const ShaderGuard&) = delete;
    ~ShaderGuard() { glDeleteShader(id); }
};
struct ProgramGuard {
    GLuint id = glCreateProgram();
    ProgramGuard() = default;
    ProgramGuard(const ProgramGuard&) = delete;
    ProgramGuard& operator=(const ProgramGuard&) = delete;
    ~ProgramGuard() { glDeleteProgram(id); }
    GLuint release() { return std::exchange(id, 0); }
};

void compile(const ShaderGuard& shader, const ShaderSource& source) {
    const char* text = source.text.c_str();
    glShaderSource(shader.id, 1, &text, nullptr);
    glCompileShader(shader.id);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id, GL_COMPILE_STATUS, &compiled);
    if (!compiled) throw Error(nameFilesInLog(shaderLog(shader.id), source.files));
}

}  // namespace

struct Program::State {
    std::string vertexFile;
    std::string fragmentFile;
    std::vector<std::string> defines;
    std::vector<fs::path> files;
    std::vector<fs::file_time_type> times;
    std::map<std::string, Uniform> uniforms;
    std::map<std::string, UniformValue> values;
    std::map<std::string, TextureBinding> textures;
    bool complete = false;  // every active uniform has been set

    std::string names() const { return vertexFile + " + " + fragmentFile; }

    /// Links, and on success replaces `uniforms`. `files` grows by what was opened, even on failure.
    GLuint build() {
        std::vector<fs::path> opened;
        try {
            const Api api = currentApi();
            const ShaderSource vertex = loadShaderSource(vertexFile, defines, api, opened);
            const ShaderSource fragment = loadShaderSource(fragmentFile, defines, api, opened);
            const GLuint program = link(vertex, fragment);
            watch(std::move(opened));
            return program;
        } catch (...) {
            opened.insert(opened.end(), files.begin(), files.end());
            watch(std::move(opened));
            throw;
        }
    }

    GLuint link(const ShaderSource& vertex, const ShaderSource& fragment) {
        const ShaderGuard vertexShader(GL_VERTEX_SHADER);
        compile(vertexShader, vertex);
        const ShaderGuard fragmentShader(GL_FRAGMENT_SHADER);
        compile(fragmentShader, fragment);
        ProgramGuard program;
        glAttachShader(program.id, vertexShader.id);
        glAttachShader(program.id, fragmentShader.id);
        glLinkProgram(program.id);
        GLint linked = GL_FALSE;
        glGetProgramiv(program.id, GL_LINK_STATUS, &linked);
        if (!linked) throw Error(names() + " do not link: " + nameFilesInLog(programLog(program.id), {}));
        findUniforms(program.id, vertex, fragment);
        return program.release();
    }

    void findUniforms(GLuint program, const ShaderSource& vertex, const ShaderSource& fragment) {
        uniforms.clear();
        complete = false;
        for (const ShaderSource* source : {&vertex, &fragment})
            for (const auto& [name, type] : declaredUniforms(source->text)) uniforms[name].type = type;
        GLint count = 0;
        glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
        for (GLint i = 0; i < count; ++i) {
            char name[256] = "";
            GLint size = 0;
            GLenum type = 0;
            glGetActiveUniform(program, GLuint(i), sizeof(name), nullptr, &size, &type, name);
            const GLint location = glGetUniformLocation(program, name);
            if (location < 0) continue;  // a member of a uniform block
            const std::string_view whole(name);
            Uniform& uniform = uniforms[std::string(whole.substr(0, whole.find('[')))];
            uniform.type = type;
            uniform.location = location;
        }
    }

    void watch(std::vector<fs::path> opened) {
        std::sort(opened.begin(), opened.end());
        opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
        files = std::move(opened);
        times.clear();
        for (const fs::path& file : files) times.push_back(timeOf(file));
    }

    static fs::file_time_type timeOf(const fs::path& file) {
        std::error_code missing;  // an editor may be replacing the file at this moment
        const auto time = fs::last_write_time(file, missing);
        return missing ? fs::file_time_type::min() : time;
    }

    Uniform& find(const std::string& name) {
        const auto it = uniforms.find(name);
        if (it != uniforms.end()) return it->second;
        throw Error(fmt::format("no uniform {} is declared in {}; check the spelling", name, names()));
    }

    void store(GLuint program, const std::string& name, const UniformValue& value) {
        Uniform& uniform = find(name);
        if (uniform.type != typeOf(value))
            throw Error(fmt::format("uniform {} of {} is a {}, but is set with a {}", name, names(),
                                    glslTypeName(uniform.type), glslTypeName(typeOf(value))));
        values[name] = value;
        uniform.assigned = true;
        if (uniform.location < 0) return;
        const InUse inUse(program);
        std::visit([&](const auto& v) { upload(uniform.location, v); }, value);
    }

    void storeTexture(GLuint program, const std::string& name, GLenum target, GLuint texture) {
        Uniform& uniform = find(name);
        if (!isSampler(uniform.type))
            throw Error(fmt::format("uniform {} of {} is a {}, not a sampler", name, names(),
                                    glslTypeName(uniform.type)));
        const auto [binding, isNew] = textures.try_emplace(name);
        if (isNew) binding->second.unit = GLint(textures.size()) - 1;
        binding->second.target = target;
        binding->second.texture = texture;
        if (!std::exchange(uniform.assigned, true) && uniform.location >= 0) {
            const InUse inUse(program);
            glUniform1i(uniform.location, binding->second.unit);
        }
    }

    /// After a reload: what was set is set again, as far as the new source still declares it with the same
    /// type.
    void restore(GLuint program) {
        for (const auto& [name, value] : std::map(values)) {
            const auto it = uniforms.find(name);
            if (it != uniforms.end() && it->second.type == typeOf(value)) store(program, name, value);
        }
        for (const auto& [name, binding] : std::map(textures)) {
            const auto it = uniforms.find(name);
            if (it != uniforms.end() && isSampler(it->second.type))
                storeTexture(program, name, binding.target, binding.texture);
        }
    }

    void requireComplete() {
        std::string missing;
        for (const auto& [name, uniform] : uniforms)
            if (uniform.location >= 0 && !uniform.assigned) missing += " " + name;
        if (!missing.empty())
            throw Error(fmt::format("{} would draw with uniforms that were never set:{}", names(), missing));
        complete = true;
    }
};

Program::Program(const std::string& vertexFile, const std::string& fragmentFile,
                 std::vector<std::string> defines)
    : state_(std::make_unique<State>()) {
    state_->vertexFile = vertexFile;
    state_->fragmentFile = fragmentFile;
    state_->defines = std::move(defines);
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
    if (id_ != 0) glDeleteProgram(id_);
}

void Program::use() {
    glUseProgram(id_);
}

void Program::set(const std::string& name, int value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, float value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, bool value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, const glm::vec2& value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, const glm::vec3& value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, const glm::vec4& value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, const glm::ivec2& value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, const glm::mat3& value) {
    state_->store(id_, name, value);
}
void Program::set(const std::string& name, const glm::mat4& value) {
    state_->store(id_, name, value);
}

void Program::setTexture(const std::string& sampler, GLenum target, GLuint texture) {
    state_->storeTexture(id_, sampler, target, texture);
}

void Program::prepareToDraw() {
    if (!state_->complete) state_->requireComplete();
    use();
    for (const auto& [name, binding] : state_->textures) {
        glActiveTexture(GLenum(GL_TEXTURE0 + binding.unit));
        glBindTexture(binding.target, binding.texture);
    }
    if (!state_->textures.empty()) glActiveTexture(GL_TEXTURE0);
}

bool Program::sourcesChanged() const {
    for (std::size_t i = 0; i < state_->files.size(); ++i) {
        const auto time = State::timeOf(state_->files[i]);
        if (time != state_->times[i] && time != fs::file_time_type::min()) return true;
    }
    return false;
}

std::string Program::reload() {
    try {
        const GLuint program = state_->build();
        glDeleteProgram(std::exchange(id_, program));
        state_->restore(id_);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

const std::vector<std::filesystem::path>& Program::sourceFiles() const {
    return state_->files;
}

}  // namespace penumbra
