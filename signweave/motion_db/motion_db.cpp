#include "signweave/motion_db/motion_db.h"

#include <cassert>

#include "signweave/motion_db/packet.h"

namespace signweave::motion_db {

namespace {

// The limits of one transaction, because it is in memory as a whole and a commit blocks other writers.
constexpr std::size_t kMostPuts = 512;
constexpr std::size_t kMostBytes = std::size_t{16} << 20;

/// Applies changes in transactions of bounded size.
class BoundedChange {
 public:
  BoundedChange(kv::KvStore& store, std::uint64_t records, std::function<void(double)> progress)
      : store_(store), records_(records), progress_(std::move(progress)) {}

  void put(ByteSpan key, ByteSpan value) {
    transaction().put(key, value);
    changed_ = true;
    stepped(value.size());
  }
  void erase(ByteSpan key) {
    changed_ |= transaction().erase(key);
    stepped(0);
  }
  void flush() {
    if (transaction_ && changed_) transaction_->commit();
    transaction_.reset();  // before `progress`, which must not wait while other writers wait for this transaction
    changed_ = false;
    steps_ = 0;
    bytes_ = 0;
    if (progress_) progress_(static_cast<double>(done_) / static_cast<double>(records_));
  }

 private:
  kv::WriteTransaction& transaction() {
    if (!transaction_) transaction_ = store_.write();
    return *transaction_;
  }
  void stepped(std::size_t bytes) {
    ++done_;
    bytes_ += bytes;
    if (++steps_ >= kMostPuts || bytes_ >= kMostBytes) flush();
  }

  kv::KvStore& store_;
  std::uint64_t records_;
  std::function<void(double)> progress_;
  std::unique_ptr<kv::WriteTransaction> transaction_;
  std::uint64_t done_ = 0;
  std::size_t steps_ = 0;
  std::size_t bytes_ = 0;
  bool changed_ = false;
};

std::uint64_t record_count(const StoredMotion& stored) {
  return 1 + packet_count(stored) + track_record_count(stored);
}

}  // namespace

void put(kv::KvStore& store, const StoredMotion& stored, const Motion& motion,
         const std::function<void(double fraction)>& progress) {
  assert(stored == describe(motion, stored.mode, stored.generation, stored.tolerance));
  const std::uint64_t generation = stored.generation;
  const FrameRange all{0, stored.frames};
  BoundedChange change(store, record_count(stored), progress);
  change.put(key_of(generation, Record{}), encode_skeleton(generation, motion.skeleton()));
  for_each_packet(stored, all, {}, [&](const Record& packet) {
    change.put(key_of(generation, packet), encode_packet(generation, motion, packet, packing_of(stored)));
  });
  for_each_track_record(stored, all, [&](const Record& record) {
    change.put(key_of(generation, record), encode_tracks(generation, motion.tracks(), record));
  });
  change.flush();
}

void for_each_key(const StoredMotion& stored, const std::function<void(ByteSpan key)>& see) {
  const FrameRange all{0, stored.frames};
  const auto see_record = [&](const Record& record) { see(key_of(stored.generation, record)); };
  see_record(Record{});
  for_each_packet(stored, all, {}, see_record);
  for_each_track_record(stored, all, see_record);
}

void erase(kv::KvStore& store, const StoredMotion& stored) {
  BoundedChange change(store, record_count(stored), {});
  for_each_key(stored, [&](ByteSpan key) { change.erase(key); });
  change.flush();
}

std::string_view kind_of(ByteSpan key) noexcept {
  if (key.size() != 16 || key[0] != std::byte{'m'}) return {};
  switch (static_cast<RecordKind>(key[9])) {
    case RecordKind::skeleton:
      return "skeletons";
    case RecordKind::packet:
      return "packets";
    case RecordKind::tracks:
      return "scalar tracks";
  }
  return {};
}

std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept {
  if (kind_of(key).empty()) return std::nullopt;
  std::uint64_t generation = 0;
  for (const std::byte byte : key.subspan(1, 8)) generation = generation << 8 | static_cast<std::uint64_t>(byte);
  return generation;
}

}  // namespace signweave::motion_db
