#include "signweave/score/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/score/junction_choice.h"

namespace signweave {
namespace {

/// Limit on frame numbers, so that sums of several do not overflow.
constexpr std::int64_t kMostFrameNumber = std::int64_t{1} << 40;

struct Checker {
  const Score& score;
  const std::string& where;
  std::size_t body = 0;  ///< the number of clips in the lane of the body

  template <class... Args>
  void require(bool holds, fmt::format_string<Args...> text, Args&&... args) const {
    if (holds) return;
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}", where, fmt::format(text, std::forward<Args>(args)...)));
  }
  static bool in_range(std::int64_t number) noexcept { return number >= 0 && number <= kMostFrameNumber; }
  static bool in_range(TimeSpan span) noexcept {
    return span.begin.count() >= -kMostFrameNumber && span.begin <= span.end && span.end.count() <= kMostFrameNumber;
  }

  void clip(const Clip& clip, std::size_t index) const {
    require(clip.id == index, "clip {} has the id {}; ids count from 0 in the order of the clips", index, clip.id);
    const bool shown = clip.source.kind == SourceRef::Kind::shown;
    require(clip.source.recording.empty() == shown, "clip {} {}", index,
            shown ? "names a recording, but is of kind 'shown'" : "names no recording");
    require(!shown || index == 0, "clip {} is of kind 'shown'; only the first one can be", index);
    const bool of_body = index < body;
    require(!clip.mirrored || clip.source.kind == SourceRef::Kind::recording,
            "clip {} is mirrored, but not of kind 'recording'; only frames of recordings can be mirrored", index);
    require(clip.changes.empty() || (clip.source.kind == SourceRef::Kind::recording && !clip.at_rest),
            "clip {} is changed in space, but not of kind 'recording', or at rest", index);
    for (const ClipChange& change : clip.changes) {
      check(change.stroke);
      require(std::isfinite(change.moved_mm) && std::isfinite(change.turned_degrees) && change.share >= 0 &&
                  change.share <= 1 && std::isfinite(change.missed_mm) && std::isfinite(change.aim_degrees),
              "a change of clip {} has no finite sizes", index);
    }
    require(!clip.at_rest || (clip.signs.empty() && !of_body),
            "clip {} is at rest, but has signs or is of the body; only a single hand rests", index);
    require(in_range(clip.whole.begin) && in_range(clip.whole.end) && clip.whole.begin <= clip.core.begin &&
                clip.core.begin < clip.core.end && clip.core.end <= clip.whole.end,
            "clip {} keeps frames {} to {} out of {} to {}; the first range must not be empty, and lie in the second",
            index, clip.core.begin, clip.core.end, clip.whole.begin, clip.whole.end);
    require(std::isfinite(clip.step) && clip.step >= 1e-3 && clip.step <= 1e6,
            "clip {} has the step {}; a step is a number from 0.001 to 1000000", index, clip.step);
    require(in_range(clip.at.begin) && clip.at.begin < clip.at.end && clip.at.end <= score.frames,
            "clip {} is at frames {} to {} of {}", index, clip.at.begin, clip.at.end, score.frames);
    require(index == 0 || !of_body || clip.at.begin >= score.clips[index - 1].at.end,
            "clip {} begins before the core of the one before it ends", index);
    const auto at = static_cast<double>(clip.at.size());
    const auto core = static_cast<double>(clip.core.size());
    require(at <= std::max(1.0, std::round(core / clip.step)) && core <= (at + 1) * clip.step + 1,
            "clip {} shows {} frames in {}, {} a frame; these numbers do not agree", index, clip.core.size(),
            clip.at.size(), clip.step);
    require(clip.sign_places.size() == clip.signs.size() && std::ranges::is_sorted(clip.sign_places) &&
                (clip.signs.empty() || clip.sign_places.front() >= clip.place),
            "the signs of clip {} are of places before its own, {}, or not in their order", index, clip.place);
    const double frame_time = clip.clock.frame_time.count();
    require(std::abs(clip.clock.origin.count()) <= 1e9 && frame_time >= 1e-6 && frame_time <= 1e4,
            "the clock of clip {} begins at {} s with {} s a frame", index, clip.clock.origin.count(), frame_time);
    for (const Sign& sign : clip.signs) {
      require(in_range(sign.span) && std::ranges::all_of(
                                         sign.phases, [](TimeSpan span) { return in_range(span); }, &Phase::span),
              "a sign of clip {} has no valid time, or ends before it begins", index);
    }
    if (!clip.standing) return;
    require(clip.standing->shift.allFinite() && std::abs(clip.standing->turn.norm() - 1) < 1e-3f,
            "clip {} has no valid standing: its turn must be a unit quaternion, its shift three numbers", index);
  }

