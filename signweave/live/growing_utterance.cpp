#include "signweave/live/growing_utterance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/motion/blend.h"

namespace signweave {
namespace {

/// The timeline grows by so much at rest.
constexpr std::int64_t kRestFramesAtOnce = 32;
/// So many frames are read at once.
constexpr std::int64_t kChunk = 64;

}  // namespace

GrowingUtterance::GrowingUtterance(SigningBase& base, const PlayerOptions& options)
    : base_(base), options_(options), loop_(options.loop), open_(base.database()) {}

std::int64_t GrowingUtterance::history() const noexcept {
  return header_ ? static_cast<std::int64_t>(std::ceil(kContext.count() * header_->rate.hertz())) + 1 : 1;
}

void GrowingUtterance::append(FrameRange frames, WovenPtr woven) {
  if (frames.empty()) return;
  if (!segments_.empty() && segments_.back().woven == woven && segments_.back().frames.end == frames.begin) {
    segments_.back().frames.end = frames.end;
  } else {
    segments_.push_back({.frames = frames, .woven = std::move(woven), .made = {}});
  }
  end_ = frames.end;
}

void GrowingUtterance::append(FrameRange frames, std::shared_ptr<const Motion> made) {
  if (frames.empty()) return;
  const std::int64_t begin = frames.end - made->frame_count();
  segments_.push_back({.frames = frames, .woven = {}, .made = std::move(made), .made_begin = begin});
  end_ = frames.end;
}

bool GrowingUtterance::extend(const FrameRing& shown) {
  try {
    return grow();
  } catch (const Error&) {
    if (tail_ != nullptr && !can_read(*tail_)) go_on_from(shown);
    throw;
  }
}

/// False where what is laid has been removed since, or is damaged.
bool GrowingUtterance::can_read(const Woven& woven) const {
  Motion one(header_->skeleton, header_->rate, 1);
  const std::int64_t last = woven.laid.core_end() - 1;
  try {
    weaver_->read(woven, {last, last + 1}, one.poses({0, 1}), {});
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Nothing follows the frames that are made but what is signed next, from there: what was laid cannot be read.
void GrowingUtterance::go_on_from(const FrameRing& made) {
  last_sign_.reset();
  last_signs_.reset();
  if (made.end() > made.begin()) {
    tail_ = history_of(made.end(), made);
    state_ = State::at_core;
  } else {
    tail_.reset();
    state_ = State::nothing;
  }
  cut(made.end());
}

bool GrowingUtterance::grow() {
  if (has_next()) {
    sign_next();
    return true;
  }
  switch (state_) {
    case State::nothing:
    case State::ended:
      return false;
    case State::at_core:
      if (options_.idle == Idle::living_rest) {
        go_to_rest();
      } else {
        append({end_, end_ + tail_->laid.retraction}, tail_);
        state_ = State::ended;
        events_.push_back({.kind = PlayerEvent::Kind::end,
                           .frame = static_cast<std::uint64_t>(end_),
                           .at = end_of_last_sign() + time_of(tail_->laid.retraction)});
      }
      return true;
    case State::resting:
      append({end_, end_ + kRestFramesAtOnce}, tail_);
      return true;
  }
  return false;
}

GrowingUtterance::WovenPtr GrowingUtterance::living_rest() const {
  auto rest = std::make_shared<Woven>();
  rest->stretch = {.recording = header_->layout_from,
                   .source = living_,
                   .whole = {0, LivingRest::kFrames},
                   .core = {0, LivingRest::kFrames},
                   .clock = {},
                   .signs = {}};
  weaver_->lay_frames(*rest);
  return rest;
}

void GrowingUtterance::go_to_rest() {
  WovenPtr rest = living_rest();
  rest->key = "rest";
  std::shared_ptr<const Motion> made = join(*tail_, *rest);
  const std::int64_t made_frames = made->frame_count();
  append({end_, rest->laid.core}, std::move(made));
  tail_ = std::move(rest);
  state_ = State::resting;
  events_.push_back({.kind = PlayerEvent::Kind::rest,
                     .frame = static_cast<std::uint64_t>(end_),
                     .at = end_of_last_sign() + time_of(made_frames)});
  append({end_, end_ + kRestFramesAtOnce}, tail_);
}

/// Lays b behind a; the frames between them, made now or before.
std::shared_ptr<const Motion> GrowingUtterance::join(Woven& a, Woven& b) {
  std::string key;
  if (!a.key.empty() && !b.key.empty()) {
    key = fmt::format("{}|{}|{}|{}", settings_key_, a.key, b.key, b.stretch.pause_before.count());
    if (const std::shared_ptr<const MadeTransition> made = base_.transitions().find(key)) {
      a.laid.after = 0;
      b.laid.before = 0;
      lay_after(a.laid, b.laid, made->cuts);
      b.laid.standing = made->transform;
      return made->frames;
    }
  }
  auto frames = std::make_shared<Motion>();
  const JunctionCuts cuts = weaver_->join(a, b, *frames);
  if (!key.empty()) {
    base_.transitions().keep(key, std::make_shared<const MadeTransition>(MadeTransition{cuts, b.laid.standing, frames}));
  }
  return frames;
}

GrowingUtterance::WovenPtr GrowingUtterance::history_of(std::int64_t next, const FrameRing& shown) const {
  const std::int64_t first = std::max(shown.begin(), next - history());
  Motion motion(header_->skeleton, header_->rate, next - first);
  std::vector<ScalarTrack> tracks;
  for (const std::string& name : header_->tracks) tracks.push_back({name, {}});
  for (std::int64_t frame = first; frame < next; ++frame) {
    const FrameView view = shown.at(frame);
    const MutablePoseView pose = motion.pose(frame - first);
    std::ranges::copy(view.pose.rotations, pose.rotations.begin());
    std::ranges::copy(view.pose.translations, pose.translations.begin());
    for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].values.push_back(view.tracks[i]);
  }
  for (ScalarTrack& track : tracks) motion.add_track(std::move(track));
  auto history = std::make_shared<Woven>();
  const FrameRange all{0, motion.frame_count()};
  history->stretch = {.recording = {},
                      .source = std::make_shared<MemorySource>(std::move(motion)),
                      .whole = all,
                      .core = all,
                      .clock = {},
                      .signs = {}};
  weaver_->lay_frames(*history);
  history->laid.core = first;
  return history;
}

void GrowingUtterance::cut(std::int64_t end) {
  while (!segments_.empty() && segments_.back().frames.begin >= end) segments_.pop_back();
  if (!segments_.empty()) segments_.back().frames.end = std::min(segments_.back().frames.end, end);
  while (!events_.empty() && events_.back().frame >= static_cast<std::uint64_t>(end)) {
    if (events_.back().kind == PlayerEvent::Kind::notice) told_.erase(events_.back().recording);
    events_.pop_back();
  }
  end_ = std::min(end_, end);
}

/// Goes on from what is shown, whatever it is.
void GrowingUtterance::leave(std::int64_t next, const FrameRing& shown) {
  if (state_ == State::nothing) return;
  last_sign_.reset();
  if (state_ == State::resting && next > tail_->laid.core) {
    tail_->laid.core_frames = next - tail_->laid.core;
    tail_->key.clear();  // the way out of it depends on the moment
  } else if (next > shown.begin()) {
    tail_ = history_of(next, shown);
  } else {  // nothing was shown yet
    cut(next);
    tail_.reset();
    state_ = State::nothing;
    return;
  }
  cut(next);
  state_ = State::at_core;
}

void GrowingUtterance::add(const Utterance& utterance, std::int64_t next, const FrameRing& shown) {
  check(utterance, places_.size() - next_);
  forget_places();
  places_.insert(places_.end(), utterance.places.begin(), utterance.places.end());
  decisions_.resize(places_.size());
  if (!utterance.places.empty()) reopen(next, shown);
}

void GrowingUtterance::set_loop(bool loop, std::int64_t next, const FrameRing& shown) {
  loop_ = loop;
  if (has_next()) reopen(next, shown);
}

/// Something follows after all what was thought the end.
void GrowingUtterance::reopen(std::int64_t next, const FrameRing& shown) {
  if (state_ != State::resting && state_ != State::ended) return;
  if (last_sign_ != nullptr && next <= last_sign_->laid.core_end()) {  // what follows it was not shown yet
    tail_ = last_sign_;
    cut(tail_->laid.core_end());
    state_ = State::at_core;
  } else {
    leave(next, shown);
  }
}

/// An utterance that goes on for hours does not fill the memory.
void GrowingUtterance::forget_places() {
  if (loop_ || next_ < 2 * kKeptPlaces) return;
  const std::size_t count = next_ - kKeptPlaces;
  const auto over = static_cast<std::ptrdiff_t>(count);
  places_.erase(places_.begin(), places_.begin() + over);
  decisions_.erase(decisions_.begin(), decisions_.begin() + over);
  std::erase_if(entries_, [&](const Entry& entry) { return entry.first < count; });
  for (Entry& entry : entries_) {
    entry.first -= count;
    entry.last -= count;
  }
  if (!entries_.empty()) {
    Entry& front = entries_.front();
    front.joined = false;
    front.begin = front.core - front.woven->laid.preparation;
  }
  next_ -= count;
  forgotten_ += count;
}

void GrowingUtterance::replace(const Utterance& utterance, std::int64_t next, const FrameRing& shown) {
  check(utterance, 0);
  const bool finished = finish_sign(next);
  places_ = utterance.places;
  decisions_.clear();
  decisions_.resize(places_.size());
  forgotten_ = 0;
  entries_.clear();
  last_round_.clear();
  last_signs_.reset();
  next_ = 0;
  if (finished || state_ == State::nothing) return;
  if (places_.empty() && state_ != State::at_core) return;  // on its way to rest, or there
  if (state_ == State::at_core && next >= end_) return;
  leave(next, shown);
}

/// Where a sign's core is shown, the timeline ends with that sign, or at once where it lasts long. False where none is.
bool GrowingUtterance::finish_sign(std::int64_t next) {
  if (entries_.empty() && last_sign_ != nullptr && next >= last_sign_->laid.core &&
      next < last_sign_->laid.core_end()) {  // as it was cut when the last utterance began
    tail_ = last_sign_;
    cut(tail_->laid.core_end());
    state_ = State::at_core;
    return true;
  }
  const auto shown = std::ranges::find_if(
      segments_, [&](const Segment& segment) { return next >= segment.frames.begin && next < segment.frames.end; });
  if (shown == segments_.end() || shown->woven == nullptr) return false;
  const WovenPtr woven = shown->woven;
  const Laid& laid = woven->laid;
  if (woven->stretch.source == living_ || next < laid.core || next >= laid.core_end()) return false;
  FrameRange core = woven->stretch.core;
  FrameRange whole = woven->stretch.whole;
  const auto entry = std::ranges::find(entries_, woven, &Entry::woven);
  for (std::size_t place = entry == entries_.end() ? 1 : entry->first; entry != entries_.end() && place <= entry->last;
       ++place) {
    const Candidate& candidate = decisions_[place]->candidate;
    if (next >= laid.frame_of(candidate.core.end)) continue;
    core.end = candidate.core.end;
    whole.end = candidate.whole.end;
    break;
  }
  auto last = std::make_shared<Woven>();
  last->stretch = woven->stretch;
  last->stretch.core.end = core.end;
  last->stretch.whole = whole;
  weaver_->lay_sign(*last);
  last->laid.core = laid.core;
  last->laid.before = laid.before;
  last->laid.standing = woven->laid.standing;
  const auto soon = static_cast<std::int64_t>(kFinished.count() * header_->rate.hertz());
  if (last->laid.core_end() - next > soon) {
    if (next == laid.core) return false;
    last->laid.core_frames = next - laid.core;
    last->laid.retraction = 0;
  }
  cut(last->laid.core_end());
  tail_ = last_sign_ = std::move(last);
  state_ = State::at_core;
  return true;
}

bool GrowingUtterance::seek(std::int64_t at, std::int64_t next) {
  if (entries_.empty()) return false;
  const auto end_of = [](const Entry& entry) { return entry.core + entry.woven->laid.core_frames; };
  // A loop that has just begun anew: the round before tells what comes later.
  const bool earlier = at >= end_of(entries_.back()) && !last_round_.empty();
  const std::vector<Entry>& entries = earlier ? last_round_ : entries_;
  at = std::clamp<std::int64_t>(at, entries.front().begin, end_of(entries.back()) - 1);
  std::size_t index = entries.size() - 1;
  while (index > 0 && entries[index].begin > at) --index;
  const Entry& entry = entries[index];
  const WovenPtr woven = entry.woven;
  std::shared_ptr<const Motion> made;
  if (at < entry.core && entry.joined) {
    Woven& before = *entries[index - 1].woven;
    const Laid was = before.laid;
    const Laid will = woven->laid;
    before.laid.core = next - (at - entries[index - 1].core);
    try {
      made = join(before, *woven);
    } catch (const Error&) {  // nothing has changed
      before.laid = was;
      woven->laid = will;
      throw;
    }
  } else {
    woven->laid.core = next + entry.core - at;
  }
  cut(next);
  segments_.clear();
  end_ = next;
  events_.push_back({.kind = PlayerEvent::Kind::seek, .frame = static_cast<std::uint64_t>(next), .at = time_of(at)});
  if (made != nullptr) {
    append({next, woven->laid.core}, std::move(made));
  } else {
    append({next, woven->laid.core}, woven);
  }
  append({std::max(next, woven->laid.core), woven->laid.core_end()}, woven);
  if (earlier) entries_ = std::move(last_round_);
  last_round_.clear();
  entries_.resize(index + 1);
  next_ = entries_.back().last + 1;
  tail_ = last_sign_ = woven;
  last_signs_.reset();
  state_ = State::at_core;
  tell_places(entries_.back(), next);
  return true;
}

void GrowingUtterance::read(std::int64_t until, FrameRing& ring) {
  const std::size_t joints = header_->skeleton->joint_count();
  while (ring.end() < until) {
    const auto segment =
        std::ranges::find_if(segments_, [&](const Segment& one) { return one.frames.end > ring.end(); });
    if (segment == segments_.end()) return;
    const std::int64_t count = ring.room(std::min({until, segment->frames.end, ring.end() + kChunk}) - ring.end());
    if (count <= 0) return;
    const MutablePoses poses = ring.poses(count);
    try {
      read_segment(*segment, {ring.end(), ring.end() + count}, ring);
    } catch (const Error&) {
      go_on_from(ring);
      throw;
    }
    if (ring.end() > ring.begin()) {
      // One rotation keeps one sign over the whole stream.
      const PoseView before = ring.at(ring.end() - 1).pose;
      for (std::size_t joint = 0; joint < joints; ++joint) {
        if (before.rotations[joint].dot(poses.rotations[joint]) >= 0) continue;
        for (std::size_t at = joint; at < poses.rotations.size(); at += joints) poses.rotations[at].coeffs() *= -1.0f;
      }
    }
    ring.grow(count);
  }
}

void GrowingUtterance::read_segment(const Segment& segment, FrameRange frames, FrameRing& ring) {
  const auto count = static_cast<std::size_t>(frames.size());
  const MutablePoses out = ring.poses(frames.size());
  const std::size_t tracks = header_->tracks.size();
  if (segment.made != nullptr) {
    const Motion& made = *segment.made;
    const auto first = static_cast<std::size_t>(frames.begin - segment.made_begin);
    const std::size_t joints = made.skeleton().joint_count();
    const std::size_t moved = made.skeleton().translation_count();
    std::ranges::copy(made.rotations().subspan(first * joints, count * joints), out.rotations.begin());
    std::ranges::copy(made.translations().subspan(first * moved, count * moved), out.translations.begin());
    for (std::size_t k = 0; k < count; ++k) {
      const std::span<float> values = ring.tracks(static_cast<std::int64_t>(k));
      for (std::size_t i = 0; i < tracks; ++i) values[i] = made.tracks()[i].values[first + k];
    }
    return;
  }
  track_values_.resize(tracks * count);
  track_spans_.clear();
  for (std::size_t i = 0; i < tracks; ++i) track_spans_.push_back(std::span(track_values_).subspan(i * count, count));
  weaver_->read(*segment.woven, frames, out, track_spans_);
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<float> values = ring.tracks(static_cast<std::int64_t>(k));
    for (std::size_t i = 0; i < tracks; ++i) values[i] = track_spans_[i][k];
  }
}

void GrowingUtterance::let_go(std::int64_t taken) noexcept {
  open_.close();
  while (!segments_.empty() && segments_.front().frames.end <= taken) segments_.pop_front();
}

std::optional<PlayerEvent> GrowingUtterance::take_event(std::int64_t frame) noexcept {
  if (events_.empty() || events_.front().frame > static_cast<std::uint64_t>(frame)) return std::nullopt;
  std::optional<PlayerEvent> event(std::move(events_.front()));
  events_.pop_front();
  return event;
}

bool GrowingUtterance::idle(std::int64_t frame) const noexcept {
  if (has_next()) return false;
  return state_ == State::nothing || (state_ == State::ended && frame >= end_) ||
         (state_ == State::resting && frame >= tail_->laid.core);
}

Milliseconds GrowingUtterance::end_of_last_sign() const noexcept {
  return entries_.empty() ? Milliseconds(0) : time_of(entries_.back().core + entries_.back().woven->laid.core_frames);
}

Milliseconds GrowingUtterance::time_of(std::int64_t frames) const noexcept {
  return Milliseconds(std::llround(static_cast<double>(frames) * 1000.0 / header_->rate.hertz()));
}

}  // namespace signweave
