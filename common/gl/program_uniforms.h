// The uniforms of one program, none of them silent; private to common/gl.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "common/gl/gl.h"

namespace penumbra {

using UniformValue = std::variant<int, float, bool, glm::vec2, glm::vec3, glm::vec4, glm::ivec2, glm::mat3,
                                  glm::mat4, std::vector<glm::vec4>>;

class ProgramUniforms {
 public:
    /// `names`: what error messages call the program.
    explicit ProgramUniforms(std::string names) : names_(std::move(names)) {}

    /// Takes over a program that was just linked: `declared` as declaredUniforms() found them. Values set
    /// before are set again, as far as they are still declared with the same type.
    void attach(GLuint program, const std::map<std::string, GLenum>& declared);
    void set(const std::string& name, const UniformValue& value);
    void setTexture(const std::string& sampler, GLenum target, GLuint texture, GLuint samplerObject);
    /// Throws Error naming every active uniform that was never set.
    void requireComplete();
    void bindTextures() const;
    /// The value of a number, truth value or vec2 in GLSL; empty if it was never set.
    std::string literal(const std::string& name) const;

 private:
    struct Uniform {
        GLenum type = 0;
        GLint location = -1;  ///< -1: declared, but optimised away
        bool assigned = false;
    };
    struct Binding {
        GLint unit = 0;
        GLenum target = 0;
        GLuint texture = 0;
        GLuint samplerObject = 0;
    };
    void findActive();
    void setAgain();
    Uniform& find(const std::string& name);

    std::string names_;
    GLuint program_ = 0;
    std::map<std::string, Uniform> uniforms_;
    std::map<std::string, UniformValue> values_;
    std::map<std::string, Binding> bindings_;
    bool complete_ = false;
};

}  // namespace penumbra
