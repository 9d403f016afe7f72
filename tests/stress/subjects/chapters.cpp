// The chapters' own classes are tried, so their main.cpp are part of this file.
#include "tests/stress/chapters.h"

#define main chapter00Main
#include "chapters/00_ray_traced_truth/main.cpp"
#undef main
#define main chapter01Main
#include "chapters/01_depth_from_light/main.cpp"
#undef main
#define main chapter02Main
#include "chapters/02_shadow_test/main.cpp"
#undef main
#define main chapter03Main
#include "chapters/03_polygon_offset/main.cpp"
#undef main
#define main chapter04Main
#include "chapters/04_pcf/main.cpp"
#undef main
#define main chapter05Main
#include "chapters/05_jittered_disk/main.cpp"
#undef main
#define main chapter06Main
#include "chapters/06_jitter_texture/main.cpp"
#undef main
#define main chapter07Main
#include "chapters/07_branching/main.cpp"
#undef main
#define main chapter08Main
#include "chapters/08_accumulation/main.cpp"
#undef main
#define main chapter09Main
#include "chapters/09_ambient_occlusion/main.cpp"
#undef main
#define main chapter10Main
#include "chapters/10_accumulated_occlusion/main.cpp"
#undef main
#define main chapter11Main
#include "chapters/11_bent_normals/main.cpp"
#undef main

namespace penumbra::stress {

std::unique_ptr<Chapter> makeChapter(const std::string& number) {
    if (number == "00") return std::make_unique<RayTracedTruth>();
    if (number == "01") return std::make_unique<DepthFromLight>();
    if (number == "02") return std::make_unique<ShadowTest>();
    if (number == "03") return std::make_unique<PolygonOffset>();
    if (number == "04") return std::make_unique<Pcf>();
    if (number == "05") return std::make_unique<JitteredDisk>();
    if (number == "06") return std::make_unique<JitterTextureChapter>();
    if (number == "07") return std::make_unique<Branching>();
    if (number == "08") return std::make_unique<Accumulation>();
    if (number == "09") return std::make_unique<AmbientOcclusion>();
    if (number == "10") return std::make_unique<AccumulatedOcclusionChapter>();
    if (number == "11") return std::make_unique<BentNormals>();
    throw Error("chapter " + number + ": is not among those that are stressed");
}

std::vector<std::string> viewsOf(const std::string& number) {
    if (number == "00") return {"color", "visibility", "irradiance", "rays"};
    if (number == "01") return {"color", "depth", "linear-depth", "light-view"};
    if (number == "07") return {"color", "visibility", "shadow-kind", "depth", "work"};
    if (number == "08") return {"color", "visibility", "irradiance", "textures", "work"};
    if (number == "09" || number == "10") return {"color", "ambient", "bent-normal", "irradiance", "work"};
    if (number == "11") return {"color", "ambient", "bent-normal", "irradiance", "diffuse", "work"};
    return {"color", "visibility", "shadow-kind", "depth"};
}

}  // namespace penumbra::stress
