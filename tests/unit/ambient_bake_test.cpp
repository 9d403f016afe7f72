#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "chapters/09_ambient_occlusion/bake_file.h"
#include "chapters/09_ambient_occlusion/baked_ambient.h"
#include "chapters/09_ambient_occlusion/least_squares.h"
#include "chapters/09_ambient_occlusion/shared_rays.h"
#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/09_ambient_occlusion/visibility_bits.h"
#include "common/error.h"
#include "common/image/file_write.h"
#include "common/math/sampling.h"
#include "common/scene/gltf_loader.h"
#include "tests/unit/temporary_folder.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {
namespace {

using namespace test_meshes;

AmbientBake baked(const Scene& scene, BakeSettings settings) {
    return bakeVertices(scene, RayBundle(scene), settings);
}

BakeSettings alone(int rays) {
    BakeSettings settings;
    settings.rays.count = rays;
    settings.share = false;
    return settings;
}

BakeSettings shared(int rays) {
    BakeSettings settings;
    settings.rays.count = rays;
    return settings;
}

/// A height field over [-1,1]^2, smooth normals, `cells`^2 quads.
Scene heightField(int cells, const std::function<double(double, double)>& height) {
    Scene scene = emptyScene();
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    for (int z = 0; z <= cells; ++z)
        for (int x = 0; x <= cells; ++x) {
            const double u = 2.0 * x / cells - 1.0, v = 2.0 * z / cells - 1.0;
            points.emplace_back(u, height(u, v), v);
        }
    const auto row = std::uint32_t(cells + 1);
    for (std::uint32_t z = 0; z + 1 < row; ++z)
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t i = z * row + x;
            indices.insert(indices.end(), {i, i + row, i + 1, i + 1, i + row, i + row + 1});
        }
    test_meshes::addPart(scene, points, indices, scaledAndMoved(1.0, 0.0));
    return scene;
}

/// Gentle hills, cut by a narrow valley with straight walls and edges.
double hillsWithGully(double u, double v) {
    const double hills = 0.08 * (std::sin(7.0 * u + 3.0 * v) + 0.5 * std::sin(13.0 * v - 5.0 * u));
    const double fromGully = std::abs(u - 0.15 * std::sin(3.0 * v));
    return hills - 3.0 * std::max(0.0, 0.1 - fromGully);
}

double rmse(const std::vector<AmbientValue>& a, const std::vector<AmbientValue>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(a[i].visibility - b[i].visibility, 2.0);
    return std::sqrt(sum / double(a.size()));
}

/// A room of 2 x 2 x 2 metres: a box seen from inside, each wall in `cells`^2 quads.
Scene room(int cells) {
    Scene scene = emptyScene();
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const auto place = [&](double s, double t) {
                glm::dvec3 p(0.0);
                p[axis] = side;
                p[(axis + 1) % 3] = side > 0.0 ? s : t;
                p[(axis + 2) % 3] = side > 0.0 ? t : s;
                return p;
            };
            for (int i = 0; i < cells; ++i)
                for (int k = 0; k < cells; ++k) {
                    const double s = 2.0 * i / cells - 1.0, t = 2.0 * k / cells - 1.0, d = 2.0 / cells;
                    addQuad(scene, place(s, t), place(s, t + d), place(s + d, t + d), place(s + d, t));
                }
        }
    return scene;
}

