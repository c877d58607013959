#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/core/error.h"
#include "signweave/motion_db/motion_db.h"
#include "signweave/motion_db/packet.h"

using namespace signweave;

namespace {

/// A snapshot of records in memory.
class Records : public kv::ReadTransaction {
 public:
  std::map<Bytes, Bytes> values;

  std::optional<ByteSpan> get(ByteSpan key) const override {
    const auto at = values.find(Bytes(key.begin(), key.end()));
    if (at == values.end()) return std::nullopt;
    return at->second;
  }
  std::optional<ByteSpan> get(ByteSpan key, Bytes&) const override { return get(key); }
};

/// Corrects a damaged record's checksum, so that the code behind the check is tested too.
void seal(Bytes& value) {
  if (value.size() < sizeof(std::uint64_t)) return;
  const std::uint64_t sum = checksum(ByteSpan(value).subspan(sizeof(std::uint64_t)));
  std::memcpy(value.data(), &sum, sizeof sum);
}

constexpr std::int64_t kMostFrames = 1000;

}  // namespace

/// A stored motion of arbitrary bytes is read or rejected with an Error by every reading function. The input is a
/// descriptor, then records: u8 kind, u16 joint, u32 block, u32 size, value.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ByteSpan input(reinterpret_cast<const std::byte*>(data), size);
  try {
    ByteReader in(input, "fuzz");
    const motion_db::StoredMotion stored = motion_db::decode(in);
    auto records = std::make_shared<Records>();
    while (in.left() > 0) {
      motion_db::Record record;
      record.kind = static_cast<motion_db::RecordKind>(in.number<std::uint8_t>());
      record.part = in.number<std::uint16_t>();
      record.block = in.number<std::uint32_t>();
      const std::size_t bytes = in.count(1);
      const ByteSpan value = in.take(bytes);
      Bytes copy(value.begin(), value.end());
      seal(copy);
      const motion_db::Key key = motion_db::key_of(stored.generation, record);
      records->values[Bytes(key.begin(), key.end())] = std::move(copy);
    }
    motion_db::check(*records, stored);
    const auto known = std::make_shared<const motion_db::KnownMotion>(*records, stored);
    const FrameRange frames{0, std::min(stored.frames, kMostFrames)};
    motion_db::read(*records, stored, known->skeleton(), frames);
    motion_db::read(*records, stored, known->skeleton(), frames, {0});
    const motion_db::StoredSource source(records, known);
    std::vector<std::vector<float>> tracks;
    if (static_cast<std::uint64_t>(frames.size()) * stored.tracks.size() <= 100'000) {
      tracks.assign(stored.tracks.size(), std::vector<float>(static_cast<std::size_t>(frames.size())));
      const std::vector<std::span<float>> spans(tracks.begin(), tracks.end());
      source.read_tracks(frames, spans);
    }
    Motion motion;
    if (static_cast<std::uint64_t>(frames.size()) * stored.joints > 100'000) return 0;
    motion.reset(source.skeleton(), source.rate(), frames.size());
    source.read(frames, motion.poses({0, frames.size()}));
  } catch (const Error&) {
  }
  return 0;
}
