// GLSL programs: #include, right file and line in errors, and no silent uniforms.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/gl/gl.h"

namespace penumbra {

/// A linked program. Sources are named relative to the shader root (the `shaders/` folder, an absolute path
/// compiled in, or $PENUMBRA_SHADERS). `#include "04_pcf/pcf.glsl"` is resolved by the loader, once per file;
/// `#line` is kept right, and compile errors name the file and line the reader knows. The version line is
/// prepended: `#version 330 core`, or
/// `#version 300 es` with precision statements when the current context is OpenGL ES.
class Program {
 public:
    /// Compiles and links. `defines`: "NAME" or "NAME VALUE". Throws Error: file:line: message.
    Program(const std::string& vertexFile, const std::string& fragmentFile,
            std::vector<std::string> defines = {});
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    ~Program();

    GLuint id() const { return id_; }
    void use();

    /// Sets a uniform of the program (which need not be in use). Throws Error if no such uniform is declared
    /// in the source or its type differs; a uniform that is declared but optimised away is accepted silently.
    void set(const std::string& name, int value);
    void set(const std::string& name, float value);
    void set(const std::string& name, bool value);
    void set(const std::string& name, const glm::vec2& value);
    void set(const std::string& name, const glm::vec3& value);
    void set(const std::string& name, const glm::vec4& value);
    void set(const std::string& name, const glm::ivec2& value);
    void set(const std::string& name, const glm::mat3& value);
    void set(const std::string& name, const glm::mat4& value);
    /// The first elements of an array; at most as many as it has.
    void set(const std::string& name, const std::vector<glm::vec4>& values);
    /// Binds `texture` to the next free unit of this program and points the sampler at it. `samplerObject`:
    /// how it is read, in place of the texture's own parameters; 0: by those.
    void setTexture(const std::string& sampler, GLenum target, GLuint texture, GLuint samplerObject = 0);

    /// Makes constants of these uniforms (numbers, truth values, vec2s, each declared on a line of its own)
    /// once they are set, and compiles again whenever the value of one changes: for what seldom does. A CPU
    /// rasteriser looks a uniform up for each pixel: 0.08 ms for each number in 512 x 512 of them.
    void fix(std::vector<std::string> names);

    /// Call before drawing: binds the program and its textures; throws Error naming every active uniform
    /// never set.
    void prepareToDraw();

    /// True if any source file changed on disk since it was loaded.
    bool sourcesChanged() const;
    /// Compiles again. On failure the old program stays in use and the message is returned; empty on success.
    /// Uniform values set before are set again.
    std::string reload();
    const std::vector<std::filesystem::path>& sourceFiles() const;

 private:
    struct State;
    GLuint id_ = 0;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra
