#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "signweave/core/bytes.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/motion_db.h"

/// Internal to this module: the records that make up a stored motion, and their bytes (docs/store.md has a worked
/// example).
namespace signweave::motion_db {

/// The content of a record. Stored on disk: never renumber.
enum class RecordKind : std::uint8_t {
  skeleton = 0,  ///< one per motion
  packet = 1,    ///< rotations and translations of one joint, or of all, over some frames
  tracks = 2,    ///< all scalar tracks, over some frames
};

/// Denotes all joints where a joint's index is stored: a skeleton has at most 65,535 joints.
inline constexpr std::uint16_t kAllJoints = 0xFFFF;

/// The size in bytes of the header before every record's payload.
inline constexpr std::size_t kHeaderSize = 32;

/// The page size of the engines. A value of a whole page does not fit next to the engine's own header of 16 bytes, so
/// values are limited to n · kPageSize − kPageLoss bytes.
inline constexpr std::size_t kPageSize = 4096;
inline constexpr std::size_t kPageLoss = 16;

/// The number of frames in one record of this many scalar tracks: header and values fill four pages, about a second or
/// two of joints.
std::int64_t track_frames(std::size_t tracks) noexcept;

/// One record of a motion: its identity and the frames that it covers.
struct Record {
  RecordKind kind = RecordKind::skeleton;
  std::uint16_t part = 0;   ///< a packet's joint or kAllJoints; else 0
  std::uint32_t block = 0;  ///< the number of earlier records of the same part
  FrameRange frames;        ///< empty for the skeleton
};

/// How the numbers of a packet are stored. Stored on disk as the version of the record's layout: never renumber.
enum class Packing : std::uint8_t {
  plain = 1,    ///< every number in full
  compact = 2,  ///< packed without loss; small if the numbers lie on grids (compact.h)
};

/// The amount of data in each frame of a record.
struct Width {
  std::uint16_t rotations = 0;  ///< of a packet; the number of tracks in a record of scalar tracks
  std::uint16_t translations = 0;

  std::size_t frame_bytes() const noexcept { return rotations * std::size_t{16} + translations * std::size_t{12}; }
  friend bool operator==(Width, Width) = default;
};

/// What a reader knows about a record's payload in advance. (Skeletons and scalar tracks are always plain.)
struct RecordLayout {
  Width width;
  Packing packing = Packing::plain;
};

/// The key of a record. An array, not on the heap, because a read builds one for each packet.
using Key = std::array<std::byte, 16>;
Key key_of(std::uint64_t generation, const Record& record) noexcept;

bool cut_by_joint(AccessMode mode) noexcept;
/// The number of frames in each packet except the last: p, or all frames.
std::int64_t packet_frames(const StoredMotion& stored) noexcept;
Width width_of(const Skeleton& skeleton, const Record& packet) noexcept;
/// The width of a record of the scalar tracks.
Width track_width(const StoredMotion& stored) noexcept;
/// The packing of a motion's packets.
Packing packing_of(const StoredMotion& stored) noexcept;
/// The size in bytes of the value of a plain packet or of a record of tracks.
std::size_t value_size(const Record& record, Width width) noexcept;
/// True if a packet or a record of tracks may have this size: it has room for all its frames.
bool can_have_size(const Record& record, RecordLayout layout, std::size_t bytes) noexcept;

/// Throws Error{unsupported} if a packet would be larger than an engine's largest value (4 GiB).
void check_packet_size(const StoredMotion& stored);

/// Calls `visit` for each packet that contains one of the frames of one of the joints (empty: all), in writing order:
/// by block of frames, then by joint.
void for_each_packet(const StoredMotion& stored, FrameRange frames, const JointSet& joints,
                     const std::function<void(const Record&)>& visit);
/// Likewise for the records of the scalar tracks, by block.
void for_each_track_record(const StoredMotion& stored, FrameRange frames,
                           const std::function<void(const Record&)>& visit);

/// The number of records of the scalar tracks.
std::uint64_t track_record_count(const StoredMotion& stored) noexcept;

/// Encodes the value of a record. (A skeleton's record is Record{}.)
Bytes encode_skeleton(std::uint64_t generation, const Skeleton& skeleton);
Bytes encode_packet(std::uint64_t generation, const Motion& motion, const Record& packet,
                    Packing packing = Packing::plain);
Bytes encode_tracks(std::uint64_t generation, const std::vector<ScalarTrack>& tracks, const Record& record);

/// Describes what is wrong with a stored value; null if nothing is. A valid value has the right size and checksum and
/// is the requested record; a compact packet can be unpacked. Without `width`, a packet of one joint may have a
/// translation or not.
const char* fault_of(ByteSpan value, std::uint64_t generation, const Record& record, std::optional<Width> width,
                     Packing packing = Packing::plain);
inline const char* fault_of(ByteSpan value, std::uint64_t generation, const Record& record, RecordLayout layout) {
  return fault_of(value, generation, record, layout.width, layout.packing);
}

/// Decodes the skeleton in a valid value. Throws Error{corrupt}.
Skeleton decode_skeleton(ByteSpan value, const std::string& where);

/// "stored motion 7, joint 3 (LeftHand), frames [64, 128)": for errors. `skeleton` may be null.
std::string name_of(const StoredMotion& stored, const Record& record, const Skeleton* skeleton);

}  // namespace signweave::motion_db
