#pragma once

#include <cstddef>
#include <span>

#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/packet.h"

/// Inside this module only: the numbers of records that were found and verified, copied to where they are wanted.
namespace signweave::motion_db {

/// A record that a read needs: its value lies in the buffer that it was read with, or in the snapshot.
struct Found {
  Record record;
  Layout layout;
  ByteSpan value;
};

/// Packets of one block that are held at once, each with a buffer of its own: eight joints of a frame are written side
/// by side, two cache lines, where one by one each would fetch its line again.
inline constexpr std::size_t kTogether = 8;

/// Copies what packets of one block, up to kTogether of them, hold of the frames and joints (empty: all) that are asked
/// for. `out` is for all the frames asked for.
void copy_group(std::span<const Found> group, const Skeleton& skeleton, const JointSet& joints, FrameRange asked,
                MutablePoses out);

/// Copies what a record of scalar tracks holds of the frames that are asked for, to a span for each track; tracks whose
/// span is empty are left out.
void copy_values(const Found& found, FrameRange asked, std::span<const std::span<float>> out);

}  // namespace signweave::motion_db
