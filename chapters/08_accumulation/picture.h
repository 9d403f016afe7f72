// The camera's picture: receivers with their textures of light, everything else in closed form.
#pragma once

#include "chapters/08_accumulation/map_pass.h"
#include "chapters/08_accumulation/other_surfaces.h"
#include "chapters/08_accumulation/received_light.h"

namespace penumbra {

class Picture {
 public:
    Picture();
    /// Draws frame.view. `received`: null for --method shadow-maps. Counts others_unshadowed (triangles that
    /// were lit as if nothing stood in the light's way).
    void draw(const Frame& frame, const AccumulationOptions& options, const ReceivedLight* received);
    std::vector<Program*> programs();

 private:
    void drawOthers(const Frame& frame, const AccumulationOptions& options, const OtherSurfaces& others,
                    int light, bool first);
    void drawReceivers(const Frame& frame, const AccumulationOptions& options, const ReceivedLight& received);
    void drawReceiver(const Frame& frame, const Receiver& receiver);
    void setView(Program& program, const Frame& frame, const AccumulationOptions& options);
    void setTriangles(const Light& light);

    Program other_, received_;
    MapPass maps_;
    std::optional<TexelTexture> triangles_;
    TexelTexture dark_;  ///< 1 texel: of the side of a receiver that no light arrives at
};

}  // namespace penumbra
