#include <algorithm>
#include <utility>

#include "signweave/choose/compose.h"
#include "signweave/choose/lint.h"
#include "signweave/choose/part_choice.h"
#include "signweave/core/error.h"
#include "signweave/live/live_score.h"

// Places in which single channels show something else than the body. They are placed together (LaneStep).
namespace signweave {

bool LiveScore::tail_is_last_sign() const noexcept {
  return state_ == State::at_core && !chain_.empty() && chain_.back() == last_sign_.clip && !round_.entries.empty();
}

/// Makes frames of the tail's recording available up to `end`, so that the recorded transition can follow.
void LiveScore::extend_tail(std::int64_t end) {
  LiveClip& clip = tail();
  if (clip.captured.whole.end >= end) return;
  const std::int64_t core_frames = clip.placed.core_frames;
  clip.captured.whole.end = end;
  extended(clip);
  clip.placed.core_frames = core_frames;
}

/// The clips of places; neighbours in a recording are one clip, except where a part or a hold begins or ends.
std::vector<LiveScore::Entry> LiveScore::clips_of_places(std::size_t first, std::size_t last, StepClips& clips,
                                                         Candidate& signs) {
  std::vector<Entry> placed;
  for (std::size_t place = first; place <= last; ++place) {
    const PlaceQueue::Decision& decision = queue_.decide_now(place);
    const Candidate& candidate = decision.candidate;
    const bool is_first = placed.empty();
    const bool can_follow = is_first ? tail_is_last_sign() && last_sign_.signs : true;
    const bool follows = can_follow && queue_.follows(is_first ? *last_sign_.signs : signs, place);
    if (follows && !is_first && !queue_.is_border(place)) {
      extend_with(signs, candidate);
      LiveClip& clip = *clips.body.back();
      clip.captured.core = signs.core;
      clip.captured.whole = signs.whole;
      clip.captured.signs = signs.signs;
      clip.captured.sign_places.resize(signs.signs.size(), place + queue_.forgotten());
      placed.back().last = place;
      continue;
    }
    auto clip = std::make_shared<LiveClip>();
    clip->captured = clip_of(*decision.contents, candidate, place, {}, queue_.space(place).mirrored);
    clip->captured.sign_places.assign(candidate.signs.size(), place + queue_.forgotten());
    set_up_for(clip->captured, decision.contents);
    const MotionClip captured = clip->captured;
    change_in_space(clip->captured, place, 0);
    if (follows) {
      clip->captured.continues = true;
      if (is_first) {
        extend_tail(candidate.core.begin);
      } else {
        FrameRange& whole = clips.body.back()->captured.whole;
        whole.end = std::max(whole.end, candidate.core.begin);
      }
    }
    signs = candidate;
    clips.body.push_back(clip);
    placed.push_back({.clip = std::move(clip), .first = place, .last = place});
    for (std::size_t i = 1; i < queue_.space(place).repetitions; ++i) {
      auto again = std::make_shared<LiveClip>();
      again->captured = captured;
      again->captured.pause_before = Milliseconds(0);
      change_in_space(again->captured, place, i);
      clips.body.push_back(again);
      placed.push_back({.clip = std::move(again), .first = place, .last = place});
    }
  }
  return placed;
}

/// The tokens of the parts of some places. They are chosen once.
const std::vector<ChosenPart>& LiveScore::chosen_parts(std::size_t first, std::size_t last, bool after_sign) {
  const Snapshot& snapshot = open_.snapshot();
  PartsOfPlaces& known = parts_[first];
  if (known.contents == snapshot.shared_contents() && known.after_sign == after_sign) return known.chosen;
  Utterance utterance = queue_.part(after_sign ? first - 1 : first, last);
  if (after_sign) utterance.places.front().parts.clear();
  known = {.choices = part_choices(snapshot.contents(), utterance, queue_.dominant(first)), .chosen = {}};
  std::vector<const Candidate*> chosen;
  for (std::size_t place = after_sign ? first - 1 : first; place <= last; ++place) {
    chosen.push_back(&queue_.chosen(place));
  }
  const Seconds transition = cache_.durations(snapshot.shared_contents(), options_.synthesis.duration)->mean;
  known.chosen =
      choose_parts(snapshot, known.choices, chosen, std::vector<Choice>(chosen.size()), {.transition = transition});
  known.contents = snapshot.shared_contents();  // now it is known
  known.after_sign = after_sign;
  return known.chosen;
}

void LiveScore::add_parts(std::size_t first, std::size_t last, const std::vector<Entry>& placed, StepClips& clips) {
  const bool after_sign = first > 0 && tail_is_last_sign() && queue_.is_decided(first - 1);
  const std::size_t before = after_sign ? 1 : 0;
  const Snapshot& snapshot = open_.snapshot();
  const std::vector<ChosenPart>& found = chosen_parts(first, last, after_sign);
  if (found.empty()) return;
  std::vector<std::size_t> clip_of_place(before, 0);  // see StepClips::parts
  const std::size_t tails = chain_.empty() ? 0 : 1;
  clip_of_place.resize(before + last - first + 1);
  for (std::size_t i = 0; i < placed.size(); ++i) {  // a place that is repeated: its last repetition
    for (std::size_t place = placed[i].first; place <= placed[i].last; ++place) {
      clip_of_place[before + place - first] = tails + i;
    }
  }
  for (const ChosenPart& part : found) {
    auto clip = std::make_shared<LiveClip>();
    const std::size_t place = first - before + part.part->place;
    clip->captured = clip_of(snapshot.contents(), part.candidate, place, part.mirrored);
    clip->captured.pause_before = Milliseconds(0);
    clip->captured.at_rest = part.rest;
    clip->captured.sign_places.assign(part.candidate.signs.size(), place + queue_.forgotten());
    clips.parts.clips.push_back(channel_clip(part, clip_of_place));
    clips.of_parts.push_back(std::move(clip));
  }
}

void LiveScore::add_holds(std::size_t first, std::size_t last, const std::vector<Entry>& placed, StepClips& clips) {
  const std::size_t tails = chain_.empty() ? 0 : 1;
  const auto clip_of_place = [&](std::size_t place) {
    std::size_t i = 0;
    while (placed[i].last < place) ++i;
    while (i + 1 < placed.size() && placed[i + 1].first == place) ++i;  // its last repetition
    return tails + i;
  };
  for (const ChannelHold& held : queue_.holds()) {
    if (held.from >= last || held.until < first) continue;
    if (held.from < first && !tail_is_last_sign()) {
      if (held.from + 1 == first) {
        notify(end(), first + queue_.forgotten(),
               "nothing to hold: the sign before is over; append what holds its hand while it is shown");
      }
      continue;
    }
    clips.parts.holds.push_back({.channel = held.channel,
                                 .from = held.from < first ? 0 : clip_of_place(held.from),
                                 .until = clip_of_place(std::min(held.until, last))});
  }
}

void LiveScore::sign_in_channels(std::size_t first) {
  const std::size_t last = queue_.last_tied_to(first);
  queue_.continue_at(last + 1);
  StepClips clips;
  Candidate signs;  // of the last clip
  std::vector<Entry> placed = clips_of_places(first, last, clips, signs);
  leave_idle();
  const bool joined = tail_is_last_sign() && chain_.back() == round_.entries.back().clip;
  add_parts(first, last, placed, clips);
  add_holds(first, last, placed, clips);
  const StepPtr step = take_step(clips);

  // The utterance's time goes on from its last sign, or begins with the first preparation.
  const PlacedClip& front = placed.front().clip->placed;
  std::int64_t begin = 0;
  if (!round_.entries.empty()) begin = round_.entries.back().core + round_.entries.back().clip->placed.core_frames;
  const std::int64_t shift = joined ? round_.entries.back().core - round_.entries.back().clip->placed.core
                                    : begin + front.preparation - front.core;
  for (Entry& entry : placed) {
    entry.step = step;
    entry.joined = joined;
    entry.begin = std::max(begin, step->begin + shift);
    entry.core = entry.clip->placed.core + shift;
    round_.entries.push_back(entry);
  }
  last_sign_ = {.clip = round_.entries.back().clip, .signs = std::move(signs), .step = step};
  state_ = State::at_core;
  report_setup(round_.entries[round_.entries.size() - placed.size()]);
  report_channels(round_.entries[round_.entries.size() - placed.size()], 0);
  for (std::size_t i = round_.entries.size() - placed.size(); i < round_.entries.size(); ++i)
    report_places(round_.entries[i], 0);
}

/// Places new clips after the chain and shows what is decided. If asked for, what is rarely done is an error instead.
LiveScore::StepPtr LiveScore::take_step(const StepClips& clips) {
  const auto place = [&](const ClipPtr& clip) {
    clip->key = key_of(clip->captured);
    setup_->builder->place_sign(*clip);
  };
  if (!clips.rests) std::ranges::for_each(clips.body, place);  // the rest is placed already
  std::ranges::for_each(clips.of_parts, place);
  auto step = std::make_shared<const LaneStep>(
      make_step(chain_, end(), clips, *setup_, options_.synthesis.tempo, cache_.steps()));
  if (options_.synthesis.strict) refuse(step->notices);
  chain_.add(step->links);
  timeline_.append({end(), std::min(chain_.core_end(), step->end())}, step->made, step->begin);
  return step;
}

void LiveScore::go_to_rest_in_channels() {
  const ClipPtr rest = place_rest(*setup_);
  const std::int64_t core_end = tail().placed.core_end();
  take_step({.body = {rest}, .rests = true});
  state_ = State::resting;
  add_event({.kind = PlayerEvent::Kind::rest,
             .frame = static_cast<std::uint64_t>(end()),
             .at = end_of_last_sign() + time_of(end() - core_end)});
  timeline_.append({end(), end() + kRestFramesAtOnce}, rest);
}

/// Lets hands that are held until the last place join the body's last retraction, as a file does. Returns the step that
/// shows it: the last sign's own if none is held, or none can be lowered.
LiveScore::StepPtr LiveScore::lower_hands() {
  const LaneStep& last = *last_sign_.step;
  const std::size_t last_clip = last.clips.body.size() - (last.had_tail ? 0 : 1);  // as StepClips::parts counts
  StepClips clips;
  for (const Side side : kSides) {
    const Channel hand = side == Side::left ? Channel::left : Channel::right;
    const Channel fingers = side == Side::left ? Channel::left_fingers : Channel::right_fingers;
    if (chain_.lane(hand).back().held_until != chain_.back()) continue;
    std::optional<MotionClip> lowered = lowered_hand(chain_.back()->captured);
    if (!lowered) continue;
    auto clip = std::make_shared<LiveClip>();
    clip->captured = std::move(*lowered);
    clips.parts.clips.push_back({.channel = hand, .clip = {}, .sync = {}, .lower = true});
    clips.of_parts.push_back(std::move(clip));
    if (std::ranges::any_of(last.clips.parts.clips, [&](const ChannelClip& part) {
          return part.channel == fingers && part.last == last_clip;
        })) {
      clips.stay.push_back(fingers);
    }
  }
  if (clips.of_parts.empty()) return last_sign_.step;
  try {
    return take_step(clips);
  } catch (const Error& error) {  // a recording is gone: the hand stays where it is
    notify(end(), round_.entries.back().last + queue_.forgotten(), error.what());
    return last_sign_.step;
  }
}

/// As finish_sign, among signs that were placed together: ends the timeline with the one that is shown if it ends soon.
bool LiveScore::finish_in_channels(std::int64_t next, const FrameRing& shown) {
  const auto entry = std::ranges::find_if(round_.entries, [&](const Entry& one) {
    return one.step && one.clip->placed.core <= next && next < one.clip->placed.core_end();
  });
  if (entry == round_.entries.end()) return false;
  const std::int64_t core_end = entry->clip->placed.core_end();
  const auto soon = static_cast<std::int64_t>(kFinished.count() * setup_->header.rate.hertz());
  if (core_end - next > soon || core_end > end()) return false;
  FrameRing left(setup_->header.shape(), static_cast<std::size_t>(core_end - next));
  for (std::int64_t frame = next; frame < core_end;) {
    const std::int64_t count = std::min(timeline_.end_of_same(frame), core_end) - frame;
    timeline_.read({frame, frame + count}, *setup_->builder, left);
    left.grow(count);
    frame += count;
  }
  Motion rest = shown_frames(0, left.end(), left);
  curves_.show({rest, next}, setup_->builder->settings());
  curves_.clear();  // the frames have them
  const std::int64_t first = std::max(shown.begin(), next - history());
  Motion frames = shown_frames(first, next, shown);
  std::vector<ScalarTrack> tracks = frames.take_tracks();
  for (std::int64_t frame = 0; frame < rest.frame_count(); ++frame) {
    const MutablePoseView pose = rest.pose(frame);
    for (std::size_t joint = 0; frames.frame_count() > 0 && joint < pose.rotations.size(); ++joint) {
      const Eigen::Quaternionf& before = frames.pose(frames.frame_count() - 1).rotations[joint];
      if (before.dot(pose.rotations[joint]) < 0) pose.rotations[joint].coeffs() *= -1.0f;
    }
    frames.append(std::as_const(rest).pose(frame));
  }
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const std::vector<float>& after = rest.tracks()[i].values;
    tracks[i].values.insert(tracks[i].values.end(), after.begin(), after.end());
    frames.add_track(std::move(tracks[i]));
  }
  const ClipPtr finished = shown_clip(std::move(frames), first);
  chain_.begin(finished);
  last_sign_ = {.clip = finished, .signs = {}};
  cut(next);
  timeline_.append({next, core_end}, finished);
  state_ = State::at_core;
  return true;
}

