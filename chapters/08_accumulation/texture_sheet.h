// Textures side by side, as they are: of all receivers, or the hard shadow images of one.
#pragma once

#include "chapters/08_accumulation/received_light.h"

namespace penumbra {

class TextureSheet {
 public:
    TextureSheet();
    /// The receivers' textures, the largest first.
    void drawTextures(const Frame& frame, const ReceivedLight& received);
    /// One image for each light point on the largest receiver that has any shadow; all white if none has.
    void drawHardShadows(const Frame& frame, const ReceivedLight& received);
    Program& program() { return sheet_; }

 private:
    void drawCell(const Frame& frame, int index, int count, const glm::ivec2& texels);

    Program sheet_;
    FullscreenTriangle triangle_;
};

}  // namespace penumbra
