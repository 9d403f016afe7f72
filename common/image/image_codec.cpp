#include "common/image/image_codec.h"

#include <fmt/format.h>

#include "common/error.h"
#include "common/system/dynamic_library.h"

namespace penumbra {
namespace {

const ImageCodec& loadCodec() {
    try {
        // Where the build put it, so that a program works wherever it is copied to on this machine.
        static const DynamicLibrary library({PENUMBRA_IMAGE_CODEC}, "PENUMBRA_IMAGE_CODEC");
        return *library.function<const ImageCodec* (*)()>("penumbraImageCodec")();
    } catch (const Error& error) {
        throw Error(fmt::format("pictures cannot be read or written: {}; build again with ./run --build",
                                error.what()));
    }
}

}  // namespace

const ImageCodec& imageCodec() {
    static const ImageCodec& codec = loadCodec();
    return codec;
}

}  // namespace penumbra
