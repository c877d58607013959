#include "signweave/features/segmenter.h"

#include "signweave/features/phase_model.h"

namespace signweave {

std::string_view name_of(MotionPhase phase) noexcept {
  switch (phase) {
    case MotionPhase::rest:
      return "rest";
    case MotionPhase::preparation:
      return "preparation";
    case MotionPhase::stroke:
      return "stroke";
    case MotionPhase::hold:
      return "hold";
    case MotionPhase::retraction:
      return "retraction";
  }
  return "rest";
}

namespace {

void add_phases(const PhaseFrames& frames, std::span<const PhaseProbabilities> probabilities,
                std::span<const MotionPhase> phases, std::vector<ProposedPhase>& result) {
  for (std::size_t begin = 0; begin < phases.size();) {
    std::size_t end = begin;
    float sum = 0;
    while (end < phases.size() && phases[end] == phases[begin]) {
      sum += probabilities[end++][static_cast<std::size_t>(phases[begin])];
    }
    result.push_back({.phase = phases[begin],
                      .begin = frames.begin + Seconds(static_cast<double>(begin) / kSegmenterRate),
                      .end = frames.begin + Seconds(static_cast<double>(end) / kSegmenterRate),
                      .confidence = sum / static_cast<float>(end - begin)});
    begin = end;
  }
}

}  // namespace

ProposedPhases propose_phases(const UpperBodyTrack& track) {
  ProposedPhases result;
  const PhaseModel& model = built_in_phase_model();
  for (const PhaseFrames& frames : phase_features(track)) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (frames.features[side].empty()) continue;
      const std::vector<PhaseProbabilities> probabilities = phase_probabilities(model, frames.features[side]);
      add_phases(frames, probabilities, most_likely_phases(model, probabilities), result.hands[side]);
    }
  }
  for (const Side side : kSides) {
    if (track.has_hand[static_cast<std::size_t>(side)]) continue;
    result.notices.push_back({"", side == Side::left ? "no left hand: nothing is proposed for it"
                                                     : "no right hand: nothing is proposed for it"});
  }
  return result;
}

}  // namespace signweave
