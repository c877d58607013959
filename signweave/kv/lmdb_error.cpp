#include <sys/statvfs.h>

#include <algorithm>
#include <cerrno>

#include "signweave/kv/lmdb_environment.h"

namespace signweave::kv {

namespace {

struct Meaning {
  int code;
  ErrorCode kind;
  const char* text;
};

constexpr Meaning kMeanings[] = {
    {ENOSPC, ErrorCode::io, "disk full, this change was not kept; free some space and try again"},
    {EDQUOT, ErrorCode::io, "disk quota used up, this change was not kept; free some space and try again"},
    {EFBIG, ErrorCode::io, "the file may not grow further, this change was not kept; raise the limit on file size"},
    {EIO, ErrorCode::io,
     "disk full, limited or failing, this change was not kept; free some space or check the disk, and try again"},
    {ENOMEM, ErrorCode::io, "not enough memory; raise the limit on virtual memory (ulimit -v)"},
    {EACCES, ErrorCode::io, "no permission; change the permissions of the folder and its files"},
    {EPERM, ErrorCode::io, "no permission; change the permissions of the folder and its files"},
    {EROFS, ErrorCode::io, "the disk is mounted for reading only; mount it for writing"},
    {MDB_MAP_FULL, ErrorCode::io,
     "the store has reached its largest size; raise the limit on virtual memory (ulimit -v)"},
    {MDB_READERS_FULL, ErrorCode::conflict, "more than 1024 readers at once; let some end and try again"},
    {MDB_MAP_RESIZED, ErrorCode::conflict,
     "another process has made the store larger than is mapped here; open it again"},
    {MDB_CORRUPTED, ErrorCode::corrupt, "the store is damaged; restore it from a copy"},
    {MDB_PAGE_NOTFOUND, ErrorCode::corrupt, "the store is damaged; restore it from a copy"},
    {MDB_INVALID, ErrorCode::corrupt, "the store is damaged; restore it from a copy"},
    {MDB_VERSION_MISMATCH, ErrorCode::unsupported,
     "the store was made by another version of LMDB; open it with that one"},
    {MDB_PANIC, ErrorCode::io, "an earlier write failed half way; open the store again"},
    {MDB_BAD_TXN, ErrorCode::io, "an earlier step of this change failed; begin it again"},
};

bool disk_is_full(const std::filesystem::path& folder) {
  struct statvfs disk {};
  return ::statvfs(folder.c_str(), &disk) == 0 && disk.f_bavail * disk.f_frsize < (1u << 20);
}

}  // namespace

void fail_lmdb(const std::filesystem::path& folder, std::string_view doing, int code) {
  // A disk becomes full with a short write, and LMDB reports that as EIO.
  if (code == EIO && disk_is_full(folder)) code = ENOSPC;
  const auto* const meaning =
      std::find_if(std::begin(kMeanings), std::end(kMeanings), [&](const Meaning& m) { return m.code == code; });
  const bool known = meaning != std::end(kMeanings);
  const std::string text = known ? meaning->text : std::string(::mdb_strerror(code)) + "; check the disk and try again";
  throw Error(known ? meaning->kind : ErrorCode::io,
              folder.string() + ": " + text + " (while " + std::string(doing) + ")");
}

}  // namespace signweave::kv
