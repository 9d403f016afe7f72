// Work that is stopped and taken up again ends as if it had never been stopped: any work in pieces, and each
// bake. tests/unit/faults_test.cpp has the same of a program and a real Ctrl-C.
#include "chapters/09_ambient_occlusion/work_in_pieces.h"

#include <gtest/gtest.h>

#include <limits>

#include "chapters/09_ambient_occlusion/visibility_bits.h"
#include "common/error.h"
#include "common/image/file_write.h"
#include "tests/unit/temporary_folder.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {
namespace {

struct Stop {};

/// Stops the work when its progress is told for the `calls`-th time.
ProgressCallback stopAt(int calls) {
    return [calls, told = 0](double) mutable {
        if (++told == calls) throw Stop();
    };
}

/// Each piece squares its number and adds what the one before found.
class Sums final : public PieceWork {
 public:
    explicit Sums(std::size_t pieces = 6) : sums_(pieces, 0) {}
    std::size_t pieces() const override { return sums_.size(); }
    void doPiece(std::size_t which) override {
        ++done;
        sums_[which] += std::uint64_t(which * which) + 7 + (which > 0 ? sums_[which - 1] : 0);
        if (which == breaksAt) throw Stop();
    }
    std::vector<std::span<std::byte>> found(std::size_t first) override { return {memoryOf(sums_, first)}; }
    const std::vector<std::uint64_t>& sums() const { return sums_; }

    std::size_t done = 0;
    std::size_t breaksAt = std::numeric_limits<std::size_t>::max();

 private:
    std::vector<std::uint64_t> sums_;
};

class WorkInPieces : public testing::Test {
 protected:
    WorkInPieces() { doAllPieces(whole, {}, key); }
    /// Leaves a file of the first two pieces.
    void stop() const {
        Sums stopped;
        EXPECT_THROW(doAllPieces(stopped, file, key, stopAt(2)), Stop);
        ASSERT_TRUE(std::filesystem::exists(file));
    }
    /// How many pieces are done when it is taken up again.
    std::size_t piecesDone(const ContentHash& withKey) const {
        Sums work;
        doAllPieces(work, file, withKey);
        EXPECT_EQ(work.sums(), whole.sums());
        EXPECT_FALSE(std::filesystem::exists(file)) << "what is finished need not wait";
        return work.done;
    }
    TemporaryFolder folder;
    std::filesystem::path file = folder / "work.part";
    ContentHash key = ContentHash().text("sums");
    Sums whole;
};

TEST_F(WorkInPieces, GoesOnAfterEachPiece) {
    for (int pieces = 1; pieces <= 6; ++pieces) {
        Sums stopped;
        EXPECT_THROW(doAllPieces(stopped, file, key, stopAt(pieces)), Stop);
        EXPECT_EQ(piecesDone(key), whole.pieces() - std::size_t(pieces));
    }
    stop();
    Sums twice;
    EXPECT_THROW(doAllPieces(twice, file, key, stopAt(3)), Stop) << "stopped again";
    EXPECT_EQ(twice.done, 3u);
    EXPECT_EQ(piecesDone(key), 1u);
    stop();
    double first = 0.0;
    Sums rest;
    doAllPieces(rest, file, key, [&](double fraction) { first = first > 0.0 ? first : fraction; });
    EXPECT_EQ(first, 0.5) << "the progress goes on too";
}

TEST_F(WorkInPieces, APieceThatBreaksIsDoneAgainFromWhatWasWhole) {
    stop();
    Sums breaks;
    breaks.breaksAt = 4;
    EXPECT_THROW(doAllPieces(breaks, file, key), Stop);
    EXPECT_EQ(piecesDone(key), 4u) << "the file of two pieces is still there, and nothing half done in it";
}

TEST_F(WorkInPieces, AnotherKeyBeginsAnew) {
    stop();
    EXPECT_EQ(piecesDone(ContentHash().text("other sums")), 6u);
    stop();
    Sums fewer(1);
    doAllPieces(fewer, file, key);
    EXPECT_EQ(fewer.done, 1u) << "a file of more pieces than there are";
}

TEST_F(WorkInPieces, ADamagedFileBeginsAnew) {
    stop();
    const std::string bytes = bytesOf(file);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        writeFile(file, bytes.substr(0, size));
        ASSERT_EQ(piecesDone(key), 6u) << "cut to " << size;
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = char(damaged[i] ^ 4);
        writeFile(file, damaged);
        ASSERT_EQ(piecesDone(key), 6u) << "byte " << i;
    }
    writeFile(file, bytes + "more");
    EXPECT_EQ(piecesDone(key), 6u);
    writeFile(file, bytes);
    EXPECT_EQ(piecesDone(key), 4u) << "who never takes anything up proves nothing";
}

