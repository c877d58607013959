#include "signweave/kv/lmdb_environment.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "signweave/kv/open_stores.h"

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

// The map is only address space: the file grows as it is written. Halved if the system refuses (ulimit -v).
constexpr std::size_t kLargestMap = std::size_t{1} << 40;
constexpr std::size_t kSmallestMap = std::size_t{1} << 28;
constexpr unsigned kMostReaders = 1024;
constexpr mode_t kLmdbFileMode = 0664;

bool write_refused(int code) {
  return code == EACCES || code == EPERM || code == EROFS;
}

}  // namespace

void LmdbEnvironment::fail(std::string_view doing, int code) const {
  fail_lmdb(folder_, doing, code);
}

std::shared_ptr<LmdbEnvironment> LmdbEnvironment::acquire(const fs::path& folder, Access access) {
  auto environment = OpenStores<LmdbEnvironment>::acquire(
      folder / "data.mdb", [&] { return std::unique_ptr<LmdbEnvironment>(new LmdbEnvironment(folder, access)); });
  if (access == Access::read_write && !environment->writable()) {
    fail_lmdb(folder, "opening for writing a store that this process has open read-only", EACCES);
  }
  return environment;
}

LmdbEnvironment::LmdbEnvironment(fs::path folder, Access access) : folder_(std::move(folder)), process_(::getpid()) {
  check_lmdb_header(folder_);
  // Readers also use the lock file if they can: it prevents writers from reusing pages that a reader still sees. Only a
  // folder without write permission is read without it, and there no process with our permissions writes.
  int code = try_open(MDB_NOTLS);
  writable_ = code == MDB_SUCCESS;
  if (access == Access::read_only) {
    if (write_refused(code)) code = try_open(MDB_NOTLS | MDB_RDONLY);
    if (write_refused(code)) code = try_open(MDB_NOTLS | MDB_RDONLY | MDB_NOLOCK);
  }
  if (code != MDB_SUCCESS) fail("opening the store", code);
  try {
    ::mdb_reader_check(env_, nullptr);  // killed readers would otherwise hold old pages permanently
    check_length();
    MDB_txn* transaction = begin_read();
    code = ::mdb_dbi_open(transaction, nullptr, 0, &database_);
    ::mdb_txn_commit(transaction);  // commit, not abort, so that the handle stays valid
    if (code != MDB_SUCCESS) fail("opening the store", code);
  } catch (...) {
    ::mdb_env_close(env_);
    throw;
  }
}

LmdbEnvironment::~LmdbEnvironment() {
  // After a fork the environment belongs to the parent; closing it here would release the parent's locks.
  if (process_ == ::getpid()) ::mdb_env_close(env_);
}

int LmdbEnvironment::try_open(unsigned flags) {
  for (std::size_t size = kLargestMap;; size /= 2) {
    int code = ::mdb_env_create(&env_);
    if (code != MDB_SUCCESS) return code;
    ::mdb_env_set_mapsize(env_, size);
    ::mdb_env_set_maxreaders(env_, kMostReaders);
    code = ::mdb_env_open(env_, folder_.c_str(), flags, kLmdbFileMode);
    if (code == MDB_SUCCESS) return code;
    ::mdb_env_close(env_);
    env_ = nullptr;
    if (code != ENOMEM || size <= kSmallestMap) return code;
  }
}

// LMDB reads through a map, and a page beyond the end of the file raises SIGBUS. A file that reaches its last page has
// all pages. A shorter one may still be valid, because LMDB does not write pages that a transaction allocated and freed
// again; then the trees are walked.
void LmdbEnvironment::check_length() {
  MDB_txn* snapshot = begin_read();  // first, because pages of this snapshot stay and were written before it
  MDB_envinfo info{};
  ::mdb_env_info(env_, &info);
  int file = -1;
  ::mdb_env_get_fd(env_, &file);
  struct stat status {};
  ::fstat(file, &status);
  MDB_stat tree{};
  ::mdb_env_stat(env_, &tree);
  const std::uint64_t wanted = (static_cast<std::uint64_t>(info.me_last_pgno) + 1) * tree.ms_psize;
  const auto bytes = static_cast<std::uint64_t>(status.st_size);
  const bool sound = bytes >= wanted || lmdb_pages_inside(file, bytes, ::mdb_txn_id(snapshot));
  ::mdb_txn_abort(snapshot);
  if (!sound) {
    throw Error(ErrorCode::corrupt, (folder_ / "data.mdb").string() + ": the file is cut short (" +
                                        std::to_string(bytes) + " bytes of " + std::to_string(wanted) +
                                        "); restore it from a copy");
  }
}

MDB_txn* LmdbEnvironment::begin_read() const {
  MDB_txn* transaction = nullptr;
  int code = ::mdb_txn_begin(env_, nullptr, MDB_RDONLY, &transaction);
  if (code == MDB_READERS_FULL) {
    ::mdb_reader_check(env_, nullptr);
    code = ::mdb_txn_begin(env_, nullptr, MDB_RDONLY, &transaction);
  }
  if (code != MDB_SUCCESS) fail("beginning to read", code);
  return transaction;
}

MDB_txn* LmdbEnvironment::begin_write() {
  if (writer_ == std::this_thread::get_id()) {
    throw Error(ErrorCode::conflict, folder_.string() + ": this thread is writing already; end that change first");
  }
  MDB_txn* transaction = nullptr;
  const int code = ::mdb_txn_begin(env_, nullptr, 0, &transaction);
  if (code != MDB_SUCCESS) fail("beginning to write", code);
  writer_ = std::this_thread::get_id();
  return transaction;
}

}  // namespace signweave::kv
