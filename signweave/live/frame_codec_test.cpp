#include "signweave/live/frame_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "signweave/core/error.h"

namespace signweave {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

struct OwnedFrame {
  Pose pose;
  std::vector<float> tracks;

  explicit OwnedFrame(const FrameShape& shape) : tracks(shape.tracks) {
    pose.rotations.resize(shape.joints, Eigen::Quaternionf::Identity());
    pose.translations.resize(shape.translations, Eigen::Vector3f::Zero());
  }
  FrameShape shape() const { return {pose.rotations.size(), pose.translations.size(), tracks.size()}; }
  FrameView view() const { return {pose.view(), tracks}; }
};

std::vector<std::byte> bytes_of_frame(const OwnedFrame& frame) {
  // One extra byte on either side: a frame need not be aligned, and nothing is written outside it.
  std::vector<std::byte> bytes(bytes_of(frame.shape()) + 2, std::byte{0xaa});
  encode(frame.view(), std::span(bytes).subspan(1, bytes.size() - 2));
  EXPECT_EQ(bytes.front(), std::byte{0xaa});
  EXPECT_EQ(bytes.back(), std::byte{0xaa});
  return {bytes.begin() + 1, bytes.end() - 1};
}

OwnedFrame there_and_back(const OwnedFrame& frame) {
  OwnedFrame back(frame.shape());
  decode(bytes_of_frame(frame), {back.pose.view(), back.tracks});
  return back;
}

/// The angle in radians, accurate for small angles.
double angle_between(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  const Eigen::Quaterniond from = a.cast<double>().normalized();
  const Eigen::Quaterniond to = b.cast<double>().normalized();
  return 2 * std::atan2((from.conjugate() * to).vec().norm(), std::abs(from.dot(to)));
}

/// An arbitrary unit quaternion, including ones with zeros.
Eigen::Quaternionf any_rotation() {
  const auto number = rc::gen::map(rc::gen::inRange(-1000, 1001), [](int n) { return static_cast<float>(n) / 1000; });
  Eigen::Vector4f numbers(*number, *number, *number, *number);
  if (numbers.norm() < 1e-3f) numbers = Eigen::Vector4f(0, 0, 0, 1);
  return Eigen::Quaternionf(numbers.normalized());
}

/// Any bits of a float.
float any_float() {
  return std::bit_cast<float>(*rc::gen::arbitrary<std::uint32_t>());
}

template <typename T>
T number_at(const std::vector<std::byte>& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string hex(std::span<const std::byte> bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kDigits[std::to_integer<unsigned>(byte) / 16];
    text += kDigits[std::to_integer<unsigned>(byte) % 16];
  }
  return text;
}

TEST(FrameCodec, MatchesTheExampleInTheHeader) {
  OwnedFrame frame({.joints = 1, .translations = 1, .tracks = 1});
  frame.pose.translations[0] = {1.0f, -0.5f, 2.00001f};
  frame.tracks[0] = 0.25f;
  frame.pose.rotations[0] = Eigen::Quaternionf(std::sqrt(0.5f), 0, std::sqrt(0.5f), 0);
  std::vector<std::byte> message(kMessageHeaderBytes + bytes_of(frame.shape()));
  const MessageHeader header{.frames = 1, .left_out = 3, .first_frame = 258};
  encode(header, message);
  encode(frame.view(), std::span(message).subspan(kMessageHeaderBytes));
  EXPECT_EQ(hex(message),
            "01 00 01 00 03 00 00 00 02 01 00 00 00 00 00 00 "
            "a0 86 01 00 b0 3c ff ff 41 0d 03 00 00 00 80 3e 00 00 82 5a 00 00 82 5a");
  EXPECT_EQ(decode_header(message, frame.shape()), header);
}

RC_GTEST_PROP(FrameCodec, FramesComeBackWithinTheBound, ()) {
  OwnedFrame frame({.joints = *rc::gen::inRange<std::size_t>(0, 70),
                    .translations = *rc::gen::inRange<std::size_t>(0, 5),
                    .tracks = *rc::gen::inRange<std::size_t>(0, 5)});
  for (Eigen::Quaternionf& q : frame.pose.rotations) q = any_rotation();
  for (Eigen::Vector3f& t : frame.pose.translations) {
    for (int i = 0; i < 3; ++i) t[i] = static_cast<float>(*rc::gen::inRange(-160'000'000, 160'000'000)) * 1e-6f;
  }
  for (float& value : frame.tracks) value = any_float();

  const OwnedFrame back = there_and_back(frame);
  for (std::size_t i = 0; i < frame.pose.rotations.size(); ++i) {
    RC_ASSERT(angle_between(frame.pose.rotations[i], back.pose.rotations[i]) <= kRotationError);
    RC_ASSERT(std::abs(back.pose.rotations[i].norm() - 1) < 1e-6f);
    RC_ASSERT(frame.pose.rotations[i].dot(back.pose.rotations[i]) > 0);  // its sign is preserved too
  }
  for (std::size_t i = 0; i < frame.pose.translations.size(); ++i) {
    const Eigen::Vector3d off = frame.pose.translations[i].cast<double>() - back.pose.translations[i].cast<double>();
    RC_ASSERT(off.cwiseAbs().maxCoeff() <= kTranslationError);
  }
  for (std::size_t i = 0; i < frame.tracks.size(); ++i) {
    RC_ASSERT(std::bit_cast<std::uint32_t>(frame.tracks[i]) == std::bit_cast<std::uint32_t>(back.tracks[i]));
  }
}

// The vectorized loop gives the same results as the standard library's rounding of single values.
RC_GTEST_PROP(FrameCodec, AnyNumbersAreRoundedAndClamped, ()) {
  OwnedFrame frame({.joints = *rc::gen::inRange<std::size_t>(0, 9), .translations = 2, .tracks = 0});
  for (Eigen::Quaternionf& q : frame.pose.rotations) q.coeffs() << any_float(), any_float(), any_float(), any_float();
  for (Eigen::Vector3f& t : frame.pose.translations) t << any_float(), any_float(), any_float();

  const std::vector<std::byte> bytes = bytes_of_frame(frame);
  const auto expected = [](double value, double most) {
    return std::isnan(value) ? 0.0 : std::clamp(std::nearbyint(value), -most, most);
  };
  std::size_t at = 0;
  for (const Eigen::Vector3f& t : frame.pose.translations) {
    for (int i = 0; i < 3; ++i, at += 4) {
      RC_ASSERT(number_at<std::int32_t>(bytes, at) == expected(static_cast<double>(t[i]) * 1e5, 2147483647));
    }
  }
  for (const Eigen::Quaternionf& q : frame.pose.rotations) {
    for (int i = 0; i < 4; ++i, at += 2) {
      const float units = q.coeffs()[i] * 32767.0f;
      RC_ASSERT(number_at<std::int16_t>(bytes, at) == expected(static_cast<double>(units), 32767));
    }
  }
}

TEST(FrameCodec, ExtremesAndNaNAreEncoded) {
  OwnedFrame frame({.joints = 2, .translations = 1, .tracks = 0});
  frame.pose.translations[0] = {kInfinity, -kInfinity, kNoNumber};
  frame.pose.rotations[0].coeffs() << kInfinity, -kInfinity, kNoNumber, -kNoNumber;
  frame.pose.rotations[1].coeffs() << 1.5f, -3e38f, 1e-45f, std::bit_cast<float>(0x7f801234u);  // a signalling NaN
  const std::vector<std::byte> bytes = bytes_of_frame(frame);
  EXPECT_EQ(number_at<std::int32_t>(bytes, 0), 2147483647);
  EXPECT_EQ(number_at<std::int32_t>(bytes, 4), -2147483647);
  EXPECT_EQ(number_at<std::int32_t>(bytes, 8), 0);
  const std::int16_t expected[] = {32767, -32767, 0, 0, 32767, -32767, 0, 0};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(number_at<std::int16_t>(bytes, 12 + 2 * i), expected[i]) << i;
}

TEST(FrameCodec, AZeroQuaternionBecomesIdentity) {
  OwnedFrame frame({.joints = 1, .translations = 0, .tracks = 0});
  frame.pose.rotations[0].coeffs().setZero();
  EXPECT_TRUE(there_and_back(frame).pose.rotations[0].isApprox(Eigen::Quaternionf::Identity()));
}

RC_GTEST_PROP(FrameCodec, AnyBytesDecodeToUnitRotations, ()) {
  const FrameShape shape{.joints = 3, .translations = 1, .tracks = 1};
  const auto bytes =
      *rc::gen::container<std::vector<std::uint8_t>>(bytes_of(shape), rc::gen::arbitrary<std::uint8_t>());
  OwnedFrame frame(shape);
  decode(std::as_bytes(std::span(bytes)), {frame.pose.view(), frame.tracks});
  for (const Eigen::Quaternionf& q : frame.pose.rotations) RC_ASSERT(std::abs(q.norm() - 1) < 1e-5f);
}

RC_GTEST_PROP(FrameCodec, HeadersComeBack, ()) {
  const MessageHeader header{.frames = *rc::gen::inRange<std::uint16_t>(0, 700),
                             .left_out = *rc::gen::arbitrary<std::uint32_t>(),
                             .first_frame = *rc::gen::arbitrary<std::uint64_t>()};
  const FrameShape shape{.joints = 2, .translations = 1, .tracks = 1};
  std::vector<std::byte> message(kMessageHeaderBytes + header.frames * bytes_of(shape));
  encode(header, message);
  RC_ASSERT(decode_header(message, shape) == header);
}

RC_GTEST_PROP(FrameCodec, AMessageOfAnyOtherFormIsRefused, ()) {
  const FrameShape shape{.joints = 2, .translations = 1, .tracks = 0};
  const auto bytes = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  try {
    const MessageHeader header = decode_header(std::as_bytes(std::span(bytes)), shape);
    RC_ASSERT(bytes.size() == kMessageHeaderBytes + header.frames * bytes_of(shape));
    RC_ASSERT(bytes.at(0) == 1);
  } catch (const Error& error) {
    RC_ASSERT(error.code() == ErrorCode::bad_input);
  }
}

TEST(FrameCodec, OtherLayoutsAndSizesAreRejected) {
  const FrameShape shape{.joints = 2, .translations = 1, .tracks = 0};
  std::vector<std::byte> message(kMessageHeaderBytes + 2 * bytes_of(shape));
  encode(MessageHeader{.frames = 2}, message);
  EXPECT_EQ(decode_header(message, shape).frames, 2);
  EXPECT_THROW(decode_header(std::span(message).first(message.size() - 1), shape), Error);
  EXPECT_THROW(decode_header(std::span(message).first(15), shape), Error);
  EXPECT_THROW(decode_header(message, {.joints = 3, .translations = 1, .tracks = 0}), Error);
  message[0] = std::byte{2};
  EXPECT_THROW(decode_header(message, shape), Error);
}

}  // namespace
}  // namespace signweave