TEST_F(WorkInPieces, WhereNoFileCanBeTheWorkIsDoneAllTheSame) {
    std::filesystem::create_directory(file);
    Sums stopped;
    EXPECT_THROW(doAllPieces(stopped, file / "", key, stopAt(2)), Stop);
    Sums work;
    doAllPieces(work, "/dev/null/folder/work.part", key);
    EXPECT_EQ(work.sums(), whole.sums());
    Sums none(0);
    doAllPieces(none, file, key);
    EXPECT_EQ(none.done, 0u);
}

/// A ball of 10242 points that floats over the ground: three pieces.
Scene ballOverGround() {
    Scene scene = test_meshes::emptyScene();
    test_meshes::addSphere(scene, 5, test_meshes::scaledAndMoved(1.0, 0.0));
    test_meshes::addQuad(scene, {-3, -1.2, -3}, {-3, -1.2, 3}, {3, -1.2, 3}, {3, -1.2, -3});
    return scene;
}

class StoppedBakeSlow : public testing::Test {
 protected:
    using Bake = std::function<AmbientBake(const BakeSettings&, const ProgressCallback&)>;

    BakeSettings settings(bool share, int rays = 32) const {
        BakeSettings settings;
        settings.rays.count = rays;
        settings.share = share;
        settings.partialFile = file;
        return settings;
    }
    AmbientBake vertices(const BakeSettings& settings, const ProgressCallback& progress = {}) const {
        return bakeVertices(scene, bundle, settings, progress);
    }
    static void expectSame(const std::vector<AmbientValue>& a, const std::vector<AmbientValue>& b) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_TRUE(a[i].visibility == b[i].visibility && a[i].bent == b[i].bent) << i;
    }
    /// Stopped after so many of its pieces, it ends with the same values for the fewer rays the later it was.
    void expectGoesOn(const Bake& bake, const BakeSettings& settings, int pieces,
                      const std::vector<int>& stops) const {
        int told = 0;
        const AmbientBake whole = bake(settings, [&](double) { ++told; });
        ASSERT_EQ(told, pieces);
        std::int64_t latest = whole.work.rays;
        for (const int stop : stops) {
            SCOPED_TRACE(stop);
            EXPECT_THROW(bake(settings, stopAt(stop)), Stop);
            const AmbientBake rest = bake(settings, {});
            expectSame(rest.values, whole.values);
            EXPECT_LE(rest.work.rays, latest);
            latest = rest.work.rays;
        }
        EXPECT_LT(latest, whole.work.rays / 2);
        EXPECT_FALSE(std::filesystem::exists(file));
    }

    TemporaryFolder folder;
    std::filesystem::path file = folder / "bake.part";
    Scene scene = ballOverGround();
    RayBundle bundle{scene};
};

TEST_F(StoppedBakeSlow, OfVerticesWhichShareRaysGoesOnInEachRound) {
    const Bake bake = [&](const BakeSettings& s, const ProgressCallback& p) { return vertices(s, p); };
    expectGoesOn(bake, settings(true, 16), 3 * 3, {1, 2, 3, 4, 5, 6, 7, 8, 9});
    BakeSettings all = settings(true, 8);
    all.skip = false;  // which points see the whole sky is then found out with rays
    expectGoesOn(bake, all, 3 * 3, {2, 8});
}

