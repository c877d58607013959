#include "signweave/score/report.h"

#include <algorithm>

#include "signweave/nonmanual/channel.h"
#include "signweave/score/lane_chain.h"

namespace signweave {
namespace {

ReportLane lane_report(const Lane& lane, const Score& score) {
  ReportLane report{.channel = lane.channel, .items = {}};
  for (const Item& item : lane.items) {
    if (item.at.size() <= 0) continue;
    ReportLaneItem& one = report.items.emplace_back();
    one.frames = item.at;
    if (const auto* const use = std::get_if<ClipUse>(&item.what)) {
      one.clip = use->clip;
      one.hand = use->place;
    } else if (const auto* const held = std::get_if<Hold>(&item.what)) {
      one.kind = ReportLaneItem::Kind::hold;
      one.clip = held->clip;
    } else {
      const Transition& made = std::get<Transition>(item.what);
      one.kind = ReportLaneItem::Kind::transition;
      one.clip = made.from;
      one.to_clip = made.to;
      one.method = score.junctions[made.to - 1].method;
    }
  }
  return report;
}

ReportMovement movement_report(const AuthoredCurve& one) {
  const Curve& curve = one.curve;
  ReportMovement report{.name = curve.name,
                        .kind = !curve.mouth.empty() ? "mouthing"
                                : curve.gaze         ? "gaze"
                                                     : "expression",
                        .channels = {},
                        .first = one.first,
                        .last = one.last,
                        .frames = one.at};
  const std::vector<std::string> tracks = tracks_of(curve);
  for (const NonManualChannel channel : kNonManualChannels) {
    const bool moves =
        std::ranges::any_of(tracks, [&](const std::string& track) { return channel_of_track(track) == channel; });
    if (moves || (channel == NonManualChannel::head && curve.head.moves())) report.channels.push_back(name_of(channel));
  }
  return report;
}

}  // namespace

SynthesisReport report_of(const Synthesis& synthesis) {
  SynthesisReport report{.frames = synthesis.motion.frame_count(),
                         .frames_per_second = synthesis.motion.rate().hertz(),
                         .signs = {},
                         .clips = {},
                         .junctions = {},
                         .lanes = {},
                         .movements = {}};
  for (const PlacedSign& placed : synthesis.signs) {
    ReportSign& sign = report.signs.emplace_back(ReportSign{.gloss = placed.sign.gloss,
                                                            .place = placed.place,
                                                            .clip = placed.clip,
                                                            .channel = placed.channel,
                                                            .recording = synthesis.clips[placed.clip].recording,
                                                            .span = placed.sign.span,
                                                            .recorded = placed.recorded,
                                                            .phases = {}});
    for (const Phase& phase : placed.sign.phases) sign.phases.push_back({name_of(phase.kind), phase.span});
  }
  for (std::size_t i = 0; i < synthesis.clips.size(); ++i) {
    const Clip& clip = synthesis.score.clips[i];
    report.clips.push_back({.clip = i,
                            .place = clip.place,
                            .shown = synthesis.clips[i],
                            .mirrored = clip.mirrored,
                            .at_rest = clip.at_rest,
                            .changes = clip.changes});
  }
  for (std::size_t i = 0; i < synthesis.junctions.size(); ++i) {
    report.junctions.push_back(
        {.place = synthesis.score.clips[i + 1].place, .from_clip = i, .junction = synthesis.junctions[i]});
  }
  for (const Lane* const lane : lanes_that_differ(synthesis.score)) {
    report.lanes.push_back(lane_report(*lane, synthesis.score));
  }
  for (const AuthoredCurve& one : synthesis.score.curves) report.movements.push_back(movement_report(one));
  return report;
}

}  // namespace signweave
