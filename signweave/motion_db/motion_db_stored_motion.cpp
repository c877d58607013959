#include <algorithm>
#include <cmath>
#include <limits>

#include "signweave/motion_db/grid.h"
#include "signweave/motion_db/motion_db.h"
#include "signweave/motion_db/packet.h"

namespace signweave::motion_db {

namespace {

constexpr std::uint8_t kVersion = 1;
constexpr std::uint8_t kCompactVersion = 2;  ///< has a tolerance

constexpr std::int64_t kMostFramesStored = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostTracks = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint64_t kLargestValue = std::numeric_limits<std::uint32_t>::max();  // of LMDB

/// Four values of this many bytes fit on a page, each with its key of 16 bytes and 10 bytes of LMDB's own.
constexpr std::size_t kQuarterPage = (kPageSize - kPageLoss) / 4 - 16 - 10;

/// The largest number of frames of `frame_bytes` that fit in a value of this many bytes.
std::uint32_t frames_in(std::size_t value_bytes, std::size_t frame_bytes) {
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, (value_bytes - kHeaderSize) / frame_bytes));
}

/// The default p.
///
/// By frame: as many frames as fit in eight pages, 38 frames of 53 joints. A sign, half a second to two seconds, is
/// then in a few packets. Measured (bench/store): packets of two to eight pages read equally fast; larger ones are
/// slower, because more is fetched in vain at both ends, and smaller ones need more lookups, and more commits to write.
///
/// By joint and frame: as many frames as fit in a quarter of a page, 60 (0.6 s at 100 Hz). Reading one hand in one sign
/// then fetches no more than twice the requested bytes, for signs of at least 0.6 s; a whole page would hold 253 frames
/// and be read mostly in vain. More packets per page would need more lookups.
std::uint32_t default_frames_per_packet(AccessMode::Kind kind, const Skeleton& skeleton) {
  const std::size_t joints = skeleton.joint_count();
  const std::size_t translations = skeleton.translation_count();
  if (kind == AccessMode::Kind::by_frame) {
    return frames_in(8 * kPageSize - kPageLoss, joints * 16 + translations * 12);
  }
  return frames_in(kQuarterPage, 2 * translations > joints ? 16 + 12 : 16);
}

/// The default p of compact packets: as many whole runs as fill about as much space as plain packets, at the sizes that
/// signing needs at 0.1 mm with some margin: 2.25 bytes per joint in packets of all joints, 4 in packets of one.
std::uint32_t default_compact_frames(AccessMode::Kind kind, const Skeleton& skeleton) {
  const std::size_t joints = skeleton.joint_count();
  const std::size_t translations = skeleton.translation_count();
  const std::uint32_t frames = kind == AccessMode::Kind::by_frame
                                   ? frames_in(8 * kPageSize - kPageLoss, joints * 9 / 4 + 1 + translations * 6)
                                   : frames_in(kQuarterPage, 2 * translations > joints ? 8 : 4);
  constexpr auto kRun = static_cast<std::uint32_t>(kRunFrames);
  return std::max(kRun, frames / kRun * kRun);
}

}  // namespace

void check_packet_size(const StoredMotion& stored) {
  const auto frames = static_cast<std::uint64_t>(std::min(packet_frames(stored), stored.frames));
  const std::uint64_t frame_bytes = cut_by_joint(stored.mode)
                                        ? (stored.translations > 0 ? 28 : 16)
                                        : std::uint64_t{stored.joints} * 16 + std::uint64_t{stored.translations} * 12;
  // The overhead of a compact packet is smaller than its numbers.
  const std::uint64_t bytes = kHeaderSize + frames * frame_bytes * (stored.tolerance > 0 ? 2 : 1);
  if (bytes <= kLargestValue) return;
  throw Error(ErrorCode::unsupported, "motion: a packet of " + to_string(stored.mode) + " would have " +
                                          std::to_string(bytes >> 20) +
                                          " MiB, more than the limit of 4095; store it by_frame or by_joint_and_frame");
}

AccessMode fitted(AccessMode mode, const Skeleton& skeleton, float tolerance) {
  const bool by_frame = mode.kind == AccessMode::Kind::by_frame || mode.kind == AccessMode::Kind::by_joint_and_frame;
  if (!by_frame) {
    mode.frames_per_packet = 0;
  } else if (mode.frames_per_packet == 0) {
    mode.frames_per_packet =
        tolerance > 0 ? default_compact_frames(mode.kind, skeleton) : default_frames_per_packet(mode.kind, skeleton);
  }
  return mode;
}

