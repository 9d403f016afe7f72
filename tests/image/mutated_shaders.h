// Breaks a shader on purpose: a bound that a broken shader keeps is no bound.
#pragma once

#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "common/gl/shader_source.h"

namespace penumbra {

/// While it lives, programs are compiled from a copy of the shader folder in which `from` reads `to` in
/// `file`. Throws if `from` is not in there exactly once: then the mutation would test nothing.
class MutatedShaders {
 public:
    MutatedShaders(const std::string& file, const std::string& from, const std::string& to)
        : folder_(std::filesystem::temp_directory_path() / ("penumbra_mutated_" + std::to_string(getpid()))) {
        std::filesystem::copy(
            shaderRoot(), folder_,
            std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
        std::stringstream content;
        content << std::ifstream(folder_ / file).rdbuf();
        std::string text = content.str();
        const std::size_t at = text.find(from);
        if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
            throw std::runtime_error("mutation: '" + from + "' is not in " + file + " exactly once");
        std::ofstream(folder_ / file) << text.replace(at, from.size(), to);
        if (const char* before = std::getenv("PENUMBRA_SHADERS")) before_ = before;
        setenv("PENUMBRA_SHADERS", folder_.c_str(), 1);
    }
    ~MutatedShaders() {
        setenv("PENUMBRA_SHADERS", before_.c_str(), 1);  // empty counts as unset
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    MutatedShaders(const MutatedShaders&) = delete;
    MutatedShaders& operator=(const MutatedShaders&) = delete;

 private:
    std::filesystem::path folder_;
    std::string before_;
};

}  // namespace penumbra
