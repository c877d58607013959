// Checks a payload once before it is unpacked: sizes, places and widths in the stored bytes.

#include <vector>

#include "signweave/motion_db/compact.h"
#include "signweave/motion_db/compact_layout.h"

namespace signweave::motion_db {

std::size_t smallest_payload(const Record& packet, Width width) noexcept {
  const Counts counts(packet, width);
  const std::size_t run = kRunHeader + counts.rotation_groups() * counts.rotation_group_bytes(false) +
                          counts.translation_groups() * counts.translation_group_bytes();
  return counts.order_bytes() + Runs(packet.frames).count() * (4 + run) + kPadding;
}

const char* compact_fault(ByteSpan payload, const Record& packet, Width width) {
  const Counts counts(packet, width);
  const Runs runs(packet.frames);
  if (payload.size() < smallest_payload(packet, width)) return "its size is wrong";
  const std::size_t end = payload.size() - kPadding;
  if (!counts.one_joint) {
    std::vector<bool> seen(counts.rotations);
    for (std::size_t place = 0; place < counts.rotations; ++place) {
      const auto joint = loaded<std::uint16_t>(payload.data() + 2 * place);
      if (joint >= counts.rotations || seen[joint]) return "it has a joint twice";
      seen[joint] = true;
    }
  }
  std::size_t at = counts.order_bytes() + 4 * runs.count();
  for (std::int64_t number = runs.first; number < runs.end; ++number) {
    const std::size_t which = counts.order_bytes() + 4 * static_cast<std::size_t>(number - runs.first);
    if (loaded<std::uint32_t>(payload.data() + which) != at) return "a run of frames is not where it should be";
    const auto frames = static_cast<std::size_t>(frames_of_run(number, packet.frames).size());
    // The parts after the header are only pointed at here, and read once they are known to exist.
    if (end - at < kRunHeader) return "its size is wrong";
    const bool wide = loaded<std::uint16_t>(payload.data() + at + 4) != 0;
    const std::size_t raw_rotations = loaded<std::uint16_t>(payload.data() + at + 6);
    const std::size_t raw_translations = loaded<std::uint16_t>(payload.data() + at + 8);
    const std::size_t fixed = kRunHeader + counts.rotation_groups() * counts.rotation_group_bytes(wide) +
                              counts.translation_groups() * counts.translation_group_bytes() +
                              2 * (raw_rotations + raw_translations) +
                              frames * (16 * raw_rotations + 12 * raw_translations);
    if (fixed > end - at) return "its size is wrong";
    const RunView run(payload.data() + at, counts, frames);
    std::uint64_t bits = 0;
    for (std::size_t group = 0; group < counts.rotation_groups(); ++group) {
      bits += RotationGroup(run, counts, group).bits();
    }
    for (std::size_t group = 0; group < counts.translation_groups(); ++group) {
      const NumberGroup numbers(run, counts, group);
      if (numbers.width > 31) return "a number has too many bits";
      bits += numbers.width;
    }
    if (bits != run.row_bits) return "the bits of a row do not match its numbers";
    for (std::size_t i = 0; i < raw_rotations + raw_translations; ++i) {
      const std::size_t most = i >= raw_rotations ? counts.translations : counts.one_joint ? 65'535 : counts.rotations;
      if (loaded<std::uint16_t>(run.raw_places + 2 * i) >= most) return "it has an invalid joint";
    }
    const std::size_t stream = stream_bytes(bits, counts.rows(frames));
    if (stream > end - at - fixed) return "its size is wrong";
    at += fixed + stream;
  }
  return at == end ? nullptr : "its size is wrong";
}

}  // namespace signweave::motion_db
