#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "assets/make/shapes.h"

namespace penumbra::assets {
namespace {

double twiceArea(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
    return twiceArea(a, b, p) >= 0.0 && twiceArea(b, c, p) >= 0.0 && twiceArea(c, a, p) >= 0.0;
}

bool isEar(const Polygon& polygon, const std::vector<std::uint32_t>& left, std::size_t i) {
    const std::size_t n = left.size();
    const Vec2 &a = polygon[left[(i + n - 1) % n]], &b = polygon[left[i]], &c = polygon[left[(i + 1) % n]];
    if (twiceArea(a, b, c) <= 1e-12) return false;
    return std::none_of(left.begin(), left.end(), [&](std::uint32_t k) {
        const Vec2& p = polygon[k];
        return p != a && p != b && p != c && inside(p, a, b, c);
    });
}

}  // namespace

std::vector<glm::uvec3> triangulate(const Polygon& polygon) {
    std::vector<std::uint32_t> left(polygon.size());
    std::iota(left.begin(), left.end(), 0u);
    std::vector<glm::uvec3> triangles;
    std::size_t i = 0, tried = 0;
    while (left.size() > 2) {
        const std::size_t n = left.size();
        if (tried > n) throw std::logic_error("triangulate: the polygon crosses itself or runs clockwise");
        i %= n;
        if (isEar(polygon, left, i)) {
            triangles.push_back({left[(i + n - 1) % n], left[i], left[(i + 1) % n]});
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
            tried = 0;
        } else {
            ++i;
            ++tried;
        }
    }
    return triangles;
}

}  // namespace penumbra::assets
