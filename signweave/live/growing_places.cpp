#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/choose/on_skeleton.h"
#include "signweave/choose/select.h"
#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/live/growing_utterance.h"
#include "signweave/retarget/retargeted_source.h"

// How places are decided and signed; where their frames come to lie is in growing_utterance.cpp.
namespace signweave {

namespace {

/// What its frames are of.
std::string key_of(const Stretch& stretch) {
  return fmt::format("{}:{}-{}-{}-{}", stretch.recording, stretch.whole.begin, stretch.core.begin, stretch.core.end,
                     stretch.whole.end);
}

}  // namespace

void GrowingUtterance::check(const Utterance& utterance, std::size_t waiting) {
  if (utterance.places.empty()) return;
  if (waiting + utterance.places.size() > kMostPlaces) {
    throw Error(ErrorCode::bad_input, fmt::format("{} signs would wait, more than {}; send the others later",
                                                  waiting + utterance.places.size(), kMostPlaces));
  }
  if (std::ranges::count(utterance.places, Place::Kind::piece, &Place::kind) >
      static_cast<std::ptrdiff_t>(kMostPieces)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("more than {} pieces of recordings at once; send the others later", kMostPieces));
  }
  for (const Place& place : utterance.places) {
    if (place.pause_before <= kLongestPause) continue;
    throw Error(ErrorCode::bad_input, fmt::format("a pause of {} ms is longer than {} ms; leave out some of its signs",
                                                  place.pause_before.count(), kLongestPause.count()));
  }
  base_.check(base_.database().contents(), utterance.places);
}

/// Which token fills a place: with the one decided before it, and as many places after it as are known and looked at.
const GrowingUtterance::Decision& GrowingUtterance::decide(std::size_t place) {
  std::unique_ptr<const Decision>& decision = decisions_[place];
  if (decision) return *decision;
  const Snapshot& snapshot = open_.snapshot();
  const std::shared_ptr<const Contents>& contents = snapshot.shared_contents();
  const std::shared_ptr<const std::vector<Candidate>> own = base_.candidates(contents, places_[place]);
  if (own->size() == 1) {
    decision = std::make_unique<const Decision>(Decision{contents, own->front()});
    return *decision;
  }
  std::vector<Choice> choices;
  const bool after_another = place > 0 && decisions_[place - 1] && decisions_[place - 1]->contents == contents;
  if (after_another) choices.push_back({{decisions_[place - 1]->candidate}, Milliseconds(0)});
  const std::size_t last = std::min(place + options_.look_ahead, places_.size() - 1);
  choices.push_back({*own, places_[place].pause_before});
  for (std::size_t i = place + 1; i <= last; ++i) {
    try {
      choices.push_back({*base_.candidates(contents, places_[i]), places_[i].pause_before});
    } catch (const Error&) {  // told when its time comes
      break;
    }
  }
  const Seconds transition = base_.durations(contents, options_.synthesis.duration)->mean;
  const Selection selection = select(snapshot, choices, {.transition = transition});
  const std::size_t at = after_another ? 1 : 0;
  decision =
      std::make_unique<const Decision>(Decision{contents, std::move(choices[at].candidates[selection.chosen[at]])});
  return *decision;
}

/// True where what a place was decided by cannot become more.
bool GrowingUtterance::decided_well(std::size_t place) const noexcept {
  return place + options_.look_ahead < places_.size();
}

/// True where a place follows whose token went on from this one in its recording: then both stay together as captured.
bool GrowingUtterance::goes_on(const Candidate& candidate, std::size_t place) {
  if (place >= places_.size() || places_[place].pause_before > Milliseconds(0)) return false;
  const bool was_decided = decisions_[place] != nullptr;
  try {
    const Decision& next = decide(place);
    if (next.contents == decisions_[place - 1]->contents && are_neighbours(*next.contents, candidate, next.candidate)) {
      return true;
    }
  } catch (const Error&) {  // told when its time comes
    return false;
  }
  if (!was_decided && !decided_well(place)) decisions_[place].reset();
  return false;
}

Stretch GrowingUtterance::stretch_of(const Decision& decision, Milliseconds pause) {
  const Candidate& candidate = decision.candidate;
  const RecordingInfo& info = decision.contents->recordings[candidate.recording];
  const auto own = std::make_shared<RecordingSource>(open_, info);
  const std::shared_ptr<const MotionSource> source = on_skeleton(info, own);
  return {.recording = info.name,
          .source = source,
          .whole = candidate.whole,
          .core = candidate.core,
          .clock = info.clock,
          .signs = candidate.signs,
          .pause_before = pause,
          .noise = source == own ? open_.snapshot().joins(candidate.recording)->noise : nullptr};
}

