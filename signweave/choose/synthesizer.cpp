#include "signweave/choose/synthesizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "signweave/choose/captured_spans.h"
#include "signweave/choose/compose.h"
#include "signweave/choose/decompose.h"
#include "signweave/choose/handedness.h"
#include "signweave/choose/lint.h"
#include "signweave/choose/missing_glosses.h"
#include "signweave/choose/notices.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/choose/open_score.h"
#include "signweave/choose/part_choice.h"
#include "signweave/choose/refuse_space.h"
#include "signweave/core/error.h"
#include "signweave/database/signer_dominance.h"

namespace signweave {
namespace {

using Clock = std::chrono::steady_clock;

/// One selected candidate, or several neighbours of a recording that stay together.
struct ChosenClip {
  Candidate candidate;
  std::size_t place = 0;  ///< the first of its places, and so the number of the junction before it
  std::vector<std::size_t> sign_places = std::vector<std::size_t>(candidate.signs.size(), place);  ///< [sign]
  bool continues = false;                                                                          ///< see MotionClip
};

/// What is signed: places, and what parts of the signer sign besides.
struct Wanted {
  std::vector<Choice> choices;  ///< of the places
  std::vector<PartChoice> parts = {};
  std::vector<ChannelHold> holds = {};             ///< between places
  std::set<std::size_t> borders = {};              ///< places at which parts begin or end
  std::vector<std::optional<Side>> dominant = {};  ///< [place]; empty: as for all
  const Utterance* utterance = nullptr;            ///< null: an edit
};

/// If the junction between neighbours is named, its transition is generated, because options were given for it. At
/// `borders`, places at which parts begin or end, neighbours stay two clips with the recorded transition.
std::vector<ChosenClip> merge_neighbours(const Contents& contents, const std::vector<Choice>& choices,
                                         const Selection& selection, const JunctionChoices& named,
                                         const std::set<std::size_t>& borders, std::vector<Notice>& notices) {
  std::vector<ChosenClip> merged;
  for (std::size_t place = 0; place < choices.size(); ++place) {
    const Candidate& next = choices[place].candidates[selection.chosen[place]];
    const bool goes_on = !merged.empty() && choices[place].pause_before == Milliseconds(0) &&
                         (choices[place].continues || are_neighbours(contents, merged.back().candidate, next));
    if (goes_on && !named.contains(place) && !borders.contains(place)) {
      extend_with(merged.back().candidate, next);
      merged.back().sign_places.insert(merged.back().sign_places.end(), next.signs.size(), place);
      continue;
    }
    if (goes_on && named.contains(place)) {
      notices.push_back({contents.recordings[next.recording].name,
                         fmt::format("'{}' and '{}' are neighbours in the recording; the transition between them is "
                                     "generated because junction {} is named",
                                     merged.back().candidate.signs.back().gloss, next.gloss(), place)});
    }
    ChosenClip& added = merged.emplace_back(ChosenClip{.candidate = next, .place = place});
    if (!goes_on || named.contains(place)) continue;
    added.continues = true;
    Candidate& before = merged[merged.size() - 2].candidate;
    before.whole.end = std::max(before.whole.end, next.core.begin);
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

/// The number of the clip that contains each place.
std::vector<std::size_t> clips_of_places(const std::vector<ChosenClip>& clips, std::size_t places) {
  std::vector<std::size_t> clip_of(places);
  for (std::size_t clip = 0; clip < clips.size(); ++clip) {
    const std::size_t end = clip + 1 < clips.size() ? clips[clip + 1].place : places;
    for (std::size_t place = clips[clip].place; place < end; ++place) clip_of[place] = clip;
  }
  return clip_of;
}

/// The parts' clips, without their motion, and the candidates that fill them.
struct ComposedParts {
  ChannelParts parts;
  std::vector<ChosenPart> chosen;  ///< [clip of the parts]
};
ComposedParts composed_parts(const Snapshot& snapshot, const Wanted& wanted, const Synthesized& made,
                             const std::vector<ChosenClip>& clips) {
  ComposedParts composed;
  if (wanted.parts.empty() && wanted.holds.empty()) return composed;
  std::vector<const Candidate*> chosen;
  for (std::size_t place = 0; place < made.choices.size(); ++place) {
    chosen.push_back(&made.choices[place].candidates[made.selection.chosen[place]]);
  }
  composed.chosen = choose_parts(snapshot, wanted.parts, chosen, made.choices, {.transition = made.durations.mean});
  const std::vector<std::size_t> clip_of = clips_of_places(clips, made.choices.size());
  for (const ChosenPart& part : composed.chosen) composed.parts.clips.push_back(channel_clip(part, clip_of));
  for (const ChannelHold& held : wanted.holds) {
    composed.parts.holds.push_back({held.channel, clip_of[held.from], clip_of[held.until]});
  }
  return composed;
}

/// Mirrors clips so that each is signed with the dominant hand that was asked for, and each hand's part by that hand.
void mirror(std::vector<MotionClip>& clips, const std::vector<ChosenClip>& chosen, const Wanted& wanted,
            const std::vector<ChosenPart>& parts, const SynthesisOptions& options, const Snapshot& snapshot,
            std::vector<Notice>& notices) {
  std::vector<std::optional<Side>> hands;
  for (const ChosenClip& clip : chosen) {
    const bool own = !wanted.dominant.empty() && wanted.dominant[clip.place];
    hands.push_back(own ? wanted.dominant[clip.place] : options.handedness);
  }
  mark_mirrored(clips, hands, snapshot, notices);
  const std::size_t body = clips.size() - parts.size();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].mirrored) clips[body + i].mirrored = *parts[i].mirrored;
  }
  mirror_marked(clips, snapshot, notices);
}

/// `edited` is the name of the edited recording; empty for an utterance.
Synthesized run(const Snapshot& snapshot, Wanted wanted, std::string_view edited, const SynthesisOptions& options,
                Clock::time_point start, Synthesis used) {
  const Contents& contents = snapshot.contents();
  check(options);
  check_numbers(options.junctions, wanted.choices.size());
  Synthesized made;
  made.contents = snapshot.shared_contents();
  made.choices = std::move(wanted.choices);
  const auto queried = Clock::now();
  if (made.choices.size() > 1 || !wanted.parts.empty())
    made.durations = durations_of(contents, *snapshot.learned(), options.duration);
  made.selection = select(snapshot, made.choices, {.transition = made.durations.mean, .explain = options.explain});
  std::vector<Notice> notices;
  std::vector<ChosenClip> chosen_clips =
      merge_neighbours(contents, made.choices, made.selection, options.junctions, wanted.borders, notices);
  ComposedParts composed = composed_parts(snapshot, wanted, made, chosen_clips);
  const std::size_t body = chosen_clips.size();
  for (const ChosenPart& part : composed.chosen) {
    ChosenClip& added = chosen_clips.emplace_back(ChosenClip{.candidate = part.candidate, .place = part.part->place});
    added.continues = !part.part->continues.empty() && part.part->continues[part.sign];
  }
  const auto selected = Clock::now();

  Seconds reading{0};
  std::map<std::size_t, std::shared_ptr<const MotionSource>> sources;
  std::vector<MotionClip> clips;
  for (ChosenClip& chosen : chosen_clips) {
    Candidate& candidate = chosen.candidate;
    const auto named = options.junctions.find(chosen.place);
    const bool is_part = clips.size() >= body;
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
                     .pause_before = is_part ? Milliseconds(0) : made.choices[chosen.place].pause_before,
                     .junction = is_part || named == options.junctions.end() ? JunctionChoice{} : named->second,
                     .fingerprint = info.motion_facts.fingerprint,
                     .place = chosen.place,
                     .sign_places = std::move(chosen.sign_places),
                     .continues = chosen.continues,
                     .noise = snapshot.joins(candidate.recording)->noise,
                     .at_rest = is_part && composed.chosen[clips.size() - body].rest});
  }

  std::size_t reference = 0;
  for (std::size_t i = body; i-- > 0;) {
    if (clips[i].recording == edited) reference = i;
  }
  const std::shared_ptr<const MotionSource> home = clips[reference].source;
  mirror(clips, chosen_clips, wanted, composed.chosen, options, snapshot, notices);
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
  std::function<std::vector<AuthoredCurve>(const Score&)> author;
  const bool plans = options.non_manuals.blinks || options.non_manuals.gaze;
  if (wanted.utterance != nullptr && (plans || !wanted.utterance->non_manuals.empty())) {
    author = [&](const Score& score) {
      return author_non_manuals(*wanted.utterance, score, options.non_manuals, notices);
    };
  }
  for (std::size_t i = body; i < clips.size(); ++i) composed.parts.clips[i - body].clip = std::move(clips[i]);
  clips.resize(body);
  made.result = compose(clips, composed.parts,
                        {.method = &method,
                         .fit = &made.durations,
                         .model = captured.model.get(),
                         .rig = &rig,
                         .tempo = options.tempo,
                         .rate = options.rate.value_or(FrameRate{0, 1}),
                         .alignment = options.alignment,
                         .most_frames = options.most_frames,
                         .author = author,
                         .reference = reference},
                        std::move(used));
  const std::vector<Notice> found = lint_channels(made.result, clips, composed.parts, rig, wanted.utterance);
  if (options.strict && !found.empty()) {
    throw Error(ErrorCode::bad_input, fmt::format("{} ({})", found.front().text, found.front().code),
                {{"strict", "false"}});
  }
  notices.insert(notices.end(), found.begin(), found.end());
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

