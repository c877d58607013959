#include "signweave/kv/fault.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

// What a change may need in addition to its own bytes: split pages and logs.
constexpr std::uint64_t kExtraOnDisk = 4u << 20;
constexpr std::uint64_t kExtraInFile = 32u << 10;

struct Meaning {
  int error;
  ErrorCode kind;
  const char* text;
};

constexpr Meaning kMeanings[] = {
    {ENOSPC, ErrorCode::io, "disk full, this change was not stored; free some space and try again"},
    {EDQUOT, ErrorCode::io, "disk quota used up, this change was not stored; free some space and try again"},
    {EFBIG, ErrorCode::io, "the file may not grow further, this change was not stored; raise the limit on file size"},
    {EIO, ErrorCode::io,
     "disk full, limited or failing, this change was not stored; free some space or check the disk, and try again"},
    {ENOMEM, ErrorCode::io, "not enough memory; raise the limit on virtual memory (ulimit -v)"},
    {EACCES, ErrorCode::io, "no permission; change the permissions of the folder and its files"},
    {EPERM, ErrorCode::io, "no permission; change the permissions of the folder and its files"},
    {EROFS, ErrorCode::io, "the disk is mounted read-only; mount it writable"},
};

bool disk_is_full(const fs::path& folder) {
  struct statvfs disk {};
  return ::statvfs(folder.c_str(), &disk) == 0 && disk.f_bavail * disk.f_frsize < (1u << 20);
}

}  // namespace

std::optional<Fault> system_fault(const fs::path& folder, int error) {
  // A full disk first causes a short write, which engines report as EIO.
  if (error == EIO && disk_is_full(folder)) error = ENOSPC;
  const auto* const meaning =
      std::find_if(std::begin(kMeanings), std::end(kMeanings), [&](const Meaning& m) { return m.error == error; });
  if (meaning == std::end(kMeanings)) return std::nullopt;
  return Fault{meaning->kind, meaning->text};
}

void fail(const fs::path& folder, std::string_view doing, const Fault& fault) {
  throw Error(fault.kind, folder.string() + ": " + fault.text + " (while " + std::string(doing) + ")");
}

void fail_system(const fs::path& folder, std::string_view doing, int error) {
  fail(folder, doing,
       system_fault(folder, error)
           .value_or(Fault{ErrorCode::io, std::generic_category().message(error) + "; check the disk and try again"}));
}

void require_room(const fs::path& file, std::uint64_t bytes) {
  const fs::path folder = file.parent_path();
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) == 0 && disk.f_bavail * disk.f_frsize < 3 * bytes + kExtraOnDisk) {
    fail_system(folder, "committing", ENOSPC);
  }
  rlimit limit{};
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (!error && ::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      size + bytes + bytes / 4 + kExtraInFile > limit.rlim_cur) {
    fail_system(folder, "committing", EFBIG);
  }
}

void reserve(const fs::path& folder, int file, std::uint64_t end, std::uint64_t bytes) {
  if (::fallocate(file, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(end), static_cast<off_t>(bytes)) == 0) return;
  if (errno != EOPNOTSUPP && errno != ENOSYS) fail_system(folder, "committing", errno);
}

std::uint64_t size_of_file(const fs::path& folder, const char* name, std::string_view doing) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(folder / name, error);
  if (error) fail_system(folder, doing, error.value());
  return size;
}

}  // namespace signweave::kv
