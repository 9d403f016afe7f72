// --compare-truth: the picture against its exact answer.
#pragma once

#include <optional>

#include "common/app/chapter_session.h"
#include "common/app/report.h"

namespace penumbra {

struct TruthComparison {
    TruthImage truth;
    FloatImage actual;  ///< the same view, one sample a pixel
    ErrorReport report;
    std::optional<ErrorReport> areaLight;  ///< the same view against Chapter::areaLightTruth
};

/// A picture that is there already, one sample a pixel, and its view.
struct DrawnPicture {
    std::string view;
    const FloatImage* picture = nullptr;  ///< null: none
};

/// The view to compare: `preferred` if the chapter has an exact answer for it, else visibility, else the
/// first view that has one. It is drawn unless it is `drawn` already. Throws UsageError if no view has an
/// exact answer.
TruthComparison compareWithTruth(ChapterSession& session, const std::string& preferred,
                                 const DrawnPicture& drawn);

/// |actual - exact|, 1 channel (of the channel that differs most); NaN where the exact answer is undefined.
FloatImage absoluteError(const TruthComparison& comparison);

/// The exact values, NaN where they are undefined.
FloatImage definedTruth(const TruthComparison& comparison);

/// Paints grey over what is undefined in a 1- or 3-channel picture for the screen: neither colour nor
/// magenta, since it is neither an error nor a fault. 3 channels out.
FloatImage greyWhereUndefined(const FloatImage& shown, const FloatImage& mask);

}  // namespace penumbra
