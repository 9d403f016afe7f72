#include "common/image/file_write.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <mutex>
#include <vector>

#include "common/error.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

// What a signal handler may look at: a fixed buffer and a flag. One write at a time (writeMutex), so one is
// enough.
std::mutex writeMutex;
char unfinishedPath[PATH_MAX];
std::atomic<bool> unfinished{false};

[[noreturn]] void failWrite(const fs::path& file, const std::string& why) {
    throw Error(
        fmt::format("{}: cannot be written: {}; choose another file or free the place", file.string(), why));
}

struct Descriptor {
    int fd;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

void writeAll(int fd, std::string_view bytes, const fs::path& file) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) failWrite(file, std::strerror(errno));
        bytes.remove_prefix(std::size_t(written));
    }
    // Networks and quotas may say only when a file is closed that it was not kept. It is a second descriptor
    // that is closed here, as the lock is gone with the first.
    const int second = ::dup(fd);
    if (second < 0 || ::close(second) != 0) failWrite(file, std::strerror(errno));
}

void makeFolders(const fs::path& file) {
    const fs::path folder = file.parent_path();
    if (folder.empty()) return;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) failWrite(file, fmt::format("no folder {} ({})", folder.string(), error.message()));
}

/// Folders above `file` that do not exist, the deepest first.
std::vector<fs::path> missingFolders(const fs::path& file) {
    std::vector<fs::path> missing;
    std::error_code ignored;
    for (fs::path folder = file.parent_path(); !folder.empty() && !fs::exists(folder, ignored);
         folder = folder.parent_path())
        missing.push_back(folder);
    return missing;
}

bool isSpecial(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// The file that a name stands for: through symbolic links, so that a link stays a link.
fs::path resolved(const fs::path& file) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(file, error);
    return error ? file : target;
}

constexpr std::string_view unfinishedMark = ".part-";
constexpr std::size_t markDigits = 6;  // mkstemp's

/// Removes what earlier writes of `file` left when they were killed. A write that is still going on holds a
/// lock on its temporary file.
void removeAbandoned(const fs::path& file) {
    const std::string prefix = file.filename().string() + std::string(unfinishedMark);
    std::error_code ignored;
    for (const auto& entry :
         fs::directory_iterator(file.has_parent_path() ? file.parent_path() : ".", ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() != prefix.size() + markDigits || !name.starts_with(prefix)) continue;
        const Descriptor fd{::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)};
        if (fd.fd >= 0 && ::flock(fd.fd, LOCK_EX | LOCK_NB) == 0) ::unlink(entry.path().c_str());
    }
}

/// A new, empty file beside `file`, registered for removal until `release`d or destroyed.
class TemporaryFile {
 public:
    explicit TemporaryFile(const fs::path& file) : lock_(writeMutex) {
        if (fs::is_directory(file)) failWrite(file, "it is a folder");
        removeAbandoned(file);
        while (!create(file)) continue;
        unfinished = true;
        ::fchmod(fd_.fd, permissionsOf(file));
    }
    ~TemporaryFile() { removeUnfinishedFile(); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    int descriptor() const { return fd_.fd; }
    void renameTo(const fs::path& file) {
        if (::rename(unfinishedPath, file.c_str()) != 0) failWrite(file, std::strerror(errno));
        unfinished = false;
    }

 private:
    /// False if another process took the new file for an abandoned one, before it was locked, and removed it.
    bool create(const fs::path& file) {
        const std::string name = file.string() + std::string(unfinishedMark) + std::string(markDigits, 'X');
        if (name.size() >= sizeof unfinishedPath) failWrite(file, "its name is too long");
        std::memcpy(unfinishedPath, name.c_str(), name.size() + 1);
        if (fd_.fd >= 0) ::close(fd_.fd);
        fd_.fd = ::mkostemp(unfinishedPath, O_CLOEXEC);
        if (fd_.fd < 0) failWrite(file, std::strerror(errno));
        ::flock(fd_.fd, LOCK_EX);
        struct stat made {};
        return ::fstat(fd_.fd, &made) != 0 || made.st_nlink > 0;
    }
    /// mkstemp makes private files; a picture should have the permissions that any new file gets.
    static mode_t permissionsOf(const fs::path& file) {
        struct stat existing {};
        if (::stat(file.c_str(), &existing) == 0) return existing.st_mode & 0777;
        const mode_t mask = ::umask(0);
        ::umask(mask);
        return 0666 & ~mask;
    }

    std::lock_guard<std::mutex> lock_;
    Descriptor fd_{-1};
};

}  // namespace

void writeFile(const fs::path& file, std::string_view bytes) {
    makeFolders(file);
    if (isSpecial(file)) {
        const Descriptor device{::open(file.c_str(), O_WRONLY | O_CLOEXEC)};
        if (device.fd < 0) failWrite(file, std::strerror(errno));
        return writeAll(device.fd, bytes, file);
    }
    const fs::path target = resolved(file);
    TemporaryFile temporary(target);
    writeAll(temporary.descriptor(), bytes, file);
    temporary.renameTo(target);
}

void requireWritable(const fs::path& file) {
    if (isSpecial(file)) return;
    const std::vector<fs::path> missing = missingFolders(file);
    makeFolders(file);
    { const TemporaryFile removedAgain(resolved(file)); }
    std::error_code ignored;
    for (const fs::path& folder : missing) fs::remove(folder, ignored);
}

void removeUnfinishedFile() noexcept {
    if (unfinished.exchange(false)) ::unlink(unfinishedPath);
}

}  // namespace penumbra