/// A recording's motion on the stream's skeleton.
std::shared_ptr<const MotionSource> GrowingUtterance::on_skeleton(const RecordingInfo& info,
                                                                  std::shared_ptr<const MotionSource> source) {
  if (!header_ || !difference(*header_->skeleton, *source->skeleton())) return source;
  std::weak_ptr<const MotionSource>& known = retargeted_[info.motion->generation];
  std::shared_ptr<const MotionSource> shown = known.lock();
  if (!shown) {
    auto mapping = base_.mapping(open_.snapshot(), info.name, header_->layout_from, *header_->skeleton);
    known = shown = std::make_shared<RetargetedSource>(std::move(source), std::move(mapping));
  }
  return shown;
}

/// How a recording of another skeleton is shown, once.
void GrowingUtterance::tell_mapping(const Entry& entry) {
  const auto* const shown = dynamic_cast<const RetargetedSource*>(entry.woven->stretch.source.get());
  if (shown == nullptr || !told_.insert(entry.woven->stretch.recording).second) return;
  for (const Notice& notice : shown->mapping().notices) {
    events_.push_back({.kind = PlayerEvent::Kind::notice,
                       .frame = static_cast<std::uint64_t>(entry.woven->laid.core),
                       .place = entry.first + forgotten_,
                       .recording = notice.where,
                       .text = notice.text});
  }
}

/// What the first stretch decides for the whole stream.
void GrowingUtterance::begin_header(const Stretch& stretch, const std::shared_ptr<const Contents>& contents) {
  const SynthesisOptions& synthesis = options_.synthesis;
  const TransitionMethod* const method = synthesis.method != nullptr ? synthesis.method : &transition_methods().front();
  rig_ = base_.rig(open_.snapshot(), stretch.recording);
  fit_ = base_.durations(contents, synthesis.duration);
  if (method->fill->needs != Needs::nothing) {
    spans_ = base_.spans(open_.snapshot(), stretch, *rig_, method->fill->needs);
  }
  const JunctionSettings settings{.skeleton = stretch.source->skeleton(),
                                  .rate = synthesis.rate.value_or(stretch.source->rate()),
                                  .method = method,
                                  .rig = rig_.get(),
                                  .model = spans_ != nullptr ? spans_->model.get() : nullptr};
  weaver_.emplace(settings, TransitionTiming{.fit = fit_.get(), .tempo = synthesis.tempo},
                  base_.tracks(*contents, stretch.recording), synthesis.alignment, stretch);
  if (options_.idle == Idle::living_rest) {
    const std::shared_ptr<const KnownRest> known = base_.rest(open_.snapshot(), stretch, *rig_);
    RestPose rest = known->rest;
    Motion alone(settings.skeleton, settings.rate);
    alone.append(rest.pose.view());
    apply(align(standing_over(alone, {0, 1}), weaver_->home()), *settings.skeleton, rest.pose.view());
    rest.tracks.assign(weaver_->tracks().size(), 0.0f);
    for (std::size_t i = 0; i < known->tracks.size(); ++i) {
      const auto at = std::ranges::find(weaver_->tracks(), known->tracks[i]);
      if (at == weaver_->tracks().end()) continue;
      rest.tracks[static_cast<std::size_t>(at - weaver_->tracks().begin())] = known->rest.tracks[i];
    }
    living_ = std::make_shared<const LivingRest>(settings.skeleton, settings.rate, rig_->signer.rig, std::move(rest),
                                                 weaver_->tracks(), LivingRestOptions{.seed = base_.new_seed()});
  }
  const Milliseconds fixed = synthesis.duration.fixed.value_or(Milliseconds(-1));
  settings_key_ = fmt::format("{} {} {}/{} {} {} {} {} {}", base_.state_number(contents), method->name,
                              settings.rate.numerator, settings.rate.denominator, synthesis.tempo, fixed.count(),
                              synthesis.duration.fitted, static_cast<int>(synthesis.alignment), key_of(stretch));
  header_ = {.skeleton = settings.skeleton,
             .rate = settings.rate,
             .tracks = weaver_->tracks(),
             .layout_from = stretch.recording,
             .declarations = *base_.declarations(contents)};
}

void GrowingUtterance::rest_in(const std::string& recording) {
  const std::shared_ptr<const Contents>& contents = open_.snapshot().shared_contents();
  const RecordingInfo& info = contents->at(recording);
  if (!info.motion) throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion", info.name));
  const FrameRange all{0, info.motion->frames};
  begin_header({.recording = info.name,
                .source = std::make_shared<RecordingSource>(open_, info),
                .whole = all,
                .core = clamp({0, kBodyFrames}, info.motion->frames),
                .clock = info.clock,
                .signs = {}},
               contents);
  if (options_.idle != Idle::living_rest) return;
  tail_ = living_rest();
  tail_->laid.core = end_;
  state_ = State::resting;
}