  void transition(const Transition& made, const FrameRange& at, std::string_view channel) const {
    const TransitionCut& cut = made.cut;
    for (const std::int64_t number :
         {cut.length, cut.retraction_frames, cut.preparation_frames, cut.blend_frames, cut.pause_frames}) {
      require(in_range(number), "lane '{}': the transition from clip {} to {} has a cut with {} frames", channel,
              made.from, made.to, number);
    }
    require(cut.retraction_frames <= cut.length && cut.preparation_frames <= cut.length,
            "lane '{}': the transition from clip {} to {} keeps more than its {} frames", channel, made.from, made.to,
            cut.length);
    require(at.size() == cut.gap() + cut.overlap(),
            "lane '{}': the transition from clip {} to {} has {} frames; its cut leaves {}", channel, made.from,
            made.to, at.size(), cut.gap() + cut.overlap());
  }

  void place(const HandPlace& place, Channel channel, ClipId clip) const {
    require(channel == Channel::left || channel == Channel::right, "lane '{}': clip {} has a place of a hand",
            name_of(channel), clip);
    require(place.kept_in != Anchor::other_hand && place.out.allFinite() && place.out.norm() <= 1,
            "lane '{}': clip {} has no valid place of the hand: a space of trunk, head or signer, and at most a metre",
            name_of(channel), clip);
  }

  /// Which items may follow which: a hold stands before the first clip, or after a clip.
  void order(const Lane& lane) const {
    const std::string_view name = name_of(lane.channel);
    std::optional<ClipId> last;       // the clip before
    bool in_transition = true;        // a clip must follow
    std::optional<ClipId> announced;  // by a transition or a hold
    for (std::size_t i = 0; i < lane.items.size(); ++i) {
      const Item& item = lane.items[i];
      if (const auto* const use = std::get_if<ClipUse>(&item.what)) {
        require(in_transition && use->clip < score.clips.size() && (!announced || *announced == use->clip),
                "lane '{}': item {} is clip {}; {}", name, i, use->clip,
                !in_transition ? "a transition must come before it" : "that is not the one that is announced");
        if (use->place) place(*use->place, lane.channel, use->clip);
        last = use->clip;
        in_transition = false;
        announced.reset();
      } else if (const auto* const held = std::get_if<Hold>(&item.what)) {
        require(!item.at.empty() && (i == 0 || (!in_transition && last == held->clip &&
                                                std::holds_alternative<ClipUse>(lane.items[i - 1].what))),
                "lane '{}': item {} holds clip {}, which is not next to it", name, i, held->clip);
        if (i == 0) announced = held->clip;
      } else {
        const auto& made = std::get<Transition>(item.what);
        require(made.to != 0, "lane '{}': item {} leads to clip 0, which nothing comes before", name, i);
        require(!in_transition && last == made.from && made.from != made.to,
                "lane '{}': item {} goes from clip {} to {}, but does not follow the first", name, i, made.from,
                made.to);
        transition(made, item.at, name);
        in_transition = true;
        announced = made.to;
      }
    }
    require(!in_transition, "lane '{}' has no clip at its end", name);
  }

  void lane(const Lane& lane) const {
    const std::string_view name = name_of(lane.channel);
    std::int64_t end = 0;
    std::int64_t core_end = 0;
    order(lane);
    for (std::size_t i = 0; i < lane.items.size(); ++i) {
      const Item& item = lane.items[i];
      require(item.at.begin == end && item.at.end >= end,
              "lane '{}': item {} is at {} to {}; the one before it ends at {}", name, i, item.at.begin, item.at.end,
              end);
      end = item.at.end;
      const auto* const use = std::get_if<ClipUse>(&item.what);
      if (use == nullptr) continue;
      const Clip& clip = score.clips[use->clip];
      require(clip.at.begin >= core_end, "lane '{}': clip {} begins before the core of the one before it ends", name,
              use->clip);
      core_end = clip.at.end;
      require(item.at.begin <= clip.at.begin && clip.at.end <= item.at.end,
              "lane '{}': clip {} is at {} to {}; its core is at {} to {}", name, use->clip, item.at.begin, item.at.end,
              clip.at.begin, clip.at.end);
    }
    require(end == score.frames, "lane '{}' ends at frame {} of {}", name, end, score.frames);
  }

