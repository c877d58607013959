#include "signweave/choose/synthesizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "signweave/choose/captured_spans.h"
#include "signweave/choose/handedness.h"
#include "signweave/choose/missing_glosses.h"
#include "signweave/choose/notices.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/choose/open_score.h"
#include "signweave/core/error.h"

namespace signweave {
namespace {

using Clock = std::chrono::steady_clock;

/// One selected candidate, or several neighbours of a recording that stay together.
struct ChosenClip {
  Candidate candidate;
  std::size_t place = 0;  ///< the first of its places, and so the number of the junction before it
  std::vector<std::size_t> sign_places = std::vector<std::size_t>(candidate.signs.size(), place);  ///< [sign]
};

/// If the junction between neighbours is named, its transition is generated, because options were given for it.
std::vector<ChosenClip> merge_neighbours(const Contents& contents, const std::vector<Choice>& choices,
                                         const Selection& selection, const JunctionChoices& named,
                                         std::vector<Notice>& notices) {
  std::vector<ChosenClip> merged;
  for (std::size_t place = 0; place < choices.size(); ++place) {
    const Candidate& next = choices[place].candidates[selection.chosen[place]];
    const bool goes_on = !merged.empty() && choices[place].pause_before == Milliseconds(0) &&
                         are_neighbours(contents, merged.back().candidate, next);
    if (goes_on && !named.contains(place)) {
      extend_with(merged.back().candidate, next);
      merged.back().sign_places.insert(merged.back().sign_places.end(), next.signs.size(), place);
      continue;
    }
    if (goes_on) {
      notices.push_back({contents.recordings[next.recording].name,
                         fmt::format("'{}' and '{}' are neighbours in the recording; the transition between them is "
                                     "generated because junction {} is named",
                                     merged.back().candidate.signs.back().gloss, next.gloss(), place)});
    }
    merged.push_back({next, place});
  }
  return merged;
}

void check_numbers(const JunctionChoices& named, std::size_t places) {
  if (named.empty() || named.rbegin()->first < places) return;
  const std::size_t junctions = places - 1;
  throw Error(ErrorCode::bad_input, fmt::format("no junction {}: there {}", named.rbegin()->first,
                                                junctions == 0   ? "is none, because nothing is joined"
                                                : junctions == 1 ? "is only junction 1"
                                                                 : fmt::format("are {}, counted from 1", junctions)));
}

/// `edited` is the name of the edited recording; empty for an utterance.
Synthesized run(const Snapshot& snapshot, std::vector<Choice> choices, std::string_view edited,
                const SynthesisOptions& options, Clock::time_point start, Synthesis used) {
  const Contents& contents = snapshot.contents();
  check(options);
  check_numbers(options.junctions, choices.size());
  Synthesized made;
  made.contents = snapshot.shared_contents();
  made.choices = std::move(choices);
  const auto queried = Clock::now();
  if (made.choices.size() > 1) made.durations = durations_of(contents, *snapshot.learned(), options.duration);
  made.selection = select(snapshot, made.choices, {.transition = made.durations.mean, .explain = options.explain});
  std::vector<Notice> notices;
  std::vector<ChosenClip> chosen_clips =
      merge_neighbours(contents, made.choices, made.selection, options.junctions, notices);
  const auto selected = Clock::now();

  Seconds reading{0};
  std::map<std::size_t, std::shared_ptr<const MotionSource>> sources;
  std::vector<MotionClip> clips;
  for (ChosenClip& chosen : chosen_clips) {
    Candidate& candidate = chosen.candidate;
    const auto named = options.junctions.find(chosen.place);
    const RecordingInfo& info = contents.recordings[candidate.recording];
    for (const Sign& sign : candidate.left_out) {
      notices.push_back(notice_left_out(info.name, sign));
    }
    std::shared_ptr<const MotionSource>& source = sources[candidate.recording];
    if (!source) source = std::make_shared<TimedSource>(snapshot.motion(info), reading);
    clips.push_back({.recording = info.name,
                     .source = source,
                     .whole = candidate.whole,
                     .core = candidate.core,
                     .clock = info.clock,
                     .signs = std::move(candidate.signs),
                     .pause_before = made.choices[chosen.place].pause_before,
                     .junction = named == options.junctions.end() ? JunctionChoice{} : named->second,
                     .fingerprint = info.motion_facts.fingerprint,
                     .place = chosen.place,
                     .sign_places = std::move(chosen.sign_places),
                     .noise = snapshot.joins(candidate.recording)->noise});
  }

  std::size_t reference = 0;
  for (std::size_t i = clips.size(); i-- > 0;) {
    if (clips[i].recording == edited) reference = i;
  }
  const std::shared_ptr<const MotionSource> home = clips[reference].source;
  if (options.handedness) show_handedness(clips, *options.handedness, snapshot, notices);
  put_on_skeleton(clips, clips[reference].recording, *home, contents, notices);
  const RecordingInfo& layout = contents.at(clips[reference].recording);
  const SignerRig rig = signer_rig_of(snapshot, layout);
  const TransitionMethod& method = options.method != nullptr ? *options.method : transition_methods().front();
  CapturedSpans captured;
  if (const TransitionMethod* const asking = method_with_needs(clips, method)) {
    captured = captured_spans(snapshot, *clips[reference].source->skeleton(), rig.groups, asking->fill->needs);
    if (asking->fill->needs == Needs::spans) {
      made.captured_transitions = captured.transitions;
      if (auto notice = notice_without_captured(asking->name, captured.transitions)) {
        notices.push_back(std::move(*notice));
      }
    }
  }
  made.result = concatenate(clips,
                            {.method = &method,
                             .fit = &made.durations,
                             .model = captured.model.get(),
                             .rig = &rig,
                             .tempo = options.tempo,
                             .rate = options.rate.value_or(FrameRate{0, 1}),
                             .alignment = options.alignment,
                             .most_frames = options.most_frames,
                             .reference = reference},
                            std::move(used));
  made.result.notices = std::move(notices);
  made.layout_from = clips[reference].recording;
  const bool timed =
      std::ranges::any_of(made.result.junctions, [](const Junction& one) { return !one.chosen.duration; });
  if (!options.duration.fixed && timed) {
    if (auto notice = notice_without_durations(made.durations)) made.result.notices.push_back(std::move(*notice));
  }
  made.result.declarations = declarations_of(contents, clips);
  const auto done = Clock::now();
  made.timings = {.semantic_query = queried - start,
                  .selection = selected - queried,
                  .retrieval = reading,
                  .concatenation = done - selected - reading,
                  .total = done - start};
  return made;
}

}  // namespace

Synthesized synthesize(const Database& database, const Score& score, Synthesis used) {
  const auto start = Clock::now();
  OpenScore open(database, score);
  Synthesized made;
  made.contents = open.contents();
  made.result = open.synthesize(std::move(used));
  made.layout_from = score.skeleton.recording;
  const Seconds total = Clock::now() - start;
  made.timings = {.retrieval = open.reading(), .concatenation = total - open.reading(), .total = total};
  return made;
}

void check(const SynthesisOptions& options) {
  const auto check_tempo = [](double tempo) {
    if (tempo >= kSlowestTempo && tempo <= kFastestTempo) return;
    throw Error(ErrorCode::bad_input, fmt::format("tempo {} is outside {} to {}", tempo, kSlowestTempo, kFastestTempo));
  };
  const auto check_duration = [](Milliseconds duration) {
    if (duration >= Milliseconds(0) && duration <= kLongestTransition) return;
    throw Error(ErrorCode::bad_input,
                fmt::format("a transition of {} ms is outside 0 to {}", duration.count(), kLongestTransition.count()));
  };
  check_tempo(options.tempo);
  check_duration(options.duration.fixed.value_or(Milliseconds(0)));
  for (const auto& [number, choice] : options.junctions) {
    if (number == 0) throw Error(ErrorCode::bad_input, "no junction 0: they are counted from 1");
    check_tempo(choice.tempo.value_or(1.0));
    check_duration(choice.duration.value_or(Milliseconds(0)));
  }
}

Synthesized synthesize(const Database& database, const Utterance& utterance, const SynthesisOptions& options,
                       Synthesis used) {
  const auto start = Clock::now();
  const Snapshot snapshot = database.snapshot();
  require_glosses(utterance, snapshot.contents().segments);
  std::vector<Choice> choices;
  for (const Place& place : utterance.places) {
    choices.push_back({candidates_for(snapshot.contents(), place), place.pause_before});
  }
  return run(snapshot, std::move(choices), {}, options, start, std::move(used));
}

Synthesized synthesize(const Database& database, std::string_view recording, const Edit& edit,
                       const SynthesisOptions& options, Synthesis used) {
  const auto start = Clock::now();
  const Snapshot snapshot = database.snapshot();
  return run(snapshot, choices_for(snapshot.contents(), recording, edit), recording, options, start, std::move(used));
}

}  // namespace signweave
