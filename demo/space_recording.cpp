#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "demo/animate.h"
#include "demo/space.h"
#include "demo/space_plan.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

Timeline plain_timeline(const SpaceTimeline& timeline) {
  Timeline plain{.rate = timeline.rate, .signs = {}, .frames = timeline.frames};
  for (const PlacedAimed& sign : timeline.signs) plain.signs.push_back(sign.placed);
  return plain;
}

/// Adds a tier with the loci over the signs that have one of that kind.
void add_loci(AnnotationDocument& document, const SpaceTimeline& timeline, const std::string& id,
              std::optional<Locus> Aimed::*kind, std::size_t& number) {
  const FrameClock clock{.frame_time = timeline.rate.frame_time()};
  Tier tier;
  tier.id = id;
  tier.type = "locus";
  tier.participant = "synthetic";
  for (const PlacedAimed& sign : timeline.signs) {
    const std::optional<Locus>& locus = sign.aimed->*kind;
    if (!locus) continue;
    tier.annotations.push_back({.id = fmt::format("a{}", ++number),
                                .label = locus->text,
                                .span = span_of({sign.placed.begin, sign.placed.end}, clock),
                                .parent = ""});
  }
  if (!tier.annotations.empty()) document.tiers.push_back(std::move(tier));
}

AnnotationDocument annotation(const SpaceScript& script, const SpaceTimeline& timeline) {
  AnnotationDocument document = annotation_of({.name = script.name, .units = {}}, plain_timeline(timeline));
  document.types.push_back({"locus", Stereotype::none, ""});
  std::size_t number = 4 * timeline.signs.size();
  add_loci(document, timeline, "From", &Aimed::from, number);
  add_loci(document, timeline, "To", &Aimed::to, number);
  add_loci(document, timeline, "At", &Aimed::at, number);
  return document;
}

std::string truth_of(const SpaceTimeline& timeline, const SpacePlan& plan, const Signer& signer, const Motion& motion) {
  const FrameClock clock{.frame_time = timeline.rate.frame_time()};
  std::string text = "gloss,phase,begin_ms,end_ms,hand,x,y,z,handshape,size\n";
  for (const PlacedAimed& token : timeline.signs) {
    const PlacedSign& sign = token.placed;
    const std::int64_t bounds[] = {sign.begin, sign.stroke_begin, sign.stroke_end, sign.end};
    for (std::size_t i = 0; i < 3; ++i) {
      static constexpr const char* kLabels[] = {"Preparation", "Stroke", "Retraction"};
      const TimeSpan span = span_of({bounds[i], bounds[i + 1]}, clock);
      const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(bounds[i + 1]));
      for (const Side side : {Side::right, Side::left}) {
        if (!acts(aimed_sign(token.aimed->gloss), side)) continue;
        const Vector3f wrist = pose.positions[static_cast<std::size_t>(signer.side(side).hand)];
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{:.4f},{:.4f},{:.4f},{},1.000\n", token.aimed->gloss,
                       kLabels[i], span.begin.count(), span.end.count(), side == Side::right ? "right" : "left",
                       wrist.x(), wrist.y(), wrist.z(),
                       name_of(plan.handshape_at(side, static_cast<double>(bounds[i + 1]))));
      }
    }
  }
  return text;
}

std::string space_truth(const SpaceTimeline& timeline) {
  constexpr float kDegrees = 180 / std::numbers::pi_v<float>;
  const FrameClock clock{.frame_time = timeline.rate.frame_time()};
  std::string text =
      "gloss,stroke_begin_ms,stroke_end_ms,hand,from,to,at,"
      "begin_x,begin_y,begin_z,begin_qw,begin_qx,begin_qy,begin_qz,begin_swivel,begin_yaw,"
      "end_x,end_y,end_z,end_qw,end_qx,end_qy,end_qz,end_swivel,end_yaw,"
      "noise_x,noise_y,noise_z,noise_rx,noise_ry,noise_rz\n";
  auto out = std::back_inserter(text);
  const auto angles = [](const std::optional<Locus>& locus) { return locus ? angles_text(*locus) : std::string(); };
  for (const PlacedAimed& sign : timeline.signs) {
    const Aimed& aimed = *sign.aimed;
    const TimeSpan span = span_of({sign.placed.stroke_begin, sign.placed.stroke_end}, clock);
    for (const Side side : {Side::right, Side::left}) {
      if (!acts(aimed_sign(aimed.gloss), side)) continue;
      fmt::format_to(out, "{},{},{},{},{},{},{}", aimed.gloss, span.begin.count(), span.end.count(),
                     side == Side::right ? "right" : "left", angles(aimed.from), angles(aimed.to), angles(aimed.at));
      for (const float done : {0.0f, 1.0f}) {
        const AimedHand hand = aimed_hand(aimed, side, done);
        fmt::format_to(out, ",{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{:.2f},{:.2f}", hand.palm.x(),
                       hand.palm.y(), hand.palm.z(), hand.hand.w(), hand.hand.x(), hand.hand.y(), hand.hand.z(),
                       kDegrees * hand.swivel, kDegrees * aimed_yaw(aimed, done));
      }
      const AimedNoise& noise = sign.noise[static_cast<std::size_t>(side)];
      fmt::format_to(out, ",{:.4f},{:.4f},{:.4f},{:.2f},{:.2f},{:.2f}\n", noise.shift.x(), noise.shift.y(),
                     noise.shift.z(), kDegrees * noise.turn.x(), kDegrees * noise.turn.y(), kDegrees * noise.turn.z());
    }
  }
  return text;
}

}  // namespace

SyntheticRecording make_space(const SpaceScript& script, FrameRate rate, std::uint64_t seed, float noise) {
  for (const char c : script.name) seed = seed * 1'099'511'628'211ull + static_cast<unsigned char>(c);
  Random random(seed);
  const Signer signer = make_signer();
  const SpaceTimeline timeline = schedule_space(script, rate, random, noise);
  const SpacePlan plan(timeline, random, noise);
  const HandPlan touches(HandPlan::Content{.touches = plan.touches()});
  SyntheticRecording recording;
  recording.name = script.name;
  recording.timeline = plain_timeline(timeline);
  std::array<std::vector<SignerHand>, 2> hands;  // [side][frame]: each is needed several times
  for (const Side side : kSides) {
    for (std::int64_t frame = 0; frame < timeline.frames; ++frame) {
      hands[static_cast<std::size_t>(side)].push_back(plan.at(side, static_cast<double>(frame)));
    }
  }
  const auto hand = [&](Side side, double frame) {
    return hands[static_cast<std::size_t>(side)][static_cast<std::size_t>(std::llround(frame))];
  };
  const auto wrist = [&](Side side, double frame) {
    return Vector3f(hand(side, frame).palm + to_model(Vector3f::Zero(), Side::left));
  };
  std::vector<BodyFrame> body = move_body(recording.timeline, wrist, random);
  for (std::size_t i = 0; i < body.size(); ++i) {
    const double yaw = static_cast<double>(plan.yaw_at(static_cast<double>(i)));
    body[i].head_yaw += 0.35 * (yaw - body[i].yaw);
    body[i].yaw = yaw - body[i].hips_yaw;
  }
  FaceMotion face = face_of(recording.timeline, random);
  recording.motion = animate(signer, rate, std::move(body), std::move(face), touches, hand, random);
  recording.document = annotation(script, timeline);
  recording.truth = truth_of(timeline, plan, signer, recording.motion);
  recording.space = space_truth(timeline);
  return recording;
}

}  // namespace signweave::demo