  void lanes() const {
    constexpr std::size_t kBase = kChannels.size();
    require(score.lanes.size() >= kBase, "{} lanes; there must be {} or more", score.lanes.size(), kBase);
    std::optional<Channel> before;
    for (std::size_t i = 0; i < score.lanes.size(); ++i) {
      const Channel channel = score.lanes[i].channel;
      if (i < kBase) {
        require(channel == kChannels[i], "lane '{}' is where '{}' belongs", name_of(channel), name_of(kChannels[i]));
      } else {
        require(parent_of(channel) && before < channel, "lane '{}' is not where it belongs: after '{}'",
                name_of(channel), name_of(*before));
      }
      before = channel;
    }
    for (const Lane& one : score.lanes) lane(one);
    // The clips of the body come first, in their order.
    std::size_t next = 0;
    for (const Item& item : score.lanes.front().items) {
      const auto* const use = std::get_if<ClipUse>(&item.what);
      if (use == nullptr) continue;
      require(use->clip == next, "lane 'body' has clip {} where {} belongs", use->clip, next);
      ++next;
    }
    std::vector<bool> shown(score.clips.size(), false);
    for (const Lane& one : score.lanes) {
      for (const Item& item : one.items) {
        if (const auto* const use = std::get_if<ClipUse>(&item.what)) shown[use->clip] = true;
      }
    }
    for (std::size_t i = 0; i < shown.size(); ++i) require(shown[i], "no lane shows clip {}", i);
  }

  void curves() const {
    for (std::size_t i = 0; i < score.curves.size(); ++i) {
      const AuthoredCurve& one = score.curves[i];
      require(one.at.begin < one.at.end && one.at.begin < score.frames && one.at.end > 0 &&
                  one.at.begin >= -kMostFrames && one.at.end <= 2 * kMostFrames && one.first <= one.last,
              "curve {} is at frames {} to {} of {}, of places {} to {}", i, one.at.begin, one.at.end, score.frames,
              one.first, one.last);
      check(one.curve, fmt::format("{}: curve {}", where, i));
    }
  }

  /// The body and both arms of a junction that all of them have.
  void junctions() const {
    using Pair = std::pair<ClipId, ClipId>;
    std::array<std::map<Pair, TransitionCut>, kChannels.size()> cuts;
    for (std::size_t lane = 0; lane < kChannels.size(); ++lane) {
      for (const Item& item : score.lanes[lane].items) {
        const auto* const made = std::get_if<Transition>(&item.what);
        if (made != nullptr) cuts[lane].emplace(Pair(made->from, made->to), made->cut);
      }
    }
    for (const auto& [clips, body_cut] : cuts[0]) {
      std::array<const TransitionCut*, kChannels.size()> all{};
      for (std::size_t lane = 0; lane < kChannels.size(); ++lane) {
        const auto at = cuts[lane].find(clips);
        if (at == cuts[lane].end()) continue;
        all[lane] = &at->second;
        require(at->second.length == body_cut.length,
                "junction {} is {} frames long in lane '{}' and {} in 'body'; its length must be the same in all lanes",
                clips.second, at->second.length, name_of(kChannels[lane]), body_cut.length);
      }
      // A cross-fade applies to the whole body.
      constexpr auto kLeft = static_cast<std::size_t>(Channel::left), kRight = static_cast<std::size_t>(Channel::right);
      const TransitionCut& left = all[kLeft] != nullptr ? *all[kLeft] : body_cut;
      const TransitionCut& right = all[kRight] != nullptr ? *all[kRight] : body_cut;
      require((body_cut == left && body_cut == right) || body_cut.overlap() + left.overlap() + right.overlap() == 0,
              "junction {} is cross-faded, so its cut must be the same in the lanes of the body and both arms",
              clips.second);
    }
  }
};

std::string name_of(const Clip& clip) {
  if (clip.source.kind == SourceRef::Kind::shown) return "what was shown before";
  std::string signs;
  for (const Sign& sign : clip.signs) signs += (signs.empty() ? "" : " ") + printable(sign.gloss);
  if (signs.empty()) signs = clip.at_rest || clip.source.kind == SourceRef::Kind::rest ? "at rest" : "a piece";
  return fmt::format("{} from '{}'{}", signs, printable(clip.source.recording), clip.mirrored ? ", mirrored" : "");
}

/// The transition between two clips in a lane, or null.
const Item* transition_in(const Lane& lane, ClipId from, ClipId to) {
  const auto at = std::ranges::find_if(lane.items, [&](const Item& item) {
    const auto* const made = std::get_if<Transition>(&item.what);
    return made != nullptr && made->from == from && made->to == to;
  });
  return at == lane.items.end() ? nullptr : &*at;
}

/// "left, left_fingers": the lanes that show a clip.
std::string lanes_with(const Score& score, ClipId clip) {
  std::string names;
  for (const Lane& lane : score.lanes) {
    const bool shows = std::ranges::any_of(lane.items, [&](const Item& item) {
      const auto* const use = std::get_if<ClipUse>(&item.what);
      return use != nullptr && use->clip == clip;
    });
    if (shows) names += (names.empty() ? "" : ", ") + std::string(name_of(lane.channel));
  }
  return names;
}

}  // namespace

std::string_view name_of(Channel channel) noexcept {
  switch (channel) {
    case Channel::body:
      return "body";
    case Channel::left:
      return "left";
    case Channel::right:
      return "right";
    case Channel::tracks:
      return "tracks";
    case Channel::left_fingers:
      return "left_fingers";
    case Channel::right_fingers:
      return "right_fingers";
    case Channel::head:
      return "head";
  }
  return "";
}