TEST(Bake, ConvexSurfacesAreOpenToTheLastBit) {
    struct Placement {
        double scale, offset;
    };
    for (const bool skip : {true, false}) {
        BakeSettings settings = alone(64);
        settings.skip = skip;
        for (const auto [scale, offset] : std::vector<Placement>{{1, 0}, {1e-3, 1}, {1e3, 1e4}, {1, 1e4}}) {
            Scene scene = emptyScene();
            addBox(scene, scaledAndMoved(scale, offset));
            const AmbientBake bake = baked(scene, settings);
            for (const AmbientValue& v : bake.values)
                EXPECT_EQ(v.visibility, 1.0) << "box, scale " << scale << ", offset " << offset;
            EXPECT_EQ(bake.work.rays == 0, skip);
        }
        for (const double scale : {1e-3, 1.0, 1e3}) {
            Scene scene = emptyScene();
            addSphere(scene, 3, scaledAndMoved(scale, 0.0));
            for (const AmbientValue& v : baked(scene, settings).values)
                EXPECT_EQ(v.visibility, 1.0) << "ball, scale " << scale;
        }
    }
    Scene coarse = emptyScene();
    addSphere(coarse, 0, scaledAndMoved(1.0, 0.0));
    BakeSettings settings = shared(64);
    settings.skip = false;
    const Scene& scene = coarse;
    for (const AmbientValue& v : baked(scene, settings).values) EXPECT_EQ(v.visibility, 1.0) << "icosahedron";
    for (const AmbientValue& v : bakeTriangles(scene, RayBundle(scene), settings).values)
        EXPECT_EQ(v.visibility, 1.0);
}

TEST(Bake, ANeedleDoesNotShadowItself) {
    // A hundred thousand times as long as wide: floats turn its plane by degrees.
    std::mt19937_64 random(31);
    BakeSettings settings = alone(64);
    settings.skip = false;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 along = randomDirection(random), tip = 0.1 * randomDirection(random);
        const glm::dvec3 across = glm::normalize(glm::cross(along, randomDirection(random)));
        Scene scene = emptyScene();
        addPart(scene, {tip + 0.7 * along, tip, tip + 5e-6 * across}, {0, 1, 2}, scaledAndMoved(1.0, 0.0));
        for (const AmbientValue& v : baked(scene, settings).values) EXPECT_EQ(v.visibility, 1.0) << i;
        const BakedBits bits = bakeBits(scene, RayBundle(scene), 64, {});
        for (std::size_t l = 0; l < 64; ++l)
            EXPECT_EQ(bits.bits.open(0, l), glm::dot(scene.normals[0], bits.bits.directions[l]) > 0.0f) << i;
    }
}

TEST(Bake, ACreaseShadowsItself) {
    // Two half planes at a right angle that share the vertices, and the normal, of their edge: from there a
    // quarter of the circle around the normal is open, A = (cos 45 deg - cos 135 deg) / 2.
    const Scene scene = heightField(32, [](double u, double) { return std::abs(u); });
    const AmbientBake bake = baked(scene, alone(1024));
    const std::size_t middle = 16 * 33 + 16;
    EXPECT_NEAR(bake.values[middle].visibility, std::sqrt(0.5), 0.03);  // 0.02: the ends of the gully
    EXPECT_NEAR(glm::normalize(bake.values[middle].bent).y, 1.0, 1e-3);
}

TEST(Bake, VerticesAtOnePlaceWithOneNormalAreOnePoint) {
    Scene once = heightField(12, hillsWithGully), twice = once;
    for (std::size_t i = 0; i < once.positions.size(); ++i) {
        twice.positions.push_back(once.positions[i]);
        twice.normals.push_back(once.normals[i]);
        twice.uvs.push_back(once.uvs[i]);
    }
    // Every other triangle uses the copies.
    for (std::size_t i = 0; i < twice.indices.size(); ++i)
        if (i / 3 % 2 == 1) twice.indices[i] += std::uint32_t(once.positions.size());
    for (const BakeSettings& settings : {alone(32), shared(64)}) {
        const AmbientBake a = baked(once, settings), b = baked(twice, settings);
        EXPECT_EQ(b.work.merged, std::int64_t(once.positions.size()));
        EXPECT_EQ(a.work.rays, b.work.rays);
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            EXPECT_EQ(a.values[i].visibility, b.values[i].visibility);
            EXPECT_EQ(b.values[i].visibility, b.values[i + a.values.size()].visibility);
        }
    }
}

