#include "signweave/render/place_correction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "signweave/motion/blend.h"
#include "signweave/transition/fade.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;
/// Below both, copying gives the wanted place. Metres, radians.
constexpr float kNoShift = 5e-5f;
constexpr float kNoTurn = 2e-4f;
/// The arm is solved again while its wrist is farther from its place than this. Metres.
constexpr float kExact = 2e-5f;
constexpr int kSolves = 3;
/// A hand is moved out by the missing depth and a little more, in at most so many rounds.
constexpr int kRounds = 12;
constexpr float kBeyond = 3e-4f;
/// Excess of a wrist's bend that is rounding. Radians.
constexpr float kBendRounding = 0.1f * kDegree;
/// Palms this far on the other side of each other do not cross yet. Metres. (ours)
constexpr float kCrossingAllowed = 0.02f;

std::size_t at(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}
std::size_t at(Side side) {
  return static_cast<std::size_t>(side);
}
const char* word(Side side) {
  return side == Side::left ? "left" : "right";
}
Side opposite(Side side) {
  return side == Side::left ? Side::right : Side::left;
}

Contact without_hands(Contact touched) {
  return static_cast<Contact>(static_cast<unsigned>(touched) & ~static_cast<unsigned>(Contact::hands));
}

float angle_of(const Quaternionf& turn) {
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

bool same_bits(const Quaternionf& a, const Quaternionf& b) {
  return std::memcmp(a.coeffs().data(), b.coeffs().data(), sizeof(float) * 4) == 0;
}

/// How far a wrist is bent beyond its limits, radians; the bend that was captured at this frame is within them.
float beyond_limits(const WristBend& bend, const WristBend& captured) {
  const WristLimits limits = widened(human_wrist(), captured);
  return std::max({bend.flexion - limits.flexion.most, -bend.flexion - limits.extension.most,
                   bend.deviation - limits.radial.most, -bend.deviation - limits.ulnar.most});
}

/// The bend of a wrist in a pose that the meter has seen.
WristBend bend_in(const HandMeter& meter, const ModelPose& pose, const ArmJoints& arm, Side side) {
  if (!meter.has_fingers(side)) return {};
  const Vector3f forearm = pose.positions[at(arm.wrist)] - pose.positions[at(arm.elbow)];
  return wrist_bend(forearm.normalized(), meter.axes(side));
}

}  // namespace

/// What goes wrong with a correction over the stroke.
struct ArmPlacer::Fit {
  float missed = 0;                 ///< as Placed::missed, the largest
  float bent = 0;                   ///< radians beyond the limits of the wrist
  float too_deep = 0;               ///< metres beyond the allowed depth
  Obstacle in = Obstacle::head;     ///< the obstacle it is too deep in
  Vector3f out = Vector3f::Zero();  ///< unit, out of the obstacle; axes of the kept space
};

ArmPlacer::ArmPlacer(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups)
    : skeleton_(&skeleton), meter_(skeleton, signer), source_meter_(skeleton, signer), pose_(skeleton) {
  if (!signer.body || signer.body->trunk == kNoJoint) return;
  spaces_ = AnchorSpaces(signer);
  for (const Side side : kSides) add_arm(side, signer, groups);
}

void ArmPlacer::add_arm(Side side, const SignerModel& signer, const JointGroups& groups) {
  const RigMap& rig = signer.rig;
  const JointIndex trunk = signer.body->trunk;
  const JointIndex wrist = groups.wrists[at(side)];
  const PartPlace& shoulder = rig[of(side, Part::left_upper_arm)];
  const PartPlace& elbow = rig[of(side, Part::left_forearm)];
  if (wrist == kNoJoint || !shoulder.known() || !elbow.known()) return;
  if (!is_above(*skeleton_, trunk, shoulder.joint)) return;
  if (!is_above(*skeleton_, shoulder.joint, elbow.joint) || !is_above(*skeleton_, elbow.joint, wrist)) return;
  std::vector<JointIndex> joints{wrist, trunk, rig[Part::left_upper_arm].joint, rig[Part::right_upper_arm].joint};
  if (rig.has(Part::head)) joints.push_back(rig[Part::head].joint);
  Arm& arm = arms_[at(side)];
  arm = {.joints = {shoulder.joint, elbow.joint, wrist},
         .with_anchors = JointChains(*skeleton_, joints),
         .with_body = {},
         .with_hand = {},
         .below_shoulder = JointChains(*skeleton_, std::array{wrist}, shoulder.joint),
         .hand_below_shoulder = {}};
  if (!meter_.has(side)) return;
  std::vector<JointIndex> with_body = joints;
  std::vector<JointIndex> below;
  for (const JointIndex joint : meter_.joints(side)) {
    (is_above(*skeleton_, shoulder.joint, joint) ? below : with_body).push_back(joint);
  }
  arm.with_body = JointChains(*skeleton_, with_body);
  arm.hand_below_shoulder = JointChains(*skeleton_, below, shoulder.joint);
  with_body.insert(with_body.end(), below.begin(), below.end());
  arm.with_hand = JointChains(*skeleton_, with_body);
}

