#pragma once

#include <cstdint>
#include <filesystem>

/// Internal to this module.
namespace signweave::kv {

/// The total size in bytes of the files in a folder, without subfolders.
std::uint64_t bytes_in(const std::filesystem::path& folder);

/// Flushes a file to the disk. Throws Error{io}.
void sync_file(const std::filesystem::path& path);

/// Makes the entries of a folder survive a power failure, if the file system supports that.
void sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace signweave::kv
