#include "assets/make/hdr_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "common/image/file_write.h"

namespace penumbra::assets {
namespace {

using std::numbers::pi;
using Bytes = std::vector<std::uint8_t>;

constexpr int pointsAcross = 4;  ///< of a texel, in either direction

glm::dvec3 texelRadiance(const Environment& environment, int column, int row) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < pointsAcross * pointsAcross; ++i) {
        const int across = i % pointsAcross, down = i / pointsAcross;
        const double u = (column + (across + 0.5) / pointsAcross) / environment.width;
        const double v = (row + (down + 0.5) / pointsAcross) / environment.height;
        const double phi = 2.0 * pi * (u - 0.5), theta = pi * v;
        sum += environment.radiance(
            {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
    }
    return sum / double(pointsAcross * pointsAcross);
}

/// Red, green, blue as eighths of bits of 2^(exponent - 128), rounded to nearest.
std::array<std::uint8_t, 4> sharedExponent(const glm::dvec3& value) {
    const double largest = std::max(value.r, std::max(value.g, value.b));
    if (largest < 1e-30) return {0, 0, 0, 0};
    int exponent = 0;
    std::frexp(largest, &exponent);
    if (std::lround(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;  // rounded up to the next power
    std::array<std::uint8_t, 4> packed{};
    for (int c = 0; c < 3; ++c)
        packed[std::size_t(c)] = std::uint8_t(std::lround(std::ldexp(value[c], 8 - exponent)));
    packed[3] = std::uint8_t(exponent + 128);
    return packed;
}

std::size_t runAt(const Bytes& bytes, std::size_t start) {
    std::size_t end = start + 1;
    while (end < bytes.size() && end - start < 127 && bytes[end] == bytes[start]) ++end;
    return end - start;
}

/// Runs of four or more as (128 + length, value), what lies between as (length, values).
void putRuns(std::ostream& out, const Bytes& bytes) {
    std::size_t i = 0;
    while (i < bytes.size()) {
        if (const std::size_t run = runAt(bytes, i); run >= 4) {
            out.put(char(128 + run)).put(char(bytes[i]));
            i += run;
            continue;
        }
        std::size_t end = i + 1;
        while (end < bytes.size() && end - i < 128 && runAt(bytes, end) < 4) ++end;
        out.put(char(end - i));
        out.write(reinterpret_cast<const char*>(bytes.data() + i), std::streamsize(end - i));
        i = end;
    }
}

}  // namespace

double smoothStep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

void writeHdr(const std::filesystem::path& file, const Environment& environment) {
    std::ostringstream out;
    out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << environment.height << " +X " << environment.width
        << "\n";
    for (int row = 0; row < environment.height; ++row) {
        std::array<Bytes, 4> planes;
        for (int column = 0; column < environment.width; ++column) {
            const auto packed = sharedExponent(texelRadiance(environment, column, row));
            for (std::size_t k = 0; k < 4; ++k) planes[k].push_back(packed[k]);
        }
        out.put(2).put(2).put(char(environment.width >> 8)).put(char(environment.width & 255));
        for (const Bytes& plane : planes) putRuns(out, plane);
    }
    writeFile(file, out.str());
}

}  // namespace penumbra::assets
