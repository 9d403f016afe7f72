// One shader source, several programs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/gl/program.h"

namespace penumbra {

/// Compiles a variant when it is first asked for. A choice made by #ifdef costs nothing in the shader; as an
/// `if` inside a loop, a CPU rasteriser would run both sides.
class ProgramVariants {
 public:
    ProgramVariants(std::string vertexFile, std::string fragmentFile)
        : vertexFile_(std::move(vertexFile)), fragmentFile_(std::move(fragmentFile)) {}

    Program& with(const std::vector<std::string>& defines) {
        const auto found = programs_.find(defines);
        if (found != programs_.end()) return found->second;
        return programs_.emplace(defines, Program(vertexFile_, fragmentFile_, defines)).first->second;
    }
    /// All that were compiled, for hot reload.
    std::vector<Program*> compiled() {
        std::vector<Program*> programs;
        for (auto& [defines, program] : programs_) programs.push_back(&program);
        return programs;
    }

 private:
    std::string vertexFile_, fragmentFile_;
    std::map<std::vector<std::string>, Program> programs_;
};

}  // namespace penumbra
