#include "common/image/resample.h"

#include <fmt/format.h>

#include "common/error.h"

namespace penumbra {

FloatImage boxFilter(const FloatImage& image, int factor) {
    if (factor < 1 || image.width % factor != 0 || image.height % factor != 0)
        throw Error(fmt::format("a {}x{} picture cannot be made {} times smaller", image.width, image.height,
                                factor));
    if (factor == 1) return image;
    FloatImage result(image.width / factor, image.height / factor, image.channels);
    const double weight = 1.0 / (double(factor) * factor);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            for (int c = 0; c < result.channels; ++c) {
                double sum = 0.0;
                for (int i = 0; i < factor * factor; ++i)
                    sum += image.at(x * factor + i % factor, y * factor + i / factor, c);
                result.at(x, y, c) = float(sum * weight);
            }
        }
    }
    return result;
}

}  // namespace penumbra
