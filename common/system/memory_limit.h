// How much memory this process may still have: so that what cannot be had is refused in one line, before a
// driver or a library runs into it. They do not all survive that: under `ulimit -v 400000` llvmpipe ends with
// a segmentation fault, under 600000 Embree's threads abort, and under 1000000 a static initialiser of one of
// OpenImageIO's libraries waits for ever for a thread that could not be started, with Ctrl-C blocked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace penumbra {

/// A limit in force, and what it leaves.
struct MemoryLimit {
    std::string name;         ///< "the limit of ulimit -v"
    std::uint64_t bytes = 0;  ///< the limit
    std::uint64_t left = 0;
    std::uint64_t libraries = 0;  ///< what driver and libraries take of it, whatever the picture
};

/// The limit of address space (RLIMIT_AS) or of writable memory (RLIMIT_DATA), whichever is set; of both the
/// one that leaves less. Nothing if neither is.
std::optional<MemoryLimit> processMemoryLimit();

/// Throws Error unless a picture that takes so many bytes can be rendered here: below the limits of this
/// process, with what the libraries take, and in the memory that the machine (or the container, Linux cgroup
/// 2) has free. Linux hands out more memory than it has and kills who uses it, which nothing can report
/// afterwards.
void requireMemoryForPicture(std::uint64_t picture);

}  // namespace penumbra
