#include "chapters/11_bent_normals/seen_sky.h"

#include "chapters/01_depth_from_light/shadow_options.h"

namespace penumbra {

// [begin:sources]
// Under whatever sky: when another one shines, no ray is traced and no map drawn.
void SeenSky::update(const Frame& frame, const BentOptions& options) {
    if (options.source == "vertices") {
        if (!baked_) baked_.emplace(scene_);
        return baked_->update(frame, options.ambient());
    }
    if (options.source == "maps") {
        if (!maps_) maps_.emplace();
        const Sky any = Sky::uniform(glm::dvec3(1.0));
        texels_ = maps_->update(frame, options.occlusion(), any).ambient;
        return;
    }
    if (!pixels_) pixels_.emplace(scene_);
    pixels_->update(frame, options.ambient());
    texels_ = pixels_->values();
}
// [end:sources]

std::int64_t SeenSky::points(const Frame& frame, const BentOptions& options) const {
    if (options.source == "vertices") return std::int64_t(scene_.positions.size());
    return std::int64_t(frame.size.x) * frame.size.y;
}

std::vector<std::string> SeenSky::defines(const BentOptions& options) const {
    if (options.source == "vertices") return {"STORED"};
    return {};
}

void SeenSky::draw(Program& program, const Frame& frame, const BentOptions& options) const {
    if (options.source == "vertices") return baked_->draw(program, frame);
    program.setTexture("uSeen", GL_TEXTURE_2D, texels_);
    drawPicture(program, frame);
}

std::vector<Program*> SeenSky::programs() {
    return maps_ ? maps_->programs() : std::vector<Program*>{};
}

}  // namespace penumbra
