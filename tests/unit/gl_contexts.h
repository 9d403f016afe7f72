// The kinds of context that every OpenGL test runs on.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <link.h>

#include <cstring>
#include <memory>
#include <string>

#include "common/error.h"
#include "common/gl/context.h"

namespace penumbra {

struct ContextKind {
    Backend backend;
    Api api;
};

inline std::string contextKindName(const testing::TestParamInfo<ContextKind>& kind) {
    return std::string(backendName(kind.param.backend)) + "_" + apiName(kind.param.api);
}

/// EGL unloads its driver with the last context. What the driver leaked has then no name that the leak
/// checker could match with tools/leaks.txt, and would count as ours; so drivers stay until the process ends.
inline void keepDriversLoaded() {
    dl_iterate_phdr(
        [](dl_phdr_info* library, std::size_t, void*) {
            if (std::strstr(library->dlpi_name, "_dri.so"))
                dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
            return 0;
        },
        nullptr);
}

/// A fixture with a current context; skips on OSMesa where this build or machine has none.
class ContextTest : public testing::TestWithParam<ContextKind> {
 protected:
    void SetUp() override {
        ContextRequest request;
        request.backend = GetParam().backend;
        request.api = GetParam().api;
        try {
            context_ = createContext(request);
            keepDriversLoaded();
        } catch (const Error& error) {
            if (request.backend != Backend::osmesa) throw;
            GTEST_SKIP() << error.what();
        }
    }
    const Context& context() const { return *context_; }
    const Capabilities& capabilities() const { return context_->capabilities(); }

 private:
    std::unique_ptr<Context> context_;
};

inline auto allContextKinds() {
    return testing::Values(ContextKind{Backend::osmesa, Api::desktop},
                           ContextKind{Backend::egl, Api::desktop}, ContextKind{Backend::egl, Api::es});
}

}  // namespace penumbra
