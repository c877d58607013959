#include <sys/stat.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <deque>
#include <limits>
#include <utility>

#include "signweave/kv/engine.h"
#include "signweave/kv/lmdb_environment.h"

// A store is LMDB's own two files, data.mdb and lock.mdb, with everything in its unnamed database.

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

using Environment = std::shared_ptr<LmdbEnvironment>;

/// LMDB takes keys of 1 to mdb_env_get_maxkeysize() bytes.
MDB_val key_of(const LmdbEnvironment& environment, ByteSpan key) {
  const auto longest = static_cast<std::size_t>(::mdb_env_get_maxkeysize(environment.get()));
  if (key.empty() || key.size() > longest) {
    throw Error(ErrorCode::bad_input, environment.folder().string() + ": a key of " + std::to_string(key.size()) +
                                          " bytes; keys have 1 to " + std::to_string(longest) + ", use a shorter name");
  }
  return {key.size(), const_cast<std::byte*>(key.data())};  // LMDB only reads it
}

std::optional<ByteSpan> get_value(const LmdbEnvironment& environment, MDB_txn* transaction, ByteSpan key) {
  assert(transaction && "the transaction is over");
  MDB_val name = key_of(environment, key);
  MDB_val value{};
  const int code = ::mdb_get(transaction, environment.database(), &name, &value);
  if (code == MDB_NOTFOUND) return std::nullopt;
  if (code != MDB_SUCCESS) environment.fail("reading", code);
  return ByteSpan(static_cast<const std::byte*>(value.mv_data), value.mv_size);
}

class LmdbRead final : public ReadTransaction {
 public:
  explicit LmdbRead(Environment environment)
      : environment_(std::move(environment)), transaction_(environment_->begin_read()) {}
  ~LmdbRead() override {
    if (cursor_) ::mdb_cursor_close(cursor_);
    ::mdb_txn_abort(transaction_);
  }

  // Uses one cursor: if the key is on the same page as the last one, as for a motion's next packet, LMDB does not
  // search the tree again.
  std::optional<ByteSpan> get(ByteSpan key) const override {
    if (over_) environment_->fail("reading", MDB_PAGE_NOTFOUND);
    int code = cursor_ ? MDB_SUCCESS : ::mdb_cursor_open(transaction_, environment_->database(), &cursor_);
    if (code != MDB_SUCCESS) environment_->fail("reading", code);
    MDB_val name = key_of(*environment_, key);
    MDB_val value{};
    code = ::mdb_cursor_get(cursor_, &name, &value, MDB_SET_KEY);
    if (code == MDB_NOTFOUND) return std::nullopt;
    if (code != MDB_SUCCESS) {
      begin_again();
      environment_->fail("reading", code);
    }
    return ByteSpan(static_cast<const std::byte*>(value.mv_data), value.mv_size);
  }
  std::optional<ByteSpan> get(ByteSpan key, Bytes&) const override { return get(key); }

  void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const {
    MDB_cursor* opened = nullptr;
    int code = ::mdb_cursor_open(transaction_, environment_->database(), &opened);
    if (code != MDB_SUCCESS) environment_->fail("reading", code);
    const std::unique_ptr<MDB_cursor, decltype(&::mdb_cursor_close)> cursor(opened, ::mdb_cursor_close);
    MDB_val key{}, value{};
    while ((code = ::mdb_cursor_get(cursor.get(), &key, &value, MDB_NEXT)) == MDB_SUCCESS) {
      see(ByteSpan(static_cast<const std::byte*>(key.mv_data), key.mv_size), value.mv_size);
    }
    if (code != MDB_NOTFOUND) environment_->fail("reading", code);
  }

 private:
  /// After a damaged page LMDB refuses everything else in the same transaction. A new transaction continues to read,
  /// and it is the same snapshot unless there was a write in between.
  void begin_again() const noexcept {
    const std::size_t snapshot = ::mdb_txn_id(transaction_);
    ::mdb_cursor_close(std::exchange(cursor_, nullptr));
    ::mdb_txn_reset(transaction_);
    over_ = ::mdb_txn_renew(transaction_) != MDB_SUCCESS || ::mdb_txn_id(transaction_) != snapshot;
  }

  Environment environment_;
  MDB_txn* transaction_;
  mutable MDB_cursor* cursor_ = nullptr;
  mutable bool over_ = false;  ///< the snapshot was lost after an error
};

class LmdbWrite final : public WriteTransaction {
 public:
  explicit LmdbWrite(Environment environment)
      : environment_(std::move(environment)), transaction_(environment_->begin_write()) {}
  ~LmdbWrite() override {
    if (!transaction_) return;
    ::mdb_txn_abort(transaction_);
    environment_->end_write();
  }

