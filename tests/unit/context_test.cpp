// Contexts through OSMesa and EGL, desktop and ES, and what happens where a library is missing.
#include "common/gl/context.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "common/error.h"
#include "common/gl/gl_object.h"
#include "tests/unit/gl_contexts.h"

namespace penumbra {
namespace {

ContextRequest request(Backend backend, Api api = Api::desktop) {
    ContextRequest wanted;
    wanted.backend = backend;
    wanted.api = api;
    return wanted;
}

/// An environment variable for the length of a scope.
class Environment {
 public:
    Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() { unsetenv(name_); }

 private:
    const char* name_;
};

std::string refusal(const ContextRequest& wanted) {
    try {
        createContext(wanted);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

class EachContext : public ContextTest {};

TEST_P(EachContext, DrawsWhatItWasTold) {
    EXPECT_EQ(context().backend(), GetParam().backend);
    EXPECT_EQ(context().capabilities().api, GetParam().api);
    EXPECT_FALSE(context().renderer().empty());
    EXPECT_EQ(context().version().rfind("OpenGL ES", 0) == 0, GetParam().api == Api::es)
        << context().version();

    const GlTexture texture;
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    const GlFramebuffer framebuffer;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    requireCompleteFramebuffer("the test's texture");
    glClearColor(1.0f, 0.0f, 0.2f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    GLubyte pixel[4] = {};
    glReadPixels(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    EXPECT_EQ(pixel[0], 255);
    EXPECT_EQ(pixel[1], 0);
    EXPECT_EQ(pixel[2], 51);
    EXPECT_NO_THROW(checkGlErrors("after a clear"));
}

TEST_P(EachContext, ReportsAnErrorOnceAtTheNextCheck) {
    glEnable(GL_TEXTURE_2D);  // not an enable of core OpenGL, nor of ES
    glDepthFunc(GL_TRIANGLES);
    try {
        checkGlErrors("in the test");
        FAIL() << "the error went unnoticed";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("in the test"), std::string::npos) << message;
        EXPECT_NE(message.find("glEnable"), std::string::npos) << "KHR_debug names the call: " << message;
        EXPECT_EQ(message.find("glDepthFunc"), std::string::npos)
            << "the first error is the cause: " << message;
    }
    EXPECT_NO_THROW(checkGlErrors("afterwards"));
}

TEST_P(EachContext, AnIncompleteFramebufferIsNamed) {
    const GlFramebuffer framebuffer;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    try {
        requireCompleteFramebuffer("the shadow map");
        FAIL() << "a framebuffer without attachments passed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("the shadow map"), std::string::npos) << error.what();
    }
}

TEST_P(EachContext, OptionalFunctionsAgreeWithCapabilities) {
    const Capabilities& can = capabilities();
    EXPECT_EQ(can.clipControl, glClipControl != nullptr);
    EXPECT_EQ(can.multiDraw, glMultiDrawElements != nullptr);
    EXPECT_EQ(can.polygonOffsetClamp, glPolygonOffsetClamp != nullptr);
    EXPECT_EQ(can.logicOp, glLogicOp != nullptr);
    EXPECT_EQ(can.logicOp, GetParam().api == Api::desktop);
    if (can.clipControl) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (can.polygonOffsetClamp) glPolygonOffsetClamp(1.0f, 1.0f, 0.1f);
    if (can.depthClamp) glEnable(GL_DEPTH_CLAMP);
    EXPECT_NO_THROW(checkGlErrors("using what the capabilities promise"));
}

INSTANTIATE_TEST_SUITE_P(Backends, EachContext, allContextKinds(), contextKindName);

TEST(Context, EsHeadlessComesThroughEgl) {
    const auto context = createContext(request(Backend::automatic, Api::es));
    EXPECT_EQ(context->backend(), Backend::egl);
}

TEST(Context, AutomaticGoesOnToEglWhereOsmesaIsMissing) {
    const Environment osmesa("PENUMBRA_OSMESA_LIBRARY", "libNoSuchOSMesa.so");
    EXPECT_EQ(createContext(request(Backend::automatic))->backend(), Backend::egl);
    const std::string message = refusal(request(Backend::osmesa));
    EXPECT_NE(message.find("osmesa: "), std::string::npos) << message;
    EXPECT_NE(message.find("install libosmesa6"), std::string::npos) << message;
    EXPECT_EQ(message.find("egl"), std::string::npos) << "only what was tried: " << message;
}

TEST(Context, NoContextAtAllIsOneLineThatSaysWhatToInstall) {
    const Environment osmesa("PENUMBRA_OSMESA_LIBRARY", "libNoSuchOSMesa.so");
    const Environment egl("PENUMBRA_EGL_LIBRARY", "libNoSuchEGL.so");
    const char* const display = std::getenv("DISPLAY");
    const std::string displayBefore = display ? display : "";
    unsetenv("DISPLAY");
    ContextRequest wanted = request(Backend::automatic);
    wanted.headless = false;
    const std::string message = refusal(wanted);
    if (display) setenv("DISPLAY", displayBefore.c_str(), 1);
    for (const char* part :
         {"window: ", "osmesa: ", "egl: no library libNoSuchEGL.so", "libegl1", "libosmesa6", "display"})
        EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(Context, ALibraryThatIsNotTheOneAskedForIsRefused) {
    const Environment egl("PENUMBRA_EGL_LIBRARY", "libm.so.6");
    const std::string message = refusal(request(Backend::egl));
    EXPECT_NE(message.find("libm.so.6 has no eglGetProcAddress"), std::string::npos) << message;
}

TEST(Context, ContextsMayFollowOneAnother) {
    for (const Backend backend : {Backend::automatic, Backend::egl, Backend::automatic}) {
        const auto context = createContext(request(backend));
        const GlBuffer buffer;
        EXPECT_NE(buffer.id(), 0u);
    }
}

TEST(GlFunctions, AMissingCoreFunctionIsNamed) {
    try {
        loadGlFunctions([](const char* name) -> GlProcAddress {
            return std::string(name) == "glDrawArrays" ? nullptr : GlProcAddress([] {});
        });
        FAIL() << "the missing function went unnoticed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("glDrawArrays"), std::string::npos) << error.what();
    }
}

TEST(GlObject, MovesItsIdAndFreesItOnce) {
    const auto context = createContext(request(Backend::automatic));
    GlTexture first;
    const GLuint id = first.id();
    glBindTexture(GL_TEXTURE_2D, id);  // a name becomes an object when it is first bound
    GlTexture second(std::move(first));
    EXPECT_EQ(second.id(), id);
    {
        const GlTexture third(std::move(second));
        EXPECT_EQ(third.id(), id);
    }
    GLint bound = -1;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    EXPECT_EQ(bound, 0) << "deleting a bound texture unbinds it";
}

}  // namespace
}  // namespace penumbra
