#include "chapters/08_accumulation/texel_blocks.h"

#include <algorithm>
#include <vector>

#include "chapters/08_accumulation/reach.h"

namespace penumbra {

namespace {

class Visitor {
 public:
    Visitor(const Receiver& receiver, const Light& light, const BlockRequest& request,
            const std::function<void(const TexelBlock&)>& visit)
        : receiver_(receiver), light_(light), request_(request), visit_(visit) {}

    void visit(const glm::ivec2& first, const glm::ivec2& size, std::span<const Triangle> occluders) const {
        const Reach reach(texelCorners(receiver_, first, size, 0.0), receiver_.normal, light_);
        std::vector<Triangle> reaching;
        if (!reach.empty())
            for (const Triangle& t : occluders)
                if (!reach.misses(t)) reaching.push_back(t);
        const bool small = std::max(size.x, size.y) <= request_.blockTexels;
        if (small || reaching.empty()) {
            visit_({first, size, reaching});
            return;
        }
        const int axis = size.x >= size.y ? 0 : 1;
        const int blocks = (size[axis] + request_.blockTexels - 1) / request_.blockTexels;
        glm::ivec2 near = size, far = size, middle = first;
        near[axis] = (blocks + 1) / 2 * request_.blockTexels;
        far[axis] = size[axis] - near[axis];
        middle[axis] += near[axis];
        visit(first, near, reaching);
        visit(middle, far, reaching);
    }

 private:
    const Receiver& receiver_;
    const Light& light_;
    const BlockRequest& request_;
    const std::function<void(const TexelBlock&)>& visit_;
};

}  // namespace

std::array<glm::dvec3, 4> texelCorners(const Receiver& receiver, const glm::ivec2& first,
                                       const glm::ivec2& size, double margin) {
    const glm::dvec2 texel = 1.0 / glm::dvec2(receiver.texels);
    const glm::dvec2 lower = (glm::dvec2(first) + 0.5 - margin) * texel;
    const glm::dvec2 upper = (glm::dvec2(first + size) - 0.5 + margin) * texel;
    return {receiver.at(lower), receiver.at({upper.x, lower.y}), receiver.at(upper),
            receiver.at({lower.x, upper.y})};
}

void visitBlocks(const Receiver& receiver, const Light& light, std::span<const Triangle> occluders,
                 const BlockRequest& request, const std::function<void(const TexelBlock&)>& visit) {
    const int rows = request.rows > 0 ? request.rows : receiver.texels.y;
    Visitor(receiver, light, request, visit)
        .visit({0, request.firstRow}, {receiver.texels.x, rows}, occluders);
}

}  // namespace penumbra
