#include <db.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

#include "signweave/kv/engine.h"
#include "signweave/kv/fault.h"
#include "signweave/kv/versioned_store.h"

// A store is one hash database in data.bdb, plus logs. The environment is private to the process. VersionedStore
// ensures that no other process has the folder open and that a change never runs concurrently with another change or a
// read, so Berkeley DB's lock table is not needed. Its pages have their own latches, so reads may run concurrently with
// each other and with a commit or a checkpoint, which write pages and logs but modify none.

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "data.bdb";
// A write may stop at any kernel page when its process is killed, and at any file system block when power fails.
// Berkeley DB's log cannot repair a partly written page, so a page is no larger than either. Values longer than a
// quarter of a page are stored on their own pages.
constexpr std::uint32_t kPageSize = 4096;
// The cache allocates memory as it fills. A page outside the cache costs ten times as much as one inside.
constexpr std::uint64_t kSmallestCache = 256u << 20;
constexpr std::uint64_t kLargestCache = 1u << 30;
constexpr std::uint32_t kLogFileBytes = 1u << 20;  // one remains when the store is closed
constexpr std::uint32_t kLogBufferBytes = 256u << 10;
constexpr std::uint64_t kCheckpointBytes = 16u << 20;  // limit of what a recovery must read and of the size of the logs
constexpr std::uint64_t kEntryOverhead = kPageSize;    // the end of a value is on its own page
constexpr std::uint32_t kHashMagic = 0x061561;
constexpr int kFileMode = 0664;

// Berkeley DB calls this in the thread that met the error, just before the failing call returns.
thread_local std::string last_message;

void keep_message(const DB_ENV*, const char*, const char* message) {
  if (last_message.size() < 300) last_message += (last_message.empty() ? "" : "; ") + std::string(message);
}
void drop_message(const DB_ENV*, const char*) {}

DBT to_read(ByteSpan bytes) {
  DBT item{};
  item.data = const_cast<std::byte*>(bytes.data());  // only read
  item.size = static_cast<std::uint32_t>(bytes.size());
  return item;
}

DBT to_fill(Bytes& buffer) {
  DBT item{};
  item.data = buffer.data();
  item.ulen =
      static_cast<std::uint32_t>(std::min<std::size_t>(buffer.size(), std::numeric_limits<std::uint32_t>::max()));
  item.flags = DB_DBT_USERMEM;
  return item;
}

[[noreturn]] void fail_berkeley(const fs::path& folder, std::string_view doing, int code) {
  const std::string message = std::exchange(last_message, {});
  const auto known = code > 0 && code != EINVAL ? system_fault(folder, code) : std::nullopt;
  if (known) fail(folder, doing, *known);
  const std::string reason = message.empty() ? ::db_strerror(code) : message;
  if (code == DB_VERSION_MISMATCH || code == DB_OLD_VERSION) {
    fail(folder, doing,
         {ErrorCode::unsupported, "the store was made by another version of Berkeley DB; open it with that one"});
  }
  if (code == ENOENT || (code > 0 && code != EINVAL)) fail_system(folder, doing, code);
  for (const int error : {ENOSPC, EDQUOT, EFBIG}) {  // at the disk's end it panics: errno says why
    if (message.find(std::strerror(error)) != std::string::npos) fail_system(folder, doing, error);
  }
  fail(folder, doing,
       {ErrorCode::corrupt, "the store is damaged (" + reason +
                                "); open it again, and restore it from a copy if that "
                                "does not help"});
}

/// The 32-bit word `index` at the head of the file.
std::uint32_t word(ByteSpan head, std::size_t index) {
  std::uint32_t value = 0;
  std::memcpy(&value, head.data() + 4 * index, sizeof value);
  return value;
}

