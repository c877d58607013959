#include "signweave/choose/synthesizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "signweave/choose/captured_spans.h"
#include "signweave/choose/missing_glosses.h"
#include "signweave/choose/notices.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/core/error.h"
#include "signweave/render/render.h"

namespace signweave {
namespace {

using Clock = std::chrono::steady_clock;

/// What the documents of the recordings used declare of themselves.
std::vector<std::pair<std::string, std::string>> declarations_of(const Contents& contents,
                                                                 const std::vector<Stretch>& stretches) {
  DeclarationSet declarations;
  for (const Stretch& stretch : stretches) add_declarations(contents.at(stretch.recording), declarations);
  return {declarations.begin(), declarations.end()};
}

/// Measures how long reading takes: the column "retrieval" of Table 1.
class TimedSource : public MotionSource {
 public:
  TimedSource(std::unique_ptr<MotionSource> source, Seconds& spent) : source_(std::move(source)), spent_(spent) {}

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return source_->skeleton(); }
  FrameRate rate() const noexcept override { return source_->rate(); }
  std::int64_t frame_count() const noexcept override { return source_->frame_count(); }
  std::span<const std::string> tracks() const noexcept override { return source_->tracks(); }
  void read(FrameRange frames, MutablePoses out) const override {
    const auto start = Clock::now();
    source_->read(frames, out);
    spent_ += Clock::now() - start;
  }
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override {
    const auto start = Clock::now();
    source_->read_tracks(frames, out);
    spent_ += Clock::now() - start;
  }