/// The source's arm is turned as a whole with its anchor, so that the elbow keeps its swivel, and hung on the target's
/// shoulder; two-bone inverse kinematics then shift the wrist by as much as this shoulder is elsewhere.
ArmPlacer::Placed ArmPlacer::place(const PlaceCorrection& correction, PoseView source, float weight,
                                   MutablePoseView pose) {
  const Arm& of = arm(correction.side);
  const auto [shoulder, elbow, wrist] = of.joints;
  const std::array joints = {shoulder, elbow, wrist};
  const AnchorMotion anchor = spaces_.between(correction.kept_in, source_, target_);
  const Vector3f goal = anchor.target_from_source * source_.positions[at(wrist)] + anchor.target_turn * correction.out;
  Placed placed{.space_turn = anchor.target_turn,
                .copied = {target_.rotations[at(wrist)], target_.positions[at(wrist)]}};

  std::array<Quaternionf, 3> current;
  for (std::size_t i = 0; i < 3; ++i) current[i] = pose.rotations[at(joints[i])];
  const Quaternionf above = target_.rotations[at(skeleton_->joint(shoulder).parent)];
  set_in_hemisphere(pose.rotations[at(shoulder)],
                    above.conjugate() * (anchor.target_from_source.turn * source_.rotations[at(shoulder)]));
  set_in_hemisphere(pose.rotations[at(elbow)], source.rotations[at(elbow)]);
  set_in_hemisphere(pose.rotations[at(wrist)], source.rotations[at(wrist)]);
  for (int solve = 0;; ++solve) {
    target_.rotations[at(shoulder)] = above * pose.rotations[at(shoulder)];
    of.below_shoulder.continue_below_top(pose, target_);
    const Vector3f missing = goal - target_.positions[at(wrist)];
    placed.missed = missing.norm();
    if (placed.missed <= kExact) break;
    if (solve == kSolves) {
      const Vector3f& from = target_.positions[at(shoulder)];
      if ((goal - from).norm() < (target_.positions[at(wrist)] - from).norm()) placed.missed = -placed.missed;
      break;
    }
    shift_wrist(*skeleton_, of.joints, target_, missing, pose);
  }
  placed.corrected = {target_.rotations[at(wrist)], target_.positions[at(wrist)]};
  if (weight < 1) {
    for (std::size_t i = 0; i < 3; ++i) {
      Quaternionf& made = pose.rotations[at(joints[i])];
      made = slerp_as_signed(current[i], made, weight);
    }
  }
  return placed;
}

/// Leaves the frame's joints in source_.
ArmPlacer::SourceHand ArmPlacer::look_at_source(PoseView pose, Side side) {
  const ArmJoints& joints = arm(side).joints;
  arm(side).with_hand.to_model_space(pose, source_);
  source_meter_.look(source_, side);
  const Quaternionf& hand = source_.rotations[at(joints.wrist)];
  return {.palm = hand.conjugate() * (source_meter_.palm(side) - source_.positions[at(joints.wrist)]),
          .bend = bend_in(source_meter_, source_, joints, side)};
}

