// Chapter 09: the sky is a light.
//
// Under a cloudy sky light comes from everywhere at once, and what makes a place dark is how little of the
// sky it sees. The lecture's three solutions, side by side: by the normal alone; rays from each pixel; rays
// from each vertex or triangle, once, stored with the surface. And what can be stored besides a number: which
// directions are open, S(x, l), so that any sky may shine afterwards.
#include "chapters/09_ambient_occlusion/ambient_picture.h"
#include "chapters/09_ambient_occlusion/ambient_truth.h"
#include "chapters/09_ambient_occlusion/profile.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class AmbientOcclusion : public Chapter {
 public:
    void declare(Parameters& parameters) override { options_.declare(parameters); }

    void load(const Scene& scene, const Context*) override {
        pixels_.emplace(scene);
        baked_.emplace(scene);
        picture_.emplace();
    }

    void render(const Frame& frame) override {
        if (frame.view == "profile" && options_.method != "rays")
            throw UsageError("--view profile: is made of the pixels of --method rays");
        if (options_.save != "none" && options_.method != "vertices" && options_.method != "bits")
            throw UsageError("--save: only --method vertices and bits make values that a .glb can hold");
        options_.light(frame.scene);  // a sky that cannot be had is named before a bake, not after it
        // [begin:solutions]
        // Solution 1: the normal knows how much of the sky lies behind the surface itself.
        if (options_.method == "hemisphere") return picture_->drawHemisphere(frame, options_);

        // Solution 2: from each pixel rays into its hemisphere; those that get away bring the sky's light.
        if (options_.method == "rays") {
            pixels_->update(frame, options_);
            const PassScope scope(frame.passTimer, "picture");
            if (frame.view == "profile") return picture_->show(frame, profilePicture(frame, *pixels_));
            return picture_->drawPixels(frame, options_, *pixels_);
        }

        // Solution 3: the same, once, and stored with the surface. Drawing needs no ray any more.
        baked_->update(frame, options_);
        const PassScope scope(frame.passTimer, "picture");
        picture_->drawBaked(frame, options_, *baked_);
        // [end:solutions]
    }

    TruthImage truth(const TruthRequest& request) override {
        AmbientRays rays = options_.rays();
        rays.count = options_.truthRays;
        if (request.view == "ambient" || request.view == "visibility") return ambientTruth(request, rays);
        if (request.view == "irradiance")
            return skyIrradianceTruth(request, rays, options_.light(request.scene));
        throw UsageError("--compare-truth: chapter 09 has exact answers for --view ambient and irradiance");
    }

    std::vector<Program*> programs() override { return picture_->programs(); }

 private:
    AmbientOptions options_;
    std::optional<PixelRays> pixels_;
    std::optional<BakedAmbient> baked_;
    std::optional<AmbientPicture> picture_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "09_ambient_occlusion",
        "the sky is a light: how much of it does a point see?",
        {{"color", "diffuse surfaces under the sky"},
         {"visibility", "the same as ambient", true, false},
         {"ambient", "share of the sky that is seen, 0 to 1", true, false},
         {"bent-normal", "mean open direction: x, y, z as red, green, blue", false, false, 0.0},
         {"irradiance", "light that arrives", false, false, 0.31830988618379067},
         {"work", "blue: nothing could be in the way; grey: all rays agree; red: they do not", false, false,
          0.0},
         {"profile", "ambient visibility along the middle row, and the surface below it", false, false, 0.0}},
        true,
        128};
    return runChapter<AmbientOcclusion>(info, argc, argv);
}
