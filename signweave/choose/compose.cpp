#include "signweave/choose/compose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "signweave/choose/channel_chains.h"
#include "signweave/choose/joint_setup.h"
#include "signweave/choose/junction_timer.h"
#include "signweave/core/error.h"
#include "signweave/render/held_clip.h"
#include "signweave/render/render.h"
#include "signweave/score/lane_chain.h"
#include "signweave/score/schedule.h"

namespace signweave {
namespace {

/// A hand that joins the body's last retraction shows so much of it.
constexpr Seconds kLowered{0.05};

/// A transition may be this much longer than its usual length before its first pose is held instead. (ours)
constexpr double kLongest = 1.5;

Timed timed_of(Channel channel) noexcept {
  switch (channel) {
    case Channel::left:
    case Channel::left_fingers:
      return Timed::left;
    case Channel::right:
    case Channel::right_fingers:
      return Timed::right;
    case Channel::body:
    case Channel::tracks:
    case Channel::head:
      return Timed::body;
  }
  return Timed::body;
}

/// A constraint of the schedule with what it means to the author.
struct Reason {
  TimeConstraint constraint;
  std::string text;
};

class Composer {
 public:
  Composer(std::vector<MotionClip> clips, std::size_t body, const ChannelParts& parts, const JunctionSettings& settings,
           const ConcatenateOptions& options, const std::vector<ChannelStart>& starts = {}, std::size_t known = 0)
      : clips_(std::move(clips)),
        body_(body),
        parts_(parts),
        settings_(settings),
        options_(options),
        timer_(settings, {.fit = options.fit, .duration = options.duration, .tempo = options.tempo}),
        chains_(channel_chains(parts, clips_, body, starts, known)) {}

  const std::vector<MotionClip>& clips() const noexcept { return clips_; }

  Score score(const SourceRef& skeleton) {
    place();
    std::vector<std::int64_t> earliest(placed_.size(), 0);
    earliest[0] = placed_[0].preparation;
    solve(earliest);
    stand();
    return placed_score(skeleton);
  }

  /// The score of clips of which some have their place already.
  Score score_after(const Continuation& before) {
    placed_ = before.placed;
    for (std::size_t i = 0; i < placed_.size(); ++i) placed_[i].captured = &clips_[i];
    fixed_ = before.fixed;
    fill();
    std::vector<std::int64_t> earliest(placed_.size(), 0);
    if (!before.fixed[0]) earliest[0] = placed_[0].preparation;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (before.fixed[i]) earliest[i] = placed_[i].core;
    }
    solve(earliest);
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (!before.fixed[i] || placed_[i].core == earliest[i]) continue;
      throw Error(ErrorCode::bad_input,
                  fmt::format("{} is signed already and cannot come later; tie nothing to it", name(i)));
    }
    return placed_score({});
  }

