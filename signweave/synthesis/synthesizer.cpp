#include "signweave/synthesis/synthesizer.h"

#include <fmt/format.h>

#include <chrono>
#include <set>

#include "signweave/core/error.h"

namespace signweave {
namespace {

using Clock = std::chrono::steady_clock;

/// What the documents of the recordings used declare of themselves.
std::vector<std::pair<std::string, std::string>> declarations_of(const Database& database,
                                                                 const std::vector<Stretch>& stretches,
                                                                 std::vector<Notice>& notices) {
  std::set<std::string> recordings;
  for (const Stretch& stretch : stretches) recordings.insert(stretch.recording);
  std::set<std::pair<std::string, std::string>> declarations;
  for (const std::string& name : recordings) {
    const std::optional<RecordingInfo> info = database.info(name);  // it may be gone meanwhile, or another
    if (!info || info->document == 0) continue;
    try {
      for (const auto& [key, value] : database.document(name).properties) {
        if (key.starts_with("signweave:") && key != "signweave:synthesis") declarations.emplace(key, value);
      }
    } catch (const Error& error) {  // its motion is sound: a damaged document stops no signing
      notices.push_back({"", error.what()});
    }
  }
  return {declarations.begin(), declarations.end()};
}

/// One selected candidate, or several that were neighbours in a recording and stay together.
std::vector<Candidate> merge_neighbours(const Contents& contents, const std::vector<Choice>& choices,
                                        const Selection& selection, std::vector<Milliseconds>& pauses) {
  std::vector<Candidate> merged;
  for (std::size_t place = 0; place < choices.size(); ++place) {
    const Candidate& next = choices[place].candidates[selection.chosen[place]];
    const Milliseconds pause = choices[place].pause_before;
    if (!merged.empty() && pause == Milliseconds(0) && are_neighbours(contents, merged.back(), next)) {
      Candidate& last = merged.back();
      last.signs.insert(last.signs.end(), next.signs.begin(), next.signs.end());
      last.core.end = next.core.end;
      last.whole.end = next.whole.end;
    } else {
      merged.push_back(next);
      pauses.push_back(pause);
    }
  }
  return merged;
}

/// `edited` names the recording that an edit starts from; empty for an utterance.
Synthesized run(const Database& database, const Contents& contents, std::vector<Choice> choices,
                std::string_view edited, const SynthesisOptions& options, Clock::time_point start) {
  if (!(options.tempo >= 0.25 && options.tempo <= 4.0)) {
    throw Error(ErrorCode::bad_input, fmt::format("tempo {} is outside 0.25 to 4", options.tempo));
  }
  const Milliseconds duration = transition_duration(options.duration, contents.transitions);
  if (duration < Milliseconds(0) || duration > Milliseconds(60'000)) {
    throw Error(ErrorCode::bad_input, fmt::format("a transition of {} ms is outside 0 to 60000", duration.count()));
  }
  Synthesized made;
  made.choices = std::move(choices);
  const auto queried = Clock::now();
  made.selection = select(database, contents, made.choices);
  std::vector<Milliseconds> pauses;
  std::vector<Candidate> candidates = merge_neighbours(contents, made.choices, made.selection, pauses);
  const auto selected = Clock::now();

  std::vector<Stretch> stretches;
  std::vector<Notice> notices;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate& candidate = candidates[i];
    const RecordingInfo& info = contents.recordings[candidate.recording];
    const FrameRange frames = clamp({candidate.whole.begin, candidate.whole.end + 1}, info.motion->frames);
    for (const Sign& sign : candidate.left_out) {
      notices.push_back({info.name, fmt::format("'{}' at {} ms has no stroke and stands at a cut: it is left out",
                                                sign.gloss, sign.span.begin.count())});
    }
    stretches.push_back({.recording = info.name,
                         .motion = database.read(info, frames),
                         .frames = frames,
                         .whole = candidate.whole,
                         .core = candidate.core,
                         .clock = info.clock,
                         .signs = std::move(candidate.signs),
                         .pause_before = pauses[i]});
  }
  const auto retrieved = Clock::now();

  std::size_t reference = 0;
  for (std::size_t i = stretches.size(); i-- > 0;) {
    if (stretches[i].recording == edited) reference = i;
  }
  made.result = concatenate(stretches, {.method = options.method,
                                        .duration = duration,
                                        .tempo = options.tempo,
                                        .rate = options.rate.value_or(FrameRate{0, 1}),
                                        .alignment = options.alignment,
                                        .reference = reference});
  made.result.notices = std::move(notices);
  made.layout_from = stretches[reference].recording;
  if (!options.duration.fixed && contents.transitions.count == 0 && !made.result.junctions.empty()) {
    made.result.notices.push_back(
        {"",
         fmt::format("no transition in this database to measure: {} ms taken; --duration sets it", duration.count())});
  }
  const auto done = Clock::now();
  made.result.declarations = declarations_of(database, stretches, made.result.notices);
  made.timings = {.semantic_query = queried - start,
                  .selection = selected - queried,
                  .retrieval = retrieved - selected,
                  .concatenation = done - retrieved,
                  .total = done - start};
  return made;
}

/// Another process may replace a recording between the look at the contents and the reading of its frames. Then all is
/// begun again with what is there now, a few times.
template <typename Attempt>
Synthesized with_fresh_contents(const Database& database, Attempt attempt) {
  constexpr int kTries = 10;
  for (int tries = 1;; ++tries) {
    try {
      const std::shared_ptr<const Contents> contents = database.contents();
      Synthesized made = attempt(*contents);
      made.contents = contents;
      return made;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::conflict || tries == kTries) throw;
    }
  }
}

}  // namespace

Synthesized synthesize(const Database& database, const Utterance& utterance, const SynthesisOptions& options) {
  return with_fresh_contents(database, [&](const Contents& contents) {
    const auto start = Clock::now();
    std::vector<Choice> choices;
    for (const Place& place : utterance.places) {
      choices.push_back({candidates_for(contents, place), place.pause_before});
    }
    return run(database, contents, std::move(choices), {}, options, start);
  });
}

Synthesized synthesize(const Database& database, std::string_view recording, const Edit& edit,
                       const SynthesisOptions& options) {
  return with_fresh_contents(database, [&](const Contents& contents) {
    const auto start = Clock::now();
    return run(database, contents, choices_for(contents, recording, edit), recording, options, start);
  });
}

}  // namespace signweave
