#include "signweave/score/report.h"

namespace signweave {

SynthesisReport report_of(const Synthesis& synthesis) {
  SynthesisReport report{.frames = synthesis.motion.frame_count(),
                         .frames_per_second = synthesis.motion.rate().hertz(),
                         .signs = {},
                         .clips = {},
                         .junctions = {},
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
    report.clips.push_back({.clip = i, .place = clip.place, .shown = synthesis.clips[i], .mirrored = clip.mirrored});
  }
  for (std::size_t i = 0; i < synthesis.junctions.size(); ++i) {
    report.junctions.push_back(
        {.place = synthesis.score.clips[i + 1].place, .from_clip = i, .junction = synthesis.junctions[i]});
  }
  for (const AuthoredCurve& one : synthesis.score.curves) {
    report.movements.push_back({one.curve.name, one.first, one.last, one.at});
  }
  return report;
}

}  // namespace signweave