/// As seek, to a frame of signs that were placed together, of which entry `index` is the last one.
void LiveScore::seek_in_step(std::size_t index, std::int64_t at, std::int64_t next) {
  const auto first_of_step = [&](std::size_t entry) {
    while (entry > 0 && round_.entries[entry - 1].step == round_.entries[entry].step) --entry;
    return entry;
  };
  // What was shown before the utterance is not shown again: then the signs are made without it.
  const auto is_shown_again = [&](const LaneStep& step) {
    return std::ranges::none_of(step.links, [](const std::deque<LiveLink>& lane) {
      return lane.front().clip->captured.kind == SourceRef::Kind::shown;
    });
  };
  std::size_t first = first_of_step(index);
  while (round_.entries[first].joined && !is_shown_again(*round_.entries[first].step)) {
    index = first - 1;
    at = round_.entries[index].core;
    if (!round_.entries[index].step) break;
    first = first_of_step(index);
  }
  if (!round_.entries[index].step) {
    round_.entries.resize(index + 1);
    seek(at, next);
    return;
  }
  const Entry& entry = round_.entries[first];
  auto step = std::make_shared<LaneStep>(*entry.step);
  cut(next);
  timeline_.restart(next);
  chain_.clear();
  if (entry.joined) {
    const std::int64_t begin = entry.core - step->to_core(entry.clip);
    at = std::max(at, begin);
    step->move_to(next - (at - begin));
    chain_.add(step->links);
  } else {
    const std::int64_t begin = entry.core - entry.clip->placed.preparation;
    at = std::max(at, begin);
    entry.clip->cuts.reset();
    *step = make_step(chain_, next - (at - begin), without_tail(step->clips, step->had_tail), *setup_,
                      options_.synthesis.tempo, cache_.steps());
    chain_.add(step->links);
    for (std::size_t i = first; i <= index; ++i) round_.entries[i].core = begin + step->to_core(round_.entries[i].clip);
  }
  if (const std::int64_t late = next + 1 - chain_.core_end(); late > 0) {  // back to the last decided frame
    at -= late;
    step->move_to(step->begin + late);
  }
  timeline_.append({next, std::min(chain_.core_end(), step->end())}, step->made, step->begin);
  // The last clip may have been continued as captured since.
  timeline_.append({std::max(next, step->end()), chain_.core_end()}, chain_.back());
  add_event({.kind = PlayerEvent::Kind::seek, .frame = static_cast<std::uint64_t>(next), .at = time_of(at)});
  round_.entries.resize(index + 1);
  for (std::size_t i = first; i <= index; ++i) round_.entries[i].step = step;
  queue_.continue_at(round_.entries.back().last + 1);
  last_sign_ = {.clip = round_.entries.back().clip, .signs = {}, .step = step};
  state_ = State::at_core;
  show_authored(next);
  report_channels(round_.entries[first], next);
  for (std::size_t i = first; i < round_.entries.size(); ++i) report_places(round_.entries[i], next);
}

}  // namespace signweave
