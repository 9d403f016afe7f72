// What the window shows is what the files hold: the shader that tone-maps and encodes against the C++ that
// does the same.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/gl/fullscreen.h"
#include "common/gl/program.h"
#include "common/gl/render_target.h"
#include "common/image/srgb.h"
#include "common/image/tone_map.h"
#include "tests/unit/gl_contexts.h"

namespace penumbra {
namespace {

class PresentTest : public ContextTest {
 protected:
    /// Top row first, as RenderTarget reads.
    FloatImage shown(const FloatImage& rgb, float exposure, bool scalar) {
        const GlTexture texture;
        glBindTexture(GL_TEXTURE_2D, texture.id());
        std::vector<float> rows;
        for (int y = rgb.height - 1; y >= 0; --y)
            rows.insert(rows.end(), &rgb.values[std::size_t(y) * rgb.width * 3],
                        &rgb.values[std::size_t(y) * rgb.width * 3] + rgb.width * 3);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, rgb.width, rgb.height, 0, GL_RGB, GL_FLOAT, rows.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        RenderTarget target({rgb.width, rgb.height}, capabilities(), GL_RGBA8);
        target.bind();
        Program program("common/fullscreen.vert", "common/present.frag");
        program.set("uExposure", exposure);
        program.set("uScalar", scalar);
        program.setTexture("uPicture", GL_TEXTURE_2D, texture.id());
        program.prepareToDraw();
        FullscreenTriangle().draw();
        FloatImage image = target.read(3);
        checkGlErrors("presenting");
        return image;
    }
    static void expectWithinOneStep(const FloatImage& actual, const FloatImage& linear) {
        for (int y = 0; y < linear.height; ++y)
            for (int x = 0; x < linear.width; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(255.0f * actual.at(x, y, c),
                                float(srgbByte(linear.at(x, y, std::min(c, linear.channels - 1)))), 1.01f)
                        << x << ' ' << y << ' ' << c;
    }
    /// Dark to far over white, in many hues.
    static FloatImage manyColours() {
        FloatImage image(64, 48, 3);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) =
                        float(std::exp2(0.2 * x - 8.0) * (0.5 + 0.5 * std::sin(0.3 * y + 2.0 * c)));
        image.at(3, 2, 0) = -1.0f;
        return image;
    }
};

TEST_P(PresentTest, ColoursAreToneMappedAsInFiles) {
    for (const float exposure : {1.0f, 0.3f, 7.0f})
        expectWithinOneStep(shown(manyColours(), exposure, false), toneMap(manyColours(), exposure));
}

TEST_P(PresentTest, ScalarsAreGrey) {
    const FloatImage picture = manyColours();
    FloatImage red(picture.width, picture.height, 1);
    for (std::size_t i = 0; i < red.values.size(); ++i) red.values[i] = picture.values[3 * i];
    expectWithinOneStep(shown(picture, 1.0f, true), toneMap(red, 1.0f));
}

TEST_P(PresentTest, FinishedPicturesPassThrough) {
    FloatImage picture = manyColours();
    for (float& value : picture.values) value = std::min(std::max(value, 0.0f), 1.0f);
    expectWithinOneStep(shown(picture, 0.0f, false), picture);
}

TEST_P(PresentTest, NotANumberIsSeen) {
    FloatImage picture(2, 2, 3, 0.5f);
    picture.at(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    picture.at(0, 1, 2) = std::numeric_limits<float>::infinity();
    expectWithinOneStep(shown(picture, 1.0f, false), toneMap(picture, 1.0f));
}

INSTANTIATE_TEST_SUITE_P(Backends, PresentTest, allContextKinds(), contextKindName);

}  // namespace
}  // namespace penumbra