std::optional<Channel> channel_named(std::string_view name) noexcept {
  for (const Channel channel : kAllChannels) {
    if (name == name_of(channel)) return channel;
  }
  return std::nullopt;
}

std::optional<Channel> parent_of(Channel channel) noexcept {
  switch (channel) {
    case Channel::left_fingers:
      return Channel::left;
    case Channel::right_fingers:
      return Channel::right;
    case Channel::head:
      return Channel::body;
    default:
      return std::nullopt;
  }
}

std::size_t body_clips(const Score& score) noexcept {
  if (score.lanes.empty()) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(
      score.lanes.front().items, [](const Item& item) { return std::holds_alternative<ClipUse>(item.what); }));
}

const Lane* lane_of(const Score& score, Channel channel) noexcept {
  const auto at = std::ranges::find(score.lanes, channel, &Lane::channel);
  return at == score.lanes.end() ? nullptr : &*at;
}

std::string_view name_of(SourceRef::Kind kind) noexcept {
  switch (kind) {
    case SourceRef::Kind::recording:
      return "recording";
    case SourceRef::Kind::rest:
      return "rest";
    case SourceRef::Kind::shown:
      return "shown";
  }
  return "";
}

void check(const Score& score, const std::string& where) {
  const Checker checker{score, where, body_clips(score)};
  checker.require(!score.clips.empty(), "a score must have at least one clip");
  checker.require(score.skeleton.kind == SourceRef::Kind::recording && !score.skeleton.recording.empty(),
                  "'skeleton' names no recording");
  constexpr std::int64_t kMostInRate = 1'000'000'000;
  checker.require(score.rate.numerator > 0 && score.rate.numerator <= kMostInRate && score.rate.denominator > 0 &&
                      score.rate.denominator <= kMostInRate && score.rate.hertz() >= 1e-3 && score.rate.hertz() <= 1e6,
                  "{}/{} frames a second; a score has 0.001 to 1000000", score.rate.numerator, score.rate.denominator);
  checker.require(score.frames > 0 && score.frames <= kMostFrames, "{} frames; a score has 1 to {}", score.frames,
                  kMostFrames);
  for (std::size_t i = 0; i < score.clips.size(); ++i) checker.clip(score.clips[i], i);
  checker.require(score.junctions.size() + 1 == score.clips.size(), "{} junctions between {} clips",
                  score.junctions.size(), score.clips.size());
  for (const JunctionRef& junction : score.junctions) {
    checker.require(find_transition_method(junction.method) != nullptr, "no transition method '{}'", junction.method);
    if (!junction.chosen.empty()) parse_junction("1=" + junction.chosen);
  }
  checker.lanes();
  checker.junctions();
  checker.curves();
}

std::string to_string(const Score& score) {
  std::string text = fmt::format("{} frames at {} frames a second, with the joints of '{}'\n", score.frames,
                                 to_string(score.rate), printable(score.skeleton.recording));
  const std::size_t body = body_clips(score);
  for (std::size_t i = 0; i < score.clips.size(); ++i) {
    const Clip& clip = score.clips[i];
    if (i > 0 && i < body) {
      const JunctionRef& junction = score.junctions[i - 1];
      text += fmt::format("{:>8}  junction {} by {}:", "", junction.number, junction.method);
      std::string_view separator = "";
      for (const Lane& lane : score.lanes) {
        const Item* const item = transition_in(lane, static_cast<ClipId>(i - 1), static_cast<ClipId>(i));
        if (item == nullptr) continue;
        text += fmt::format("{} {} {}-{}", separator, name_of(lane.channel), item->at.begin, item->at.end);
        separator = ",";
      }
      text += '\n';
    }
    text += fmt::format("{:>8}  clip {}, place {}: {} {}-{}{}{}\n", clip.at.begin, clip.id, clip.place, name_of(clip),
                        clip.core.begin, clip.core.end,
                        clip.step == 1 ? "" : fmt::format(", {:.4g} frames a frame", clip.step),
                        i < body ? "" : ", " + lanes_with(score, clip.id));
  }
  for (const AuthoredCurve& one : score.curves) {
    text += fmt::format("{:>8}  {} until {}\n", one.at.begin, printable(one.curve.name), one.at.end);
  }
  for (const Lane& lane : score.lanes) {
    for (const Item& item : lane.items) {
      const auto* const held = std::get_if<Hold>(&item.what);
      if (held == nullptr) continue;
      text += fmt::format("{:>8}  {}: clip {} is held until {}\n", item.at.begin, name_of(lane.channel), held->clip,
                          item.at.end);
    }
  }
  return text;
}

}  // namespace signweave