/// Joins the next place to what is there, and the places after it that stay together with it.
void GrowingUtterance::sign_next() {
  if (next_ >= places_.size()) {  // a loop begins anew
    next_ = 0;
    last_round_ = std::exchange(entries_, {});
    last_signs_.reset();
  }
  const std::size_t first = next_++;  // whatever happens, it is not tried again
  const Decision& decision = decide(first);
  const Milliseconds pause = places_[first].pause_before;
  if (state_ == State::at_core && last_signs_ && tail_ == last_sign_ && !entries_.empty() && first > 0 &&
      pause == Milliseconds(0) && decisions_[first - 1] && decisions_[first - 1]->contents == decision.contents &&
      are_neighbours(*decision.contents, *last_signs_, decision.candidate)) {
    go_on_as_captured(first);
    return;
  }
  auto woven = std::make_shared<Woven>();
  woven->stretch = stretch_of(decision, pause);
  Candidate signs = decision.candidate;
  std::size_t last = first;
  while (goes_on(signs, last + 1)) go_on_with(signs, decisions_[++last]->candidate);
  woven->stretch.core = signs.core;
  woven->stretch.whole = signs.whole;
  if (!header_) begin_header(woven->stretch, decision.contents);
  weaver_->lay_sign(*woven);
  woven->key = key_of(woven->stretch);

  Entry entry{.woven = woven, .first = first, .last = last};
  if (state_ == State::nothing && options_.idle == Idle::living_rest) {  // out of a rest that nobody saw
    tail_ = living_rest();
    tail_->laid.core_frames = history();
    tail_->laid.core = end_ - history();
  } else if (state_ == State::resting) {
    tail_->laid.core_frames = end_ - tail_->laid.core;
    tail_->key.clear();  // the way out of it depends on the moment
  }
  if (tail_ == nullptr) {
    woven->laid.before = woven->laid.preparation;
    woven->laid.core = end_ + woven->laid.preparation;
    weaver_->place(*woven);
    append({end_, woven->laid.core}, woven);
    entry.core = woven->laid.preparation;
  } else {
    std::shared_ptr<const Motion> made = join(*tail_, *woven);
    entry.joined = !entries_.empty() && tail_ == entries_.back().woven;
    if (!entries_.empty()) entry.begin = entries_.back().core + entries_.back().woven->laid.core_frames;
    entry.core = entry.begin + (entry.joined ? made->frame_count() : woven->laid.preparation);
    append({end_, woven->laid.core}, std::move(made));
  }
  append({end_, woven->laid.core_end()}, woven);
  next_ = last + 1;
  entries_.push_back(std::move(entry));
  tail_ = last_sign_ = std::move(woven);
  last_signs_ = std::move(signs);
  state_ = State::at_core;
  tell_mapping(entries_.back());
  tell_places(entries_.back(), 0);
}

/// The place goes on from the tail in its recording: the tail becomes longer.
void GrowingUtterance::go_on_as_captured(std::size_t place) {
  const Candidate& candidate = decisions_[place]->candidate;
  go_on_with(*last_signs_, candidate);
  Woven& woven = *tail_;
  const Laid before = woven.laid;
  const std::optional<GroundTransform> transform = woven.laid.standing;
  woven.stretch.core.end = candidate.core.end;
  woven.stretch.whole.end = candidate.whole.end;
  weaver_->lay_sign(woven);
  woven.laid.core = before.core;
  woven.laid.before = before.before;
  woven.laid.standing = transform;
  woven.key.clear();  // it stands where its beginning alone was brought
  append({end_, woven.laid.core_end()}, tail_);
  entries_.back().last = place;
  Entry told = entries_.back();
  told.first = place;
  tell_places(told, 0);
}

/// Events of the places whose strokes begin at or after a frame.
void GrowingUtterance::tell_places(const Entry& entry, std::int64_t from) {
  const Laid& laid = entry.woven->laid;
  for (std::size_t place = entry.first; place <= entry.last; ++place) {
    const Candidate& candidate = decisions_[place]->candidate;
    const std::int64_t frame = laid.frame_of(candidate.core.begin);
    for (const Sign& sign : candidate.left_out) {
      events_.push_back({.kind = PlayerEvent::Kind::notice,
                         .frame = static_cast<std::uint64_t>(std::max(frame, from)),
                         .place = place + forgotten_,
                         .recording = entry.woven->stretch.recording,
                         .text = fmt::format("'{}' at {} ms has no stroke and stands at a cut: it is left out",
                                             printable(sign.gloss), sign.span.begin.count())});
    }
    if (frame < from) continue;
    events_.push_back({.kind = PlayerEvent::Kind::place,
                       .frame = static_cast<std::uint64_t>(frame),
                       .place = place + forgotten_,
                       .gloss = candidate.signs.empty() ? std::string() : candidate.gloss(),
                       .token = candidate.token,
                       .recording = entry.woven->stretch.recording,
                       .at = time_of(entry.core + frame - laid.core)});
  }
}

}  // namespace signweave