 private:
  Score placed_score(const SourceRef& skeleton) {
    Score score{
        .skeleton = skeleton, .rate = settings_.rate, .frames = frames(), .clips = {}, .junctions = {}, .lanes = {}};
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      score.clips.push_back(clip_of(placed_[i], static_cast<ClipId>(i)));
      if (i == 0) continue;
      score.junctions.push_back({.number = clips_[i].place.value_or(i),
                                 .method = std::string(method_of(settings_, placed_[i]).name),
                                 .chosen = to_string(clips_[i].junction)});
    }
    for (const ChannelChain& chain : chains_) score.lanes.push_back(lane_of(chain, score));
    return score;
  }

  void place() {
    placed_.reserve(clips_.size());
    for (const MotionClip& clip : clips_) {
      placed_.push_back(placed_at_tempo(clip, settings_.rate, options_.tempo));
    }
    fixed_.assign(placed_.size(), false);
    fill();
  }

  /// Stretches the cores of parts that fill those of whole-body clips.
  void fill() {
    for (std::size_t i = 0; i < parts_.clips.size(); ++i) {
      if (!parts_.clips[i].fill || fixed_[body_ + i]) continue;
      const PlacedClip& whole = placed_[parts_.clips[i].first];
      PlacedClip& filled = placed_[body_ + i];
      const auto frames = static_cast<double>(clips_[body_ + i].core.size());
      const std::optional<GroundTransform> standing = filled.standing;
      filled = placed_by_step(clips_[body_ + i], frames / static_cast<double>(whole.core_frames));
      filled.core_frames = whole.core_frames;
      filled.standing = standing;
    }
  }

  std::string name(std::size_t clip) const {
    const std::string own = quoted_name(clips_[clip]);
    return clip < body_ ? own : fmt::format("{} ({})", own, name_of(parts_.clips[clip - body_].channel));
  }

  /// The usual length of a transition and its cuts.
  const JunctionCuts& usual(std::size_t from, std::size_t to, bool held) {
    const auto [at, is_new] = usual_.try_emplace({from, to, held});
    if (!is_new) return at->second;
    const bool of_body = to == from + 1 && to < body_;
    if (to == from + 1 && to != body_ && !held && clips_[to].continues) {
      const std::int64_t recorded = clips_[to].core.begin - clips_[from].core.end;
      const std::int64_t length = std::min(
          placed_[from].retraction, std::int64_t{std::llround(static_cast<double>(recorded) / placed_[from].step)});
      at->second.tracks = {.length = length, .retraction_frames = length};
      at->second.parts.fill(at->second.tracks);
      return at->second;
    }
    const Milliseconds pause = of_body && !held ? clips_[to].pause_before : Milliseconds(0);
    if (held) {
      const HeldClip still = hold(placed_[from], {.after_core = 1});
      at->second = timer_.cuts_between(still.placed, placed_[to], pause, scratch_);
    } else {
      at->second = timer_.cuts_between(placed_[from], placed_[to], pause, scratch_);
    }
    return at->second;
  }

  std::int64_t frames_in(Seconds time) const {
    return std::llround(time.count() / options_.tempo * settings_.rate.hertz());
  }

  /// Each clip must come late enough after the one before it in every lane, and with those that it is tied to.
  std::vector<Reason> reasons() {
    std::vector<Reason> all;
    for (const ChannelChain& chain : chains_) {
      if (chain.channel == Channel::tracks) continue;
      for (std::size_t i = 0; i + 1 < chain.links.size(); ++i) {
        const ChannelLink& from = chain.links[i];
        const ChannelLink& to = chain.links[i + 1];
        if (fixed_[to.clip]) continue;
        const std::int64_t length = usual(from.clip, to.clip, from.held_until.has_value()).tracks.length;
        all.push_back({{from.clip, to.clip, placed_[from.clip].core_frames + length},
                       fmt::format("{} comes after {} in the lane '{}'", name(to.clip), name(from.clip),
                                   name_of(chain.channel))});
        if (clips_[to.clip].at_rest && to.first > 0 && from.clip + 1 != to.first) {
          const std::size_t before = to.first - 1;
          all.push_back({{before, to.clip, placed_[before].core_frames + length},
                         fmt::format("{} in the lane '{}' begins after {}", name(to.clip), name_of(chain.channel),
                                     name(before))});
        }
        if (!from.held_until) continue;
        const std::size_t until = *from.held_until;
        all.push_back({{until, to.clip, placed_[until].core_frames + length},
                       fmt::format("{} is held in the lane '{}' until {} ends", name(from.clip), name_of(chain.channel),
                                   name(until))});
      }
    }
    for (std::size_t i = 0; i < parts_.clips.size(); ++i) {
      if (fixed_[body_ + i]) continue;
      if (parts_.clips[i].lower) {  // it ends with the body's retraction
        const std::size_t last = body_ - 1;
        const PlacedClip& lowered = placed_[body_ + i];
        const std::int64_t begin = placed_[last].retraction - lowered.core_frames - lowered.retraction;
        all.push_back({{last, body_ + i, placed_[last].core_frames + begin}, "the held hand is lowered"});
      }
      for (const ClipSync& sync : parts_.clips[i].sync) tie(body_ + i, sync, all);
    }
    return all;
  }

  void tie(std::size_t clip, const ClipSync& sync, std::vector<Reason>& all) const {
    const bool at_end = sync.anchor == ClipSync::Anchor::end;
    std::int64_t offset = frames_in(sync.offset);
    if (at_end) offset += placed_[sync.with].core_frames - placed_[clip].core_frames;
    const std::string text =
        fmt::format("{} {} {}{}", name(clip), at_end ? "ends with" : "begins with", name(sync.with),
                    sync.offset == Seconds(0) ? std::string() : fmt::format(" {:+.7g} ms", 1000 * sync.offset.count()));
    all.push_back({{sync.with, clip, offset}, text});
    if (!sync.at_least) all.push_back({{clip, sync.with, -offset}, text});
  }

  void solve(const std::vector<std::int64_t>& earliest) {
    const std::vector<Reason> all = reasons();
    std::vector<TimeConstraint> constraints;
    for (const Reason& reason : all) constraints.push_back(reason.constraint);
    const Schedule found = schedule(earliest, constraints);
    if (!found.contradiction.empty()) contradict(all, found.contradiction);
    for (std::size_t i = 0; i < placed_.size(); ++i) placed_[i].core = found.moments[i];
  }

  [[noreturn]] void contradict(const std::vector<Reason>& all, const std::vector<std::size_t>& cycle) const {
    std::vector<std::string> texts;
    std::string lengths;
    for (const std::size_t i : cycle) {
      if (std::ranges::find(texts, all[i].text) != texts.end()) continue;
      texts.push_back(all[i].text);
      const std::size_t clip = all[i].constraint.from;
      const double ms = 1000.0 * static_cast<double>(placed_[clip].core_frames) / settings_.rate.hertz();
      lengths += fmt::format("{}{} takes {:.0f} ms", lengths.empty() ? "" : ", ", name(clip), ms);
    }
    throw Error(ErrorCode::bad_input,
                fmt::format("these cannot all be true: {}; strokes keep their length ({}), so leave out one of them",
                            fmt::join(texts, "; "), lengths));
  }

  void stand() {
    Motion memory;
    const std::string& home_recording = clips_[options_.reference].recording;
    std::optional<Standing> home;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (!is_aligned(options_.alignment, clips_[i].recording, home_recording)) continue;
      if (!home) home = standing_of(placed_[options_.reference], settings_, memory);
      placed_[i].standing = align(standing_of(placed_[i], settings_, memory), *home);
    }
  }

  /// The length of the output: until the last retraction of any lane.
  std::int64_t frames() const {
    std::int64_t end = 0;
    for (const ChannelChain& chain : chains_) {
      const ChannelLink& last = chain.links.back();
      const PlacedClip& placed = placed_[last.clip];
      end = std::max(end, placed.core_end() + (last.held_until ? 0 : placed.retraction));
    }
    if (end > options_.most_frames) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("the result would have {} frames, more than {}; sign fewer signs, or at a lower rate",
                              end, options_.most_frames),
                  {{"rate", ""}});
    }
    return end;
  }

  /// What is held after a clip, and the cut of the transition after that.
  LaneLink joined(const ChannelChain& chain, std::size_t link) {
    const ChannelLink& from = chain.links[link];
    const ChannelLink& to = chain.links[link + 1];
    LaneLink made{.clip = static_cast<ClipId>(from.clip), .cut = {}};
    const bool is_held = from.held_until.has_value();
    const JunctionCuts& usual_cuts = usual(from.clip, to.clip, is_held);
    const std::int64_t length = usual_cuts.tracks.length;
    const std::int64_t time = placed_[to.clip].core - placed_[from.clip].core_end();
    const bool has_time_left = static_cast<double>(time) > kLongest * static_cast<double>(length);
    if (is_held || has_time_left || clips_[from.clip].at_rest) made.held = time - length;
    const bool lowers = to.clip >= body_ && parts_.clips[to.clip - body_].lower;
    if (lowers) made.held = placed_[body_ - 1].core_end() - placed_[from.clip].core_end();
    const auto [at, is_new] = cuts_.try_emplace({from.clip, to.clip, made.held});
    if (is_new) {
      if (made.held == 0 && time == length && !is_held) {
        at->second = usual_cuts;
      } else {
        const bool of_body = to.clip == from.clip + 1 && to.clip < body_;
        const Milliseconds pause = of_body && made.held == 0 ? clips_[to.clip].pause_before : Milliseconds(0);
        std::optional<HeldClip> still;
        if (made.held > 0) still = hold(placed_[from.clip], {.after_core = made.held});
        at->second = timer_.cuts_between(still ? still->placed : placed_[from.clip], placed_[to.clip], pause, scratch_,
                                         time - made.held);
      }
    }
    made.cut = chain.channel == Channel::tracks ? at->second.tracks
                                                : at->second.parts[static_cast<std::size_t>(timed_of(chain.channel))];
    return made;
  }

  Lane lane_of(const ChannelChain& chain, const Score& score) {
    LaneChain links;
    for (std::size_t i = 0; i + 1 < chain.links.size(); ++i) links.push_back(joined(chain, i));
    const ChannelLink& last = chain.links.back();
    const PlacedClip& end = placed_[last.clip];
    const std::int64_t shown_after = last.held_until ? 0 : end.retraction;
    links.push_back({.clip = static_cast<ClipId>(last.clip),
                     .held = std::max<std::int64_t>(0, score.frames - end.core_end() - shown_after),
                     .cut = {}});
    const PlacedClip& first = placed_[chain.links.front().clip];
    links.front().held_before = std::max<std::int64_t>(0, first.core - first.preparation);
    return signweave::lane_of(chain.channel, links, score.clips, score.frames);
  }

  std::vector<MotionClip> clips_;  ///< those of the body, then those of the parts
  std::size_t body_;
  const ChannelParts& parts_;
  const JunctionSettings& settings_;
  const ConcatenateOptions& options_;
  JunctionTimer timer_;
  JunctionScratch scratch_;
  std::vector<ChannelChain> chains_;
  std::vector<PlacedClip> placed_;  ///< [clip]
  std::vector<bool> fixed_;         ///< [clip] it has its place
  std::map<std::tuple<std::size_t, std::size_t, bool>, JunctionCuts> usual_;
  std::map<std::tuple<std::size_t, std::size_t, std::int64_t>, JunctionCuts> cuts_;
};

