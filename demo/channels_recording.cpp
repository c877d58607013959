#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "demo/animate.h"
#include "demo/channels.h"

namespace signweave::demo {
namespace {

struct LanePhase {
  const std::string* label;
  std::int64_t begin, end;  ///< frames
};

std::vector<LanePhase> lane_phases(const LaneSign& sign, const ChannelTiers& tiers) {
  std::vector<LanePhase> phases = {{&tiers.preparation, sign.placed.begin, sign.placed.stroke_begin},
                                   {&tiers.stroke, sign.placed.stroke_begin, sign.placed.stroke_end}};
  if (sign.hold_end > sign.placed.stroke_end) phases.push_back({&tiers.hold, sign.placed.stroke_end, sign.hold_end});
  phases.push_back({&tiers.retraction, sign.hold_end, sign.placed.end});
  return phases;
}

/// Writes the tiers of one document.
class Annotator {
 public:
  Annotator(const ChannelScript& script, const ChannelTimeline& timeline)
      : script_(script), timeline_(timeline), clock_{.frame_time = timeline.rate.frame_time()} {}

  AnnotationDocument document() {
    document_ = annotation_of({.name = script_.name, .units = {}}, {.rate = timeline_.rate, .signs = {}});
    document_.tiers.clear();
    document_.types.push_back({"marking", Stereotype::none, ""});
    for (const Side side : {Side::right, Side::left}) add_lane(static_cast<std::size_t>(side));
    add_marked("Mouthing", timeline_.mouthings);
    add_marked("Brows", timeline_.brows);
    add_marked("Head", timeline_.heads);
    add_marked("Gaze", timeline_.gazes);
    add_marked("Blink", timeline_.blinks);
    add_marked("Contact", timeline_.contacts);
    return std::move(document_);
  }

 private:
  static Tier tier(std::string id, std::string type, std::string parent = {}) {
    Tier made;
    made.id = std::move(id);
    made.type = std::move(type);
    made.parent = std::move(parent);
    made.participant = "synthetic";
    return made;
  }

  Annotation annotation(const std::string& label, std::int64_t begin, std::int64_t end,
                        const std::string& parent = {}) {
    return {
        .id = fmt::format("a{}", ++number_), .label = label, .span = span_of({begin, end}, clock_), .parent = parent};
  }

  void add_lane(std::size_t side) {
    Tier glosses = tier(script_.tiers.glosses[side], "gloss");
    Tier phases = tier(script_.tiers.phases[side], "phase", glosses.id);
    for (const LaneSign& sign : timeline_.lanes[side]) {
      glosses.annotations.push_back(
          annotation(std::string(sign.placed.shape->gloss), sign.placed.begin, sign.placed.end));
      const std::string id = glosses.annotations.back().id;
      for (const LanePhase& phase : lane_phases(sign, script_.tiers)) {
        phases.annotations.push_back(annotation(*phase.label, phase.begin, phase.end, id));
      }
    }
    document_.tiers.push_back(std::move(glosses));
    document_.tiers.push_back(std::move(phases));
  }

  void add_marked(const std::string& id, const std::vector<MarkedFrames>& marked) {
    if (marked.empty()) return;
    Tier made = tier(id, "marking");
    for (const MarkedFrames& one : marked) made.annotations.push_back(annotation(one.label, one.begin, one.end));
    document_.tiers.push_back(std::move(made));
  }

  const ChannelScript& script_;
  const ChannelTimeline& timeline_;
  FrameClock clock_;
  AnnotationDocument document_;
  std::size_t number_ = 0;
};

std::string lane_truth(const ChannelScript& script, const ChannelTimeline& timeline, const HandPlan& plan) {
  const FrameClock clock{.frame_time = timeline.rate.frame_time()};
  std::string text = "gloss,phase,begin_ms,end_ms,hand,x,y,z,handshape,size\n";
  for (const Side side : {Side::right, Side::left}) {
    for (const LaneSign& sign : timeline.lanes[static_cast<std::size_t>(side)]) {
      for (const LanePhase& phase : lane_phases(sign, script.tiers)) {
        const TimeSpan span = span_of({phase.begin, phase.end}, clock);
        const auto end = static_cast<double>(phase.end);
        const Eigen::Vector3f wrist = plan.at(side, end);
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{:.4f},{:.4f},{:.4f},{},{:.3f}\n",
                       sign.placed.shape->gloss, *phase.label, span.begin.count(), span.end.count(),
                       side == Side::right ? "right" : "left", wrist.x(), wrist.y(), wrist.z(),
                       name_of(plan.shape_at(side, end)), sign.placed.token.size);
      }
    }
  }
  return text;
}

/// The directions of the eyes as ARKit's weights: 1 is 35° across or down, 25° up.
void add_eye_tracks(const Signer& signer, Motion& motion) {
  constexpr float kDegree = std::numbers::pi_v<float> / 180.0f;
  for (const Side side : {Side::left, Side::right}) {
    const std::string suffix = side == Side::left ? "Left" : "Right";
    std::array<ScalarTrack, 4> tracks;  // in, out, up, down
    static constexpr const char* kDirections[] = {"In", "Out", "Up", "Down"};
    for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].name = "eyeLook" + (kDirections[i] + suffix);
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const auto eye = static_cast<std::size_t>(signer.side(side).eye);
      const Eigen::Vector3f look = motion.pose(frame).rotations[eye] * Eigen::Vector3f::UnitZ();
      const float out = sign_of(side) * std::atan2(look.x(), look.z()) / kDegree;
      const float up = std::asin(std::clamp(look.y(), -1.0f, 1.0f)) / kDegree;
      const float weights[] = {-out / 35, out / 35, up / 25, -up / 35};
      for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].values.push_back(std::clamp(weights[i], 0.0f, 1.0f));
    }
    for (ScalarTrack& track : tracks) motion.add_track(std::move(track));
  }
}

}  // namespace

SyntheticRecording make_channels(const ChannelScript& script, FrameRate rate, std::uint64_t seed, float unrest) {
  for (const char c : script.name) seed = seed * 1'099'511'628'211ull + static_cast<unsigned char>(c);
  Random random(seed);
  const Signer signer = make_signer();
  const ChannelTimeline timeline = schedule_channels(script, rate, random);
  const HandPlan plan = plan_of(timeline, random, unrest);
  SyntheticRecording recording;
  recording.name = script.name;
  recording.timeline = dominant_timeline(timeline);
  std::vector<BodyFrame> body = move_body(recording.timeline, plan, random);
  turn_heads(timeline, body);
  FaceMotion face = face_of(timeline, random);
  recording.motion = animate(signer, rate, std::move(body), std::move(face), plan, random);
  add_eye_tracks(signer, recording.motion);
  recording.document = Annotator(script, timeline).document();
  recording.truth = lane_truth(script, timeline, plan);
  return recording;
}

}  // namespace signweave::demo
