#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "signweave/core/bytes.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/motion_db.h"

/// Inside this module only: the records that a stored motion consists of, and their bytes (docs/store.md has a worked
/// example).
namespace signweave::motion_db {

/// What a record holds. Stored on disk: never renumber.
enum class RecordKind : std::uint8_t {
  skeleton = 0,  ///< one a motion
  packet = 1,    ///< rotations and translations of one joint or of all, over some frames
  tracks = 2,    ///< all scalar tracks, over some frames
};

/// Stands for every joint where a joint's index is stored: a skeleton has at most 65,535 joints.
inline constexpr std::uint16_t kAllJoints = 0xFFFF;

/// Bytes in front of every record's payload.
inline constexpr std::size_t kHeaderSize = 32;

/// The pages of the engines. A value of a whole page does not fit beside the engine's own header of 16 bytes, so
/// values are made to have at most n · kPageSize − kPageLoss bytes.
inline constexpr std::size_t kPageSize = 4096;
inline constexpr std::size_t kPageLoss = 16;

/// Frames in one record of so many scalar tracks: header and values fill four pages, like a second or two of joints.
std::int64_t track_frames(std::size_t tracks) noexcept;

/// One record of a motion: which it is, and what it covers.
struct Record {
  RecordKind kind = RecordKind::skeleton;
  std::uint16_t part = 0;   ///< a packet's joint or kAllJoints; else 0
  std::uint32_t block = 0;  ///< how many records of the same part lie before it
  FrameRange frames;        ///< empty for the skeleton
};

/// How the numbers of a packet are kept. Stored on disk as the version of the record's layout: never renumber.
enum class Packing : std::uint8_t {
  plain = 1,    ///< every number in full
  compact = 2,  ///< packed without loss, small where the numbers lie on grids (compact.h)
};

/// How many numbers each frame of a record holds.
struct Width {
  std::uint16_t rotations = 0;  ///< of a packet; of scalar tracks their number
  std::uint16_t translations = 0;

  std::size_t frame_bytes() const noexcept { return rotations * std::size_t{16} + translations * std::size_t{12}; }
  friend bool operator==(Width, Width) = default;
};

/// What a reader knows of a record's payload beforehand. (Skeletons and scalar tracks are always plain.)
struct Layout {
  Width width;
  Packing packing = Packing::plain;
};

/// The key of a record. Not on the heap: a read makes one for each packet.
using Key = std::array<std::byte, 16>;
Key key_of(std::uint64_t generation, const Record& record) noexcept;

bool cut_by_joint(AccessMode mode) noexcept;
/// The frames of each packet but the last: p, or all of them.
std::int64_t packet_frames(const StoredMotion& stored) noexcept;
Width width_of(const Skeleton& skeleton, const Record& packet) noexcept;
/// The width of a record of the scalar tracks.
Width track_width(const StoredMotion& stored) noexcept;
/// How a motion's packets are packed.
Packing packing_of(const StoredMotion& stored) noexcept;
/// Bytes of the value of a plain packet or of tracks.
std::size_t value_size(const Record& record, Width width) noexcept;
/// True where a packet or a record of tracks may have so many bytes: it has room for all its frames.
bool can_have_size(const Record& record, Layout layout, std::size_t bytes) noexcept;

/// Throws Error{unsupported} where a packet would be larger than an engine's largest value (4 GiB).
void check_packet_size(const StoredMotion& stored);

/// Calls `visit` for each packet that holds one of the frames of one of the joints (empty: all), in the order in which
/// they are written: by block of frames, then by joint.
void for_each_packet(const StoredMotion& stored, FrameRange frames, const JointSet& joints,
                     const std::function<void(const Record&)>& visit);
/// Likewise for the records of the scalar tracks, by block.
void for_each_track_record(const StoredMotion& stored, FrameRange frames,
                           const std::function<void(const Record&)>& visit);

/// How many records the scalar tracks have.
std::uint64_t track_record_count(const StoredMotion& stored) noexcept;

/// The value of a record. (A skeleton's record is Record{}.)
Bytes encode_skeleton(std::uint64_t generation, const Skeleton& skeleton);
Bytes encode_packet(std::uint64_t generation, const Motion& motion, const Record& packet,
                    Packing packing = Packing::plain);
Bytes encode_tracks(std::uint64_t generation, const std::vector<ScalarTrack>& tracks, const Record& record);

/// What is wrong with a stored value, or null. A value without fault has the right size, is the record that was asked
/// for, and has the right checksum; a compact packet can be unpacked. Without `width`, a packet of one joint may have a
/// translation or not.
const char* fault_of(ByteSpan value, std::uint64_t generation, const Record& record, std::optional<Width> width,
                     Packing packing = Packing::plain);
inline const char* fault_of(ByteSpan value, std::uint64_t generation, const Record& record, Layout layout) {
  return fault_of(value, generation, record, layout.width, layout.packing);
}

/// The skeleton in a value without fault. Throws Error{corrupt}.
Skeleton decode_skeleton(ByteSpan value, const std::string& where);

/// "stored motion 7, joint 3 (LeftHand), frames [64, 128)": for errors. `skeleton` may be null.
std::string name_of(const StoredMotion& stored, const Record& record, const Skeleton* skeleton);

}  // namespace signweave::motion_db
