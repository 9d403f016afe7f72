#include "common/system/dynamic_library.h"

#include <dlfcn.h>

#include <cstdlib>

#include "common/error.h"

namespace penumbra {

DynamicLibrary::DynamicLibrary(const std::vector<std::string>& names, const char* overrideVariable) {
    const char* replacement = std::getenv(overrideVariable);
    const std::vector<std::string> candidates = replacement ? std::vector<std::string>{replacement} : names;
    std::string tried;
    for (const std::string& name : candidates) {
        handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle_ != nullptr) {
            name_ = name;
            return;
        }
        tried += (tried.empty() ? "" : " or ") + name;
    }
    throw Error("no library " + tried);
}

void* DynamicLibrary::symbol(const char* name) const {
    void* address = dlsym(handle_, name);
    if (address == nullptr) throw Error(name_ + " has no " + name);
    return address;
}

}  // namespace penumbra
