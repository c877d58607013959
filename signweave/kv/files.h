#pragma once

#include <cstdint>
#include <filesystem>

/// Inside this module only.
namespace signweave::kv {

/// Bytes of the files in a folder, without those in folders inside it.
std::uint64_t bytes_in(const std::filesystem::path& folder);

/// Flushes a file to the disk. Throws Error{io}.
void sync_file(const std::filesystem::path& path);

/// Makes the names in a folder survive a power cut, where the file system can.
void sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace signweave::kv