 private:
  std::unique_ptr<MotionSource> source_;
  Seconds& spent_;
};

/// One selected candidate, or several that were neighbours in a recording and stay together.
struct Part {
  Candidate candidate;
  std::size_t place = 0;  ///< the first of its places, and so the number of the junction before it
};

/// Of neighbours whose junction is named the transition is made: who tells how it is to be made wants it so.
std::vector<Part> merge_neighbours(const Contents& contents, const std::vector<Choice>& choices,
                                   const Selection& selection, const JunctionChoices& named,
                                   std::vector<Notice>& notices) {
  std::vector<Part> merged;
  for (std::size_t place = 0; place < choices.size(); ++place) {
    const Candidate& next = choices[place].candidates[selection.chosen[place]];
    const bool goes_on = !merged.empty() && choices[place].pause_before == Milliseconds(0) &&
                         are_neighbours(contents, merged.back().candidate, next);
    if (goes_on && !named.contains(place)) {
      go_on_with(merged.back().candidate, next);
      continue;
    }
    if (goes_on) {
      notices.push_back({contents.recordings[next.recording].name,
                         fmt::format("'{}' and '{}' were signed one after the other: what lies between is made all the "
                                     "same, for junction {} is named",
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
                                                junctions == 0   ? "is none, for nothing is joined"
                                                : junctions == 1 ? "is one alone, number 1"
                                                                 : fmt::format("are {}, counted from 1", junctions)));
}

void require_unchanged(const RecordingInfo& info, const SourceRef& source) {
  if (source.fingerprint == 0 || source.fingerprint == info.motion_fingerprint) return;
  throw Error(ErrorCode::conflict,
              fmt::format("recording '{}' changed since this score was made; sign its utterance again", info.name));
}

/// The first method of a junction that needs something of the corpus, captured spans before all; or null.
const TransitionMethod* method_with_needs(const std::vector<Stretch>& stretches, const TransitionMethod& of_all) {
  const TransitionMethod* found = nullptr;
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    const TransitionMethod* const own = stretches[i].junction.method;
    const TransitionMethod& method = own != nullptr ? *own : of_all;
    if (method.fill->needs == Needs::spans) return &method;
    if (method.fill->needs == Needs::teaching) found = &method;
  }
  return found;
}

/// `edited` names the recording that an edit starts from; empty for an utterance.
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
  std::vector<Part> parts = merge_neighbours(contents, made.choices, made.selection, options.junctions, notices);
  const auto selected = Clock::now();

  Seconds reading{0};
  std::map<std::size_t, std::shared_ptr<const MotionSource>> sources;
  std::vector<Stretch> stretches;
  for (Part& part : parts) {
    Candidate& candidate = part.candidate;
    const auto named = options.junctions.find(part.place);
    const RecordingInfo& info = contents.recordings[candidate.recording];
    for (const Sign& sign : candidate.left_out) {
      notices.push_back(notice_left_out(info.name, sign));
    }
    std::shared_ptr<const MotionSource>& source = sources[candidate.recording];
    if (!source) source = std::make_shared<TimedSource>(snapshot.motion(info), reading);
    stretches.push_back({.recording = info.name,
                         .source = source,
                         .whole = candidate.whole,
                         .core = candidate.core,
                         .clock = info.clock,
                         .signs = std::move(candidate.signs),
                         .pause_before = made.choices[part.place].pause_before,
                         .junction = named == options.junctions.end() ? JunctionChoice{} : named->second,
                         .fingerprint = info.motion_fingerprint,
                         .place = part.place,
                         .noise = snapshot.joins(candidate.recording)->noise});
  }

  std::size_t reference = 0;
  for (std::size_t i = stretches.size(); i-- > 0;) {
    if (stretches[i].recording == edited) reference = i;
  }
  put_on_skeleton(stretches, reference, contents, notices);
  const RecordingInfo& layout = contents.at(stretches[reference].recording);
  const SignerRig rig = signer_rig_of(snapshot, layout);
  const TransitionMethod& method = options.method != nullptr ? *options.method : transition_methods().front();
  CapturedSpans captured;
  if (const TransitionMethod* const asking = method_with_needs(stretches, method)) {
    captured = captured_spans(snapshot, *stretches[reference].source->skeleton(), rig.groups, asking->fill->needs);
    if (asking->fill->needs == Needs::spans) {
      made.captured_transitions = captured.transitions;
      if (auto notice = notice_without_captured(asking->name, captured.transitions)) {
        notices.push_back(std::move(*notice));
      }
    }
  }
  made.result = concatenate(stretches,
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
  made.layout_from = stretches[reference].recording;
  const bool timed =
      std::ranges::any_of(made.result.junctions, [](const Junction& one) { return !one.chosen.duration; });
  if (!options.duration.fixed && timed) {
    if (auto notice = notice_without_durations(made.durations)) made.result.notices.push_back(std::move(*notice));
  }
  made.result.declarations = declarations_of(contents, stretches);
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
  check(score, "score");
  const Snapshot snapshot = database.snapshot();
  const Contents& contents = snapshot.contents();
  Synthesized made;
  made.contents = snapshot.shared_contents();
  Seconds reading{0};
  std::map<std::string, ScoreSource> sources;
  std::vector<Stretch> stretches = stretches_of(score, [&](const SourceRef& source) {
    if (source.kind != SourceRef::Kind::recording) {
      throw Error(ErrorCode::unsupported,
                  "score: a stream made it, and it has frames of no recording (kind 'rest' or 'shown'); sign its "
                  "utterance again");
    }
    const auto [at, is_new] = sources.try_emplace(source.recording);
    const RecordingInfo& info = contents.at(source.recording);
    require_unchanged(info, source);
    if (is_new) {
      at->second = {std::make_shared<TimedSource>(snapshot.motion(info), reading),
                    snapshot.joins(static_cast<std::size_t>(&info - contents.recordings.data()))->noise};
    }
    return at->second;
  });
  const auto reference = static_cast<std::size_t>(
      std::ranges::find(stretches, score.skeleton.recording, &Stretch::recording) - stretches.begin());
  if (reference == stretches.size()) {
    throw Error(ErrorCode::bad_input,
                fmt::format("score: its skeleton is that of '{}', of which it has no clip", score.skeleton.recording));
  }
  std::vector<Notice> notices;
  put_on_skeleton(stretches, reference, contents, notices);
  const RecordingInfo& layout = contents.at(score.skeleton.recording);
  const SignerRig rig = signer_rig_of(snapshot, layout);
  const TransitionMethod& method = transition_methods().front();
  CapturedSpans captured;
  if (const TransitionMethod* const asking = method_with_needs(stretches, method)) {
    captured = captured_spans(snapshot, *stretches[reference].source->skeleton(), rig.groups, asking->fill->needs);
  }
  made.result.motion = std::move(used.motion);
  made.result.sources = std::move(used.sources);
  render(score, stretches,
         {.skeleton = stretches[reference].source->skeleton(),
          .rate = score.rate,
          .method = &method,
          .rig = &rig,
          .model = captured.model.get()},
         made.result);
  made.result.notices = std::move(notices);
  made.result.declarations = declarations_of(contents, stretches);
  made.layout_from = score.skeleton.recording;
  const Seconds total = Clock::now() - start;
  made.timings = {.retrieval = reading, .concatenation = total - reading, .total = total};
  return made;
}

SignerRig signer_rig_of(const Snapshot& snapshot, const RecordingInfo& recording) {
  SignerModel signer = *snapshot.signer(recording);
  JointGroups groups = joint_groups(*snapshot.motion(recording)->skeleton(), signer.rig);
  return {std::move(signer), std::move(groups)};
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
