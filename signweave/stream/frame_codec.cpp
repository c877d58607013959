#include "signweave/stream/frame_codec.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "signweave/core/error.h"

namespace signweave {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are written as the machine has its numbers");

constexpr float kPerMetre = 100'000.0f;
constexpr float kPerUnit = 32'767.0f;

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
    for (int i = 0; i < 3; ++i) {
      const float units = std::nearbyint(t[i] * kPerMetre);
      put(to, std::isfinite(units) ? static_cast<std::int32_t>(std::clamp(units, -2.1e9f, 2.1e9f)) : 0);
    }
  }
  for (const float value : frame.tracks) put(to, value);
  for (const Eigen::Quaternionf& q : frame.pose.rotations) {
    for (int i = 0; i < 4; ++i) {
      const float units = std::nearbyint(q.coeffs()[i] * kPerUnit);
      put(to,
          std::isfinite(units) ? static_cast<std::int16_t>(std::clamp(units, -kPerUnit, kPerUnit)) : std::int16_t{0});
    }
  }
}

MessageHeader decode_header(std::span<const std::byte> message, const FrameShape& shape) {
  if (message.size() < kMessageHeaderBytes) throw Error(ErrorCode::bad_input, "a message without a header");
  const std::byte* from = message.data();
  if (get<std::uint8_t>(from) != 1) throw Error(ErrorCode::bad_input, "a message of another layout");
  from += 1;
  MessageHeader header;
  header.frames = get<std::uint16_t>(from);
  header.left_out = get<std::uint32_t>(from);
  header.first_frame = get<std::uint64_t>(from);
  if (message.size() != kMessageHeaderBytes + header.frames * bytes_of(shape)) {
    throw Error(ErrorCode::bad_input, "a message that has not the size of its frames");
  }
  return header;
}

void decode(std::span<const std::byte> bytes, MutableFrameView out) noexcept {
  const std::byte* from = bytes.data();
  for (Eigen::Vector3f& t : out.pose.translations) {
    for (int i = 0; i < 3; ++i) t[i] = static_cast<float>(get<std::int32_t>(from)) / kPerMetre;
  }
  for (float& value : out.tracks) value = get<float>(from);
  for (Eigen::Quaternionf& q : out.pose.rotations) {
    for (int i = 0; i < 4; ++i) q.coeffs()[i] = static_cast<float>(get<std::int16_t>(from)) / kPerUnit;
    const float norm = q.norm();
    q = norm > 0 ? Eigen::Quaternionf(q.coeffs() / norm) : Eigen::Quaternionf::Identity();
  }
}

}  // namespace signweave
