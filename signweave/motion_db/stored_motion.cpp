#include <algorithm>
#include <limits>

#include "signweave/motion_db/motion_db.h"
#include "signweave/motion_db/packet.h"

namespace signweave::motion_db {

namespace {

constexpr std::uint8_t kVersion = 1;

constexpr std::int64_t kMostFrames = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostTracks = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint64_t kLargestValue = std::numeric_limits<std::uint32_t>::max();  // of LMDB

/// The most frames of `frame_bytes` that a value of `pages` pages takes.
std::uint32_t frames_in(std::size_t pages, std::size_t frame_bytes) {
  return static_cast<std::uint32_t>(
      std::max<std::size_t>(1, (pages * kPageSize - kPageLoss - kHeaderSize) / frame_bytes));
}

/// The default p.
///
/// By frame: as many frames as eight pages hold, 38 of 53 joints. A sign, half a second to two, then lies in a few
/// packets, and what is read in vain at both ends is less than what is wanted; larger packets make that worse, and
/// smaller ones cost more lookups than they save.
///
/// By joint and frame: as many as one page holds, 253 (4 s at 60 Hz), two pages and 290 where most joints are
/// translated: the smallest value that wastes no page, because this mode is for few joints over a short time.
std::uint32_t default_frames_per_packet(AccessMode::Kind kind, const Skeleton& skeleton) {
  const std::size_t joints = skeleton.joint_count();
  const std::size_t translations = skeleton.translation_count();
  if (kind == AccessMode::Kind::by_frame) return frames_in(8, joints * 16 + translations * 12);
  return 2 * translations > joints ? frames_in(2, 16 + 12) : frames_in(1, 16);
}

}  // namespace

void check_packet_size(const StoredMotion& stored) {
  const auto frames = static_cast<std::uint64_t>(std::min(packet_frames(stored), stored.frames));
  const std::uint64_t frame_bytes = cut_by_joint(stored.mode)
                                        ? (stored.translations > 0 ? 28 : 16)
                                        : std::uint64_t{stored.joints} * 16 + std::uint64_t{stored.translations} * 12;
  const std::uint64_t bytes = kHeaderSize + frames * frame_bytes;
  if (bytes <= kLargestValue) return;
  throw Error(ErrorCode::unsupported, "motion: a packet of " + to_string(stored.mode) + " would have " +
                                          std::to_string(bytes >> 20) +
                                          " MiB and 4095 is the most; store it by_frame or by_joint_and_frame");
}

StoredMotion describe(const Motion& motion, AccessMode mode, std::uint64_t generation) {
  const auto refuse = [](ErrorCode code, const std::string& what) { throw Error(code, "motion: " + what); };
  const Skeleton& skeleton = motion.skeleton();
  if (motion.frame_count() < 1) refuse(ErrorCode::bad_input, "it has no frames; store one that has");
  if (skeleton.joint_count() < 1) refuse(ErrorCode::bad_input, "its skeleton has no joints; store one that has");
  if (motion.frame_count() > kMostFrames) refuse(ErrorCode::unsupported, "more than 2^32 - 1 frames; cut it");
  if (motion.tracks().size() > kMostTracks) refuse(ErrorCode::unsupported, "more than 65535 scalar tracks; drop some");
  const bool by_frame = mode.kind == AccessMode::Kind::by_frame || mode.kind == AccessMode::Kind::by_joint_and_frame;
  if (!by_frame) {
    mode.frames_per_packet = 0;
  } else if (mode.frames_per_packet == 0) {
    mode.frames_per_packet = default_frames_per_packet(mode.kind, skeleton);
  }
  StoredMotion stored{.generation = generation,
                      .mode = mode,
                      .rate = motion.rate(),
                      .frames = motion.frame_count(),
                      .joints = static_cast<std::uint32_t>(skeleton.joint_count()),
                      .translations = static_cast<std::uint32_t>(skeleton.translation_count()),
                      .tracks = {}};
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
// u32 joints, u32 translations, u32 tracks, each a text.
void encode(const StoredMotion& stored, ByteWriter& out) {
  out.number(kVersion);
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
}

StoredMotion decode(ByteReader& in) {
  const auto version = in.number<std::uint8_t>();
  if (version != kVersion) {
    throw Error(ErrorCode::unsupported, "stored motion: layout version " + std::to_string(version) +
                                            ", this program knows version 1; use a newer signweave");
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

  const bool by_frame =
      stored.mode.kind == AccessMode::Kind::by_frame || stored.mode.kind == AccessMode::Kind::by_joint_and_frame;
  if (stored.mode.kind > AccessMode::Kind::by_joint_and_frame) in.fail("an access mode that does not exist");
  if (by_frame != (stored.mode.frames_per_packet > 0)) in.fail("frames per packet that do not fit the access mode");
  if (stored.rate.numerator < 1 || stored.rate.denominator < 1) in.fail("no frame rate");
  if (stored.frames < 1 || stored.frames > kMostFrames) in.fail("an impossible number of frames");
  if (stored.joints < 1 || stored.joints > 65'535) in.fail("an impossible number of joints");
  if (stored.translations > stored.joints) in.fail("more translations than joints");
  if (stored.tracks.size() > kMostTracks) in.fail("too many tracks");
  return stored;
}

}  // namespace signweave::motion_db
