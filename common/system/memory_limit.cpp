#include "common/system/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "common/error.h"

namespace penumbra {

namespace {

constexpr std::uint64_t megabyte = std::uint64_t(1) << 20;

/// The number in the line of a file that begins with `name`; none without such a line.
std::optional<std::uint64_t> numberAfter(const char* file, const std::string& name) {
    std::ifstream in(file);
    for (std::string word; in >> word; in.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
        if (std::uint64_t number = 0; word == name && in >> number) return number;
    return std::nullopt;
}

std::optional<std::uint64_t> numberIn(const char* file) {
    std::ifstream in(file);
    std::uint64_t number = 0;
    if (in >> number) return number;
    return std::nullopt;  // no such file, or "max"
}

std::optional<MemoryLimit> limitOf(__rlimit_resource resource, const char* name, const char* used,
                                   std::uint64_t libraries) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
    const std::uint64_t now = 1024 * numberAfter("/proc/self/status", used).value_or(0);
    return MemoryLimit{name, limit.rlim_cur, limit.rlim_cur > now ? limit.rlim_cur - now : 0, libraries};
}

/// Memory that the machine has free, or that the container may still have.
std::uint64_t memoryFree() {
    std::uint64_t free = std::numeric_limits<std::uint64_t>::max();
    if (const auto available = numberAfter("/proc/meminfo", "MemAvailable:"))
        free = 1024 * (*available + numberAfter("/proc/meminfo", "SwapFree:").value_or(0));
    const auto most = numberIn("/sys/fs/cgroup/memory.max");
    const auto used = numberIn("/sys/fs/cgroup/memory.current");
    if (!most || !used) return free;
    // Files that were read are counted as used, but give way.
    const std::uint64_t files = numberAfter("/sys/fs/cgroup/memory.stat", "inactive_file").value_or(0);
    return std::min(free, *most + files > *used ? *most + files - *used : 0);
}

std::string megabytes(std::uint64_t bytes) {
    return std::to_string(bytes / megabyte) + " MB";
}

}  // namespace

std::optional<MemoryLimit> processMemoryLimit() {
    // What the chapters were seen to take for a small picture with two threads, 1.26 GB and 0.32 GB, and some
    // air. Stacks and heaps of a thread are address space that it hardly uses.
    const std::uint64_t threads = std::uint64_t(::sysconf(_SC_NPROCESSORS_ONLN));
    const auto space =
        limitOf(RLIMIT_AS, "the limit of ulimit -v", "VmSize:", (1152 + 128 * threads) * megabyte);
    const auto data =
        limitOf(RLIMIT_DATA, "the limit of ulimit -d", "VmData:", (256 + 64 * threads) * megabyte);
    if (space && data) return space->left < data->left ? space : data;
    return space ? space : data;
}

void requireMemoryForPicture(std::uint64_t picture) {
    if (const auto limit = processMemoryLimit()) {
        const std::uint64_t needed = limit->libraries + picture;
        if (limit->left < needed)
            throw Error("not enough memory for this picture: it needs about " + megabytes(needed) +
                        " more, and " + limit->name + ", " + megabytes(limit->bytes) + ", leaves " +
                        megabytes(limit->left) + "; raise it, or use a smaller --size or --antialias");
    }
    if (const std::uint64_t free = memoryFree(); picture > free)
        throw Error("not enough memory for this picture: it needs about " + megabytes(picture) + " and " +
                    megabytes(free) + " are free; use a smaller --size or --antialias");
}

}  // namespace penumbra
