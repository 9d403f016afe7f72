// Chapter 11: where the light comes from.
//
// What a point sees of the sky has a size, A, and a middle: B, the mean open direction, the bent normal.
// Under a sky that is not the same everywhere, A times what an open plane gets is not enough: the sky has to
// be looked up where it is seen. The irradiance of the sky is kept in nine numbers or a small picture, and
// the look-up goes along B instead of n.
#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/06_jitter_texture/program_variants.h"
#include "chapters/09_ambient_occlusion/ambient_truth.h"
#include "chapters/09_ambient_occlusion/backdrop.h"
#include "chapters/11_bent_normals/irradiance_truth.h"
#include "chapters/11_bent_normals/seen_sky.h"
#include "chapters/11_bent_normals/sky_irradiance.h"
#include "common/app/pass_timer.h"
#include "common/error.h"
#include "common/scene/gpu_light.h"

using namespace penumbra;

namespace {

class BentNormals : public Chapter {
 public:
    void declare(Parameters& parameters) override { options_.declare(parameters); }

    void load(const Scene& scene, const Context*) override {
        seen_.emplace(scene);
        sky_.emplace();
        backdrop_.emplace();
        surfaces_.emplace("11_bent_normals/bent.vert", "11_bent_normals/bent.frag");
    }

    void render(const Frame& frame) override {
        options_.requireSense();
        // A sky or a lamp that is not there is named before a bake, not after it.
        options_.skyOf(frame.scene);
        options_.lamp(frame.scene);
        // [begin:passes]
        const bool asked = options_.asksTheSky(frame.view) || !frame.skips(skyNotShown);
        frame.work["points_asked"] = asked ? seen_->points(frame, options_) : 0;
        if (asked) {
            // Pass 1: A and B of each point, from rays, vertices or shadow maps (chapters 09, 10).
            seen_->update(frame, options_);

            // Pass 2, once for a sky: what it gives to an open plane with any normal.
            frame.work["irradiance_map_rows"] = sky_->update(frame.scene, options_);
        }

        // Pass 3: the picture. Each pixel looks the irradiance up along B, and takes A of it.
        const PassScope scope(frame.passTimer, "picture");
        backdrop_->draw(frame, options_.shining(), frame.view == "color" && options_.combine == "principled");
        glEnable(GL_DEPTH_TEST);
        if (asked)
            seen_->draw(underTheSky(frame), frame, options_);
        else
            drawPicture(surfaces(frame, {"LAMP_ALONE"}), frame);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        AmbientRays rays = options_.ambient().rays();
        rays.count = options_.truthRays;
        if (request.view == "irradiance")
            return irradianceTruth(request, options_.skyOf(request.scene), rays);
        if (request.view == "ambient") return ambientTruth(request, rays);
        if (request.view == "bent-normal") return bentNormalTruth(request, rays);
        throw UsageError(
            "--compare-truth: chapter 11 has exact answers for --view irradiance, ambient and bent-normal");
    }

    std::vector<Program*> programs() override {
        std::vector<Program*> all = surfaces_->compiled(), others = seen_->programs();
        all.insert(all.end(), others.begin(), others.end());
        all.push_back(&backdrop_->program());
        return all;
    }

 private:
    /// The shaders of bent.frag for this source and sky, their uniforms set.
    Program& underTheSky(const Frame& frame) {
        std::vector<std::string> defines = seen_->defines(options_), sky = sky_->defines(options_);
        defines.insert(defines.end(), sky.begin(), sky.end());
        Program& program = surfaces(frame, defines);
        sky_->set(program, options_);
        return program;
    }

    Program& surfaces(const Frame& frame, const std::vector<std::string>& defines) {
        Program& program = surfaces_->with(defines);
        program.set("uClipFromWorld",
                    glm::mat4(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y)));
        program.set("uView", viewNumber(frame.view));
        program.set("uCombine", options_.combine == "principled" ? 0 : options_.combine == "adhoc" ? 1 : 2);
        program.set("uLookUpBent", options_.lookUp == "bent");
        setLight(program, options_.lamp(frame.scene));
        return program;
    }

    static int viewNumber(const std::string& view) {
        const std::vector<std::string> names{"color",      "ambient", "bent-normal",
                                             "irradiance", "diffuse", "work"};
        return int(std::find(names.begin(), names.end(), view) - names.begin());
    }

    BentOptions options_;
    std::optional<SeenSky> seen_;
    std::optional<SkyIrradiance> sky_;
    std::optional<Backdrop> backdrop_;
    std::optional<ProgramVariants> surfaces_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "11_bent_normals",
        "B, the mean open direction: the sky is looked up where it is seen",
        {{"color", "diffuse surfaces, as --combine says"},
         {"irradiance", "light that arrives from the sky", false, false, 0.31830988618379067},
         {"ambient", "A: share of the sky that is seen, 0 to 1", true, false},
         {"bent-normal", "B: x, y, z as red, green, blue", false, false, 0.0},
         {"diffuse", "the lamp's diffuse light, without any shadow"},
         {"work", "blue: all is open; dark: nothing is; red: in between, where B matters", false, false,
          0.0}},
        true,
        192};  // with --source maps all of chapter 10's
    return runChapter<BentNormals>(info, argc, argv);
}
