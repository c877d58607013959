#include "signweave/formats/fbx/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "signweave/core/text.h"

namespace signweave::fbx {
namespace {

/// 54 hours: up to here a time in ticks is exact as a double.
constexpr std::int64_t kMostTicks = std::int64_t{1} << 53;

// Bits of KeyAttrFlags.
constexpr std::int64_t kConstant = 0x2;
constexpr std::int64_t kCubic = 0x8;
constexpr std::int64_t kConstantNext = 0x100;
constexpr std::int64_t kTensionContinuityBias = 0x200;
constexpr std::int64_t kWeighted = 0x0100'0000;
constexpr std::int64_t kNextWeighted = 0x0200'0000;

/// The interpolation after a key, as given by KeyAttrFlags and four numbers of KeyAttrDataFloat.
KeyPart part_of(const Source& source, const Record& record, std::int64_t flags, const std::uint32_t* data) {
  KeyPart part;
  if ((flags & kConstant) != 0) {
    part.shape = (flags & kConstantNext) != 0 ? KeyPart::Shape::constant_next : KeyPart::Shape::constant;
  }
  if ((flags & kCubic) == 0) return part;
  if ((flags & kTensionContinuityBias) != 0) {
    source.fail(record.place,
                "keys with tension, continuity and bias (TCB) are not read; bake the animation, a key a frame");
  }
  part.shape = KeyPart::Shape::cubic;
  if (data == nullptr) return part;
  part.slope = std::bit_cast<float>(data[0]);
  part.next_slope = std::bit_cast<float>(data[1]);
  if (!(std::abs(part.slope) <= 1e12f) || !(std::abs(part.next_slope) <= 1e12f)) {
    source.fail(record.place, fmt::format("KeyAttrDataFloat holds a slope of {} and {}; export it again", part.slope,
                                          part.next_slope));
  }
  // Weights are in ten-thousandths, two packed into one number.
  if ((flags & kWeighted) != 0) part.weight = static_cast<float>(data[2] & 0xFFFF) / 9999.0f;
  if ((flags & kNextWeighted) != 0) part.next_weight = static_cast<float>(data[2] >> 16) / 9999.0f;
  return part;
}

/// Reads the interpolation between the keys: each row of flags and data applies to a number of successive keys.
std::vector<KeyPart> parts_of(const Source& source, const Record& record, std::size_t keys, Arrays& arrays) {
  const Record* flags_record = record.child("KeyAttrFlags");
  const Record* counts_record = record.child("KeyAttrRefCount");
  const Record* data_record = record.child("KeyAttrDataFloat");
  if (flags_record == nullptr || counts_record == nullptr) return {};
  const std::vector<std::int64_t> flags = arrays.wholes(*flags_record);
  const std::vector<std::int64_t> counts = arrays.wholes(*counts_record);
  const std::vector<std::uint32_t> data =
      data_record == nullptr ? std::vector<std::uint32_t>() : arrays.attributes(*data_record);
  if (counts.size() != flags.size() || (!data.empty() && data.size() != 4 * flags.size())) {
    source.fail(flags_record->place,
                fmt::format("{} KeyAttrFlags, {} KeyAttrRefCount and {} KeyAttrDataFloat do not go "
                            "together; export it again",
                            flags.size(), counts.size(), data.size()));
  }
  std::vector<KeyPart> parts;
  for (std::size_t i = 0; i < flags.size() && parts.size() < keys; ++i) {
    const KeyPart part = part_of(source, *flags_record, flags[i], data.empty() ? nullptr : &data[4 * i]);
    const std::size_t left = keys - parts.size();
    const std::size_t count = counts[i] < 0 ? 0 : std::min(left, static_cast<std::size_t>(counts[i]));
    parts.insert(parts.end(), count, part);
  }
  if (parts.size() != keys) {
    source.fail(counts_record->place,
                fmt::format("KeyAttrRefCount covers {} keys of {}; export it again", parts.size(), keys));
  }
  return parts;
}

Curve read_curve(const Source& source, const Record& record, Arrays& arrays) {
  const Record* times = record.child("KeyTime");
  const Record* values = record.child("KeyValueFloat");
  if (times == nullptr || values == nullptr) {
    source.fail(record.place, "an AnimationCurve without KeyTime or KeyValueFloat; export it again");
  }
  Curve curve{.ticks = arrays.wholes(*times), .values = arrays.reals(*values), .parts = {}};
  if (curve.ticks.empty() || curve.ticks.size() != curve.values.size()) {
    source.fail(record.place, fmt::format("an AnimationCurve of {} times and {} values; export it again",
                                          curve.ticks.size(), curve.values.size()));
  }
  for (std::size_t i = 0; i < curve.ticks.size(); ++i) {
    if (curve.ticks[i] < -kMostTicks || curve.ticks[i] > kMostTicks) {
      source.fail(times->place, "a key more than 54 hours from the beginning; export it again");
    }
    if (i > 0 && curve.ticks[i] <= curve.ticks[i - 1]) {
      source.fail(times->place, fmt::format("key {} is not after the key before; export it again", i + 1));
    }
  }
  curve.parts = parts_of(source, record, curve.ticks.size(), arrays);
  return curve;
}

}  // namespace

Curves read_curves(const Source& source, const std::vector<const Record*>& records) {
  Arrays arrays(source);
  Curves curves;
  for (const Record* record : records) {
    const auto [at, fresh] = curves.try_emplace(record);
    if (fresh) at->second = read_curve(source, *record, arrays);
  }
  return curves;
}

}  // namespace signweave::fbx