/// The parts, and for each pose that is held until the last clip ends, what its hand does after that.
ChannelParts with_lowered(const std::vector<MotionClip>& clips, ChannelParts parts) {
  const std::size_t last = clips.size() - 1;
  for (const ChannelHold& held : parts.holds) {
    if (held.until != last) continue;
    std::optional<MotionClip> clip = lowered_hand(clips[last]);
    if (!clip) continue;
    parts.clips.push_back(
        {.channel = held.channel, .clip = std::move(*clip), .first = last, .last = last, .sync = {}, .lower = true});
  }
  return parts;
}

/// Lets hands keep the places that they had in their recordings.
void set_places(Score& score, const std::vector<MotionClip>& clips, const std::vector<FoundPlace>& places) {
  for (const FoundPlace& found : places) {
    const PlaceCorrection& correction = found.correction;
    if (correction.why_not && clips[found.clip].at_rest) continue;  // it rests as the copied arm has it
    if (correction.why_not) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("{}; take another token of it, or let the whole body sign it", *correction.why_not));
    }
    if (correction.none) continue;
    for (Item& item : score.lanes[static_cast<std::size_t>(found.channel)].items) {
      auto* const use = std::get_if<ClipUse>(&item.what);
      if (use == nullptr || use->clip != found.clip) continue;
      use->place = HandPlace{.anchor = correction.anchor,
                             .kept_in = correction.kept_in,
                             .out = correction.out,
                             .moved_mm = correction.size_mm,
                             .turned_degrees = correction.size_degrees};
    }
  }
}

}  // namespace