/// Rejects a file that is not a Berkeley DB hash file or, if all its pages should be present, is shorter than its head
/// says.
void check_head(const fs::path& folder, bool whole) {
  const fs::path path = folder / kFile;
  Bytes head(72);
  std::ifstream file(path, std::ios::binary);
  if (!file) fail_system(folder, "opening the store", errno);
  file.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  const std::uint64_t bytes = size_of_file(folder, kFile, "opening the store");
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::corrupt, path.string() + ": " + what + "; restore it from a copy");
  };
  if (!file) refuse("the file is cut short (" + std::to_string(bytes) + " bytes)");
  if (word(head, 3) != kHashMagic || word(head, 5) != kPageSize) refuse("this is not a Berkeley DB file of signweave");
  const std::uint64_t wanted = (std::uint64_t{word(head, 8)} + 1) * kPageSize;
  if (whole && bytes < wanted) {
    refuse("the file is cut short (" + std::to_string(bytes) + " bytes of " + std::to_string(wanted) + ")");
  }
}

/// If a write reached the end of the disk or the file size limit, the file ends within a page, and Berkeley DB would
/// reject it. The committed content of that page is in the logs.
void drop_part_of_a_page(const fs::path& folder) {
  std::error_code error;
  const std::uint64_t bytes = fs::file_size(folder / kFile, error);
  if (!error && bytes % kPageSize != 0) fs::resize_file(folder / kFile, bytes - bytes % kPageSize, error);
  if (error) fail_system(folder, "opening the store", error.value());
}

bool has_logs(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().starts_with("log.")) return true;
  }
  return false;
}

/// Makes a file that was closed in order forget its logs: they are gone, and no longer needed.
void forget_logs(const fs::path& folder) {
  DB_ENV* env = nullptr;
  int code = ::db_env_create(&env, 0);
  if (code != 0) fail_berkeley(folder, "opening the store", code);
  env->set_errcall(env, keep_message);
  code = env->open(env, folder.c_str(), DB_PRIVATE | DB_CREATE | DB_INIT_MPOOL, kFileMode);
  if (code == 0) code = env->lsn_reset(env, kFile, 0);
  const int closed = env->close(env, 0);
  if (code == 0) code = closed;
  if (code != 0) fail_berkeley(folder, "opening the store", code);
}

/// Before a store is opened for writing: fixes what Berkeley DB's own recovery cannot handle.
void prepare_for_recovery(const fs::path& folder, bool closed) {
  check_head(folder, closed);  // foreign files stay unchanged
  if (has_logs(folder)) {
    if (!closed) drop_part_of_a_page(folder);
    return;
  }
  if (closed) return forget_logs(folder);
  throw Error(ErrorCode::corrupt, folder.string() +
                                      ": the last writer did not close the store, and its logs (log.…) are missing; "
                                      "restore it from a copy");
}

class BerkeleyStore final : public PlainStore {
 public:
  /// `make`: also creates the file.
  BerkeleyStore(const fs::path& folder, Access access, bool make) : folder_(folder), access_(access) {
    try {
      open(make);
    } catch (...) {
      release();
      throw;
    }
  }
  ~BerkeleyStore() override { release(); }

  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override {
    for (;;) {
      DBT name = to_read(key);
      DBT value = to_fill(buffer);
      const int code = db_->get(db_, nullptr, &name, &value, 0);
      if (code == 0) return ByteSpan(buffer).first(value.size);
      if (code == DB_NOTFOUND) return std::nullopt;
      if (code != DB_BUFFER_SMALL) refuse("reading", code);
      make_room(buffer, value.size);
    }
  }

  bool has(ByteSpan key) const override {
    DBT name = to_read(key);
    const int code = db_->exists(db_, nullptr, &name, 0);
    if (code != 0 && code != DB_NOTFOUND) refuse("reading", code);
    return code == 0;
  }

  std::uint64_t entries() const override { return entries_; }

  void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const override {
    DBC* opened = nullptr;
    int code = db_->cursor(db_, nullptr, &opened, 0);
    if (code != 0) refuse("reading", code);
    const std::unique_ptr<DBC, int (*)(DBC*)> cursor(opened, [](DBC* one) { return one->close(one); });
    Bytes key_buffer(512);
    for (;;) {
      DBT key = to_fill(key_buffer);
      DBT nothing{};
      nothing.flags = DB_DBT_USERMEM | DB_DBT_PARTIAL;
      code = cursor->get(cursor.get(), &key, &nothing, DB_NEXT);
      if (code == DB_NOTFOUND) return;
      if (code != 0) refuse("reading", code);
      if (key.size == 0) continue;  // the counter
      // Requesting the value with an empty buffer returns its size without reading it.
      DBT same{};
      same.flags = DB_DBT_USERMEM | DB_DBT_PARTIAL;
      DBT value{};
      value.flags = DB_DBT_USERMEM;
      code = cursor->get(cursor.get(), &same, &value, DB_CURRENT);
      if (code != 0 && code != DB_BUFFER_SMALL) refuse("reading", code);
      see(ByteSpan(key_buffer).first(key.size), value.size);
    }
  }

