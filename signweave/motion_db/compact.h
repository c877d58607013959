#pragma once

#include "signweave/motion_db/packet.h"

/// Inside this module only: the payload of compact packets (docs/store.md). Packing loses nothing, whatever the motion;
/// it is small where the numbers lie on the grids that `quantise` puts them on.
namespace signweave::motion_db {

/// The payload of a packet: all joints over some frames, or one joint.
Bytes pack(const Motion& motion, const Record& packet);

/// No payload of such a packet is smaller.
std::size_t smallest_payload(const Record& packet, Width width) noexcept;

/// What is wrong with the payload of a packet, or null. A payload without fault can be unpacked: whatever else its
/// bytes say, nothing outside of it is read.
const char* compact_fault(ByteSpan payload, const Record& packet, Width width);

/// Unpacks the frames that a payload without fault shares with `asked`, into poses of `asked`, of the joints in the
/// packet (of `joints` among them; empty: all).
void unpack(ByteSpan payload, const Record& packet, const Skeleton& skeleton, FrameRange asked, const JointSet& joints,
            MutablePoses out);

}  // namespace signweave::motion_db
