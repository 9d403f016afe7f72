#include "common/truth/truth_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/image/file_write.h"

namespace penumbra {

namespace {

constexpr std::string_view formatName = "penumbra truth 1\n";

std::uint64_t mixed(std::uint64_t v) {  // the finaliser of SplitMix64 (Steele, Lea & Flood 2014, OOPSLA)
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
    return v ^ (v >> 31);
}

/// Appends values to, or takes them from, a byte string; taking past the end fails for good.
class Writer {
 public:
    void number(std::uint64_t value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); }
    void text(const std::string& value) {
        number(value.size());
        out += value;
    }
    void image(const FloatImage& image) {
        number(std::uint64_t(image.width));
        number(std::uint64_t(image.height));
        number(std::uint64_t(image.channels));
        out.append(reinterpret_cast<const char*>(image.values.data()), image.values.size() * sizeof(float));
    }
    std::string out;
};

class Reader {
 public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}
    bool ok() const { return ok_; }
    bool finished() const { return ok_ && rest_.empty(); }
    std::uint64_t number() {
        std::uint64_t value = 0;
        take(&value, sizeof value);
        return value;
    }
    std::string text() {
        std::string value(checked(number()), '\0');
        take(value.data(), value.size());
        return value;
    }
    FloatImage image() {
        const std::uint64_t width = number(), height = number(), channels = number();
        if (width > 65536 || height > 65536 || channels > 4 || checked(width * height * channels * 4) == 0)
            return {};
        FloatImage result{int(width), int(height), int(channels)};
        take(result.values.data(), result.values.size() * sizeof(float));
        return result;
    }

 private:
    std::size_t checked(std::uint64_t count) {
        ok_ = ok_ && count <= rest_.size();
        return ok_ ? std::size_t(count) : 0;
    }
    void take(void* target, std::size_t count) {
        if (checked(count) != count) return;
        std::memcpy(target, rest_.data(), count);
        rest_.remove_prefix(count);
    }
    std::string_view rest_;
    bool ok_ = true;
};

std::string checksum(std::string_view bytes) {
    return ContentHash().text(bytes).hex();
}

std::string encode(const TruthImage& truth) {
    Writer writer;
    writer.image(truth.value);
    writer.image(truth.mask);
    for (const std::string* text : {&truth.quantity, &truth.method, &truth.against}) writer.text(*text);
    for (const std::size_t count : {truth.background, truth.facingAway, truth.straddling})
        writer.number(count);
    return std::string(formatName) + checksum(writer.out) + writer.out;
}

std::optional<TruthImage> decode(std::string_view file) {
    constexpr std::size_t header = formatName.size() + 32;
    if (file.size() < header || !file.starts_with(formatName)) return std::nullopt;
    const std::string_view body = file.substr(header);
    if (file.substr(formatName.size(), 32) != checksum(body)) return std::nullopt;
    Reader reader(body);
    TruthImage truth;
    truth.value = reader.image();
    truth.mask = reader.image();
    for (std::string* text : {&truth.quantity, &truth.method, &truth.against}) *text = reader.text();
    for (std::size_t* count : {&truth.background, &truth.facingAway, &truth.straddling})
        *count = reader.number();
    return reader.finished() ? std::optional(truth) : std::nullopt;
}

std::optional<TruthImage> load(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;  // reading a folder throws
    std::ifstream in(file, std::ios::binary);
    return decode(std::string(std::istreambuf_iterator<char>(in), {}));
}

/// Of ours: exact answers, bakes that wait to be taken up again, and what a kill left of either.
bool isCached(const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    const std::string whole = name.substr(0, name.find(".part-"));
    return whole.ends_with(".truth") || whole.ends_with(".bake");
}

void removeOldest(const std::filesystem::path& folder) {
    constexpr std::uintmax_t most = std::uintmax_t(1) << 30;
    std::vector<std::filesystem::directory_entry> files;
    std::uintmax_t total = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!isCached(entry.path())) continue;
        files.push_back(entry);
        total += entry.file_size();
    }
    std::ranges::sort(files, {}, [](const auto& entry) { return entry.last_write_time(); });
    for (const auto& entry : files) {
        if (total <= most) return;
        total -= entry.file_size();
        std::filesystem::remove(entry.path());
    }
}

void store(const std::filesystem::path& file, const TruthImage& truth) {
    try {
        writeFile(file, encode(truth));
        removeOldest(file.parent_path());
    } catch (const Error&) {  // a read-only checkout: the answer is right all the same
    } catch (const std::filesystem::filesystem_error&) {  // another process tidied up at the same time
    }
}

}  // namespace

ContentHash& ContentHash::bytes(const void* data, std::size_t count) {
    const auto* p = static_cast<const unsigned char*>(data);
    const auto absorb = [this](std::uint64_t word) {
        a_ = mixed(a_ ^ word);
        b_ = std::rotl(b_, 23) * 0x9fb21c651e98df25u + mixed(word + b_);
    };
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        std::uint64_t word;
        std::memcpy(&word, p + i, 8);
        absorb(word);
    }
    std::uint64_t last = 0;
    if (i < count) std::memcpy(&last, p + i, count - i);
    absorb(last ^ (std::uint64_t(count - i) << 56));
    return *this;
}

ContentHash& ContentHash::text(std::string_view text) {
    return number(std::int64_t(text.size())).bytes(text.data(), text.size());
}

ContentHash& ContentHash::geometry(const Scene& scene) {
    array(std::span(scene.positions)).array(std::span(scene.normals)).array(std::span(scene.indices));
    for (const Part& part : scene.parts) {
        number(std::int64_t(part.firstTriangle)).number(std::int64_t(part.triangleCount));
    }
    return *this;
}

ContentHash& ContentHash::camera(const Camera& camera) {
    vector(camera.position).vector(camera.forward).vector(camera.up);
    number(std::int64_t(camera.orthographic)).number(camera.verticalFov).number(camera.height);
    return number(camera.near).number(camera.far);
}

ContentHash& ContentHash::light(const Light& light) {
    number(std::int64_t(light.type)).vector(light.position).vector(light.direction).vector(light.emission);
    number(light.innerCone).number(light.outerCone).number(light.area).number(std::int64_t(light.part));
    for (const auto& polygon : light.polygons) array(std::span(polygon));
    return *this;
}

std::string ContentHash::hex() const {
    return fmt::format("{:016x}{:016x}", mixed(a_ ^ b_), mixed(b_));
}

TruthImage cachedTruth(const ContentHash& key, const std::function<TruthImage()>& compute) {
    const std::filesystem::path file = truthCacheFolder() / (key.hex() + ".truth");
    if (std::optional<TruthImage> found = load(file)) return *found;
    TruthImage truth = compute();
    store(file, truth);
    return truth;
}

std::filesystem::path truthCacheFolder() {
    const char* chosen = std::getenv("PENUMBRA_TRUTH_CACHE");
    return chosen ? std::filesystem::path(chosen)
                  : std::filesystem::path(PENUMBRA_SOURCE_DIR) / "out" / "truth-cache";
}

}  // namespace penumbra
