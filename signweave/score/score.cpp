#include "signweave/score/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    require(!clip.mirrored || clip.source.kind == SourceRef::Kind::recording,
            "clip {} is mirrored, but not of kind 'recording'; only frames of recordings can be mirrored", index);
    require(in_range(clip.whole.begin) && in_range(clip.whole.end) && clip.whole.begin <= clip.core.begin &&
                clip.core.begin < clip.core.end && clip.core.end <= clip.whole.end,
            "clip {} keeps frames {} to {} out of {} to {}; the first range must not be empty, and lie in the second",
            index, clip.core.begin, clip.core.end, clip.whole.begin, clip.whole.end);
    require(std::isfinite(clip.step) && clip.step >= 1e-3 && clip.step <= 1e6,
            "clip {} has the step {}; a step is a number from 0.001 to 1000000", index, clip.step);
    require(in_range(clip.at.begin) && clip.at.begin < clip.at.end && clip.at.end <= score.frames,
            "clip {} is at frames {} to {} of {}", index, clip.at.begin, clip.at.end, score.frames);
    require(index == 0 || clip.at.begin >= score.clips[index - 1].at.end,
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

  void transition(const Transition& made, const FrameRange& at, std::size_t index, std::string_view channel) const {
    const TransitionCut& cut = made.cut;
    require(made.from + 1 == made.to && made.from == index, "lane '{}': transition {} goes from clip {} to {}", channel,
            index, made.from, made.to);
    for (const std::int64_t number :
         {cut.length, cut.retraction_frames, cut.preparation_frames, cut.blend_frames, cut.pause_frames}) {
      require(in_range(number), "lane '{}': transition {} has a cut with {} frames", channel, index, number);
    }
    require(cut.retraction_frames <= cut.length && cut.preparation_frames <= cut.length,
            "lane '{}': transition {} keeps more than its {} frames", channel, index, cut.length);
    require(at.size() == cut.gap() + cut.overlap(), "lane '{}': transition {} has {} frames; its cut leaves {}",
            channel, index, at.size(), cut.gap() + cut.overlap());
  }

  void lane(const Lane& lane, Channel channel) const {
    const std::string_view name = name_of(channel);
    require(lane.channel == channel, "lane '{}' is where '{}' belongs", name_of(lane.channel), name);
    require(lane.items.size() == 2 * score.clips.size() - 1, "lane '{}' has {} items; {} clips make {}", name,
            lane.items.size(), score.clips.size(), 2 * score.clips.size() - 1);
    std::int64_t end = 0;
    for (std::size_t i = 0; i < lane.items.size(); ++i) {
      const Item& item = lane.items[i];
      require(item.at.begin == end && item.at.end >= end,
              "lane '{}': item {} is at {} to {}; the one before it ends at {}", name, i, item.at.begin, item.at.end,
              end);
      end = item.at.end;
      if (i % 2 == 1) {
        require(std::holds_alternative<Transition>(item.what), "lane '{}': item {} is not a transition", name, i);
        transition(std::get<Transition>(item.what), item.at, i / 2, name);
      } else {
        const ClipUse* const use = std::get_if<ClipUse>(&item.what);
        require(use != nullptr && use->clip == i / 2, "lane '{}': item {} is not clip {}", name, i, i / 2);
        const Clip& clip = score.clips[i / 2];
        require(item.at.begin <= clip.at.begin && clip.at.end <= item.at.end,
                "lane '{}': clip {} is at {} to {}; its core is at {} to {}", name, i / 2, item.at.begin, item.at.end,
                clip.at.begin, clip.at.end);
      }
    }
    require(end == score.frames, "lane '{}' ends at frame {} of {}", name, end, score.frames);
  }
};

std::string name_of(const Clip& clip) {
  if (clip.source.kind == SourceRef::Kind::shown) return "what was shown before";
  std::string signs;
  for (const Sign& sign : clip.signs) signs += (signs.empty() ? "" : " ") + printable(sign.gloss);
  if (signs.empty()) signs = clip.source.kind == SourceRef::Kind::rest ? "at rest" : "a piece";
  return fmt::format("{} from '{}'{}", signs, printable(clip.source.recording), clip.mirrored ? ", mirrored" : "");
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
  }
  return "";
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
  const Checker checker{score, where};
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
  checker.require(score.lanes.size() == kChannels.size(), "{} lanes; there must be {}", score.lanes.size(),
                  kChannels.size());
  for (std::size_t i = 0; i < kChannels.size(); ++i) checker.lane(score.lanes[i], kChannels[i]);
  for (std::size_t i = 0; i + 1 < score.clips.size(); ++i) {
    const auto length = [&](std::size_t lane) {
      return std::get<Transition>(score.lanes[lane].items[2 * i + 1].what).cut.length;
    };
    for (std::size_t lane = 1; lane < kChannels.size(); ++lane) {
      checker.require(
          length(lane) == length(0),
          "junction {} is {} frames long in lane '{}' and {} in '{}'; its length must be the same in all lanes", i + 1,
          length(lane), name_of(kChannels[lane]), length(0), name_of(kChannels[0]));
    }
    // A cross-fade applies to the whole body.
    const auto cut = [&](Channel lane) {
      return std::get<Transition>(score.lanes[static_cast<std::size_t>(lane)].items[2 * i + 1].what).cut;
    };
    const TransitionCut body = cut(Channel::body), left = cut(Channel::left), right = cut(Channel::right);
    checker.require((body == left && body == right) || body.overlap() + left.overlap() + right.overlap() == 0,
                    "junction {} is cross-faded, so its cut must be the same in the lanes of the body and both arms",
                    i + 1);
  }
}

std::string to_string(const Score& score) {
  std::string text = fmt::format("{} frames at {} frames a second, with the joints of '{}'\n", score.frames,
                                 to_string(score.rate), printable(score.skeleton.recording));
  for (std::size_t i = 0; i < score.clips.size(); ++i) {
    const Clip& clip = score.clips[i];
    if (i > 0) {
      const JunctionRef& junction = score.junctions[i - 1];
      text += fmt::format("{:>8}  junction {} by {}:", "", junction.number, junction.method);
      for (const Lane& lane : score.lanes) {
        const FrameRange at = lane.items[2 * i - 1].at;
        text += fmt::format("{} {} {}-{}", &lane == &score.lanes.front() ? "" : ",", name_of(lane.channel), at.begin,
                            at.end);
      }
      text += '\n';
    }
    text += fmt::format("{:>8}  clip {}, place {}: {} {}-{}{}\n", clip.at.begin, clip.id, clip.place, name_of(clip),
                        clip.core.begin, clip.core.end,
                        clip.step == 1 ? "" : fmt::format(", {:.4g} frames a frame", clip.step));
  }
  return text;
}

}  // namespace signweave
