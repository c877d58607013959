#pragma once

#include "signweave/motion_db/packet.h"

/// Internal to this module: the payload of compact packets (docs/store.md). Packing is lossless for any motion; the
/// result is small if the numbers lie on the grids of `quantise`.
namespace signweave::motion_db {

/// Packs the payload of a packet: all joints over some frames, or one joint.
Bytes pack(const Motion& motion, const Record& packet);

/// The smallest possible size of such a packet's payload.
std::size_t smallest_payload(const Record& packet, Width width) noexcept;

/// Describes what is wrong with the payload of a packet; null if nothing is. Unpacking a payload that passes this check
/// never reads outside of it, whatever else its bytes contain.
const char* compact_fault(ByteSpan payload, const Record& packet, Width width);

/// Unpacks those frames of a checked payload that lie in `requested` into `out`, the poses of `requested`. Unpacks the
/// joints of the packet, or those of them that are in `joints` unless that is empty.
void unpack(ByteSpan payload, const Record& packet, const Skeleton& skeleton, FrameRange requested,
            const JointSet& joints, MutablePoses out);

}  // namespace signweave::motion_db
