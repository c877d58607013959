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

/// The motion database (the paper's raw database): motions divided into packets in a key-value store. It knows nothing
/// of names or annotation. The caller's record determines which motions are visible (see database/): a motion is first
/// written under a new generation number, in bounded transactions, and becomes visible when the caller's record names
/// it. Its keys have 16 bytes and begin with 'm': the caller's own keys must not.
namespace signweave::motion_db {

struct Record;

/// The descriptor needed to read or erase a stored motion: the caller stores it.
struct StoredMotion {
  std::uint64_t generation = 0;  ///< unique in the database, never reused
  AccessMode mode;               ///< frames_per_packet filled in
  FrameRate rate;
  std::int64_t frames = 0;
  std::uint32_t joints = 0;
  std::uint32_t translations = 0;
  std::vector<std::string> tracks;  ///< names of the scalar tracks
  /// Metres. In compact packets, joints and tips are within this distance of their positions when the motion was
  /// stored. 0: lossless, all numbers in full.
  float tolerance = 0;
  friend bool operator==(const StoredMotion&, const StoredMotion&) = default;
};

void encode(const StoredMotion& stored, ByteWriter& out);
StoredMotion decode(ByteReader& in);

/// The access mode with p filled in: the given p, or the default for the skeleton and the engines' page size.
AccessMode fitted(AccessMode mode, const Skeleton& skeleton, float tolerance = 0);

/// The descriptor under which `put` will write, with a default p filled in: known before anything is written, so that
/// the caller can record what to sweep after a crash. Throws Error{bad_input} for a motion without frames or joints,
/// Error{unsupported} if a packet would be larger than an engine allows (4 GiB). With a tolerance (metres, above 0) the
/// packets will be compact and the descriptor contains the tolerance. Such a motion must be the result of `quantise`
/// (quantise.h) to pack small: any other is also stored exactly, but takes as much room as without a tolerance.
StoredMotion describe(const Motion& motion, AccessMode mode, std::uint64_t generation, float tolerance = 0);

/// The number of packets of the motion: the paper's 1, ceil(n/p), m, m * ceil(n/p). Skeleton and scalar tracks are
/// separate records and not counted.
std::uint64_t packet_count(const StoredMotion& stored) noexcept;

/// Writes skeleton, packets and tracks in transactions of bounded size. `stored` is the result of `describe` for this
/// motion. `progress` is called between transactions and may throw to cancel; `erase` then removes what was written.
void put(kv::KvStore& store, const StoredMotion& stored, const Motion& motion,
         const std::function<void(double fraction)>& progress = {});

/// Erases everything that `put` wrote or began to write under this descriptor. Repeating it is harmless.
void erase(kv::KvStore& store, const StoredMotion& stored);

/// Calls see(key) for the key of each record of a stored motion, in writing order.
void for_each_key(const StoredMotion& stored, const std::function<void(ByteSpan key)>& see);

/// The cost of a read. `packets` counts packets only; `bytes` includes the records of scalar tracks.
struct ReadCost {
  std::uint64_t packets = 0;
  std::uint64_t bytes = 0;
};

/// The kind of the record under a key: "packets", "skeletons" or "scalar tracks"; empty if it is not a motion's record.
std::string_view kind_of(ByteSpan key) noexcept;
/// The generation of the motion to which the record under the key belongs; empty if it is not a motion's record.
std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept;

/// The skeleton of a stored motion.
std::shared_ptr<const Skeleton> read_skeleton(const kv::ReadTransaction& snapshot, const StoredMotion& stored);

/// Reads some frames of some joints (empty: all), bit for bit as stored, from only the packets that contain them. The
/// result has the whole skeleton; other joints are at rest, and scalar tracks are included only if the joint set is
/// empty. Throws Error{bad_input} for frames or joints that the motion does not have, Error{corrupt} naming joints and
/// frames if a packet is missing or its checksum is wrong. `skeleton` is the result of read_skeleton (so that motions
/// share it).
Motion read(const kv::ReadTransaction& snapshot, const StoredMotion& stored,
            const std::shared_ptr<const Skeleton>& skeleton, FrameRange frames, const JointSet& joints = {},
            ReadCost* cost = nullptr);

/// Cached knowledge of a stored motion: its skeleton, and which of its records were verified. Thread-safe. Generations
/// are never reused, so it stays valid as long as the motion exists.
class KnownMotion {
 public:
  /// Throws as `read_skeleton` does.
  KnownMotion(const kv::ReadTransaction& snapshot, StoredMotion stored);

  const StoredMotion& stored() const noexcept { return stored_; }
  const std::shared_ptr<const Skeleton>& skeleton() const noexcept { return skeleton_; }
  /// Packets are numbered in writing order, followed by the records of the scalar tracks.
  bool is_sound(std::uint64_t record) const noexcept;
  void mark_sound(std::uint64_t record) const noexcept;

 private:
  StoredMotion stored_;
  std::shared_ptr<const Skeleton> skeleton_;
  mutable std::vector<std::atomic<std::uint64_t>> sound_;  ///< one bit per record
};

/// Reads frames of a stored motion directly into the caller's memory, a few packets at a time. A record's checksum is
/// verified the first time it is read through the same KnownMotion; later reads only copy. Belongs to the thread of its
/// snapshot.
class StoredSource : public MotionSource {
 public:
  StoredSource(std::shared_ptr<const kv::ReadTransaction> snapshot, std::shared_ptr<const KnownMotion> motion)
      : snapshot_(std::move(snapshot)), motion_(std::move(motion)) {}

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return motion_->skeleton(); }
  FrameRate rate() const noexcept override { return motion_->stored().rate; }
  std::int64_t frame_count() const noexcept override { return motion_->stored().frames; }
  std::span<const std::string> tracks() const noexcept override { return motion_->stored().tracks; }
  /// Throws Error{corrupt} as the function `read` does.
  void read(FrameRange frames, MutablePoses out) const override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override;

 private:
  void remember(const Record& packet, ByteSpan value, const Bytes& buffer) const;

  std::shared_ptr<const kv::ReadTransaction> snapshot_;
  std::shared_ptr<const KnownMotion> motion_;
  mutable std::vector<Bytes> buffers_;  ///< reused buffers for values of an engine without a map
  /// Verified packets of all joints by block, if the engine lends them until the snapshot ends.
  mutable std::vector<ByteSpan> places_;
};

/// Verifies every record of a motion. Returns one line per fault, naming joints and frames, and one more if there are
/// over 1,000; empty if there are none. `progress` is called from time to time.
std::vector<std::string> check(const kv::ReadTransaction& snapshot, const StoredMotion& stored,
                               const std::function<void()>& progress = {});

}  // namespace signweave::motion_db
