#include "signweave/live/live_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"

// The score and its timeline; signing of places is in live_score_places.cpp.
namespace signweave {
namespace {

/// Number of frames read at once.
constexpr std::int64_t kChunk = 64;

}  // namespace

LiveScore::LiveScore(SharedSigningCache& cache, const PlayerOptions& options)
    : cache_(cache), options_(options), open_(cache.database()), queue_(cache, open_, options_) {
  options_.synthesis.space.learned = cache.learned_strokes();
  // What is planned needs the whole utterance; the living rest blinks.
  options_.synthesis.non_manuals.gaze = options_.synthesis.non_manuals.blinks = false;
}

std::int64_t LiveScore::history() const noexcept {
  return setup_ ? context_frames(setup_->header.rate) : 1;
}

bool LiveScore::extend(const FrameRing& shown) {
  try {
    return grow();
  } catch (const Error&) {
    if (!chain_.empty() && !can_read(tail())) continue_from(shown);
    throw;
  }
}

/// False if the clip's recording has been removed since, or is damaged.
bool LiveScore::can_read(const LiveClip& clip) const {
  Motion one(setup_->header.skeleton, setup_->header.rate, 1);
  const std::int64_t last = clip.placed.core_end() - 1;
  try {
    setup_->builder->read(clip, {last, last + 1}, one.poses({0, 1}), {});
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Continues from the frames made so far, because the placed clip cannot be read.
void LiveScore::continue_from(const FrameRing& made) {
  last_sign_ = {};
  if (made.end() > made.begin()) {
    chain_.begin(history_of(made.end(), made));
    state_ = State::at_core;
  } else {
    chain_.clear();
    state_ = State::nothing;
  }
  cut(made.end());
}

bool LiveScore::grow() {
  if (queue_.has_next()) {
    const std::int64_t from = end();
    const std::size_t first = queue_.restarts() ? 0 : queue_.next();
    try {
      sign_next();
      while (queue_.goes_on()) sign_next();  // where a non-manual ends must be known
    } catch (const Error&) {
      author(first, from);
      throw;
    }
    author(first, from);
    return true;
  }
  switch (state_) {
    case State::nothing:
    case State::ended:
      return false;
    case State::at_core:
      if (options_.idle == Idle::end) {
        end_at_last_sign();
      } else if (chain_.is_uniform()) {
        go_to_rest();
      } else {
        go_to_rest_in_channels();
      }
      return true;
    case State::resting:
      timeline_.append({end(), end() + kRestFramesAtOnce}, chain_.back());
      return true;
  }
  return false;
}

/// Shows the last retraction.
void LiveScore::end_at_last_sign() {
  const std::int64_t core_end = tail().placed.core_end();
  if (chain_.is_uniform()) {
    timeline_.append({end(), end() + tail().placed.retraction}, chain_.back());
  } else {
    const StepPtr step = lower_hands();
    timeline_.append({end(), step->end()}, step->made, step->begin);
  }
  state_ = State::ended;
  add_event({.kind = PlayerEvent::Kind::end,
             .frame = static_cast<std::uint64_t>(end()),
             .at = end_of_last_sign() + time_of(end() - core_end)});
}

void LiveScore::go_to_rest() {
  const ClipPtr rest = place_rest(*setup_);
  std::shared_ptr<const Motion> made = join(tail(), *rest);
  const std::int64_t made_frames = made->frame_count();
  timeline_.append({end(), rest->placed.core}, std::move(made));
  chain_.add(rest);
  state_ = State::resting;
  add_event({.kind = PlayerEvent::Kind::rest,
             .frame = static_cast<std::uint64_t>(end()),
             .at = end_of_last_sign() + time_of(made_frames)});
  timeline_.append({end(), end() + kRestFramesAtOnce}, rest);
}

/// Places b after a. Returns the frames between them, from the cache if possible.
std::shared_ptr<const Motion> LiveScore::join(LiveClip& a, LiveClip& b) {
  std::string key;
  if (!a.key.empty() && !b.key.empty()) {
    key = fmt::format("{}|{}|{}|{}", setup_->key, a.key, b.key, b.captured.pause_before.count());
    if (const std::shared_ptr<const MadeTransition> made = cache_.transitions().find(key)) {
      a.placed.after = 0;
      b.placed.before = 0;
      place_after(a.placed, b.placed, made->cuts);
      b.cuts = made->cuts;
      b.placed.standing = made->standing;
      return made->frames;
    }
  }
  auto frames = std::make_shared<Motion>();
  const JunctionCuts cuts = setup_->builder->join(a, b, *frames);
  if (!key.empty()) {
    cache_.transitions().keep(key,
                              std::make_shared<const MadeTransition>(MadeTransition{cuts, b.placed.standing, frames}));
  }
  return frames;
}

LiveScore::ClipPtr LiveScore::history_of(std::int64_t next, const FrameRing& shown) const {
  const std::int64_t first = std::max(shown.begin(), next - history());
  return shown_clip(shown_frames(first, next, shown), first);
}

Motion LiveScore::shown_frames(std::int64_t first, std::int64_t end, const FrameRing& shown) const {
  Motion motion(setup_->header.skeleton, setup_->header.rate, end - first);
  std::vector<ScalarTrack> tracks;
  for (const std::string& name : setup_->header.tracks) tracks.push_back({name, {}});
  for (std::int64_t frame = first; frame < end; ++frame) {
    const FrameView view = shown.at(frame);
    const MutablePoseView pose = motion.pose(frame - first);
    std::ranges::copy(view.pose.rotations, pose.rotations.begin());
    std::ranges::copy(view.pose.translations, pose.translations.begin());
    for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].values.push_back(view.tracks[i]);
  }
  for (ScalarTrack& track : tracks) motion.add_track(std::move(track));
  return motion;
}

/// A clip of frames that the stream shows, from `first` on.
LiveScore::ClipPtr LiveScore::shown_clip(Motion motion, std::int64_t first) const {
  auto history = std::make_shared<LiveClip>();
  const FrameRange all{0, motion.frame_count()};
  history->captured = {.recording = {},
                       .source = std::make_shared<MemorySource>(std::move(motion)),
                       .whole = all,
                       .core = all,
                       .clock = {setup_->header.rate.frame_time(), Seconds(0)},
                       .signs = {},
                       .kind = SourceRef::Kind::shown};
  setup_->builder->place_frames(*history);
  history->placed.core = first;
  return history;
}

void LiveScore::cut(std::int64_t end) {
  curves_.cut(end);
  while (!reports_.events.empty() && reports_.events.back().event.frame >= static_cast<std::uint64_t>(end)) {
    const auto& [event, once] = reports_.events.back();
    if (once) reports_.of_stream.erase(*once);
    if (!event.code.empty()) reports_.of_places.erase({event.place, event.code, event.text});
    reports_.events.pop_back();
  }
  timeline_.cut(end);
}

/// Removes what follows the last sign.
void LiveScore::end_with_last_sign() {
  chain_.end_with(last_sign_.clip);
  cut(chain_.core_end());
  state_ = State::at_core;
}

/// Continues from the shown pose.
void LiveScore::leave(std::int64_t next, const FrameRing& shown) {
  if (state_ == State::nothing) return;
  last_sign_.clip.reset();
  curves_.clear();  // the shown pose has them
  if (state_ == State::resting && next > tail().placed.core) {
    leave_rest_at(next);
  } else if (next > shown.begin()) {
    chain_.begin(history_of(next, shown));
  } else {  // nothing was shown yet
    cut(next);
    chain_.clear();
    state_ = State::nothing;
    return;
  }
  cut(next);
  state_ = State::at_core;
}

/// Ends the rest, which is the tail, at `next`.
void LiveScore::leave_rest_at(std::int64_t next) {
  tail().placed.core_frames = next - tail().placed.core;
  tail().key.clear();  // the following transition depends on `next`
}

void LiveScore::add(const Utterance& utterance, std::int64_t next, const FrameRing& shown) {
  queue_.check(utterance, true);
  forget_places();
  queue_.add(utterance, let_go_on(utterance, next));
  if (!utterance.places.empty()) reopen(next, shown);
}

void LiveScore::set_loop(bool loop, std::int64_t next, const FrameRing& shown) {
  queue_.set_loop(loop);
  if (queue_.has_next()) reopen(next, shown);
}

/// Continues after what was the end.
void LiveScore::reopen(std::int64_t next, const FrameRing& shown) {
  if (state_ != State::resting && state_ != State::ended) return;
  if (last_sign_.clip != nullptr && next <= last_sign_.clip->placed.core_end()) {
    chain_.end_with(last_sign_.clip);
    state_ = State::at_core;
    if (next <= chain_.core_end()) {
      cut(chain_.core_end());
      return;
    }
  }
  leave(next, shown);
}

void LiveScore::forget_places() {
  const std::size_t count = queue_.forget();
  if (count == 0) return;
  parts_.clear();
  reports_.of_places.clear();
  std::erase_if(round_.entries, [&](const Entry& entry) { return entry.first < count; });
  for (Entry& entry : round_.entries) {
    entry.first -= count;
    entry.last -= count;
  }
  if (!round_.entries.empty()) {
    Entry& front = round_.entries.front();
    if (!front.step) front.begin = front.core - front.clip->placed.preparation;
    front.joined = false;
  }
  round_.authored.erase(round_.authored.begin(), round_.authored.lower_bound(queue_.forgotten_non_manuals()));
}

void LiveScore::replace(const Utterance& utterance, std::int64_t next, const FrameRing& shown) {
  queue_.check(utterance, false);
  const bool finished = finish_sign(next, shown);
  queue_.replace(utterance);
  parts_.clear();
  reports_.of_places.clear();
  round_ = {};
  last_round_ = {};
  last_sign_.signs.reset();
  if (finished || state_ == State::nothing) return;
  if (queue_.empty() && state_ != State::at_core) return;  // moving to rest, or at rest
  if (state_ == State::at_core && next >= end()) return;
  leave(next, shown);
}

/// If a sign's core is shown, ends the timeline with that sign, or immediately if it is long. Returns false otherwise.
bool LiveScore::finish_sign(std::int64_t next, const FrameRing& shown) {
  if (round_.entries.empty() && last_sign_.clip != nullptr && next >= last_sign_.clip->placed.core &&
      next < last_sign_.clip->placed.core_end()) {  // as cut when the last utterance began
    end_with_last_sign();
    return true;
  }
  const ClipPtr clip = timeline_.clip_at(next);
  if (clip == nullptr) return finish_in_channels(next, shown);
  const PlacedClip& placed = clip->placed;
  if (clip->captured.kind == SourceRef::Kind::rest || next < placed.core || next >= placed.core_end()) return false;
  std::optional<std::size_t> last_place;  // none: all its signs are finished
  FrameRange core = clip->captured.core;
  FrameRange whole = clip->captured.whole;
  const auto entry = std::ranges::find(round_.entries, clip, &Entry::clip);
  for (std::size_t place = entry == round_.entries.end() ? 1 : entry->first;
       entry != round_.entries.end() && place <= entry->last; ++place) {
    const Candidate& candidate = queue_.chosen(place);
    if (next >= placed.frame_of(candidate.core.end)) continue;
    core.end = candidate.core.end;
    whole.end = candidate.whole.end;
    last_place = place + queue_.forgotten();
    break;
  }
  auto last = std::make_shared<LiveClip>();
  last->captured = clip->captured;
  last->captured.core.end = core.end;
  last->captured.whole = whole;
  if (last_place) {
    const auto end = std::ranges::upper_bound(last->captured.sign_places, *last_place);
    const auto kept = end - last->captured.sign_places.begin();
    last->captured.signs.erase(last->captured.signs.begin() + kept, last->captured.signs.end());
    last->captured.sign_places.erase(end, last->captured.sign_places.end());
  }
  setup_->builder->place_sign(*last);
  last->placed.core = placed.core;
  last->placed.before = placed.before;
  last->placed.standing = clip->placed.standing;
  last->placed.core_frames = std::min(last->placed.core_frames, placed.core_frames);
  last->cuts = clip->cuts;
  const auto soon = static_cast<std::int64_t>(kFinished.count() * setup_->header.rate.hertz());
  if (last->placed.core_end() - next > soon) {
    if (next == placed.core) return false;
    last->placed.core_frames = next - placed.core;
    last->placed.retraction = 0;
  }
  chain_.end_with(clip);
  chain_.replace_back(last);
  timeline_.replace(clip, last);
  if (entry != round_.entries.end()) {
    curves_.end_after(last_place.value_or(entry->last + queue_.forgotten()), last->placed.core_end(),
                      setup_->header.rate);
  }
  last_sign_.clip = std::move(last);
  end_with_last_sign();
  return true;
}

bool LiveScore::seek(std::int64_t at, std::int64_t next) {
  if (round_.entries.empty()) return false;
  const auto end_of = [](const Entry& entry) { return entry.core + entry.clip->placed.core_frames; };
  // A loop that has just restarted: later places are found in the previous round.
  const bool earlier = at >= end_of(round_.entries.back()) && !last_round_.entries.empty();
  const std::vector<Entry>& entries = earlier ? last_round_.entries : round_.entries;
  at = std::clamp<std::int64_t>(at, entries.front().begin, end_of(entries.back()) - 1);
  std::size_t index = entries.size() - 1;
  while (index > 0 && entries[index].begin > at) --index;
  const Entry& entry = entries[index];
  if (entry.step) {
    if (earlier) round_ = std::move(last_round_);
    seek_in_step(index, at, next);
    last_round_ = {};
    return true;
  }
  const ClipPtr clip = entry.clip;
  ClipPtr before_it;
  std::shared_ptr<const Motion> made;
  if (at < entry.core && entry.joined) {
    before_it = entries[index - 1].clip;
    LiveClip& before = *before_it;
    const PlacedClip was = before.placed;
    const PlacedClip will = clip->placed;
    before.placed.core = next - (at - entries[index - 1].core);
    try {
      made = join(before, *clip);
    } catch (const Error&) {  // nothing has changed
      before.placed = was;
      clip->placed = will;
      throw;
    }
  } else {
    clip->placed.core = next + entry.core - at;
  }
  cut(next);
  timeline_.restart(next);
  add_event({.kind = PlayerEvent::Kind::seek, .frame = static_cast<std::uint64_t>(next), .at = time_of(at)});
  if (made != nullptr) {
    chain_.begin(std::move(before_it));
    chain_.add(clip);
    timeline_.append({next, clip->placed.core}, std::move(made));
  } else {
    clip->cuts.reset();
    chain_.begin(clip);
    timeline_.append({next, clip->placed.core}, clip);
  }
  timeline_.append({std::max(next, clip->placed.core), clip->placed.core_end()}, clip);
  if (earlier) round_ = std::move(last_round_);
  last_round_ = {};
  round_.entries.resize(index + 1);
  queue_.continue_at(round_.entries.back().last + 1);
  last_sign_ = {.clip = clip, .signs = {}};
  state_ = State::at_core;
  show_authored(next);
  report_places(round_.entries.back(), next);
  return true;
}

void LiveScore::read(std::int64_t until, FrameRing& ring) {
  const std::size_t joints = setup_->header.skeleton->joint_count();
  while (ring.end() < until) {
    const std::int64_t end_of_same = timeline_.end_of_same(ring.end());
    const std::int64_t count = ring.room(std::min({until, end_of_same, ring.end() + kChunk}) - ring.end());
    if (count <= 0) return;
    const MutablePoses poses = ring.poses(count);
    try {
      timeline_.read({ring.end(), ring.end() + count}, *setup_->builder, ring);
    } catch (const Error&) {
      continue_from(ring);
      throw;
    }
    if (curves_.cover({ring.end(), ring.end() + count})) {
      curves_.show(ring, count, setup_->header.tracks, setup_->builder->settings());
    }
    if (ring.end() > ring.begin()) {
      // Each rotation keeps its quaternion sign over the whole stream.
      const PoseView before = ring.at(ring.end() - 1).pose;
      for (std::size_t joint = 0; joint < joints; ++joint) {
        if (before.rotations[joint].dot(poses.rotations[joint]) >= 0) continue;
        for (std::size_t at = joint; at < poses.rotations.size(); at += joints) poses.rotations[at].coeffs() *= -1.0f;
      }
    }
    ring.grow(count);
  }
}

void LiveScore::let_go(std::int64_t taken) noexcept {
  open_.close();
  timeline_.forget(taken);
}

std::optional<PlayerEvent> LiveScore::take_event(std::int64_t frame) noexcept {
  if (reports_.events.empty() || reports_.events.front().event.frame > static_cast<std::uint64_t>(frame))
    return std::nullopt;
  std::optional<PlayerEvent> event(std::move(reports_.events.front().event));
  reports_.events.pop_front();
  return event;
}

bool LiveScore::idle(std::int64_t frame) const noexcept {
  if (queue_.has_next()) return false;
  return state_ == State::nothing || (state_ == State::ended && frame >= end()) ||
         (state_ == State::resting && frame >= tail().placed.core);
}

Milliseconds LiveScore::end_of_last_sign() const noexcept {
  return round_.entries.empty() ? Milliseconds(0)
                                : time_of(round_.entries.back().core + round_.entries.back().clip->placed.core_frames);
}

Milliseconds LiveScore::time_of(std::int64_t frames) const noexcept {
  return Milliseconds(std::llround(static_cast<double>(frames) * 1000.0 / setup_->header.rate.hertz()));
}

std::optional<ShownScore> LiveScore::score(std::int64_t next, std::size_t most_clips) const {
  if (!setup_) return std::nullopt;
  std::optional<ShownScore> shown = chain_.score(*setup_->builder, setup_->skeleton, next, end(), most_clips);
  if (!shown) return shown;
  const std::int64_t begin = next - shown->next;
  for (AuthoredCurve one : curves_.all()) {
    one.at = {one.at.begin - begin, one.at.end - begin};
    if (one.at.end > 0 && one.at.begin < shown->score.frames) shown->score.curves.push_back(std::move(one));
  }
  return shown;
}

}  // namespace signweave
