// Whose texture of light the camera's picture looks up: the others need not be filled.
#pragma once

#include <optional>
#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "chapters/08_accumulation/texel_target.h"
#include "common/app/chapter.h"

namespace penumbra {

inline constexpr Skip receiversUnseen{
    "receivers-unseen", "receivers_updated",
    "receivers of which no pixel of the picture shows anything get no texture of light until the camera "
    "sees them; filled once, it stays"};

class SeenReceivers {
 public:
    SeenReceivers();
    /// One entry for each receiver: does any pixel of the frame show its lit side? Exact: draws what the
    /// picture draws, in its order, with numbers for colours. Those that are not `lit` have no texture, and
    /// are drawn as what is no receiver. Kept while neither camera nor size nor `lit` changes (keptShadows).
    /// Leaves the frame's framebuffer bound. Counts draw_calls.
    const std::vector<bool>& find(const Frame& frame, const std::vector<Receiver>& receivers,
                                  const std::vector<bool>& lit);
    /// Other receivers, though there may be as many: nothing is kept.
    void forget() { camera_.reset(); }
    Program& program() { return id_; }

 private:
    void draw(const Frame& frame, const std::vector<Receiver>& receivers, const std::vector<bool>& lit);

    Program id_;
    std::optional<TexelTarget> ids_;
    std::optional<Camera> camera_;  ///< of `seen_`, as are the next two
    glm::ivec2 size_{0};
    std::vector<bool> lit_;
    std::vector<bool> seen_;
};

}  // namespace penumbra