  void begin(std::size_t entries, std::uint64_t bytes) override {
    last_message.clear();
    entries_before_ = entries_;
    // Pages reach the file long after their commit, and there must be room for them then.
    const std::uint64_t wanted = waiting_ + bytes + entries * kEntryOverhead + 4 * kPageSize;
    require_room(folder_ / kFile, wanted);
    int file = -1;
    if (db_->fd(db_, &file) == 0) reserve(folder_, file, size_of_file(folder_, kFile, "beginning to write"), wanted);
    waiting_ = wanted;
    const int code = env_->txn_begin(env_, nullptr, &transaction_, 0);
    if (code != 0) refuse("beginning to write", code);
  }

  void put(ByteSpan key, ByteSpan value) override {
    DBT name = to_read(key);
    DBT bytes = to_read(value);
    int code = db_->put(db_, transaction_, &name, &bytes, DB_NOOVERWRITE);
    if (code == 0) ++entries_;
    if (code == DB_KEYEXIST) code = db_->put(db_, transaction_, &name, &bytes, 0);
    if (code != 0) refuse("writing", code);
  }

  void erase(ByteSpan key) override {
    DBT name = to_read(key);
    const int code = db_->del(db_, transaction_, &name, 0);
    if (code != 0) refuse("erasing", code);
    --entries_;
  }

  void finish() override {
    if (entries_ != entries_before_) put_counter();
  }

  void commit() override {
    DB_TXN* const transaction = std::exchange(transaction_, nullptr);  // over, whatever the commit returns
    const int code = transaction->commit(transaction, 0);
    if (code != 0) refuse("committing", code);
    // The committed change is in the log whatever the checkpoint does, and the next commit tries it again.
    if (waiting_ >= kCheckpointBytes) {
      const int written = env_->txn_checkpoint(env_, 0, 0, 0);
      if (written == 0) waiting_ = 0;
      if (written == DB_RUNRECOVERY) broken_ = true;
    }
    last_message.clear();
  }

  void abort() override {
    entries_ = entries_before_;
    if (!transaction_) return;
    DB_TXN* const transaction = std::exchange(transaction_, nullptr);
    const int code = transaction->abort(transaction);
    if (code != 0) refuse("undoing a change", code);
  }

  bool sound() const noexcept override { return !broken_; }

  void close() override {
    DB* const db = std::exchange(db_, nullptr);
    int code = db->close(db, 0);
    if (code != 0) refuse("closing the store", code);
    code = env_->txn_checkpoint(env_, 0, 0, DB_FORCE);
    if (code != 0) refuse("closing the store", code);
    DB_ENV* const env = std::exchange(env_, nullptr);
    code = env->close(env, 0);
    if (code != 0) refuse("closing the store", code);
  }

 private:
  void open(bool make);
  void put_counter();
  void release() noexcept;

  [[noreturn]] void refuse(std::string_view doing, int code) const {
    if (code == DB_RUNRECOVERY) broken_ = true;
    fail_berkeley(folder_, doing, code);
  }

  fs::path folder_;
  Access access_;
  DB_ENV* env_ = nullptr;
  DB* db_ = nullptr;
  DB_TXN* transaction_ = nullptr;
  mutable std::atomic<bool> broken_ = false;  ///< the environment failed ("panic")
  std::uint64_t entries_ = 0;
  std::uint64_t entries_before_ = 0;
  std::uint64_t waiting_ = 0;  ///< committed bytes that may not yet be in the main file
};

