#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/kv/kv_store.h"
#include "signweave/motion/motion.h"
#include "signweave/motion/motion_source.h"
#include "signweave/motion_db/access_mode.h"

/// The motion database (the paper's raw database): motions cut into packets on a key-value store. It knows nothing of
/// names or annotation. Which motions are visible is the caller's record (see database/), so a motion is written under
/// a new generation number first, in bounded transactions, and becomes visible when the caller's one record names it.
/// Its keys have 16 bytes and begin with 'm': the caller's own must not.
namespace signweave::motion_db {

struct Record;

/// What must be known to read, or to erase, a stored motion: the caller keeps it.
struct StoredMotion {
  std::uint64_t generation = 0;  ///< unique in the database, never used again
  AccessMode mode;               ///< frames_per_packet filled in
  FrameRate rate;
  std::int64_t frames = 0;
  std::uint32_t joints = 0;
  std::uint32_t translations = 0;
  std::vector<std::string> tracks;  ///< names of the scalar tracks
  /// Metres: joints and tips were kept within it of where they were when the motion was stored, in compact packets.
  /// 0: lossless, every number in full.
  float tolerance = 0;
  friend bool operator==(const StoredMotion&, const StoredMotion&) = default;
};

void encode(const StoredMotion& stored, ByteWriter& out);
StoredMotion decode(ByteReader& in);

/// The access mode with p filled in: the given one, or the default that fits a skeleton to the engines' pages.
AccessMode fitted(AccessMode mode, const Skeleton& skeleton, float tolerance = 0);

/// The descriptor that `put` will write under, with a default p filled in: known before anything is written, so that a
/// caller can note what to sweep after a crash. Throws Error{bad_input} for a motion without frames or joints,
/// Error{unsupported} where a packet would be larger than an engine takes (4 GiB). With a tolerance (metres, above 0)
/// its packets will be compact; the tolerance is noted, and the motion must have been through `quantise` (quantise.h)
/// to pack small: any other is stored as exactly, but takes as much room as without.
StoredMotion describe(const Motion& motion, AccessMode mode, std::uint64_t generation, float tolerance = 0);

/// How many packets the motion has: the paper's 1, ceil(n/p), m, m * ceil(n/p). Skeleton and scalar tracks are records
/// of their own and not counted.
std::uint64_t packet_count(const StoredMotion& stored) noexcept;

/// Writes skeleton, packets and tracks in transactions of bounded size. `stored` is what `describe` gave for this
/// motion. `progress` is called between transactions and may throw to cancel; `erase` then removes what was written.
void put(kv::KvStore& store, const StoredMotion& stored, const Motion& motion,
         const std::function<void(double fraction)>& progress = {});

/// Erases everything that `put` wrote or began to write under this descriptor. Doing it twice is harmless.
void erase(kv::KvStore& store, const StoredMotion& stored);

/// Calls see(key) for the key of each record of a stored motion, in the order in which they are written.
void for_each_key(const StoredMotion& stored, const std::function<void(ByteSpan key)>& see);

/// What a read cost. `packets` counts packets only, `bytes` the records of scalar tracks too.
struct ReadCost {
  std::uint64_t packets = 0;
  std::uint64_t bytes = 0;
};

/// What the record under a key is: "packets", "skeletons" or "scalar tracks"; empty where it is none of a motion's.
std::string_view kind_of(ByteSpan key) noexcept;
/// The generation of the motion whose record the key names; none where it is none of a motion's.
std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept;

/// The skeleton of a stored motion.
std::shared_ptr<const Skeleton> read_skeleton(const kv::ReadTransaction& snapshot, const StoredMotion& stored);

/// Some frames of some joints (empty: all), bit for bit as they were put, reading only the packets that hold them.
/// The result has the whole skeleton; joints that were not asked for are at rest, and scalar tracks come along only
/// where all joints are asked for by an empty set. Throws Error{bad_input} for frames or joints that the motion does
/// not have, Error{corrupt} naming joints and frames where a packet is missing or its checksum is wrong. `skeleton` is
/// what read_skeleton gave (so that motions share it).
Motion read(const kv::ReadTransaction& snapshot, const StoredMotion& stored,
            const std::shared_ptr<const Skeleton>& skeleton, FrameRange frames, const JointSet& joints = {},
            ReadCost* cost = nullptr);

/// What was learned of a stored motion by looking at it: its skeleton, and which of its records have been found sound.
/// Threads may share it. Generations are never used twice, so it holds as long as the motion is there.
class KnownMotion {
 public:
  /// Throws as `read_skeleton`.
  KnownMotion(const kv::ReadTransaction& snapshot, StoredMotion stored);

  const StoredMotion& stored() const noexcept { return stored_; }
  const std::shared_ptr<const Skeleton>& skeleton() const noexcept { return skeleton_; }
  /// Packets are numbered as they are written, and after them the records of the scalar tracks.
  bool is_sound(std::uint64_t record) const noexcept;
  void found_sound(std::uint64_t record) const noexcept;

 private:
  StoredMotion stored_;
  std::shared_ptr<const Skeleton> skeleton_;
  mutable std::vector<std::atomic<std::uint64_t>> sound_;  ///< a bit per record
};

/// Frames of a stored motion, read straight to where they are wanted, a few packets at a time. A record's checksum is
/// verified when it is read for the first time through the same KnownMotion; after that reading is a copy. Belongs to
/// its snapshot's thread.
class StoredSource : public MotionSource {
 public:
  StoredSource(std::shared_ptr<const kv::ReadTransaction> snapshot, std::shared_ptr<const KnownMotion> motion)
      : snapshot_(std::move(snapshot)), motion_(std::move(motion)) {}

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return motion_->skeleton(); }
  FrameRate rate() const noexcept override { return motion_->stored().rate; }
  std::int64_t frame_count() const noexcept override { return motion_->stored().frames; }
  std::span<const std::string> tracks() const noexcept override { return motion_->stored().tracks; }
  /// Throws Error{corrupt} as `read` below does.
  void read(FrameRange frames, MutablePoses out) const override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override;

 private:
  void remember(const Record& packet, ByteSpan value, const Bytes& buffer) const;

  std::shared_ptr<const kv::ReadTransaction> snapshot_;
  std::shared_ptr<const KnownMotion> motion_;
  mutable std::vector<Bytes> buffers_;  ///< what an engine without a map reads values into, kept from read to read
  /// Sound packets of all joints by block, where the engine lends them until the snapshot ends.
  mutable std::vector<ByteSpan> places_;
};

/// Verifies every record of a motion: one line per fault found, naming joints and frames, and one more where there are
/// over 1,000; empty where all is well. `progress` is called every now and then.
std::vector<std::string> check(const kv::ReadTransaction& snapshot, const StoredMotion& stored,
                               const std::function<void()>& progress = {});

}  // namespace signweave::motion_db
