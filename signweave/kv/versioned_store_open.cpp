#include <cassert>
#include <deque>
#include <limits>
#include <unordered_map>

#include "signweave/kv/versioned_store.h"

namespace signweave::kv {

namespace {

using Store = std::shared_ptr<VersionedStore>;

/// Holds copies that a transaction lends until it ends.
class Lent {
 public:
  ByteSpan keep(ByteSpan value) { return lent_.emplace_back(value.begin(), value.end()); }
  Bytes& scratch() noexcept { return scratch_; }

 private:
  std::deque<Bytes> lent_;
  Bytes scratch_;
};

class VersionedRead final : public ReadTransaction {
 public:
  explicit VersionedRead(Store store) : store_(std::move(store)), snapshot_(store_->begin_snapshot()) {}
  ~VersionedRead() override { store_->end_snapshot(snapshot_); }

  std::optional<ByteSpan> get(ByteSpan key) const override {
    const std::optional<ByteSpan> value = get(key, lent_.scratch());
    if (!value) return std::nullopt;
    return lent_.keep(*value);
  }
  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override {
    return store_->get(snapshot_, key, buffer);
  }

 private:
  Store store_;
  std::uint64_t snapshot_;
  mutable Lent lent_;
};

class VersionedWrite final : public WriteTransaction {
 public:
  explicit VersionedWrite(Store store) : store_(std::move(store)), turn_(store_->begin_write()) {}
  ~VersionedWrite() override { end(); }

  std::optional<ByteSpan> get(ByteSpan key) const override {
    const std::optional<ByteSpan> value = get(key, lent_.scratch());
    if (!value) return std::nullopt;
    return lent_.keep(*value);
  }

  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override {
    assert(turn_ && "the transaction is over");
    if (const auto at = places_.find(text_of(key)); at != places_.end()) {
      const std::optional<Bytes>& value = changes_[at->second].value;
      if (!value) return std::nullopt;
      make_room(buffer, value->size());
      std::copy(value->begin(), value->end(), buffer.begin());
      return ByteSpan(buffer).first(value->size());
    }
    return store_->get(std::numeric_limits<std::uint64_t>::max(), key, buffer);
  }

  void put(ByteSpan key, ByteSpan value) override {
    assert(turn_ && "the transaction is over");
    store_->check_key(key);
    if (value.size() > store_->engine().largest_value) {
      throw Error(ErrorCode::unsupported, store_->folder().string() + ": a value of " + std::to_string(value.size()) +
                                              " bytes; this engine takes " +
                                              std::to_string(store_->engine().largest_value) +
                                              " at most, store it in smaller parts");
    }
    change(key).value.emplace(value.begin(), value.end());
  }

  bool erase(ByteSpan key) override {
    assert(turn_ && "the transaction is over");
    store_->check_key(key);
    const auto at = places_.find(text_of(key));
    const bool there = at != places_.end() ? changes_[at->second].value.has_value() : store_->has(key);
    if (there) change(key).value.reset();
    return there;
  }

  void commit() override {
    assert(turn_ && "the transaction is over");
    struct End {
      VersionedWrite& transaction;
      ~End() { transaction.end(); }
    } const end{*this};
    if (!changes_.empty()) store_->apply(changes_);
  }

 private:
  Change& change(ByteSpan key) {
    const auto at = places_.find(text_of(key));
    if (at != places_.end()) return changes_[at->second];
    changes_.push_back({std::string(text_of(key)), {}});
    places_.emplace(changes_.back().key, changes_.size() - 1);
    return changes_.back();
  }

  void end() noexcept {
    if (!turn_) return;
    store_->end_write();
    turn_.unlock();
  }

  Store store_;
  std::unique_lock<std::mutex> turn_;
  std::deque<Change> changes_;                                ///< in the order of the first change of each key
  std::unordered_map<std::string_view, std::size_t> places_;  ///< [key] index in changes_, which owns the key
  mutable Lent lent_;
};

class VersionedKv final : public KvStore {
 public:
  VersionedKv(Store store, Access access) : store_(std::move(store)), access_(access) {}

  std::unique_ptr<ReadTransaction> read() const override { return std::make_unique<VersionedRead>(store_); }

  std::unique_ptr<WriteTransaction> write() override {
    if (access_ == Access::read_only) {
      throw Error(ErrorCode::unsupported,
                  store_->folder().string() + ": the store was opened read-only; open it for writing");
    }
    return std::make_unique<VersionedWrite>(store_);
  }

  EngineInfo info() const override { return store_->info(); }
  void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const override {
    store_->visit(see);
  }
  std::size_t longest_key() const noexcept override { return store_->engine().longest_key; }

 private:
  Store store_;
  Access access_;
};

}  // namespace

void create_versioned(const std::filesystem::path& folder, const PlainEngine& engine) {
  StoreLock lock(folder, Access::read_write);
  engine.make(folder)->close();
  lock.mark(true);
}

std::unique_ptr<KvStore> open_versioned(const std::filesystem::path& folder, Access access, const PlainEngine& engine) {
  return std::make_unique<VersionedKv>(VersionedStore::acquire(folder, access, engine), access);
}

}  // namespace signweave::kv