void BerkeleyStore::open(bool make) {
  const auto need = [&](int code) {
    if (code != 0) refuse(make ? "making the store" : "opening the store", code);
  };
  const bool writing = access_ == Access::read_write;
  last_message.clear();
  if (!make) check_head(folder_, !writing);
  need(::db_env_create(&env_, 0));
  env_->set_errcall(env_, keep_message);
  env_->set_msgcall(env_, drop_message);
  const std::uint64_t bytes = make ? 0 : size_of_file(folder_, kFile, "opening the store");
  const std::uint64_t cache = std::clamp(bytes + bytes / 4, kSmallestCache, kLargestCache);
  need(env_->set_cachesize(env_, static_cast<std::uint32_t>(cache >> 30),
                           static_cast<std::uint32_t>(cache & ((1u << 30) - 1)), 1));
  need(env_->set_lg_max(env_, kLogFileBytes));
  need(env_->set_lg_bsize(env_, kLogBufferBytes));
  need(env_->log_set_config(env_, DB_LOG_AUTO_REMOVE, 1));
  // A reader needs no logs: after an orderly close everything is in the main file. It may also lack the permission to
  // write one.
  const std::uint32_t parts = writing ? DB_INIT_TXN | DB_INIT_LOG | DB_RECOVER : 0;
  need(env_->open(env_, folder_.c_str(), DB_PRIVATE | DB_THREAD | DB_CREATE | DB_INIT_MPOOL | parts, kFileMode));
  need(::db_create(&db_, env_, 0));
  if (make) {
    need(db_->set_pagesize(db_, kPageSize));
    need(db_->set_flags(db_, DB_CHKSUM));
  }
  const std::uint32_t mode = writing ? DB_AUTO_COMMIT | (make ? DB_CREATE : 0) : DB_RDONLY;
  need(db_->open(db_, nullptr, kFile, nullptr, DB_HASH, DB_THREAD | mode, kFileMode));
  if (make) {
    put_counter();
    return;
  }
  check_head(folder_, true);  // a recovery writes everything that was missing
  Bytes buffer(sizeof entries_);
  const std::optional<ByteSpan> counter = get({}, buffer);
  if (!counter || counter->size() != sizeof entries_) {
    throw Error(ErrorCode::corrupt,
                (folder_ / kFile).string() + ": the number of its entries is missing; restore it from a copy");
  }
  std::memcpy(&entries_, counter->data(), sizeof entries_);
}

// The number of entries is stored under the empty key, which is otherwise invalid: Berkeley DB itself can only count
// all entries.
void BerkeleyStore::put_counter() {
  DBT name{};
  DBT value = to_read(std::as_bytes(std::span(&entries_, 1)));
  const int code = db_->put(db_, transaction_, &name, &value, 0);
  if (code != 0) refuse("writing", code);
}

void BerkeleyStore::release() noexcept {
  if (broken_ && env_) env_->set_flags(env_, DB_NOPANIC, 1);  // otherwise closing would free nothing
  if (transaction_) transaction_->abort(transaction_);
  if (db_) db_->close(db_, DB_NOSYNC);
  if (env_) env_->close(env_, 0);
  last_message.clear();
}

std::string version() {
  int major = 0, minor = 0, patch = 0;
  ::db_version(&major, &minor, &patch);
  return std::to_string(major) + '.' + std::to_string(minor) + '.' + std::to_string(patch);
}

constexpr PlainEngine kBerkeley = {
    .name = "berkeley",
    .file = kFile,
    .logs = "log.",
    .version = version,
    .longest_key = 511,
    .largest_value = 0xF0000000,  // sizes have 32 bits, and a buffer is slightly larger than its value
    .make = [](const fs::path& folder) -> std::unique_ptr<PlainStore> {
      return std::make_unique<BerkeleyStore>(folder, Access::read_write, true);
    },
    .open = [](const fs::path& folder, Access access, bool closed) -> std::unique_ptr<PlainStore> {
      if (access == Access::read_write) prepare_for_recovery(folder, closed);
      return std::make_unique<BerkeleyStore>(folder, access, false);
    },
};

}  // namespace

void berkeley_create(const fs::path& folder) {
  create_versioned(folder, kBerkeley);
}

std::unique_ptr<KvStore> berkeley_open(const fs::path& folder, Access access) {
  return open_versioned(folder, access, kBerkeley);
}

void berkeley_compact(const fs::path& folder, const fs::path& compacting,
                      const std::function<void(double fraction)>& progress) {
  compact_versioned(folder, compacting, kBerkeley, progress);
}

}  // namespace signweave::kv
