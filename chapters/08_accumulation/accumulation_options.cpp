#include "chapters/08_accumulation/accumulation_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "chapters/08_accumulation/received_light.h"
#include "common/error.h"
#include "common/math/polygon.h"
#include "common/math/sampling.h"

namespace penumbra {

namespace {

const std::vector<std::string> patternNames{"regular", "jittered", "fibonacci", "owen-sobol"};

const std::map<std::string, glm::dvec3> tints{
    {"white", {1.0, 1.0, 1.0}}, {"warm", {1.0, 0.72, 0.42}}, {"blue", {0.45, 0.65, 1.0}}};

/// Half-planes through the light's centre whose inside stays on.
std::vector<glm::dvec3> inward(const Light& light, const std::string& part) {
    const glm::dvec3 u = glm::normalize(light.polygons[0][1] - light.polygons[0][0]);
    const glm::dvec3 v = glm::cross(light.direction, u);
    if (part == "left") return {-u};
    if (part == "right") return {u};
    if (part == "quarter") return {u, v};
    return {};
}

}  // namespace

void AccumulationOptions::declare(Parameters& parameters) {
    parameters.add("light", maps.light, -1, 63, "",
                   "index of the light; -1: all of them, one after the other");
    parameters.add("samples", samples, 1, 4096, "",
                   "points of an area light; 4: hard edges side by side, 1024: smooth");
    parameters.add("pattern", pattern, patternNames,
                   "how the points are spread; regular: the paper's grid, with bands along its rows");
    parameters.add(
        "method", method, {"accumulate", "mask", "exact", "shadow-maps"},
        "accumulate: the paper's; mask: 32 points a draw call; exact: cone subtraction, no points");
    parameters.add("target", target, {"8", "16f", "32f", "rg32f"},
                   "bits of the sums of --method accumulate; 8: rounded away, 16f: not enough above 64, "
                   "rg32f: two channels, not the four of an accumulation buffer");
    parameters.add("weights", weights, {"ratio", "sum", "equal"},
                   "sum: the paper's, noise where nothing shadows; equal: wrong near a large light");
    parameters.add("light-part", lightPart, {"all", "left", "right", "quarter"},
                   "the part of an area light that is on; masks are kept, so nothing is drawn again");
    parameters.add("intensity", intensity, 0.0f, 16.0f, "", "of the light, a multiple of the scene's");
    parameters.add("tint", tint, {"white", "warm", "blue"}, "colour that the light is seen through");
    parameters.add("texels-per-metre", texelsPerMetre, 1.0f, 4096.0f, "1/m",
                   "of a receiver's texture; 20: blurred staircases at contacts");
    parameters.add("texel-budget", texelBudget, 1, 65536, "1024 texels",
                   "of all receivers together; what asks for more gets coarser textures");
    parameters.add("minimum-area", minimumArea, 1e-4f, 100.0f, "m^2",
                   "smaller flat polygons get no texture; 0.0001: thousands of tiny ones");
    parameters.add("others", others, {"shadow-maps", "unshadowed"},
                   "light on what is no receiver: curved and small surfaces");
    parameters.add("others-samples", othersSamples, 1, 4096, "", "their light points, a shadow map each");
    parameters.add("map-size", maps.mapSize, 16, 8192, "texels", "side of each of these shadow maps");
    parameters.add(
        "masks", masks, {"logic-op", "stencil"},
        "how bits are set; stencil: a draw call for each bit, for OpenGL ES, which has no logic op");
    for (const Skip* skip : {&receiversUnseen, &receiversUnreached, &clustersNotBetween, &texelsUnreached,
                             &texelsAgreeing, &trianglesOffBlock, &keptShadows, &keptTextures})
        parameters.skips().declare(*skip);
    declareMapSkips(parameters.skips());
}

std::vector<int> AccumulationOptions::chosenLights(const Scene& scene) const {
    if (maps.light >= 0) {
        maps.chosenLight(scene);  // throws if there is none
        return {maps.light};
    }
    std::vector<int> all(scene.lights.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
}

bool inLightPart(const Light& light, const std::string& part, const glm::dvec3& p) {
    if (light.type != LightType::area) return true;
    for (const glm::dvec3& n : inward(light, part))
        if (glm::dot(n, p - light.position) < 0.0) return false;
    return true;
}

Light AccumulationOptions::lit(const Scene& scene, int index) const {
    Light result = scene.lights[std::size_t(index)];
    result.emission *= double(intensity) * tints.at(tint);
    if (result.type != LightType::area || lightPart == "all") return result;
    const glm::dvec3 centre = result.position;
    std::vector<std::vector<glm::dvec3>> kept;
    glm::dvec3 sum(0.0);
    result.area = 0.0;
    for (const auto& whole : result.polygons) {
        Polygon3 polygon(whole);
        for (const glm::dvec3& n : inward(result, lightPart))
            polygon = clip(polygon, [&](const glm::dvec3& p) { return glm::dot(n, p - centre); });
        const double area = polygonArea(polygon.span());
        if (!(area > 0.0)) continue;
        kept.emplace_back(polygon.span().begin(), polygon.span().end());
        result.area += area;
        const glm::dvec3 corners = std::accumulate(kept.back().begin(), kept.back().end(), glm::dvec3(0.0));
        sum += area * corners / double(kept.back().size());
    }
    if (kept.empty()) throw UsageError("--light-part " + lightPart + ": nothing of the light is left on");
    result.polygons = std::move(kept);
    result.position = sum / result.area;
    return result;
}

std::vector<LightPoint> AccumulationOptions::points(const Light& of, int count, std::uint32_t seed) const {
    const auto found = std::find(patternNames.begin(), patternNames.end(), pattern);
    return lightPoints(of, count, LightPattern(found - patternNames.begin()), seed);
}

ReceiverRequest AccumulationOptions::receiverRequest(const Scene& scene) const {
    ReceiverRequest request;
    request.minimumArea = minimumArea;
    request.texelsPerMetre = texelsPerMetre;
    request.budget = std::int64_t(texelBudget) * 1024;
    request.lights = chosenLights(scene);
    return request;
}

std::string AccumulationOptions::shadowKey(std::uint32_t seed) const {
    return fmt::format("{} {} {} {} {} {} {} {} {} {}", maps.light, samples, pattern, method, target, masks,
                       texelsPerMetre, texelBudget, minimumArea, seed);
}

std::string AccumulationOptions::lightKey() const {
    return fmt::format("{} {} {} {}", weights, lightPart, intensity, tint);
}

}  // namespace penumbra