std::optional<MotionClip> lowered_hand(const MotionClip& last) {
  MotionClip lowered = last;
  const auto frames = std::int64_t{std::llround(kLowered.count() * lowered.source->rate().hertz())};
  lowered.whole.begin = lowered.core.end;
  if (lowered.whole.size() <= frames) return std::nullopt;
  lowered.core = {lowered.whole.end - std::max<std::int64_t>(frames, 1), lowered.whole.end};
  lowered.at_rest = true;
  lowered.signs.clear();
  lowered.sign_places.clear();
  lowered.junction = {};
  lowered.continues = false;
  return lowered;
}

Synthesis compose(const std::vector<MotionClip>& clips, const ChannelParts& wanted, const ConcatenateOptions& options,
                  Synthesis used) {
  const bool continues = std::ranges::any_of(clips, &MotionClip::continues);
  if (wanted.empty() && !continues) return concatenate(clips, options, std::move(used));
  const ChannelParts parts = with_lowered(clips, wanted);
  std::vector<MotionClip> all = clips;
  for (const ChannelClip& part : parts.clips) all.push_back(part.clip);
  const JointSetup setup(all, options);
  Composer composer(std::move(all), clips.size(), parts, setup.settings, options);
  Score score = composer.score(source_of(clips.at(options.reference)));
  if (options.author) score.curves = options.author(score);
  Synthesis out;
  out.motion = std::move(used.motion);
  out.sources = std::move(used.sources);
  Renderer renderer(plan_of(score, composer.clips()), setup.settings);
  set_places(score, composer.clips(), renderer.find_places(static_cast<ClipId>(clips.size()), out.motion));
  check(score, "score");
  render_over_body(std::move(score), renderer, composer.clips(), out);
  return out;
}

Score compose_after(const Continuation& before, const std::vector<MotionClip>& clips, std::size_t body,
                    const ChannelParts& parts, const JunctionSettings& settings, const ConcatenateOptions& options) {
  Composer composer(clips, body, parts, settings, options, before.starts, before.known_parts);
  Score score = composer.score_after(before);
  for (Lane& lane : score.lanes) {
    if (!side_of_arm(lane.channel)) continue;
    for (Item& item : lane.items) {
      if (auto* const use = std::get_if<ClipUse>(&item.what)) use->place = before.places[use->clip];
    }
  }
  const std::size_t known = body + before.known_parts;
  if (known == clips.size()) return score;
  Renderer renderer(plan_of(score, composer.clips()), settings, Renderer::Tracks::left_out);
  set_places(score, composer.clips(), renderer.find_places(static_cast<ClipId>(known)));
  return score;
}

}  // namespace signweave
