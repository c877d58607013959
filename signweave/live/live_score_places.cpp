#include <fmt/format.h>

#include <algorithm>

#include "signweave/choose/handedness.h"
#include "signweave/choose/inflect.h"
#include "signweave/choose/lint.h"
#include "signweave/choose/notices.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/core/error.h"
#include "signweave/live/live_score.h"
#include "signweave/retarget/mirrored_source.h"
#include "signweave/retarget/retargeted_source.h"

// Signing of places; the positions of their frames are managed in live_score.cpp.
namespace signweave {

/// The clip of a place's token. It is mirrored if the hand that is to be dominant there is another than its signer's,
/// unless `mirrored` says so for it, and mirrored once more if `exchanged`.
MotionClip LiveScore::clip_of(const Contents& contents, const Candidate& candidate, std::size_t place,
                              std::optional<bool> mirrored, bool exchanged) {
  const RecordingInfo& info = contents.recordings[candidate.recording];
  const auto own = std::make_shared<RecordingSource>(open_, info);
  MotionClip clip{.recording = info.name,
                  .source = own,
                  .whole = candidate.whole,
                  .core = candidate.core,
                  .clock = info.clock,
                  .signs = candidate.signs,
                  .pause_before = queue_.pause_before(place),
                  .fingerprint = info.motion_facts.fingerprint,
                  .place = place + queue_.forgotten()};
  std::vector<Notice> notices;
  if (const std::optional<Side> hand = queue_.wanted_hand(place); hand || mirrored || exchanged) {
    mark_mirrored({&clip, 1}, {&hand, 1}, open_.snapshot(), notices);
    clip.mirrored = mirrored.value_or(clip.mirrored) != exchanged;
    mirror_marked({&clip, 1}, open_.snapshot(), notices);
  }
  clip.source = on_skeleton(info, clip.source);
  if (clip.source == own) clip.noise = open_.snapshot().joins(candidate.recording)->noise;
  return clip;
}

/// A recording's motion on the stream's skeleton.
std::shared_ptr<const MotionSource> LiveScore::on_skeleton(const RecordingInfo& info,
                                                           std::shared_ptr<const MotionSource> source) {
  if (!setup_ || have_same_joints(setup_->header.skeleton, source->skeleton())) return source;
  const bool is_mirrored = dynamic_cast<const MirroredSource*>(source.get()) != nullptr;
  std::weak_ptr<const MotionSource>& known = bodies_.shown[{info.motion->generation, is_mirrored}];
  std::shared_ptr<const MotionSource> shown = known.lock();
  if (!shown) {
    auto mapping = cache_.mapping(open_.snapshot(), info.name, setup_->header.layout_from, *setup_->header.skeleton);
    known = shown = std::make_shared<RetargetedSource>(std::move(source), std::move(mapping));
  }
  return shown;
}

/// Adds an event after those of earlier frames and of its own.
void LiveScore::add_event(PlayerEvent event, std::optional<std::string> once) {
  reports_.events.push_back({.event = std::move(event), .once = std::move(once)});
}

/// Reports how the stream is signed, and how a recording with another skeleton is retargeted, once each.
void LiveScore::report_setup(const Entry& entry) {
  const auto report = [&](const std::vector<Notice>& notices, const std::string& once) {
    if (!reports_.of_stream.insert(once).second) return;
    for (const Notice& notice : notices) {
      add_event({.kind = PlayerEvent::Kind::notice,
                 .frame = static_cast<std::uint64_t>(entry.clip->placed.core),
                 .place = entry.first + queue_.forgotten(),
                 .recording = notice.where,
                 .text = notice.text},
                once);
    }
  };
  report(setup_->notices, {});
  const auto* const shown = dynamic_cast<const RetargetedSource*>(entry.clip->captured.source.get());
  if (shown != nullptr) report(shown->mapping().notices, entry.clip->captured.recording);
}

/// Reports what is rarely done in the step whose first clip this is, at `from` or later. Rounds of a loop, and a place
/// that is signed again after a jump, report nothing of the same kind for it; nothing is said twice in an utterance.
void LiveScore::report_channels(const Entry& first, std::int64_t from) {
  const std::size_t place = first.first + queue_.forgotten();
  std::set<ReportedNotice> now;
  for (const Notice& notice : first.step->notices) {
    const bool is_known = std::ranges::any_of(reports_.of_places, [&](const ReportedNotice& one) {
      return one.text == notice.text || (one.place == place && one.code == notice.code);
    });
    if (is_known || !now.insert({place, notice.code, notice.text}).second) continue;
    const std::int64_t frame = std::max(first.clip->placed.core, from);
    add_event({.kind = PlayerEvent::Kind::notice,
               .frame = static_cast<std::uint64_t>(frame),
               .place = place,
               .at = time_of(first.core + frame - first.clip->placed.core),
               .text = notice.text,
               .code = notice.code});
  }
  reports_.of_places.merge(now);
}

void LiveScore::rest_in(const std::string& recording) {
  const std::shared_ptr<const Contents>& contents = open_.snapshot().shared_contents();
  const RecordingInfo& info = contents->at(recording);
  if (!info.motion) throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion", info.name));
  const FrameRange all{0, info.motion->frames};
  const MotionClip first{.recording = info.name,
                         .source = std::make_shared<RecordingSource>(open_, info),
                         .whole = all,
                         .core = clamp({0, kBodyFrames}, info.motion->frames),
                         .clock = info.clock,
                         .signs = {},
                         .fingerprint = info.motion_facts.fingerprint};
  setup_ = set_up(cache_, open_.snapshot(), contents, first, options_);
  if (options_.idle != Idle::living_rest) return;
  chain_.begin(place_rest(*setup_));
  tail().placed.core = end();
  state_ = State::resting;
}

/// Joins the next place to the tail, with the following places that stay together with it.
void LiveScore::sign_next() {
  if (queue_.restarts()) {
    last_round_ = std::exchange(round_, {});
    last_sign_.signs.reset();
  }
  const std::size_t first = queue_.take_next();  // not retried, even after an error
  if (queue_.is_tied(first) || (!chain_.empty() && !chain_.is_uniform())) {
    sign_in_channels(first);
    return;
  }
  const PlaceQueue::Decision& decision = queue_.decide(first);
  if (state_ == State::at_core && last_sign_.signs && chain_.back() == last_sign_.clip && !round_.entries.empty() &&
      queue_.follows(*last_sign_.signs, first)) {
    continue_as_captured(first);
    return;
  }
  auto clip = std::make_shared<LiveClip>();
  clip->captured = clip_of(*decision.contents, decision.candidate, first, {}, queue_.space(first).mirrored);
  Candidate signs = decision.candidate;
  std::size_t last = first;
  std::vector<std::size_t> sign_places(signs.signs.size(), *clip->captured.place);
  while (queue_.will_follow(signs, last + 1)) {
    const Candidate& next = queue_.chosen(++last);
    sign_places.insert(sign_places.end(), next.signs.size(), last + queue_.forgotten());
    extend_with(signs, next);
  }
  clip->captured.core = signs.core;
  clip->captured.whole = signs.whole;
  clip->captured.signs = signs.signs;
  clip->captured.sign_places = std::move(sign_places);
  set_up_for(clip->captured, decision.contents);
  change_in_space(clip->captured, first, 0);
  setup_->builder->place_sign(*clip);
  clip->key = key_of(clip->captured);

  Entry entry{.clip = clip, .first = first, .last = last};
  leave_idle();
  if (chain_.empty()) {
    clip->placed.before = clip->placed.preparation;
    clip->placed.core = end() + clip->placed.preparation;
    setup_->builder->place_first(*clip);
    timeline_.append({end(), clip->placed.core}, clip);
    entry.core = clip->placed.preparation;
    chain_.begin(clip);
  } else {
    std::shared_ptr<const Motion> made = join(tail(), *clip);
    entry.joined = !round_.entries.empty() && chain_.back() == round_.entries.back().clip;
    if (!round_.entries.empty())
      entry.begin = round_.entries.back().core + round_.entries.back().clip->placed.core_frames;
    entry.core = entry.begin + (entry.joined ? made->frame_count() : clip->placed.preparation);
    timeline_.append({end(), clip->placed.core}, std::move(made));
    chain_.add(clip);
  }
  timeline_.append({end(), clip->placed.core_end()}, clip);
  queue_.continue_at(last + 1);
  round_.entries.push_back(std::move(entry));
  last_sign_ = {.clip = std::move(clip), .signs = std::move(signs)};
  state_ = State::at_core;
  report_setup(round_.entries.back());
  report_places(round_.entries.back(), 0);
}

void LiveScore::set_up_for(const MotionClip& first, const std::shared_ptr<const Contents>& contents) {
  if (setup_) return;
  PlayerOptions options = options_;
  if (!queue_.non_manuals().empty()) options.face = true;
  setup_ = set_up(cache_, open_.snapshot(), contents, first, options);
}

/// Changes a clip of a place, its n-th repetition, as the place asks.
void LiveScore::change_in_space(MotionClip& clip, std::size_t place, std::size_t repetition) {
  const SpaceChange& change = queue_.space(place);
  if (changes_nothing(change)) return;
  const ClipToInflect one{.clip = &clip, .place = place, .change = repetitions_of(change)[repetition]};
  std::vector<Notice> notices;
  inflect({&one, 1}, queue_.loci(), open_.snapshot(), setup_->rig, options_.synthesis.space, notices);
  if (options_.synthesis.strict) refuse(notices);
  for (const Notice& notice : notices) {
    const std::size_t number = place + queue_.forgotten();
    if (!reports_.of_places.insert({number, notice.code, notice.text}).second) continue;
    add_event({.kind = PlayerEvent::Kind::notice,
               .frame = static_cast<std::uint64_t>(end()),
               .place = number,
               .recording = notice.where,
               .text = notice.text,
               .code = notice.code});
  }
}

/// Ends the rest before a sign.
void LiveScore::leave_idle() {
  if (state_ == State::nothing && options_.idle == Idle::living_rest) {  // starting from an invisible rest
    chain_.begin(place_rest(*setup_));
    tail().placed.core_frames = history();
    tail().placed.core = end() - history();
  } else if (state_ == State::resting) {
    leave_rest_at(end());
  }
}

/// Keeps a clip of which more is captured now where it is.
void LiveScore::extended(LiveClip& clip) const {
  const PlacedClip before = clip.placed;
  setup_->builder->place_sign(clip);
  clip.placed.core = before.core;
  clip.placed.before = before.before;
  clip.placed.standing = before.standing;
  if (clip.key.empty()) return;
  // Its standing was measured from its first ends, so it is not the clip that is chosen with these ends.
  clip.key.resize(std::min(clip.key.size(), clip.key.find(" on to ", clip.key.rfind(':'))));
  clip.key += fmt::format(" on to {}-{}", clip.captured.core.end, clip.captured.whole.end);
}

/// Adds a notice among the events of its frame.
void LiveScore::notify(std::int64_t frame, std::size_t place, std::string text) {
  const auto at = static_cast<std::uint64_t>(frame);
  const auto after =
      std::ranges::upper_bound(reports_.events, at, {}, [](const Pending& pending) { return pending.event.frame; });
  reports_.events.insert(
      after, {.event = {.kind = PlayerEvent::Kind::notice, .frame = at, .place = place, .text = std::move(text)}});
}

/// The place follows the tail in its recording, so the tail is extended.
void LiveScore::continue_as_captured(std::size_t place) {
  const Candidate& candidate = queue_.chosen(place);
  extend_with(*last_sign_.signs, candidate);
  LiveClip& clip = tail();
  clip.captured.core.end = candidate.core.end;
  clip.captured.whole.end = candidate.whole.end;
  clip.captured.signs = last_sign_.signs->signs;
  clip.captured.sign_places.resize(clip.captured.signs.size(), place + queue_.forgotten());
  extended(clip);
  timeline_.append({end(), clip.placed.core_end()}, chain_.back());
  round_.entries.back().last = place;
  Entry now = round_.entries.back();
  now.first = place;
  report_places(now, 0);
}

/// Adds events for the places whose strokes begin at or after `from`.
void LiveScore::report_places(const Entry& entry, std::int64_t from) {
  const PlacedClip& placed = entry.clip->placed;
  for (std::size_t place = entry.first; place <= entry.last; ++place) {
    const Candidate& candidate = queue_.chosen(place);
    const std::int64_t frame = placed.frame_of(candidate.core.begin);
    for (const Sign& sign : candidate.left_out) {
      add_event({.kind = PlayerEvent::Kind::notice,
                 .frame = static_cast<std::uint64_t>(std::max(frame, from)),
                 .place = place + queue_.forgotten(),
                 .recording = entry.clip->captured.recording,
                 .text = notice_left_out(entry.clip->captured.recording, sign).text});
    }
    if (frame < from) continue;
    add_event({.kind = PlayerEvent::Kind::place,
               .frame = static_cast<std::uint64_t>(frame),
               .place = place + queue_.forgotten(),
               .gloss = candidate.signs.empty() ? std::string() : candidate.gloss(),
               .token = candidate.token,
               .recording = entry.clip->captured.recording,
               .clip = entry.clip->number,
               .at = time_of(entry.core + frame - placed.core)});
  }
}

}  // namespace signweave
