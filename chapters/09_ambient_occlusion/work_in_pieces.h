// Work of minutes that an interruption does not undo: it is done in pieces, and what is finished waits in a
// file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "common/truth/parallel.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

class PieceWork {
 public:
    virtual ~PieceWork() = default;

    /// How many pieces there are: the same in every run.
    virtual std::size_t pieces() const = 0;
    /// Does one. In order, each once; after an interruption, from the first that is missing. To the bit the
    /// same in every run.
    virtual void doPiece(std::size_t which) = 0;
    /// The memory that holds all that the first `done` pieces have found, as far as later pieces or the
    /// result need it: written to the file as it is, and filled from it. Before the first piece it has its
    /// full size already.
    virtual std::vector<std::span<std::byte>> found(std::size_t done) = 0;
    /// Share of the whole time that the first `done` pieces take, 0 to 1.
    virtual double timeShare(std::size_t done) const { return double(done) / double(pieces()); }
};

/// Does all pieces. A non-empty `file` keeps what is finished, a few times a second while that costs little,
/// and is taken up again by the next call with the same `key` and the same build of the program: after
/// Ctrl-C, or a kill. One that is damaged, or of another key, counts as none. It is removed at the end. One
/// that cannot be written keeps nothing, and the work goes on. `key`: of all that the results depend on.
/// `progress` may throw: that stops the work, and nothing that is finished is lost.
void doAllPieces(PieceWork& work, const std::filesystem::path& file, const ContentHash& key,
                 const ProgressCallback& progress = {});

/// The memory of values that can be copied byte by byte, the first `count` of them.
template <class T>
std::span<std::byte> memoryOf(std::vector<T>& values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_writable_bytes(std::span(values).first(count));
}

/// Points number first, first + 1 ... end - 1 of a mesh.
struct PointRange {
    std::size_t first = 0, end = 0;
};

/// So many points are finished together: half a second of a careful bake.
inline constexpr std::size_t pointsInPiece = 4096;

inline std::size_t piecesOf(std::size_t points) {
    return (points + pointsInPiece - 1) / pointsInPiece;
}
inline PointRange allOf(std::size_t points) {
    return {0, points};
}
inline PointRange pieceOf(std::size_t points, std::size_t which) {
    return {which * pointsInPiece, std::min(points, (which + 1) * pointsInPiece)};
}
/// How many points the first `done` pieces have.
inline std::size_t pointsDone(std::size_t points, std::size_t done) {
    return std::min(points, done * pointsInPiece);
}

/// Calls `some` for short runs that make up the range, on all cores. Short, since at the end of a piece every
/// core waits for the last.
void forRuns(PointRange range, const std::function<void(PointRange run)>& some);

}  // namespace penumbra
