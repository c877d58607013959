#pragma once

#include <cstddef>
#include <span>

#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/packet.h"

/// Internal to this module: copies the numbers of records that were found and verified to their destination.
namespace signweave::motion_db {

/// A record that a read needs. Its value lies in the buffer that it was read with, or in the snapshot.
struct Found {
  Record record;
  RecordLayout layout;
  ByteSpan value;
};

/// The number of packets of one block that are held at once, each with its own buffer: eight joints of a frame are
/// adjacent and fill two cache lines, which would be fetched repeatedly if the joints were written one by one.
inline constexpr std::size_t kTogether = 8;

/// Copies the requested frames and joints (empty: all) from up to kTogether packets of one block. `out` holds all the
/// requested frames.
void copy_group(std::span<const Found> group, const Skeleton& skeleton, const JointSet& joints, FrameRange requested,
                MutablePoses out);

/// Copies the requested frames from a record of scalar tracks to one span per track; tracks with an empty span are
/// skipped.
void copy_values(const Found& found, FrameRange requested, std::span<const std::span<float>> out);

}  // namespace signweave::motion_db