/// Puts the arm on every frame of the stroke, and leaves its palms in `palms_`.
ArmPlacer::Fit ArmPlacer::fit(const ComposedStroke& stroke, const PlaceCorrection& correction,
                              const HandDepths& captured) {
  const Side side = correction.side;
  const ArmJoints& joints = arm(side).joints;
  Fit fit{.bent = -1, .too_deep = -1};
  palms_.clear();
  SourceHand hand;
  for (std::int64_t frame = 0; frame < stroke.source.frames; ++frame) {
    const PoseView source = stroke.source.pose(frame);
    const PoseView composed = stroke.composed.pose(frame);
    std::ranges::copy(composed.rotations, pose_.rotations.begin());
    std::ranges::copy(composed.translations, pose_.translations.begin());
    if (!is_held(stroke.source, frame)) hand = look_at_source(source, side);
    arm(side).with_body.to_model_space(composed, target_);
    const Placed placed = place(correction, source, 1, pose_.view());
    if (std::abs(placed.missed) > std::abs(fit.missed)) fit.missed = placed.missed;

    arm(side).hand_below_shoulder.continue_below_top(std::as_const(pose_).view(), target_);
    meter_.look(target_, side);
    if (meter_.has_fingers(side)) {
      fit.bent = std::max(fit.bent, beyond_limits(bend_in(meter_, target_, joints, side), hand.bend));
    }
    for (const Obstacle obstacle : kBodyObstacles) {
      const Approach near = meter_.to(side, obstacle);
      const float allowed = std::max(captured[static_cast<std::size_t>(obstacle)], 0.0f) + kDepthOfHandAllowed;
      if (-near.clearance - allowed <= fit.too_deep) continue;
      fit.too_deep = -near.clearance - allowed;
      fit.in = obstacle;
      fit.out = placed.space_turn.conjugate() * near.away;
    }

    const SignerSpace space = spaces_.space_with_shoulders_of(source_, target_);
    const Quaternionf turn = placed.corrected.turn * placed.copied.turn.conjugate();
    palms_.push_back({space.turn_to_signer(placed.copied * hand.palm - space.origin),
                      space.turn_to_signer(placed.corrected * hand.palm - space.origin),
                      space.model_from_signer.conjugate() * turn * space.model_from_signer});
  }
  return fit;
}

/// Sets the sizes of a correction from the palms of its stroke.
void ArmPlacer::set_sizes(PlaceCorrection& correction) const {
  Vector3f from = Vector3f::Zero();
  Vector3f to = Vector3f::Zero();
  Eigen::Vector4f sum = Eigen::Vector4f::Zero();
  correction.size_mm = correction.size_degrees = correction.varies_mm = correction.varies_degrees = 0;
  for (const Palm& palm : palms_) {
    from += palm.copied;
    to += palm.corrected;
    sum += (palm.turn.coeffs().dot(palms_.front().turn.coeffs()) < 0 ? -1.0f : 1.0f) * palm.turn.coeffs();
    correction.size_mm = std::max(correction.size_mm, 1000 * (palm.corrected - palm.copied).norm());
    correction.size_degrees = std::max(correction.size_degrees, angle_of(palm.turn) / kDegree);
  }
  from /= static_cast<float>(palms_.size());
  to /= static_cast<float>(palms_.size());
  correction.shift = to - from;
  correction.turn = Quaternionf(sum).normalized();
  for (const Palm& palm : palms_) {
    const Vector3f rigid = to + correction.turn * (palm.copied - from);
    correction.varies_mm = std::max(correction.varies_mm, 1000 * (palm.corrected - rigid).norm());
    correction.varies_degrees =
        std::max(correction.varies_degrees, angle_of(palm.turn * correction.turn.conjugate()) / kDegree);
  }
}

void ArmPlacer::correct(const ComposedStroke& stroke, std::span<PlaceCorrection> together) {
  std::array<HandDepths, 2> captured;
  for (std::size_t i = 0; i < together.size(); ++i) {
    captured[i] = source_meter_.deepest(stroke.source, together[i].side);
  }
  std::array<Fit, 2> fits;
  for (int round = 0;; ++round) {
    for (std::size_t i = 0; i < together.size(); ++i) {
      fits[i] = fit(stroke, together[i], captured[i]);
      set_sizes(together[i]);
    }
    const Fit& worst = together.size() > 1 && fits[1].too_deep > fits[0].too_deep ? fits[1] : fits[0];
    const Vector3f out = together[0].out + (worst.too_deep + kBeyond) * worst.out;
    if (worst.too_deep <= 0 || round == kRounds || out.norm() > kMostOut) break;
    for (PlaceCorrection& correction : together) correction.out = out;
  }
  for (std::size_t i = 0; i < together.size(); ++i) {
    PlaceCorrection& correction = together[i];
    correction.none =
        correction.size_mm <= 1000 * kNoShift && correction.size_degrees <= kNoTurn / kDegree && fits[i].too_deep <= 0;
    if (!correction.none) correction.why_not = why_not(stroke.name, correction.side, fits[i]);
  }
}