TEST(Bake, NothingAboveThePlaneNeedsNoRay) {
    Scene scene = heightField(20, [](double, double) { return 0.0; });
    addBox(scene, [](const glm::dvec3& p) { return 0.2 * p + glm::dvec3(0.3, 0.4, 0.0); });
    BakeSettings settings = alone(64);
    settings.rays.reach.range = 0.15;  // the box hangs 0.3 above the plane
    AmbientBake skipping = baked(scene, settings);
    EXPECT_EQ(skipping.work.rays, 0);
    settings.rays.reach.range = 0.5;
    skipping = baked(scene, settings);
    settings.skip = false;
    const AmbientBake all = baked(scene, settings);
    EXPECT_GT(skipping.work.skipped, 100);
    EXPECT_LT(skipping.work.skipped, skipping.work.points - skipping.work.merged - 50);
    EXPECT_GT(all.work.rays, skipping.work.rays);
    for (std::size_t i = 0; i < all.values.size(); ++i)
        EXPECT_EQ(all.values[i].visibility, skipping.values[i].visibility) << i;
}

/// The same values, to the last bit, whether the skip is on or off; returns how many points it skips.
std::int64_t expectSkipChangesNothing(const Scene& scene, BakeSettings settings) {
    const RayBundle bundle(scene);
    const AmbientBake skipping = bakeVertices(scene, bundle, settings);
    settings.skip = false;
    const AmbientBake all = bakeVertices(scene, bundle, settings);
    int differing = 0;
    for (std::size_t i = 0; i < all.values.size(); ++i)
        differing += all.values[i].visibility != skipping.values[i].visibility ||
                     all.values[i].bent != skipping.values[i].bent;
    EXPECT_EQ(differing, 0) << "of " << all.values.size();
    return skipping.work.skipped;
}

TEST(Bake, SplitNormalsDoNotDarkenAConvexSurface) {
    // As at the rims of a model's cylinders: each vertex has a part of the circle only, and a normal that is
    // not its triangles'.
    Scene ball = emptyScene();
    addSphere(ball, 1, scaledAndMoved(1.0, 0.0));
    Scene scene = withoutSharedVertices(ball);
    std::mt19937_64 random(11);
    for (glm::vec3& n : scene.normals)
        n = glm::vec3(glm::normalize(glm::dvec3(n) + 0.01 * randomDirection(random)));
    for (const bool share : {false, true}) {
        BakeSettings settings = shared(256);
        settings.share = share;
        EXPECT_EQ(expectSkipChangesNothing(scene, settings), std::int64_t(scene.positions.size()));
    }
}

TEST(Bake, FromARidgeTheNextOfTheSameHeightIsNotAbove) {
    // By solid angle: many rays go out near the horizon.
    const Scene scene =
        heightField(32, [](double u, double) { return int(32.5 + 16.0 * u) % 2 ? 0.5 : 0.0; });
    BakeSettings settings = alone(512);
    settings.rays.weighting = Weighting::uniform;
    EXPECT_GE(expectSkipChangesNothing(scene, settings), 16 * 33);
}

TEST(Bake, WhatIsJustBeyondTheRangeIsBeyondItForEveryRay) {
    // A floor of four triangles and walls around it: the rays of the middle begin a little nearer to them.
    const std::vector<glm::dvec3> points = {{0, 0, 0}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {-1, 0, 1}};
    Scene scene = emptyScene();
    addPart(scene, points, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1}, scaledAndMoved(1.0, 0.0));
    const glm::dvec3 up(0.0, 0.5, 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 &a = points[i + 1], &b = points[(i + 1) % 4 + 1];
        addQuad(scene, a, a + up, b + up, b);
    }
    BakeSettings settings = alone(8192);
    settings.rays.weighting = Weighting::uniform;
    settings.rays.reach.range = 1.0 - 1e-4;
    EXPECT_EQ(expectSkipChangesNothing(scene, settings), 0);
    settings.rays.reach.range = 1.0 - 1e-2;
    EXPECT_EQ(expectSkipChangesNothing(scene, settings), 1);
}

