// The textures of light: what each receiver gets from all lights together.
#pragma once

#include <map>
#include <vector>

#include "chapters/08_accumulation/seen_receivers.h"
#include "chapters/08_accumulation/stored_shadow.h"

namespace penumbra {

inline constexpr Skip keptTextures{
    "kept-textures", "textures_composed",
    "a receiver's texture of light is kept from the frame before while none of "
    "its shadows has changed (a window, --still)"};

class ReceivedLight {
 public:
    /// What a texel holds.
    enum class Output { irradiance, visibility, work };

    ReceivedLight();
    /// Forgets everything: another scene.
    void reset();
    /// Whose textures: those of the camera's picture (receiversUnseen), or of the sheets.
    enum class For { picture, sheets };
    /// Finds the receivers (once), updates the shadows of each light on each that is asked for, and composes.
    void update(const Frame& frame, const AccumulationOptions& options, Output output, For shown);

    const std::vector<Receiver>& receivers() const { return receivers_; }
    /// Of receiver i; null: no light arrives there.
    const TexelTarget* texture(std::size_t i) const { return textures_[i] ? &*textures_[i] : nullptr; }
    /// Of the first light on receiver i.
    const StoredShadow& shadow(std::size_t i) const { return shadows_.begin()->second[i]; }
    std::vector<Program*> programs();

 private:
    void findReceivers(const Frame& frame, const AccumulationOptions& options);
    /// Receivers that light arrives at and whose texture the picture does not look up.
    std::vector<bool> unseen(const Frame& frame, const std::vector<int>& lights);
    void compose(const StoredShadow::Request& request, StoredShadow& shadow, Output output,
                 const TexelTarget& target);
    /// All that texture i is made from.
    std::string composedKey(const AccumulationOptions& options, Output output, std::size_t i) const;

    std::vector<Receiver> receivers_;
    std::string receiversKey_, lightKey_;
    std::map<int, std::vector<StoredShadow>> shadows_;  ///< by light, then receiver
    std::vector<std::optional<TexelTarget>> textures_;
    std::vector<std::string> composed_;
    SeenReceivers seen_;
    ShadowPasses passes_;
    Program compose_;
    FullscreenTriangle triangle_;
};

}  // namespace penumbra