StoredMotion describe(const Motion& motion, AccessMode mode, std::uint64_t generation, float tolerance) {
  const auto refuse = [](ErrorCode code, const std::string& what) { throw Error(code, "motion: " + what); };
  const Skeleton& skeleton = motion.skeleton();
  if (motion.frame_count() < 1) refuse(ErrorCode::bad_input, "it has no frames; store one that has some");
  if (skeleton.joint_count() < 1) refuse(ErrorCode::bad_input, "its skeleton has no joints; store one that has some");
  if (motion.frame_count() > kMostFramesStored) refuse(ErrorCode::unsupported, "more than 2^32 - 1 frames; cut it");
  if (motion.tracks().size() > kMostTracks) refuse(ErrorCode::unsupported, "more than 65535 scalar tracks; drop some");
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) refuse(ErrorCode::bad_input, "a tolerance must be 0 or a length");
  StoredMotion stored{.generation = generation,
                      .mode = fitted(mode, skeleton, tolerance),
                      .rate = motion.rate(),
                      .frames = motion.frame_count(),
                      .joints = static_cast<std::uint32_t>(skeleton.joint_count()),
                      .translations = static_cast<std::uint32_t>(skeleton.translation_count()),
                      .tracks = {},
                      .tolerance = tolerance};
  for (const ScalarTrack& track : motion.tracks()) stored.tracks.push_back(track.name);
  check_packet_size(stored);
  return stored;
}

std::uint64_t packet_count(const StoredMotion& stored) noexcept {
  const std::int64_t p = packet_frames(stored);
  const auto blocks = static_cast<std::uint64_t>((stored.frames + p - 1) / p);
  return cut_by_joint(stored.mode) ? blocks * stored.joints : blocks;
}

// u8 version, u64 generation, u8 kind of access mode, u32 p, i64 numerator and i64 denominator of the rate, i64 frames,
// u32 joints, u32 translations, u32 tracks, each a text; in version 2 f32 tolerance, above 0.
void encode(const StoredMotion& stored, ByteWriter& out) {
  out.number(stored.tolerance > 0 ? kCompactVersion : kVersion);
  out.number(stored.generation);
  out.number(stored.mode.kind);
  out.number(stored.mode.frames_per_packet);
  out.number(stored.rate.numerator);
  out.number(stored.rate.denominator);
  out.number(stored.frames);
  out.number(stored.joints);
  out.number(stored.translations);
  out.number(static_cast<std::uint32_t>(stored.tracks.size()));
  for (const std::string& track : stored.tracks) out.text(track);
  if (stored.tolerance > 0) out.number(stored.tolerance);
}

StoredMotion decode(ByteReader& in) {
  const auto version = in.number<std::uint8_t>();
  if (version != kVersion && version != kCompactVersion) {
    throw Error(ErrorCode::unsupported, "stored motion: layout version " + std::to_string(version) +
                                            ", this program knows versions 1 and 2; use a newer signweave");
  }
  StoredMotion stored;
  stored.generation = in.number<std::uint64_t>();
  stored.mode.kind = in.number<AccessMode::Kind>();
  stored.mode.frames_per_packet = in.number<std::uint32_t>();
  stored.rate.numerator = in.number<std::int64_t>();
  stored.rate.denominator = in.number<std::int64_t>();
  stored.frames = in.number<std::int64_t>();
  stored.joints = in.number<std::uint32_t>();
  stored.translations = in.number<std::uint32_t>();
  stored.tracks.resize(in.count(4));
  for (std::string& track : stored.tracks) track = in.text();
  if (version == kCompactVersion) {
    stored.tolerance = in.number<float>();
    if (!(stored.tolerance > 0) || !std::isfinite(stored.tolerance)) in.fail("a tolerance that is not a length");
  }

  const bool by_frame =
      stored.mode.kind == AccessMode::Kind::by_frame || stored.mode.kind == AccessMode::Kind::by_joint_and_frame;
  if (stored.mode.kind > AccessMode::Kind::by_joint_and_frame) in.fail("an access mode that does not exist");
  if (by_frame != (stored.mode.frames_per_packet > 0)) in.fail("frames per packet that do not fit the access mode");
  if (stored.rate.numerator < 1 || stored.rate.denominator < 1) in.fail("an invalid frame rate");
  if (stored.frames < 1 || stored.frames > kMostFramesStored) in.fail("an impossible number of frames");
  if (stored.joints < 1 || stored.joints > 65'535) in.fail("an impossible number of joints");
  if (stored.translations > stored.joints) in.fail("more translations than joints");
  if (stored.tracks.size() > kMostTracks) in.fail("too many tracks");
  return stored;
}

}  // namespace signweave::motion_db
