#include "common/gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "common/error.h"

namespace penumbra {
namespace {

/// ES has no default precision for these; without the statements a fragment shader does not compile, and with
/// mediump a shadow test on a phone shows bands.
const char* const esHeader =
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp sampler3D;\n"
    "precision highp samplerCube;\n"
    "precision highp sampler2DArray;\n"
    "precision highp sampler2DShadow;\n"
    "precision highp samplerCubeShadow;\n"
    "precision highp sampler2DArrayShadow;\n"
    "precision highp isampler2D;\n"
    "precision highp usampler2D;\n"
    "precision highp usampler3D;\n"
    "precision highp usampler2DArray;\n";

/// The name the reader knows: from the folder above the root, "shaders/04_pcf/pcf.glsl".
std::string displayName(const std::string& file) {
    return (shaderRoot().filename() / file).generic_string();
}

class Expander {
 public:
    Expander(ShaderSource& source, std::vector<std::filesystem::path>& opened,
             const std::map<std::string, std::string>& constants)
        : source_(source), opened_(opened), constants_(constants) {}

    void expand(const std::string& file, const std::string& includer) {
        checkCycle(file);
        if (std::find(done_.begin(), done_.end(), file) != done_.end()) return;
        done_.push_back(file);
        const std::string content = read(file, includer);
        const std::size_t number = source_.files.size();
        source_.files.push_back(displayName(file));
        stack_.push_back(file);
        source_.text += fmt::format("#line 1 {}\n", number);
        expandLines(content, file, number);
        stack_.pop_back();
    }

 private:
    void checkCycle(const std::string& file) const {
        if (std::find(stack_.begin(), stack_.end(), file) == stack_.end()) return;
        std::string chain;
        for (const std::string& outer : stack_) chain += displayName(outer) + " -> ";
        throw Error("shader include cycle: " + chain + displayName(file) +
                    "; break it by removing one #include");
    }

    std::string read(const std::string& file, const std::string& includer) {
        const std::filesystem::path path = shaderRoot() / file;
        opened_.push_back(path);
        std::ifstream stream(path, std::ios::binary);
        std::ostringstream content;
        content << stream.rdbuf();
        if (stream && std::filesystem::is_regular_file(path)) return content.str();
        throw Error(fmt::format(
            "{}no shader file {}; shaders are looked for in {} (set PENUMBRA_SHADERS to change that)",
            includer.empty() ? "" : includer + ": ", displayName(file), shaderRoot().string()));
    }

