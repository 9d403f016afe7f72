// Chapter 10: the sky is many lights.
//
// What chapter 09 asks with rays, one point at a time, a shadow map answers for all points at once: who sees
// the sky in this direction? Draw one for each of N directions, add up the answers in float, each by the
// cosine it counts with, and the mean is the ambient visibility.
#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/09_ambient_occlusion/ambient_truth.h"
#include "chapters/09_ambient_occlusion/backdrop.h"
#include "chapters/09_ambient_occlusion/bake_file.h"
#include "chapters/10_accumulated_occlusion/accumulated_occlusion.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class AccumulatedOcclusionChapter : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        options_.declare(parameters);
        declareSky(parameters, light_.sky);
        parameters.add("truth-rays", light_.truthRays, 64, 65536, "",
                       "rays at a pixel of the exact answer; the report says its standard error");
        parameters.addOrFile("save", save_, {"none"},
                             "writes the scene with the values of --method vertices as a .glb; draw it with "
                             "chapter 09's --method stored");
    }

    void load(const Scene&, const Context*) override {
        occlusion_.emplace();
        backdrop_.emplace();
        pixels_.emplace("09_ambient_occlusion/ambient.vert", "09_ambient_occlusion/ambient.frag",
                        std::vector<std::string>{"PIXELS"});
        vertices_.emplace("10_accumulated_occlusion/vertex_texels.vert", "09_ambient_occlusion/ambient.frag",
                          std::vector<std::string>{"STORED"});
    }

    void render(const Frame& frame) override {
        if (save_ != "none" && !options_.perVertex())
            throw UsageError("--save: only --method vertices makes values that a .glb can hold");
        if (save_ != "none" && save_ != savable_) requireSavable(save_);
        savable_ = save_;
        // [begin:passes]
        // Pass 1: where the receivers are: what the pixels see, or the vertices.
        // Passes 2 and 3, for a batch of directions at a time: a shadow map from each of them; every receiver
        // looks them all up, and adds what it finds to its sums.
        // Pass 4: the sums become means.
        const AmbientTextures textures = occlusion_->update(frame, options_, light_.light(frame.scene).sky);

        // Pass 5: the picture, as chapter 09 draws it.
        const PassScope scope(frame.passTimer, "picture");
        backdrop_->draw(frame, light_, frame.view == "color");
        draw(frame, textures);
        // [end:passes]
        if (save_ != "none" && frame.work.contains("directions_added"))
            saveAmbient(frame.scene, occlusion_->vertexValues(frame.scene), save_);
    }

    TruthImage truth(const TruthRequest& request) override {
        AmbientRays rays;
        rays.count = light_.truthRays;
        if (request.view == "ambient" || request.view == "visibility") return ambientTruth(request, rays);
        if (request.view == "irradiance")
            return skyIrradianceTruth(request, rays, light_.light(request.scene));
        throw UsageError("--compare-truth: chapter 10 has exact answers for --view ambient and irradiance");
    }

    std::vector<Program*> programs() override {
        std::vector<Program*> all = occlusion_->programs();
        for (Program* program : {&*pixels_, &*vertices_, &backdrop_->program()}) all.push_back(program);
        return all;
    }

 private:
    void draw(const Frame& frame, const AmbientTextures& textures) {
        Program& program = textures.perVertex ? *vertices_ : *pixels_;
        // Work is shown in the place of visibility.
        const GLuint stored = frame.view == "work" ? textures.light : textures.ambient;
        program.setTexture(textures.perVertex ? "uAmbient" : "uStored", GL_TEXTURE_2D, stored);
        program.setTexture(textures.perVertex ? "uLightOfVertices" : "uLight", GL_TEXTURE_2D, textures.light);
        program.set("uClipFromWorld",
                    glm::mat4(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y)));
        program.set("uView", frame.view == "color"         ? 0
                             : frame.view == "bent-normal" ? 2
                             : frame.view == "irradiance"  ? 3
                                                           : 1);
        glEnable(GL_DEPTH_TEST);
        drawPicture(program, frame);
    }

    OcclusionOptions options_;
    AmbientOptions light_;  ///< its sky
    std::string save_ = "none", savable_ = "none";
    std::optional<AccumulatedOcclusion> occlusion_;
    std::optional<Backdrop> backdrop_;
    std::optional<Program> pixels_, vertices_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "10_accumulated_occlusion",
        "the sky is many lights: N shadow maps, added up",
        {{"color", "diffuse surfaces under the sky"},
         {"visibility", "the same as ambient", true, false},
         {"ambient", "share of the sky that is seen, 0 to 1", true, false},
         {"bent-normal", "mean open direction: x, y, z as red, green, blue", false, false, 0.0},
         {"irradiance", "light that arrives", false, false, 0.31830988618379067},
         {"work", "share of the directions that were looked up", true, true}},
        true,
        176};
    return runChapter<AccumulatedOcclusionChapter>(info, argc, argv);
}
