#include "chapters/09_ambient_occlusion/work_in_pieces.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "common/error.h"
#include "common/image/file_write.h"

namespace penumbra {

namespace {

constexpr std::size_t pointsInRun = 64;
// A twentieth of the time goes into saving, at most; and work that is over at once needs none.
constexpr int workingPerSaving = 20;
constexpr std::chrono::milliseconds leastBetweenSaves(300);

constexpr std::string_view formatName = "penumbra partial bake 2\n";
constexpr std::size_t hashDigits = 32;

/// Of a partial file: the name of the format, the key, a hash of what follows, the number of pieces that are
/// done, what they found.
constexpr std::size_t headerBytes = formatName.size() + 2 * hashDigits + sizeof(std::uint64_t);

std::string hashOf(std::uint64_t done, std::string_view payload) {
    return ContentHash().number(std::int64_t(done)).text(payload).hex();
}

/// A build of the program is told from the next by the time it was made: what another one found may differ.
ContentHash withProgram(ContentHash key) {
    std::error_code ignored;
    const std::filesystem::path program = "/proc/self/exe";
    key.number(std::int64_t(std::filesystem::file_size(program, ignored)));
    return key.number(
        std::int64_t(std::filesystem::last_write_time(program, ignored).time_since_epoch().count()));
}

/// The file, or none at all if its name is empty.
class Keeper {
 public:
    Keeper(std::filesystem::path file, const ContentHash& key)
        : file_(std::move(file)), key_(file_.empty() ? "" : withProgram(key).hex()) {}

    /// Gives `work` what the file holds. Returns the number of pieces that are done.
    std::size_t takeUp(PieceWork& work) const;
    void save(PieceWork& work, std::size_t done);
    bool isTime() const { return Clock::now() - savedAt_ > betweenSaves_; }
    void remove() const {
        std::error_code ignored;
        if (!file_.empty()) std::filesystem::remove(file_, ignored);
    }

 private:
    using Clock = std::chrono::steady_clock;
    std::filesystem::path file_;
    std::string key_;
    std::size_t saved_ = 0;
    Clock::time_point savedAt_ = Clock::now();
    Clock::duration betweenSaves_ = leastBetweenSaves;
};

std::size_t Keeper::takeUp(PieceWork& work) const {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file_, ignored)) return 0;
    std::ifstream in(file_, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    if (bytes.size() < headerBytes || !bytes.starts_with(std::string(formatName) + key_)) return 0;
    std::uint64_t done = 0;
    std::memcpy(&done, bytes.data() + headerBytes - sizeof done, sizeof done);
    std::string_view payload = std::string_view(bytes).substr(headerBytes);
    if (bytes.substr(formatName.size() + hashDigits, hashDigits) != hashOf(done, payload)) return 0;
    if (done > work.pieces()) return 0;
    const std::vector<std::span<std::byte>> targets = work.found(done);
    std::size_t wanted = 0;
    for (const std::span<std::byte>& target : targets) wanted += target.size();
    if (payload.size() != wanted) return 0;
    for (const std::span<std::byte>& target : targets) {
        std::ranges::copy(std::as_bytes(std::span(payload.substr(0, target.size()))), target.begin());
        payload.remove_prefix(target.size());
    }
    return done;
}

/// Written beside, then renamed: a kill at any moment leaves the old file or the new one. On a full disk the
/// work goes on: an interruption then costs what was not kept.
void Keeper::save(PieceWork& work, std::size_t done) {
    if (file_.empty() || done == saved_) return;
    const Clock::time_point start = Clock::now();
    std::string payload;
    for (const std::span<std::byte>& part : work.found(done))
        payload.append(reinterpret_cast<const char*>(part.data()), part.size());
    std::string header(formatName);
    header.append(key_).append(hashOf(done, payload));
    const std::uint64_t number = done;
    header.append(reinterpret_cast<const char*>(&number), sizeof number);
    try {
        writeFile(file_, payload.insert(0, header));
    } catch (const Error&) {
        file_.clear();
        return;
    }
    saved_ = done;
    savedAt_ = Clock::now();
    betweenSaves_ = std::max<Clock::duration>(leastBetweenSaves, workingPerSaving * (savedAt_ - start));
}

}  // namespace

// [begin:pieces]
void doAllPieces(PieceWork& work, const std::filesystem::path& file, const ContentHash& key,
                 const ProgressCallback& progress) {
    Keeper keeper(file, key);
    std::size_t done = keeper.takeUp(work);
    while (done < work.pieces()) {
        work.doPiece(done++);
        if (keeper.isTime()) keeper.save(work, done);
        if (!progress) continue;
        try {
            progress(work.timeShare(done));
        } catch (...) {
            // Only here: what throws within a piece leaves it half done, and then the file of the latest
            // whole one is the one to go on from.
            keeper.save(work, done);
            throw;
        }
    }
    keeper.remove();
}
// [end:pieces]

void forRuns(PointRange range, const std::function<void(PointRange run)>& some) {
    parallelRows(int((range.end - range.first + pointsInRun - 1) / pointsInRun), [&](int row) {
        const std::size_t first = range.first + std::size_t(row) * pointsInRun;
        some({first, std::min(range.end, first + pointsInRun)});
    });
}

}  // namespace penumbra
