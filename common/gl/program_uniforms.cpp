#include "common/gl/program_uniforms.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>
#include <string_view>
#include <utility>

#include "common/error.h"
#include "common/gl/shader_source.h"

namespace penumbra {
namespace {

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
void upload(GLint at, const std::vector<glm::vec4>& v) {
    if (!v.empty()) glUniform4fv(at, GLsizei(v.size()), glm::value_ptr(v.front()));
}

GLenum typeOf(const UniformValue& value) {
    static const GLenum types[] = {GL_INT,        GL_FLOAT,    GL_BOOL,       GL_FLOAT_VEC2, GL_FLOAT_VEC3,
                                   GL_FLOAT_VEC4, GL_INT_VEC2, GL_FLOAT_MAT3, GL_FLOAT_MAT4, GL_FLOAT_VEC4};
    return types[value.index()];
}

bool isSampler(GLenum type) {
    return glslTypeName(type).find("sampler") != std::string::npos;
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

}  // namespace

void ProgramUniforms::attach(GLuint program, const std::map<std::string, GLenum>& declared) {
    program_ = program;
    complete_ = false;
    uniforms_.clear();
    for (const auto& [name, type] : declared) uniforms_[name].type = type;
    findActive();
    setAgain();
}

void ProgramUniforms::findActive() {
    GLint count = 0;
    glGetProgramiv(program_, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        char name[256] = "";
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(program_, GLuint(i), sizeof(name), nullptr, &size, &type, name);
        const GLint location = glGetUniformLocation(program_, name);
        if (location < 0) continue;  // a member of a uniform block
        const std::string_view whole(name);
        Uniform& uniform = uniforms_[std::string(whole.substr(0, whole.find('[')))];
        uniform.type = type;
        uniform.location = location;
    }
}

void ProgramUniforms::setAgain() {
    for (const auto& [name, value] : std::map(values_)) {
        const auto it = uniforms_.find(name);
        if (it != uniforms_.end() && it->second.type == typeOf(value)) set(name, value);
    }
    for (const auto& [name, binding] : std::map(bindings_)) {
        const auto it = uniforms_.find(name);
        if (it != uniforms_.end() && isSampler(it->second.type))
            setTexture(name, binding.target, binding.texture, binding.samplerObject);
    }
}

ProgramUniforms::Uniform& ProgramUniforms::find(const std::string& name) {
    const auto it = uniforms_.find(name);
    if (it != uniforms_.end()) return it->second;
    throw Error(fmt::format("no uniform {} is declared in {}; check the spelling", name, names_));
}

void ProgramUniforms::set(const std::string& name, const UniformValue& value) {
    Uniform& uniform = find(name);
    if (uniform.type != typeOf(value))
        throw Error(fmt::format("uniform {} of {} is a {}, but is set with a {}", name, names_,
                                glslTypeName(uniform.type), glslTypeName(typeOf(value))));
    values_[name] = value;
    uniform.assigned = true;
    if (uniform.location < 0) return;
    const InUse inUse(program_);
    std::visit([&](const auto& v) { upload(uniform.location, v); }, value);
}

void ProgramUniforms::setTexture(const std::string& sampler, GLenum target, GLuint texture,
                                 GLuint samplerObject) {
    Uniform& uniform = find(sampler);
    if (!isSampler(uniform.type))
        throw Error(fmt::format("uniform {} of {} is a {}, not a sampler", sampler, names_,
                                glslTypeName(uniform.type)));
    const auto [binding, isNew] = bindings_.try_emplace(sampler);
    if (isNew) binding->second.unit = GLint(bindings_.size()) - 1;
    binding->second.target = target;
    binding->second.texture = texture;
    binding->second.samplerObject = samplerObject;
    if (std::exchange(uniform.assigned, true) || uniform.location < 0) return;
    const InUse inUse(program_);
    glUniform1i(uniform.location, binding->second.unit);
}

void ProgramUniforms::requireComplete() {
    if (complete_) return;
    std::string missing;
    for (const auto& [name, uniform] : uniforms_)
        if (uniform.location >= 0 && !uniform.assigned) missing += " " + name;
    if (!missing.empty())
        throw Error(fmt::format("{} would draw with uniforms that were never set:{}", names_, missing));
    complete_ = true;
}

std::string ProgramUniforms::literal(const std::string& name) const {
    const auto value = values_.find(name);
    if (value == values_.end()) return {};
    if (const int* number = std::get_if<int>(&value->second)) return fmt::format("{}", *number);
    if (const bool* truth = std::get_if<bool>(&value->second)) return *truth ? "true" : "false";
    // Nine digits tell any two floats apart.
    if (const auto* pair = std::get_if<glm::vec2>(&value->second))
        return fmt::format("vec2({:.9g}, {:.9g})", pair->x, pair->y);
    if (const float* number = std::get_if<float>(&value->second))
        return fmt::format("float({:.9g})", *number);
    throw Error(
        fmt::format("uniform {} of {} is no number, truth value or vec2: it cannot be fixed", name, names_));
}

void ProgramUniforms::bindTextures() const {
    for (const auto& [name, binding] : bindings_) {
        glActiveTexture(GLenum(GL_TEXTURE0 + binding.unit));
        glBindTexture(binding.target, binding.texture);
        glBindSampler(GLuint(binding.unit), binding.samplerObject);
    }
    if (!bindings_.empty()) glActiveTexture(GL_TEXTURE0);
}

}  // namespace penumbra
