#include "chapters/08_accumulation/texture_sheet.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

TextureSheet::TextureSheet() : sheet_("common/fullscreen.vert", "08_accumulation/sheet.frag") {}

/// Cell `index` of a grid that holds `count` cells, row by row from the top; the image keeps its shape.
void TextureSheet::drawCell(const Frame& frame, int index, int count, const glm::ivec2& texels) {
    const int columns = int(std::ceil(std::sqrt(double(count)))), rows = (count + columns - 1) / columns;
    const int gap = count > 1 ? std::max(1, frame.size.x / 256) : 0;
    const glm::ivec2 cell = frame.size / glm::ivec2(columns, rows);
    const glm::ivec2 room = glm::max(cell - gap, glm::ivec2(1));
    const double scale = std::min(double(room.x) / texels.x, double(room.y) / texels.y);
    const glm::ivec2 shown = glm::max(glm::ivec2(scale * glm::dvec2(texels)), glm::ivec2(1));
    const glm::ivec2 corner =
        cell * glm::ivec2(index % columns, rows - 1 - index / columns) + (cell - shown) / 2;
    sheet_.set("uOrigin", corner);
    sheet_.set("uShownSize", shown);
    sheet_.prepareToDraw();
    glViewport(corner.x, corner.y, shown.x, shown.y);
    triangle_.draw();
    glViewport(0, 0, frame.size.x, frame.size.y);
}

void TextureSheet::drawTextures(const Frame& frame, const ReceivedLight& received) {
    std::vector<const TexelTarget*> textures;
    for (std::size_t i = 0; i < received.receivers().size(); ++i)
        if (received.texture(i)) textures.push_back(received.texture(i));
    sheet_.set("uPoint", -1);
    sheet_.setTexture("uMasks", GL_TEXTURE_2D_ARRAY, 0);
    for (std::size_t i = 0; i < textures.size(); ++i) {
        sheet_.setTexture("uReceived", GL_TEXTURE_2D, textures[i]->texture());
        drawCell(frame, int(i), int(textures.size()), textures[i]->size());
    }
}

void TextureSheet::drawHardShadows(const Frame& frame, const ReceivedLight& received) {
    for (std::size_t i = 0; i < received.receivers().size(); ++i) {
        const MaskLayers* masks = received.shadow(i).masks();
        if (!masks) continue;
        sheet_.setTexture("uReceived", GL_TEXTURE_2D, received.texture(i)->texture());
        sheet_.setTexture("uMasks", GL_TEXTURE_2D_ARRAY, masks->texture());
        for (int point = 0; point < masks->points(); ++point) {
            sheet_.set("uPoint", point);
            drawCell(frame, point, masks->points(), masks->size());
        }
        return;
    }
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace penumbra