TEST_F(StoppedBakeSlow, AfterEachPieceInARowItEndsTheSame) {
    const AmbientBake whole = vertices(settings(true, 16));
    for (int piece = 0; piece < 3 * 3; ++piece)
        EXPECT_THROW(vertices(settings(true, 16), stopAt(1)), Stop) << piece;
    const AmbientBake rest = vertices(settings(true, 16));
    EXPECT_EQ(rest.work.rays, 0);
    expectSame(rest.values, whole.values);
}

TEST_F(StoppedBakeSlow, OfVerticesEachOnItsOwnGoesOn) {
    expectGoesOn([&](const BakeSettings& s, const ProgressCallback& p) { return vertices(s, p); },
                 settings(false, 8), 3, {1, 2});
}

TEST_F(StoppedBakeSlow, OfTrianglesGoesOn) {
    expectGoesOn(
        [&](const BakeSettings& s, const ProgressCallback& p) { return bakeTriangles(scene, bundle, s, p); },
        settings(true, 8), 3 * 6, {3, 13});
}

TEST_F(StoppedBakeSlow, OfLeastSquaresGoesOn) {
    expectGoesOn([&](const BakeSettings& s,
                     const ProgressCallback& p) { return bakeVerticesLeastSquares(scene, bundle, s, 3, p); },
                 settings(false, 4), 16, {9});
}

TEST_F(StoppedBakeSlow, WithAnythingElseChangedBeginsAnew) {
    const BakeSettings stopped = settings(true, 8);
    const auto expectAnew = [&](const Scene& changedScene, const BakeSettings& changed) {
        EXPECT_THROW(vertices(stopped, stopAt(5)), Stop);
        BakeSettings fresh = changed;
        fresh.partialFile.clear();
        const RayBundle changedBundle(changedScene);
        const AmbientBake expected = bakeVertices(changedScene, changedBundle, fresh);
        const AmbientBake found = bakeVertices(changedScene, changedBundle, changed);
        EXPECT_EQ(found.work.rays, expected.work.rays);
        expectSame(found.values, expected.values);
    };
    const auto with = [&](const std::function<void(BakeSettings&)>& change) {
        BakeSettings changed = stopped;
        change(changed);
        expectAnew(scene, changed);
    };
    with([](BakeSettings& s) { s.rays.count = 9; });
    with([](BakeSettings& s) { s.rays.weighting = Weighting::uniform; });
    with([](BakeSettings& s) { s.rays.reach.range = 0.5; });
    with([](BakeSettings& s) { s.rays.reach.smooth = true; });
    with([](BakeSettings& s) { s.seed = 2; });
    with([](BakeSettings& s) { s.share = false; });
    with([](BakeSettings& s) { s.skip = false; });
    Scene moved = scene;
    moved.positions.back().y += 0.01f;
    expectAnew(moved, stopped);
}

TEST_F(StoppedBakeSlow, OfPointsOfAnotherKindBeginsAnew) {
    EXPECT_THROW(vertices(settings(true, 8), stopAt(4)), Stop);
    BakeSettings fresh = settings(true, 8);
    fresh.partialFile.clear();
    expectSame(bakeTriangles(scene, bundle, settings(true, 8)).values,
               bakeTriangles(scene, bundle, fresh).values);
}

TEST_F(StoppedBakeSlow, OfBitsGoesOn) {
    const BakedBits whole = bakeBits(scene, bundle, 64, {}, file);
    EXPECT_FALSE(std::filesystem::exists(file));
    const auto stop = [&] {
        EXPECT_THROW(bakeBits(scene, bundle, 64, {}, file, stopAt(1)), Stop);
        EXPECT_TRUE(std::filesystem::exists(file));
    };
    stop();
    const BakedBits rest = bakeBits(scene, bundle, 64, {}, file);
    EXPECT_LT(rest.work.rays, 0.8 * double(whole.work.rays));
    EXPECT_EQ(rest.bits.words, whole.bits.words);
    EXPECT_FALSE(std::filesystem::exists(file));
    stop();  // another reach: begins anew
    EXPECT_EQ(bakeBits(scene, bundle, 64, {0.5, false}, file).bits.words,
              bakeBits(scene, bundle, 64, {0.5, false}).bits.words);
}

}  // namespace
}  // namespace penumbra