TEST(Bake, ARoomIsBlackWithoutALimitAndOpenInTheMiddleOfItsWallsWithOne) {
    const Scene scene = room(8);
    BakeSettings settings = shared(256);
    for (const AmbientValue& v : baked(scene, settings).values) {
        EXPECT_EQ(v.visibility, 0.0);
        EXPECT_EQ(v.bent, glm::dvec3(0.0));
    }
    settings.rays.reach.range = 0.4;
    const AmbientBake limited = baked(scene, settings);
    double least = 1.0;
    for (std::size_t i = 0; i < limited.values.size(); ++i) {
        const glm::vec3 p = glm::abs(scene.positions[i]);
        const float toWall = 1.0f - (p.x + p.y + p.z - 1.0f - std::min({p.x, p.y, p.z}));
        if (toWall > 0.41f) {
            EXPECT_EQ(limited.values[i].visibility, 1.0);
        }
        least = std::min(least, limited.values[i].visibility);
    }
    EXPECT_NEAR(least, 0.25, 0.05);  // in the corners three of eight octants of the cosine are left: about
    // With the falloff a corner is lighter: what is farther away counts less.
    settings.rays.reach.smooth = true;
    for (const AmbientValue& v : baked(scene, settings).values) EXPECT_GT(v.visibility, least);
}

TEST(SharedRays, AreAsGoodAsSoManyRaysAloneOnASharpGullyToo) {
    const Scene scene = heightField(72, hillsWithGully);
    const RayBundle bundle(scene);
    const auto truth = bakeVertices(scene, bundle, alone(1500)).values;
    BakeSettings several = shared(180);
    for (const Weighting weighting : {Weighting::cosine, Weighting::uniform}) {
        several.rays.weighting = weighting;
        BakeSettings single = several;
        single.share = false;
        const AmbientBake ours = bakeVertices(scene, bundle, several);
        const AmbientBake plain = bakeVertices(scene, bundle, single);
        EXPECT_LT(ours.work.rays, 0.5 * double(plain.work.rays));
        if (weighting == Weighting::cosine) {
            EXPECT_LT(rmse(ours.values, truth), 1.1 * rmse(plain.values, truth));
        } else {
            EXPECT_LT(rmse(ours.values, plain.values), 0.012);
        }
    }
}

TEST(SharedRays, WhereNeighboursSeeOtherThingsEachPointHasTheRaysThatItWouldHaveAlone) {
    const Scene scene = heightField(20, [](double x, double z) {
        return hashUnit(std::uint32_t(std::lround(10.0 * x + 10.0)), std::uint32_t(std::lround(10.0 * z)));
    });
    const AmbientBake ours = baked(scene, shared(128)), plain = baked(scene, alone(128));
    EXPECT_EQ(ours.work.rays, plain.work.rays);
    for (std::size_t i = 0; i < plain.values.size(); ++i)
        EXPECT_NEAR(ours.values[i].visibility, plain.values[i].visibility, 1e-6);
}

