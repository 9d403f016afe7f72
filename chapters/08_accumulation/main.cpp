// Chapter 08: an area light is many points.
//
// On a plane, the shadow that one point of a light throws is a drawing: project what is in between by a
// matrix, and what is covered is dark (Heckbert & Herf 1997). An area light is many such points; the average
// of their hard shadows, each weighted by what its point would give, is the soft shadow. The result is a
// texture of light on each flat receiver.
#include "chapters/08_accumulation/accumulation_truth.h"
#include "chapters/08_accumulation/picture.h"
#include "chapters/08_accumulation/texture_sheet.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class Accumulation : public Chapter {
 public:
    void declare(Parameters& parameters) override { options_.declare(parameters); }

    void load(const Scene&, const Context*) override {
        received_.emplace();
        picture_.emplace();
        sheet_.emplace();
    }

    void render(const Frame& frame) override {
        if (frame.view == "hard-shadows" && options_.method != "mask")
            throw UsageError("--view hard-shadows: shows the bits of --method mask");
        // [begin:passes]
        // --method shadow-maps: no receiver is special, the camera's pixels are added up.
        if (options_.method == "shadow-maps") {
            if (frame.view == "textures")
                throw UsageError("--view textures: --method shadow-maps has no textures of light");
            return picture_->draw(frame, options_, nullptr);
        }

        // Pass 1: for each light and receiver the hard shadows of all light points, and their weighted sum.
        // Pass 2: the sums become light: what Lambert's formula gives times the share that is seen.
        const bool sheet = frame.view == "textures" || frame.view == "hard-shadows";
        received_->update(frame, options_, outputOf(frame.view),
                          sheet ? ReceivedLight::For::sheets : ReceivedLight::For::picture);

        // Pass 3: the picture, each receiver with its texture of light.
        const PassScope scope(frame.passTimer, "picture");
        if (sheet) return drawSheet(frame);
        picture_->draw(frame, options_, &*received_);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override { return accumulationTruth(request, options_); }

    std::vector<Program*> programs() override {
        std::vector<Program*> all = received_->programs(), drawing = picture_->programs();
        all.insert(all.end(), drawing.begin(), drawing.end());
        all.push_back(&sheet_->program());
        return all;
    }

 private:
    static ReceivedLight::Output outputOf(const std::string& view) {
        if (view == "visibility" || view == "hard-shadows") return ReceivedLight::Output::visibility;
        if (view == "work") return ReceivedLight::Output::work;
        return ReceivedLight::Output::irradiance;
    }

    void drawSheet(const Frame& frame) {
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glDisable(GL_DEPTH_TEST);
        if (frame.view == "textures")
            sheet_->drawTextures(frame, *received_);
        else
            sheet_->drawHardShadows(frame, *received_);
    }

    AccumulationOptions options_;
    std::optional<ReceivedLight> received_;
    std::optional<Picture> picture_;
    std::optional<TextureSheet> sheet_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "08_accumulation",
        "an area light is many points: hard shadows on planes, added up",
        {{"color", "diffuse surfaces in the light's soft shadow"},
         {"visibility", "share of the unoccluded light that arrives, 0 to 1", true, false},
         {"irradiance", "light that arrives", false, false, 0.31830988618379067},
         {"textures", "the receivers' textures of light, side by side", false, false, 0.31830988618379067},
         {"hard-shadows", "of each light point on the largest receiver, side by side", true, false},
         {"work", "red: points disagree; grey: lit or dark without weights; blue: nothing could shadow it",
          false, false, 0.0}},
        true,
        96};  // the number of each pixel's receiver too
    return runChapter<Accumulation>(info, argc, argv);
}
