#include "demo/corpus.h"

#include <fmt/format.h>

#include <iterator>

namespace signweave::demo {
namespace {

struct PlacedPhase {
  const char* label;
  std::int64_t begin, end;  ///< frames
};

std::vector<PlacedPhase> phases_of(const PlacedSign& sign) {
  return {{"Preparation", sign.begin, sign.stroke_begin},
          {"Stroke", sign.stroke_begin, sign.stroke_end},
          {"Retraction", sign.stroke_end, sign.end}};
}

std::string truth_of(const Timeline& timeline, const HandPlan& plan) {
  const FrameClock clock{.frame_time = timeline.rate.frame_time()};
  std::string text = "gloss,phase,begin_ms,end_ms,hand,x,y,z,handshape,size\n";
  for (const PlacedSign& sign : timeline.signs) {
    for (const PlacedPhase& phase : phases_of(sign)) {
      const TimeSpan span = span_of({phase.begin, phase.end}, clock);
      for (const Side side : {Side::right, Side::left}) {
        if (!acts(*sign.shape, side)) continue;
        const auto end = static_cast<double>(phase.end);
        const Eigen::Vector3f wrist = plan.at(side, end);
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{:.4f},{:.4f},{:.4f},{},{:.3f}\n", sign.shape->gloss,
                       phase.label, span.begin.count(), span.end.count(), side == Side::right ? "right" : "left",
                       wrist.x(), wrist.y(), wrist.z(), name_of(plan.shape_at(side, end)), sign.token.size);
      }
    }
  }
  return text;
}

std::uint64_t mixed(const Script& script, std::uint64_t seed) {
  for (const char c : script.name) seed = seed * 1'099'511'628'211ull + static_cast<unsigned char>(c);
  return seed;
}

}  // namespace

AnnotationDocument annotation_of(const Script& script, const Timeline& timeline) {
  const FrameClock clock{.frame_time = timeline.rate.frame_time()};
  AnnotationDocument document;
  document.author = "signweave demo: synthetic, placeholder shapes, not LSF";
  document.date = "1970-01-01T00:00:00+00:00";  // no clock, so that the bytes are always the same
  document.linked_files.push_back({.url = "./" + script.name + ".bvh",
                                   .relative_url = "./" + script.name + ".bvh",
                                   .mime_type = "application/octet-stream",
                                   .media = false});
  document.properties = {{"signweave:placeholder", "synthetic motion: placeholder shapes, not LSF"}};
  document.types = {{"gloss", Stereotype::none, ""}, {"phase", Stereotype::time_subdivision, ""}};
  Tier glosses;
  glosses.id = "Gloss";
  glosses.type = "gloss";
  glosses.participant = "synthetic";
  Tier phases = glosses;
  phases.id = "Phase";
  phases.type = "phase";
  phases.parent = glosses.id;
  std::size_t number = 0;
  const auto next_id = [&number] { return fmt::format("a{}", ++number); };
  for (const PlacedSign& sign : timeline.signs) {
    const std::string id = next_id();
    glosses.annotations.push_back({.id = id,
                                   .label = std::string(sign.shape->gloss),
                                   .span = span_of({sign.begin, sign.end}, clock),
                                   .parent = ""});
    for (const PlacedPhase& phase : phases_of(sign)) {
      phases.annotations.push_back(
          {.id = next_id(), .label = phase.label, .span = span_of({phase.begin, phase.end}, clock), .parent = id});
    }
  }
  document.tiers = {std::move(glosses), std::move(phases)};
  return document;
}

Timeline timeline_of(const Script& script, FrameRate rate, std::uint64_t seed) {
  Random timing(mixed(script, seed));
  timing.bits();
  return schedule(script, rate, timing);
}

SyntheticRecording make_recording(const Script& script, FrameRate rate, std::uint64_t seed) {
  // One random stream per recording and use, so that a change of one does not affect the others.
  Random idle_motion(Random(mixed(script, seed)).bits());
  const Signer signer = make_signer();
  SyntheticRecording recording;
  recording.name = script.name;
  recording.timeline = timeline_of(script, rate, seed);
  Random paths(idle_motion.bits());
  const HandPlan plan(script, recording.timeline, paths);
  recording.motion = animate(signer, recording.timeline, plan, idle_motion);
  recording.document = annotation_of(script, recording.timeline);
  recording.truth = truth_of(recording.timeline, plan);
  return recording;
}

}  // namespace signweave::demo