TEST(SharedRays, WhereAllIsBlackSoIsWhatNeighboursSay) {
    // On a round wall the places say what the normals say, and do not determine the function: what rounding
    // leaves of the equations must not be taken for knowledge.
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    int unclear = 0;
    for (int round = 0; round < 300; ++round) {
        const int sides = 12 + int(random() % 60);
        const double radius = 0.1 + part(random), length = 2.0 * part(random), start = part(random);
        std::vector<glm::dvec3> corners;
        std::vector<std::uint32_t> indices;
        for (std::uint32_t i = 0; i < std::uint32_t(sides); ++i) {
            const double angle = start + 2.0 * std::numbers::pi * i / sides;
            for (const double x : {0.0, length})
                corners.emplace_back(x, radius * std::cos(angle), radius * std::sin(angle));
            const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % std::uint32_t(sides));
            indices.insert(indices.end(), {a, b, a + 1, b, b + 1, a + 1});
        }
        Scene scene = emptyScene();
        addPart(scene, corners, indices, scaledAndMoved(1.0, part(random)));
        const BakePoints points = vertexPoints(scene);
        const PointNeighbours neighbours = vertexNeighbours(scene, points);
        const std::vector<OwnEstimate> black(points.points.size());
        const SharedRays sharing(points, neighbours, black);
        for (std::uint32_t i = 0; i < black.size(); ++i) {
            const NeighbourEstimate estimate = sharing.at(i);
            unclear += !(estimate.value == glm::vec4(0.0f)) || !(estimate.variance > 0.0f);
        }
    }
    EXPECT_EQ(unclear, 0);
}

TEST(SharedRays, ThresholdAndMeanOfTwoEstimates) {
    EXPECT_FLOAT_EQ(thresholdOfMean({4.0f, 1.0f, 9.0f}, 2.0), 2.5f);  // (1 + 2.5 + 2.5) / 3
    EXPECT_TRUE(std::isinf(thresholdOfMean({1.0f, 2.0f}, 5.0)));
    glm::vec4 value(1.0f);
    EXPECT_FLOAT_EQ(combine(value, 1.0f, glm::vec4(4.0f), 2.0f), 2.0f / 3.0f);
    EXPECT_FLOAT_EQ(value.w, 2.0f);
    EXPECT_FLOAT_EQ(combine(value, 1.0f, glm::vec4(9.0f), std::numeric_limits<float>::infinity()), 1.0f);
    EXPECT_FLOAT_EQ(value.w, 2.0f);
}

/// Samples of `field` on the triangles of `scene`, and what vertex values make of them.
struct Fitted {
    std::vector<SurfaceSample> samples;
    std::vector<double> values;

    Fitted(const Scene& scene, const std::function<double(const glm::dvec3&)>& field) {
        for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
            for (int k = 0; k < 4; ++k) {
                const glm::dvec2 b = stratifiedBarycentric(k, hashSeed(t));
                samples.push_back({t, b, 0.25});
                values.push_back(field(pointOn(scene, t, b.x, b.y)));
            }
    }
    double error(const Scene& scene, const std::vector<double>& x) const {
        double sum = 0.0;
        for (std::size_t s = 0; s < samples.size(); ++s) {
            const std::uint32_t* corner = &scene.indices[3 * samples[s].triangle];
            const glm::dvec2 b = samples[s].barycentric;
            const double y = (1.0 - b.x - b.y) * x[corner[0]] + b.x * x[corner[1]] + b.y * x[corner[2]];
            sum += samples[s].area * std::pow(y - values[s], 2.0);
        }
        return std::sqrt(sum);
    }
};

TEST(LeastSquares, ALinearFieldComesBack) {
    const Scene scene = heightField(24, hillsWithGully);
    const auto field = [](const glm::dvec3& p) { return 0.3 + p.x - 2.0 * p.y + 0.5 * p.z; };
    const Fitted fitted(scene, field);
    const auto x =
        leastSquaresVertices(scene.indices, scene.positions.size(), fitted.samples, fitted.values, 1);
    for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_NEAR(x[i], field(glm::dvec3(scene.positions[i])), 1e-6) << i;
}

