#include "chapters/08_accumulation/other_surfaces.h"

#include <algorithm>
#include <map>

#include "chapters/01_depth_from_light/shadow_options.h"

namespace penumbra {

std::vector<IndexRange> rangesOf(const std::vector<std::uint32_t>& triangles) {
    std::vector<IndexRange> ranges;
    for (const std::uint32_t triangle : triangles) {
        if (!ranges.empty() && ranges.back().firstTriangle + ranges.back().triangleCount == triangle)
            ++ranges.back().triangleCount;
        else
            ranges.push_back({triangle, 1});
    }
    return ranges;
}

OtherSurfaces::OtherSurfaces(const Frame& frame, const std::vector<Receiver>& receivers) {
    const Scene& scene = frame.scene;
    std::vector<bool> other(scene.triangleCount(), true);
    for (const Receiver& receiver : receivers)
        for (const std::uint32_t triangle : receiver.triangles) other[triangle] = false;
    count_ = std::count(other.begin(), other.end(), true);
    for (const Light& light : scene.lights) {
        if (light.part < 0) continue;
        const Part& part = scene.parts[std::size_t(light.part)];
        const auto first = other.begin() + part.firstTriangle;
        count_ -= std::count(first, first + part.triangleCount, true);
    }

    const Frustum frustum(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y));
    const VisibleClusters visible =
        frame.skips(clustersUnseen) ? visibleClusters(scene, frustum) : allClusters(scene);
    std::map<int, std::pair<int, std::vector<std::uint32_t>>> byMaterial;  // a part of it, its triangles
    for (const std::uint32_t index : visible.clusters) {
        const Cluster& cluster = scene.clusters[index];
        auto& [part, triangles] = byMaterial[scene.parts[cluster.part].material];
        part = int(cluster.part);
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t)
            if (other[t]) triangles.push_back(t);
    }
    for (const auto& [material, entry] : byMaterial)
        if (!entry.second.empty()) seen_.push_back({entry.first, rangesOf(entry.second)});
}

void OtherSurfaces::draw(Program& program, const Frame& frame) const {
    for (const Run& run : seen_) {
        const DrawCounts drawn = frame.gpu->drawShaded(program, run.part, run.ranges);
        frame.work["triangles_shaded"] += std::int64_t(drawn.triangles);
        frame.work["draw_calls"] += std::int64_t(drawn.drawCalls);
    }
}

}  // namespace penumbra