std::optional<std::string> ArmPlacer::why_not(std::string_view name, Side side, const Fit& fit) {
  if (std::abs(fit.missed) > kMissAllowed) {
    return fmt::format("the {} hand cannot reach the place of '{}' with this trunk: {:.0f} mm too {}", word(side), name,
                       std::max(1.0f, 1000 * std::abs(fit.missed)), fit.missed > 0 ? "far" : "near");
  }
  if (fit.bent > kBendRounding) {
    return fmt::format("the {} wrist would bend {:.0f}° beyond its limits at the place of '{}' with this trunk",
                       word(side), std::max(1.0f, fit.bent / kDegree), name);
  }
  if (fit.too_deep > 0) {
    return fmt::format("the {} hand would be {:.0f} mm deeper in the {} than captured at the place of '{}'", word(side),
                       1000 * (fit.too_deep + kDepthOfHandAllowed), name_of(fit.in), name);
  }
  return std::nullopt;
}

std::array<std::optional<PlaceCorrection>, 2> ArmPlacer::corrections(const ComposedStroke& stroke) {
  assert(stroke.source.frames == stroke.composed.frames && stroke.source.frames > 0);
  std::array<std::optional<PlaceCorrection>, 2> result;
  std::array<PlaceCorrection, 2> found;
  std::array<Contact, 2> touched{};
  for (const Side side : kSides) {
    found[at(side)].side = side;
    if (!stroke.from_source[at(side)]) continue;
    if (has(side)) {
      touched[at(side)] = source_meter_.touched(stroke.source, side);
    } else {
      found[at(side)].why_not = fmt::format("the {} arm of this body is unknown", word(side));
    }
  }
  const bool both = has(Side::left) && has(Side::right) && stroke.from_source[0] && stroke.from_source[1];
  const bool tied = both && signweave::has(touched[0] | touched[1], Contact::hands);
  for (const Side side : kSides) {
    if (!stroke.from_source[at(side)]) continue;
    PlaceCorrection& correction = found[at(side)];
    correction.anchor = anchor_of(touched[at(side)]);
    correction.kept_in = anchor_of(without_hands(tied ? touched[0] | touched[1] : touched[at(side)]));
    if (has(side) && !tied) correct(stroke, {&correction, 1});
    if (correction.anchor == Anchor::other_hand && !tied) {
      correction.why_not = fmt::format("the {} hand touches the {} one in '{}': take both arms from it", word(side),
                                       word(opposite(side)), stroke.name);
    }
  }
  if (tied) correct(stroke, found);
  for (const Side side : kSides) {
    if (stroke.from_source[at(side)]) result[at(side)] = std::move(found[at(side)]);
  }
  return result;
}

void ArmPlacer::apply(const PlaceCorrection& correction, PosesView source, std::span<const float> weights,
                      MutablePoses composed) {
  assert(static_cast<std::size_t>(source.frames) == weights.size());
  if (!has(correction.side)) return;
  const Arm& of = arm(correction.side);
  const auto [shoulder, elbow, wrist] = of.joints;
  bool has_seen = false;  // the frame before
  for (std::int64_t frame = 0; frame < source.frames; ++frame) {
    const float weight = std::min(weights[static_cast<std::size_t>(frame)], 1.0f);
    const bool seen_before = std::exchange(has_seen, weight > 0);
    if (!(weight > 0)) continue;
    const MutablePoseView pose = pose_at(*skeleton_, composed, frame);
    const PoseView captured = source.pose(frame);
    if (!correction.none) {
      if (!seen_before || !is_held(source, frame)) of.with_anchors.to_model_space(captured, source_);
      of.with_anchors.to_model_space(pose, target_);
      place(correction, captured, weight, pose);
      continue;
    }
    for (const JointIndex joint : {shoulder, elbow, wrist}) {
      Quaternionf& current = pose.rotations[at(joint)];
      const Quaternionf& copied = captured.rotations[at(joint)];
      if (!same_bits(current, copied)) current = weight < 1 ? slerp(current, copied, weight) : copied;
    }
  }
}

std::optional<std::string> why_hands_collide(const HandsMeeting& made, std::span<const HandsMeeting> captured) {
  float depth = 0;
  float crossed = 0;
  for (const HandsMeeting& meeting : captured) {
    depth = std::max(depth, meeting.depth);
    crossed = std::max(crossed, meeting.crossed);
  }
  if (made.depth > depth + kDepthOfHandAllowed) {
    return fmt::format("the hands are {:.0f} mm deeper in each other than captured", 1000 * (made.depth - depth));
  }
  if (made.crossed > crossed + kCrossingAllowed) {
    return fmt::format("the hands cross by {:.0f} cm", 100 * made.crossed);
  }
  return std::nullopt;
}

}  // namespace signweave