TEST(LeastSquares, NeverWorseThanValuesSampledAtTheVertices) {
    std::mt19937_64 random(5);
    const Scene scene = heightField(16, hillsWithGully);
    for (int round = 0; round < 20; ++round) {
        const glm::dvec3 n = randomDirection(random);
        const auto field = [&](const glm::dvec3& p) {
            return (glm::dot(n, p) > 0.1 ? 1.0 : 0.2) + 0.1 * std::sin(9.0 * p.x);
        };
        const Fitted fitted(scene, field);
        const auto x =
            leastSquaresVertices(scene.indices, scene.positions.size(), fitted.samples, fitted.values, 1);
        std::vector<double> atVertices;
        for (const glm::vec3& p : scene.positions) atVertices.push_back(field(glm::dvec3(p)));
        EXPECT_LT(fitted.error(scene, x), fitted.error(scene, atVertices));
    }
}

/// Mean squared error of vertex values on the `cells`^2 quads of a floor, against a fine bake of the same.
double floorError(const std::vector<AmbientValue>& coarse, int cells, const std::vector<AmbientValue>& fine,
                  int fineCells) {
    double sum = 0.0;
    for (int z = 0; z <= fineCells; ++z)
        for (int x = 0; x <= fineCells; ++x) {
            const double u = double(x) * cells / fineCells, v = double(z) * cells / fineCells;
            const int i = std::min(int(u), cells - 1), k = std::min(int(v), cells - 1);
            const double a = u - i, b = v - k;
            const auto at = [&](int p, int q) {
                return coarse[std::size_t(q) * std::size_t(cells + 1) + std::size_t(p)].visibility;
            };
            const double y = a + b <= 1.0
                                 ? at(i, k) + a * (at(i + 1, k) - at(i, k)) + b * (at(i, k + 1) - at(i, k))
                                 : at(i + 1, k + 1) + (1 - a) * (at(i, k + 1) - at(i + 1, k + 1)) +
                                       (1 - b) * (at(i + 1, k) - at(i + 1, k + 1));
            sum += std::pow(y - fine[std::size_t(z) * std::size_t(fineCells + 1) + std::size_t(x)].visibility,
                            2.0);
        }
    return sum / ((fineCells + 1) * (fineCells + 1));
}

TEST(LeastSquares, AVertexUnderABoxDoesNotDarkenItsTriangles) {
    const auto withBox = [](int cells) {
        Scene scene = heightField(cells, [](double, double) { return 0.0; });
        addBox(scene, [](const glm::dvec3& p) { return 0.08 * p + glm::dvec3(0.0, 0.0401, 0.0); });
        return scene;
    };
    const Scene coarse = withBox(8), fine = withBox(64);
    const RayBundle bundle(coarse);
    const auto truth = bakeVertices(fine, RayBundle(fine), alone(128)).values;
    const auto sampled = bakeVertices(coarse, bundle, alone(256)).values;
    const auto fitted = bakeVerticesLeastSquares(coarse, bundle, alone(64), 16).values;
    EXPECT_LT(floorError(fitted, 8, truth, 64), 0.49 * floorError(sampled, 8, truth, 64));  // 30 % less L2
    EXPECT_THROW(bakeVerticesLeastSquares(coarse, bundle, alone(4), 2), Error);
}

TEST(VisibilityBits, GiveTheAmbientVisibilityOfAllRays) {
    const Scene scene = heightField(40, hillsWithGully);
    const RayBundle bundle(scene);
    const BakedBits bits = bakeBits(scene, bundle, 256, {});
    EXPECT_EQ(bits.bits.bytes(), scene.positions.size() * 32 + 256 * 12);
    const auto rays = bakeVertices(scene, bundle, alone(512)).values;
    std::vector<AmbientValue> values;
    for (std::size_t i = 0; i < rays.size(); ++i)
        values.push_back(ambientFromBits(bits.bits, i, glm::dvec3(scene.normals[i]), Weighting::cosine));
    EXPECT_LT(rmse(values, rays), 0.0114 * 1.3);  // 256 Fibonacci directions against one ball: 0.0114
    EXPECT_THROW(bakeBits(scene, bundle, 63, {}), Error);
    EXPECT_THROW(bakeBits(scene, bundle, 1025, {}), Error);
}

