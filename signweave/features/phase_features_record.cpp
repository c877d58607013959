#include <cmath>

#include "signweave/features/from_source.h"
#include "signweave/features/phase_features.h"

// A record of features, before it is sealed:
//
//     u16  kFeatureVersion
//     text reason why nothing was measured (empty: it was)
//     f32  shoulder width, metres
//     u32  phases, then for each:
//       f32 seconds
//       u8  bits: 1 anything known, 2 left hand known, 4 right hand known
//       only if anything is known:
//         f32 × 2 distance between the hands at begin and end
//         f32 × 3 lean, f32 twist of the trunk at begin, the same at end
//       for each hand that is known, left first:
//         begin and end, each: f32 × 3 position, velocity, acceleration, palm, fingers, elbow;
//                              f32 curvature, openness; f32 × 15 handshape;
//                              u8 height, across, reach, contact
//         f32 path, displacement, mean speed, peak speed, peak time, mean acceleration, mean curvature
//         f32 × 16 profile
//     u32 joints, f32 noise of each, radians; u32 translated joints, f32 noise of each, metres (not in version 2)

namespace signweave {
namespace {

// A single list of members is used for writing, reading and comparing.
template <typename Hand, typename Number, typename Small>
void each_of_end(Hand& at, Number number, Small small) {
  for (auto* vector : {&at.position, &at.velocity, &at.acceleration, &at.palm, &at.fingers, &at.elbow}) {
    for (int axis = 0; axis < 3; ++axis) number((*vector)[axis]);
  }
  number(at.curvature);
  number(at.openness);
  for (auto& value : at.handshape.values) number(value);
  small(at.zone.height, Height::above_head);
  small(at.zone.across, Across::right);
  small(at.zone.reach, Reach::far);
  small(at.contact, Contact::hands | Contact::head | Contact::torso);
}

template <typename Phase, typename Number>
void each_of_trunk(Phase& phase, Number number) {
  for (auto* trunk : {&phase.trunk_begin, &phase.trunk_end}) {
    for (int axis = 0; axis < 3; ++axis) number(trunk->lean[axis]);
    number(trunk->twist);
  }
}

template <typename Hand, typename Number, typename Small>
void each_of(Hand& hand, Number number, Small small) {
  each_of_end(hand.begin, number, small);
  each_of_end(hand.end, number, small);
  for (auto* value : {&hand.path_length, &hand.displacement, &hand.mean_speed, &hand.peak_speed, &hand.peak_time,
                      &hand.mean_acceleration, &hand.mean_curvature}) {
    number(*value);
  }
  for (auto& value : hand.profile) number(value);
}

constexpr std::size_t kSmallestPhase = sizeof(float) + 1;

std::uint8_t bits_of(const PhaseFeatures& phase) {
  return static_cast<std::uint8_t>((phase.known ? 1 : 0) | (phase.hands[0].known ? 2 : 0) |
                                   (phase.hands[1].known ? 4 : 0));
}

}  // namespace

void encode(const RecordingFeatures& features, ByteWriter& out) {
  out.number(kFeatureVersion);
  out.text(features.why_not);
  out.number(features.shoulder_width);
  out.number(static_cast<std::uint32_t>(features.phases.size()));
  for (const PhaseFeatures& phase : features.phases) {
    out.number(phase.seconds);
    out.number(bits_of(phase));
    if (!phase.known) continue;
    out.number(phase.hands_distance_begin);
    out.number(phase.hands_distance_end);
    each_of_trunk(phase, [&](float value) { out.number(value); });
    for (const HandOver& hand : phase.hands) {
      if (!hand.known) continue;
      each_of(
          hand, [&](float value) { out.number(value); }, [&](auto value, auto) { out.number(value); });
    }
  }
  for (const std::vector<float>* noise : {&features.noise.rotations, &features.noise.translations}) {
    out.number(static_cast<std::uint32_t>(noise->size()));
    for (const float one : *noise) out.number(one);
  }
}

std::optional<RecordingFeatures> decode_features(ByteReader& in) {
  return decode_features(in, {});
}

std::optional<RecordingFeatures> decode_features(ByteReader& in, const Pause& pause) {
  const auto version = in.number<std::uint16_t>();
  if (version != kFeatureVersion && version != kFeaturesWithoutNoise) return std::nullopt;
  RecordingFeatures features;
  features.why_not = in.text();
  const auto number = [&](float& value) {
    value = in.number<float>();
    if (!std::isfinite(value)) in.fail("a feature is not finite");
  };
  const auto small = [&](auto& value, auto largest) {
    value = in.number<std::remove_reference_t<decltype(value)>>();
    if (value > largest) in.fail("a feature has an unknown value");
  };
  number(features.shoulder_width);
  features.phases.resize(in.count(kSmallestPhase));
  std::size_t count = 0;
  for (PhaseFeatures& phase : features.phases) {
    if (pause && (count++ & 0xFFU) == 0) pause();
    number(phase.seconds);
    const auto bits = in.number<std::uint8_t>();
    if (bits != 0 && bits != 3 && bits != 5 && bits != 7) in.fail("the flags of a phase are inconsistent");
    phase.known = (bits & 1) != 0;
    if (!phase.known) continue;
    number(phase.hands_distance_begin);
    number(phase.hands_distance_end);
    each_of_trunk(phase, number);
    for (std::size_t side = 0; side < 2; ++side) {
      HandOver& hand = phase.hands[side];
      hand.known = (bits & (side == 0 ? 2 : 4)) != 0;
      if (hand.known) each_of(hand, number, small);
    }
  }
  for (std::vector<float>* noise : {&features.noise.rotations, &features.noise.translations}) {
    if (version == kFeaturesWithoutNoise) break;
    noise->resize(in.count(sizeof(float)));
    for (float& one : *noise) {
      number(one);
      if (one < 0) in.fail("a noise value is negative");
    }
  }
  in.finish();
  return features;
}

bool finite(const PhaseFeatures& phase) noexcept {
  bool all = std::isfinite(phase.hands_distance_begin) && std::isfinite(phase.hands_distance_end);
  each_of_trunk(phase, [&](float value) { all = all && std::isfinite(value); });
  for (const HandOver& hand : phase.hands) {
    each_of(
        hand, [&](float value) { all = all && std::isfinite(value); }, [](auto, auto) {});
  }
  return all;
}

bool nearly_same(const PhaseFeatures& a, const PhaseFeatures& b) noexcept {
  constexpr float kRounding = 1e-3f;
  if (bits_of(a) != bits_of(b)) return false;
  // The same values in the same order, so that both lists can be compared.
  std::array<float, 160> numbers{};
  const auto same = [&](const HandOver& first, const HandOver& second) {
    std::size_t count = 0;
    each_of(
        first, [&](float value) { numbers[count++] = value; },
        [&](auto value, auto) { numbers[count++] = static_cast<float>(value); });
    bool all = true;
    count = 0;
    each_of(
        second,
        [&](float value) {
          const float other = numbers[count++];
          all = all && std::abs(value - other) <= kRounding * (1 + std::abs(other));
        },
        [&](auto value, auto) { all = all && numbers[count++] == static_cast<float>(value); });
    return all;
  };
  std::array<float, 8> trunk{};
  std::size_t count = 0;
  each_of_trunk(a, [&](float value) { trunk[count++] = value; });
  bool same_trunk = true;
  count = 0;
  each_of_trunk(b, [&](float value) { same_trunk = same_trunk && std::abs(value - trunk[count++]) <= kRounding; });
  return same_trunk && std::abs(a.seconds - b.seconds) <= kRounding && same(a.hands[0], b.hands[0]) &&
         same(a.hands[1], b.hands[1]) && std::abs(a.hands_distance_begin - b.hands_distance_begin) <= kRounding &&
         std::abs(a.hands_distance_end - b.hands_distance_end) <= kRounding;
}

}  // namespace signweave