    void expandLines(const std::string& content, const std::string& file, std::size_t number) {
        static const std::regex include(R"re(^\s*#\s*include\s+"([^"]+)"\s*(//.*)?$)re");
        std::istringstream lines(content);
        std::string line;
        for (int lineNumber = 1; std::getline(lines, line); ++lineNumber) {
            if (!line.empty() && line.back() == '\r') line.pop_back();
            std::smatch match;
            if (!std::regex_match(line, match, include)) {
                source_.text += withConstants(line) + "\n";
                continue;
            }
            expand(match[1], fmt::format("{}:{}", displayName(file), lineNumber));
            source_.text += fmt::format("#line {} {}\n", lineNumber + 1, number);
        }
    }

    std::string withConstants(const std::string& line) {
        static const std::regex uniform(R"re(^uniform (\w+) (\w+);.*$)re");
        std::smatch match;
        if (constants_.empty() || !std::regex_match(line, match, uniform)) return line;
        const auto constant = constants_.find(match[2]);
        if (constant == constants_.end()) return line;
        source_.constants.merge(declaredUniforms(line));
        return fmt::format("const {} {} = {};", match[1].str(), match[2].str(), constant->second);
    }

    ShaderSource& source_;
    std::vector<std::filesystem::path>& opened_;
    const std::map<std::string, std::string>& constants_;
    std::vector<std::string> stack_;
    std::vector<std::string> done_;
};

/// Replaces comments by spaces; line breaks stay.
std::string withoutComments(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "//") == 0) {
            i = text.find('\n', i);
            if (i == std::string::npos) break;
        } else if (text.compare(i, 2, "/*") == 0) {
            i = text.find("*/", i + 2);
            if (i == std::string::npos) break;
            ++i;
            out += ' ';
            continue;
        }
        out += text[i];
    }
    return out;
}

struct GlslType {
    const char* name;
    GLenum type;
};

const GlslType glslTypes[] = {
    {"float", GL_FLOAT},
    {"vec2", GL_FLOAT_VEC2},
    {"vec3", GL_FLOAT_VEC3},
    {"vec4", GL_FLOAT_VEC4},
    {"int", GL_INT},
    {"ivec2", GL_INT_VEC2},
    {"ivec3", GL_INT_VEC3},
    {"ivec4", GL_INT_VEC4},
    {"uint", GL_UNSIGNED_INT},
    {"uvec2", GL_UNSIGNED_INT_VEC2},
    {"uvec4", GL_UNSIGNED_INT_VEC4},
    {"bool", GL_BOOL},
    {"mat2", GL_FLOAT_MAT2},
    {"mat3", GL_FLOAT_MAT3},
    {"mat4", GL_FLOAT_MAT4},
    {"sampler2D", GL_SAMPLER_2D},
    {"sampler3D", GL_SAMPLER_3D},
    {"samplerCube", GL_SAMPLER_CUBE},
    {"sampler2DArray", GL_SAMPLER_2D_ARRAY},
    {"sampler2DShadow", GL_SAMPLER_2D_SHADOW},
    {"samplerCubeShadow", GL_SAMPLER_CUBE_SHADOW},
    {"sampler2DArrayShadow", GL_SAMPLER_2D_ARRAY_SHADOW},
    {"isampler2D", GL_INT_SAMPLER_2D},
    {"usampler2D", GL_UNSIGNED_INT_SAMPLER_2D},
    {"usampler3D", GL_UNSIGNED_INT_SAMPLER_3D},
    {"usampler2DArray", GL_UNSIGNED_INT_SAMPLER_2D_ARRAY},
};

}  // namespace

std::filesystem::path shaderRoot() {
    const char* overridden = std::getenv("PENUMBRA_SHADERS");
    std::filesystem::path root = overridden && *overridden ? overridden : PENUMBRA_SOURCE_DIR "/shaders";
    root = root.lexically_normal();
    return root.has_filename() ? root : root.parent_path();
}

ShaderSource loadShaderSource(const std::string& file, const std::vector<std::string>& defines, Api api,
                              std::vector<std::filesystem::path>& opened,
                              const std::map<std::string, std::string>& constants) {
    ShaderSource source;
    source.text = api == Api::es ? esHeader : "#version 330 core\n";
    for (const std::string& define : defines) source.text += "#define " + define + "\n";
    Expander(source, opened, constants).expand(file, "");
    return source;
}

std::string nameFilesInLog(const std::string& log, const std::vector<std::string>& files) {
    static const std::regex location(
        R"(^((?:ERROR|WARNING): )?(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\)) ?: ?(.*)$)");
    std::istringstream lines(log);
    std::string line;
    std::string out;
    while (std::getline(lines, line)) {
        std::smatch match;
        if (std::regex_match(line, match, location) && std::stoul(match[2]) < files.size())
            line = fmt::format("{}:{}: {}{}", files[std::stoul(match[2])], match[3].str() + match[4].str(),
                               match[1].str(), match[5].str());
        if (!line.empty()) out += (out.empty() ? "" : "\n") + line;
    }
    return out;
}

std::map<std::string, GLenum> declaredUniforms(const std::string& text) {
    static const std::regex declaration(R"(\buniform\s+(?:(?:lowp|mediump|highp)\s+)?(\w+)\s+([^;{]+);)");
    static const std::regex name(R"((\w+)\s*(\[[^\]]*\])?)");
    const std::string code = withoutComments(text);
    std::map<std::string, GLenum> uniforms;
    for (std::sregex_iterator it(code.begin(), code.end(), declaration), end; it != end; ++it) {
        const auto* type =
            std::find_if(std::begin(glslTypes), std::end(glslTypes),
                         [&](const GlslType& candidate) { return (*it)[1] == candidate.name; });
        if (type == std::end(glslTypes)) continue;
        const std::string names = (*it)[2];
        for (std::sregex_iterator n(names.begin(), names.end(), name); n != end; ++n)
            uniforms[(*n)[1]] = type->type;
    }
    return uniforms;
}

std::string glslTypeName(GLenum type) {
    for (const GlslType& candidate : glslTypes)
        if (candidate.type == type) return candidate.name;
    return fmt::format("type 0x{:x}", type);
}

}  // namespace penumbra
