#include <algorithm>

#include "signweave/kv/fault.h"
#include "signweave/kv/lmdb_environment.h"

namespace signweave::kv {

namespace {

struct LmdbMeaning {
  int code;
  ErrorCode kind;
  const char* text;
};

constexpr LmdbMeaning kLmdbMeanings[] = {
    {MDB_MAP_FULL, ErrorCode::io,
     "the store has reached its maximum size; raise the limit on virtual memory (ulimit -v)"},
    {MDB_READERS_FULL, ErrorCode::conflict, "more than 1024 readers at once; wait until some have finished"},
    {MDB_MAP_RESIZED, ErrorCode::conflict,
     "another process has made the store larger than is mapped here; open it again"},
    {MDB_CORRUPTED, ErrorCode::corrupt, "the store is damaged; restore it from a copy"},
    {MDB_PAGE_NOTFOUND, ErrorCode::corrupt, "the store is damaged; restore it from a copy"},
    {MDB_INVALID, ErrorCode::corrupt, "the store is damaged; restore it from a copy"},
    {MDB_VERSION_MISMATCH, ErrorCode::unsupported,
     "the store was made by another version of LMDB; open it with that one"},
    {MDB_PANIC, ErrorCode::io, "an earlier write failed half way; open the store again"},
    {MDB_BAD_TXN, ErrorCode::io, "an earlier step of this change failed; start it again"},
};

}  // namespace

void fail_lmdb(const std::filesystem::path& folder, std::string_view doing, int code) {
  const auto* const meaning = std::find_if(std::begin(kLmdbMeanings), std::end(kLmdbMeanings),
                                           [&](const LmdbMeaning& m) { return m.code == code; });
  if (meaning != std::end(kLmdbMeanings)) fail(folder, doing, {meaning->kind, meaning->text});
  fail_system(folder, doing, code);
}

}  // namespace signweave::kv