TEST(VisibilityBits, RelightingIsTheSumOverTheOpenDirections) {
    std::mt19937_64 random(9);
    for (const int count : {64, 100, 256}) {  // 100: not a multiple of 8
        VisibilityBits bits = VisibilityBits::allBlocked(skyDirections(count), 50);
        std::vector<glm::vec3> normals, radiance;
        for (std::size_t i = 0; i < bits.points; ++i) {
            normals.emplace_back(randomDirection(random));
            for (std::size_t l = 0; l < bits.directions.size(); ++l)
                if (random() % 3 != 0) bits.setOpen(i, l);
        }
        for (int l = 0; l < count; ++l)
            radiance.emplace_back(double(random() % 1000) * 1e-3, l < count / 2 ? 0.0 : 1.0, 0.25);
        addSun(bits.directions, {0.0, 1.0, 0.0}, glm::dvec3(3.0), radiance);
        const auto light = relight(bits, normals, radiance);
        for (std::size_t i = 0; i < bits.points; ++i) {
            glm::dvec3 sum(0.0);
            for (std::size_t l = 0; l < bits.directions.size(); ++l) {
                const double c = glm::dot(glm::dvec3(normals[i]), glm::dvec3(bits.directions[l]));
                if (bits.open(i, l)) sum += std::max(0.0, c) * glm::dvec3(radiance[l]);
            }
            sum *= 4.0 * std::numbers::pi / count;
            EXPECT_LT(glm::length(glm::dvec3(light[i]) - sum), 1e-5 * glm::length(sum));
        }
    }
}

TEST(VisibilityBits, UnderAUniformSkyAnOpenPlaneHasPiTimesTheRadiance) {
    const Scene scene = heightField(4, [](double, double) { return 0.0; });
    const BakedBits baked = bakeBits(scene, RayBundle(scene), 1024, {});
    EXPECT_EQ(baked.work.rays, 0);
    const auto radiance = skyRadiance(Sky::uniform(glm::dvec3(2.0)), baked.bits.directions);
    for (const glm::vec3& e : relight(baked.bits, scene.normals, radiance))
        EXPECT_NEAR(e.y, 2.0 * std::numbers::pi, 2e-3);
    for (const Weighting w : {Weighting::cosine, Weighting::uniform}) {
        const AmbientValue v = ambientFromBits(baked.bits, 0, {0.0, 1.0, 0.0}, w);
        EXPECT_NEAR(v.visibility, 1.0, 2e-3);
        EXPECT_NEAR(v.bent.y, w == Weighting::cosine ? 2.0 / 3.0 : 0.5, 2e-3);
    }
}

TEST(BakeFile, AnAmbientSceneSurvivesAFile) {
    const TemporaryFolder folder;
    Scene made = heightField(12, hillsWithGully);
    addBox(made, scaledAndMoved(0.3, 0.5));
    saveAmbient(made, baked(made, alone(16)).values, folder / "made.glb");
    const Scene first = loadGltf(folder / "made.glb");
    EXPECT_EQ(first.triangleCount(), made.triangleCount());
    const auto values = baked(first, alone(64)).values;
    saveAmbient(first, values, folder / "first.glb");
    const Scene second = loadGltf(folder / "first.glb");
    ASSERT_EQ(second.positions, first.positions);
    EXPECT_EQ(second.indices, first.indices);
    EXPECT_EQ(second.cameras.size(), first.cameras.size());
    const auto loaded = loadedAmbient(second);
    ASSERT_TRUE(loaded.has_value());
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ((*loaded)[i].visibility, double(float(values[i].visibility)));
        EXPECT_EQ((*loaded)[i].bent, glm::dvec3(glm::vec3(values[i].bent)));
    }
    EXPECT_FALSE(loadedAmbient(made).has_value());
    EXPECT_THROW(saveAmbient(made, {}, folder / "none.glb"), Error);
}

}  // namespace
}  // namespace penumbra
