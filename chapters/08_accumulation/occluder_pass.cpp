#include "chapters/08_accumulation/occluder_pass.h"

namespace penumbra {

namespace {

constexpr GLuint firstRow = 4;  // attribute location of project.vert
constexpr std::size_t bytesPerPoint = 16 * sizeof(float);

}  // namespace

void OccluderPass::begin(const Frame& frame, const ShadowPlan& plan, int lightPart) {
    frame_ = &frame;
    plan_ = &plan;
    lightPart_ = lightPart;
    std::vector<glm::mat4> rows;
    for (const ReceiverProjection& projection : plan.projections)
        rows.emplace_back(glm::transpose(projection.clipFromWorld));
    glBindBuffer(GL_ARRAY_BUFFER, matrices_.id());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(rows.size() * bytesPerPoint), rows.data(), GL_STREAM_DRAW);
    glDisable(GL_DEPTH_TEST);
}

// [begin:instances]
void OccluderPass::draw(Program& program, int first, int count) {
    glBindVertexArray(frame_->gpu->depthArray());
    glBindBuffer(GL_ARRAY_BUFFER, matrices_.id());
    for (GLuint row = 0; row < 4; ++row) {
        const std::size_t offset = std::size_t(first) * bytesPerPoint + row * 4 * sizeof(float);
        glEnableVertexAttribArray(firstRow + row);
        glVertexAttribPointer(firstRow + row, 4, GL_FLOAT, GL_FALSE, GLsizei(bytesPerPoint),
                              reinterpret_cast<const void*>(offset));
        glVertexAttribDivisor(firstRow + row, 1);  // one step per instance, not per vertex
    }
    program.prepareToDraw();
    const DrawCounts drawn = frame_->gpu->drawDepth({.visible = &plan_->occluders.clusters,
                                                     .cullClosed = plan_->cullClosed,
                                                     .exceptPart = lightPart_,
                                                     .instances = count});
    frame_->work["occluders_drawn"] += std::int64_t(drawn.triangles);
    frame_->work["draw_calls"] += std::int64_t(drawn.drawCalls);
}
// [end:instances]

}  // namespace penumbra
