// A shared library that may be missing, or that is costly to load and often not needed.
#pragma once

#include <string>
#include <vector>

namespace penumbra {

/// Opened at run time, so that a program starts where it is not installed. Never closed: libraries register
/// exit handlers that must still be there when the process ends.
class DynamicLibrary {
 public:
    /// Opens the first of `names` that is there; the environment variable `overrideVariable`, when set,
    /// replaces them all. Throws Error naming what was looked for.
    DynamicLibrary(const std::vector<std::string>& names, const char* overrideVariable);

    /// Throws Error when the library has no such symbol.
    template <class Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(symbol(name));
    }

 private:
    void* symbol(const char* name) const;

    void* handle_ = nullptr;
    std::string name_;
};

}  // namespace penumbra
