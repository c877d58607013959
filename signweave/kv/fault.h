#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/core/error.h"

/// Internal to this module: the meaning of system errors, in the same words for all engines.
namespace signweave::kv {

struct Fault {
  ErrorCode kind;
  std::string text;  ///< what is wrong, and how to fix it
};

/// The meaning of a system errno for a store in `folder`; empty if there is no better text than the errno's own.
std::optional<Fault> system_fault(const std::filesystem::path& folder, int error);

/// Throws Error{"FOLDER: TEXT (while DOING)"}.
[[noreturn]] void fail(const std::filesystem::path& folder, std::string_view doing, const Fault& fault);
[[noreturn]] void fail_system(const std::filesystem::path& folder, std::string_view doing, int error);

/// Throws Error{io} if the disk, or the limit on file size, has no room for a change of `bytes` to the store whose main
/// file is `file`. Checked in advance, because an engine that reaches the end of the disk may fail half way, and some
/// fail badly.
void require_room(const std::filesystem::path& file, std::uint64_t bytes);

/// Reserves disk space for `bytes` more at the end of an open file, whose size does not change: an engine that writes
/// through a map or from a cache cannot report later that the disk is full. Throws Error{io}.
void reserve(const std::filesystem::path& folder, int file, std::uint64_t end, std::uint64_t bytes);

/// The size in bytes of a file in the folder. Throws Error{io}.
std::uint64_t size_of_file(const std::filesystem::path& folder, const char* name, std::string_view doing);

}  // namespace signweave::kv
