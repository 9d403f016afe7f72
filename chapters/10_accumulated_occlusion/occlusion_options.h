// What is asked of the N shadow maps, from the command line.
#pragma once

#include <string>

#include "chapters/01_depth_from_light/depth_format.h"
#include "chapters/10_accumulated_occlusion/sky_directions.h"
#include "common/app/parameters.h"

namespace penumbra {

struct OcclusionOptions {
    int samples = 128;  ///< directions, on the whole sphere
    std::string directions = "fibonacci";
    int mapSize = 512;
    std::string depthFormat = "32f";
    float bias = 1.0f;
    std::string method = "pixels";
    std::string edges = "auto";
    bool rotate = false;

    /// Declares --samples, --directions, --map-size, --depth-format, --bias, --method, --edges and --rotate.
    void declare(Parameters& parameters);
    bool perVertex() const { return method == "vertices"; }
    /// Of the shadows of a single direction.
    bool softEdges() const { return edges == "soft" || (edges == "auto" && perVertex()); }
    bool operator==(const OcclusionOptions&) const = default;
};

/// The skips of AccumulatedOcclusion, and of drawing its picture.
void declareOcclusionSkips(Parameters& parameters);

}  // namespace penumbra
