#include "signweave/live/frame_codec.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "signweave/core/error.h"

// Rounding without branches or calls, so that the compiler can vectorize the loop over rotations: adding a number of
// moderate size to one so large that its last place has the value 1 rounds the sum to an integer, and the low bits of
// the sum are that integer in two's complement.

namespace signweave {
namespace {

static_assert(std::endian::native == std::endian::little, "messages use the machine's byte order");
static_assert(sizeof(Eigen::Quaternionf) == 4 * sizeof(float), "rotations are stored without padding");

constexpr double kPerMetre = 100'000.0;
constexpr float kPerUnit = 32'767.0f;
constexpr double kMostUnits = 2'147'483'647.0;
constexpr float kRoundsFloats = 12'582'912.0f;              // 1.5 · 2^23, low bits 0
constexpr double kRoundsDoubles = 6'755'399'441'055'744.0;  // 1.5 · 2^52, low bits 0

/// Clamps to [least, most].
template <typename Number>
[[gnu::always_inline]] inline Number within(Number value, Number least, Number most) noexcept {
  const Number kept = value < most ? value : most;
  return kept > least ? kept : least;
}
[[gnu::always_inline]] inline std::uint32_t rotation_units(float value, float least, float most) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(within(value * kPerUnit, least, most) + kRoundsFloats);
  return bits & (value == value ? 0xffffu : 0u);
}
[[gnu::always_inline]] inline std::int32_t translation_units(float metres) noexcept {
  if (metres != metres) return 0;
  const double units = within(static_cast<double>(metres) * kPerMetre, -kMostUnits, kMostUnits);
  return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(units + kRoundsDoubles));
}

// Volatile, because the compiler turns comparisons with known constants into branches.
const volatile float kLeastRotation = -kPerUnit;
const volatile float kMostRotation = kPerUnit;

template <typename T>
void put(std::byte*& to, T value) noexcept {
  std::memcpy(to, &value, sizeof value);
  to += sizeof value;
}
template <typename T>
T get(const std::byte*& from) noexcept {
  T value;
  std::memcpy(&value, from, sizeof value);
  from += sizeof value;
  return value;
}

}  // namespace

void encode(const MessageHeader& header, std::span<std::byte> out) noexcept {
  assert(out.size() >= kMessageHeaderBytes);
  std::byte* to = out.data();
  put<std::uint8_t>(to, 1);
  put<std::uint8_t>(to, 0);
  put(to, header.frames);
  put(to, header.left_out);
  put(to, header.first_frame);
}

void encode(const FrameView& frame, std::span<std::byte> out) noexcept {
  std::byte* to = out.data();
  for (const Eigen::Vector3f& t : frame.pose.translations) {
    for (int i = 0; i < 3; ++i) put(to, translation_units(t[i]));
  }
  if (!frame.tracks.empty()) std::memcpy(to, frame.tracks.data(), frame.tracks.size_bytes());
  to += frame.tracks.size_bytes();
  if (frame.pose.rotations.empty()) return;
  const float* from = frame.pose.rotations.front().coeffs().data();
  const std::size_t pairs = 2 * frame.pose.rotations.size();
  const float least = kLeastRotation;
  const float most = kMostRotation;
  // Two values at a time: whole words need fewer shuffles than halves.
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::uint32_t units = rotation_units(from[2 * i], least, most) | rotation_units(from[2 * i + 1], least, most)
                                                                               << 16;
    std::memcpy(to + i * sizeof units, &units, sizeof units);
  }
}

MessageHeader decode_header(std::span<const std::byte> message, const FrameShape& shape) {
  if (message.size() < kMessageHeaderBytes) throw Error(ErrorCode::bad_input, "the message has no complete header");
  const std::byte* from = message.data();
  if (get<std::uint8_t>(from) != 1) throw Error(ErrorCode::bad_input, "the message has an unknown layout");
  from += 1;
  MessageHeader header;
  header.frames = get<std::uint16_t>(from);
  header.left_out = get<std::uint32_t>(from);
  header.first_frame = get<std::uint64_t>(from);
  if (message.size() != kMessageHeaderBytes + header.frames * bytes_of(shape)) {
    throw Error(ErrorCode::bad_input, "the size of the message does not match its frames");
  }
  return header;
}

void decode(std::span<const std::byte> bytes, MutableFrameView out) noexcept {
  const std::byte* from = bytes.data();
  for (Eigen::Vector3f& t : out.pose.translations) {
    for (int i = 0; i < 3; ++i) t[i] = static_cast<float>(get<std::int32_t>(from) / kPerMetre);
  }
  for (float& value : out.tracks) value = get<float>(from);
  for (Eigen::Quaternionf& q : out.pose.rotations) {
    const auto x = static_cast<float>(get<std::int16_t>(from));
    const auto y = static_cast<float>(get<std::int16_t>(from));
    const auto z = static_cast<float>(get<std::int16_t>(from));
    const auto w = static_cast<float>(get<std::int16_t>(from));
    const float square = x * x + y * y + z * z + w * w;
    const float scale = 1.0f / std::sqrt(square);
    q = square > 0 ? Eigen::Quaternionf(w * scale, x * scale, y * scale, z * scale) : Eigen::Quaternionf::Identity();
  }
}

}  // namespace signweave
