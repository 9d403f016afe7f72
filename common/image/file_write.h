// The one place that puts bytes on disk.
#pragma once

#include <filesystem>
#include <string_view>

namespace penumbra {

/// Writes `bytes` to a temporary file beside `file`, then renames it: a kill at any moment leaves the old
/// file or the new one, never half of one; the temporary file that a kill leaves is removed by the next write
/// of the same file. Makes missing directories. A device or pipe (/dev/null, /dev/stdout) is written to
/// directly, never replaced. Throws Error: no such folder, read-only, is a folder, disk full.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

/// Throws the Error that `writeFile` would, as far as can be known before there is anything to write: so that
/// a wrong path is reported at once and not after a minute of rendering. Leaves nothing behind.
void requireWritable(const std::filesystem::path& file);

/// Deletes the temporary file of a write in progress, if any. Async-signal-safe: for the handler of Ctrl-C.
void removeUnfinishedFile() noexcept;

}  // namespace penumbra
