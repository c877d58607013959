#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/core/error.h"

/// Inside this module only: what the system's refusals mean, in one set of words for all engines.
namespace signweave::kv {

struct Fault {
  ErrorCode kind;
  std::string text;  ///< what is wrong, and what would mend it
};

/// The meaning of an errno of the system for a store in `folder`, or none where we know nothing better than its name.
std::optional<Fault> system_fault(const std::filesystem::path& folder, int error);

/// Throws Error{"FOLDER: TEXT (while DOING)"}.
[[noreturn]] void fail(const std::filesystem::path& folder, std::string_view doing, const Fault& fault);
[[noreturn]] void fail_system(const std::filesystem::path& folder, std::string_view doing, int error);

/// Throws Error{io} where the disk, or the limit on the size of a file, has no room for a change of `bytes` to the
/// store whose main file is `file`. An engine may fail half way where it meets the end of the disk, and some fail
/// badly: so we ask first.
void require_room(const std::filesystem::path& file, std::uint64_t bytes);

/// Takes room on the disk for `bytes` more at the end of an open file, whose size stays: an engine that writes through
/// a map or from a cache cannot say later that there is none. Throws Error{io}.
void reserve(const std::filesystem::path& folder, int file, std::uint64_t end, std::uint64_t bytes);

/// Bytes of a file in the folder. Throws Error{io}.
std::uint64_t size_of_file(const std::filesystem::path& folder, const char* name, std::string_view doing);

}  // namespace signweave::kv