/// The dominant hand of the signer of the first place's tokens; it is asked for only if parts name it.
Side usual_hand(const Snapshot& snapshot, const Utterance& utterance) {
  const bool has_parts = !utterance.holds.empty() ||
                         std::ranges::any_of(utterance.places, [](const Place& place) { return !place.parts.empty(); });
  if (!has_parts) return Side::right;
  const std::vector<Candidate> first = candidates_for(snapshot.contents(), utterance.places.front());
  return dominance_of(snapshot, first.front().recording).hand.value_or(Side::right);
}

/// A recording in channels: every place stays a clip of its own.
Wanted wanted_of(Decomposed decomposed) {
  Wanted wanted{.choices = std::move(decomposed.choices), .parts = std::move(decomposed.parts)};
  for (std::size_t place = 0; place < wanted.choices.size(); ++place) wanted.borders.insert(place);
  return wanted;
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
  refuse_space(utterance);
  const Snapshot snapshot = database.snapshot();
  require_glosses(utterance, snapshot.contents().segments);
  const Side dominant = options.handedness.value_or(usual_hand(snapshot, utterance));
  Wanted wanted{.choices = {},
                .parts = part_choices(snapshot.contents(), utterance, dominant),
                .holds = channel_holds(utterance, dominant),
                .borders = clip_borders(utterance),
                .utterance = &utterance};
  for (const Place& place : utterance.places) {
    wanted.choices.push_back({candidates_for(snapshot.contents(), place), place.pause_before});
    wanted.dominant.push_back(place.dominant);
  }
  return run(snapshot, std::move(wanted), {}, options, start, std::move(used));
}

Synthesized synthesize(const Database& database, std::string_view recording, const Edit& edit,
                       const SynthesisOptions& options, Synthesis used) {
  const auto start = Clock::now();
  const Snapshot snapshot = database.snapshot();
  Wanted wanted;
  if (edit.hands.empty()) {
    wanted.choices = choices_for(snapshot.contents(), recording, edit);
  } else {
    Decomposed decomposed = decompose(snapshot.contents(), recording);
    replace_in_hands(snapshot.contents(), recording, edit.hands, decomposed);
    wanted = wanted_of(std::move(decomposed));
  }
  return run(snapshot, std::move(wanted), recording, options, start, std::move(used));
}

Synthesized recompose(const Database& database, std::string_view recording) {
  const auto start = Clock::now();
  const Snapshot snapshot = database.snapshot();
  return run(snapshot, wanted_of(decompose(snapshot.contents(), recording)), recording, {}, start, {});
}

}  // namespace signweave
