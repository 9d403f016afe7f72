// Exact answers on disk, found again by a hash of everything they depend on. Comparing the same picture twice
// is quick; comparing after any change computes anew, since the hash is another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

#include "common/scene/scene.h"
#include "common/truth/truth_image.h"

namespace penumbra {

/// A 128-bit hash of bytes, for content, not for secrets. Adding the same things in the same order gives the
/// same hash.
class ContentHash {
 public:
    ContentHash& bytes(const void* data, std::size_t count);
    ContentHash& text(std::string_view text);
    ContentHash& number(std::int64_t value) { return bytes(&value, sizeof value); }
    ContentHash& number(double value) { return bytes(&value, sizeof value); }
    ContentHash& vector(const glm::dvec3& v) { return number(v.x).number(v.y).number(v.z); }
    template <class T>
    ContentHash& array(std::span<const T> values) {
        return number(std::int64_t(values.size())).bytes(values.data(), values.size_bytes());
    }
    /// What an exact answer depends on: geometry (not names, not colours), ...
    ContentHash& geometry(const Scene& scene);
    ContentHash& camera(const Camera& camera);
    ContentHash& light(const Light& light);

    std::string hex() const;  ///< 32 digits

 private:
    std::uint64_t a_ = 0x9e3779b97f4a7c15u;
    std::uint64_t b_ = 0xc2b2ae3d27d4eb4fu;
};

/// The answer stored under `key`, or `compute()`, which is then stored (written to a temporary file, then
/// renamed). A damaged file, or one from another version of the format, is computed and written again. A
/// folder that cannot be written costs the time of computing, no more.
TruthImage cachedTruth(const ContentHash& key, const std::function<TruthImage()>& compute);

/// $PENUMBRA_TRUTH_CACHE, else out/truth-cache of the project. Files beyond 1 GiB in all are removed, oldest
/// first.
std::filesystem::path truthCacheFolder();

}  // namespace penumbra