  std::optional<ByteSpan> get(ByteSpan key) const override {
    const std::optional<ByteSpan> value = get_value(*environment_, transaction_, key);
    if (!value) return std::nullopt;
    // LMDB's own view lasts until the next put; lent bytes must last until the transaction ends.
    return ByteSpan(lent_.emplace_back(value->begin(), value->end()));
  }

  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override {
    const std::optional<ByteSpan> value = get_value(*environment_, transaction_, key);
    if (!value) return std::nullopt;
    buffer.assign(value->begin(), value->end());
    return ByteSpan(buffer);
  }

  void put(ByteSpan key, ByteSpan value) override {
    assert(transaction_ && "the transaction is over");
    if (value.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::unsupported, environment_->folder().string() + ": a value of " +
                                              std::to_string(value.size()) +
                                              " bytes; LMDB takes less than 4 GiB, store it in smaller parts");
    }
    MDB_val name = key_of(*environment_, key);
    MDB_val bytes{value.size(), const_cast<std::byte*>(value.data())};  // LMDB only reads it
    const int code = ::mdb_put(transaction_, environment_->database(), &name, &bytes, 0);
    if (code != MDB_SUCCESS) environment_->fail("writing", code);
  }

  bool erase(ByteSpan key) override {
    assert(transaction_ && "the transaction is over");
    MDB_val name = key_of(*environment_, key);
    const int code = ::mdb_del(transaction_, environment_->database(), &name, nullptr);
    if (code == MDB_NOTFOUND) return false;
    if (code != MDB_SUCCESS) environment_->fail("erasing", code);
    return true;
  }

  void commit() override {
    assert(transaction_ && "the transaction is over");
    const int code = ::mdb_txn_commit(transaction_);  // the transaction ends, whatever it returns
    transaction_ = nullptr;
    environment_->end_write();
    if (code != MDB_SUCCESS) environment_->fail("committing", code);
  }

 private:
  Environment environment_;
  MDB_txn* transaction_;
  mutable std::deque<Bytes> lent_;
};

class LmdbStore final : public KvStore {
 public:
  LmdbStore(Environment environment, Access access) : environment_(std::move(environment)), access_(access) {}

  std::unique_ptr<ReadTransaction> read() const override { return std::make_unique<LmdbRead>(environment_); }

  std::unique_ptr<WriteTransaction> write() override {
    if (access_ == Access::read_only) {
      throw Error(ErrorCode::unsupported,
                  environment_->folder().string() + ": the store was opened read-only; open it for writing");
    }
    return std::make_unique<LmdbWrite>(environment_);
  }

  EngineInfo info() const override {
    MDB_stat tree{};
    const int code = ::mdb_env_stat(environment_->get(), &tree);
    if (code != MDB_SUCCESS) environment_->fail("reading", code);
    int file = -1;
    ::mdb_env_get_fd(environment_->get(), &file);
    struct stat status {};
    if (::fstat(file, &status) != 0) environment_->fail("reading", errno);
    const auto bytes = static_cast<std::uint64_t>(status.st_size);
    int major = 0, minor = 0, patch = 0;
    ::mdb_version(&major, &minor, &patch);
    return {.name = "lmdb",
            .version = std::to_string(major) + '.' + std::to_string(minor) + '.' + std::to_string(patch),
            .entries = tree.ms_entries,
            .bytes_on_disk = bytes,
            .bytes_free = bytes - std::min(bytes, bytes_used())};
  }

  void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const override {
    const LmdbRead snapshot(environment_);
    snapshot.visit(see);
  }

  std::size_t longest_key() const noexcept override {
    return static_cast<std::size_t>(::mdb_env_get_maxkeysize(environment_->get()));
  }

 private:
  /// The bytes of the pages with entries, and of the two pages at the head of the file.
  std::uint64_t bytes_used() const {
    MDB_stat tree{};
    const int code = ::mdb_env_stat(environment_->get(), &tree);
    if (code != MDB_SUCCESS) environment_->fail("reading", code);
    return (2 + tree.ms_branch_pages + tree.ms_leaf_pages + tree.ms_overflow_pages) * std::uint64_t{tree.ms_psize};
  }

  Environment environment_;
  Access access_;
};

}  // namespace

void lmdb_create(const fs::path& folder) {
  MDB_env* env = nullptr;
  int code = ::mdb_env_create(&env);
  if (code != MDB_SUCCESS) fail_lmdb(folder, "making the store", code);
  code = ::mdb_env_open(env, folder.c_str(), 0, 0664);  // writes the two meta pages
  if (code == MDB_SUCCESS) code = ::mdb_env_sync(env, 1);
  ::mdb_env_close(env);
  if (code != MDB_SUCCESS) fail_lmdb(folder, "making the store", code);
}

std::unique_ptr<KvStore> lmdb_open(const fs::path& folder, Access access) {
  return std::make_unique<LmdbStore>(LmdbEnvironment::acquire(folder, access), access);
}

}  // namespace signweave::kv
