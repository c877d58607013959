#include "signweave/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "signweave/core/error.h"
#include "signweave/render/carry_tracks.h"
#include "signweave/render/curve_renderer.h"
#include "signweave/render/lane_renderer.h"
#include "signweave/render/window.h"
#include "signweave/score/place_signs.h"

namespace signweave {
namespace {

const std::string& name_at_end(const MotionClip& clip) {
  return clip.signs.empty() ? clip.recording : clip.signs.back().gloss;
}
const std::string& name_at_begin(const MotionClip& clip) {
  return clip.signs.empty() ? clip.recording : clip.signs.front().gloss;
}

/// Fills in the source of each frame of a plan.
void name_sources(const Score& score, const Plan& plan, std::vector<FrameSource>& sources) {
  sources.resize(static_cast<std::size_t>(plan.frames));
  const auto at = [&](std::int64_t frame) -> FrameSource& { return sources[static_cast<std::size_t>(frame)]; };
  for (std::size_t i = 0; i < plan.placed.size(); ++i) {
    const PlacedClip& now = plan.placed[i];
    const auto clip = static_cast<std::int32_t>(i);
    const bool last = i + 1 == plan.placed.size();
    const std::int64_t kept_before = i == 0 ? now.before : common_to(plan.cuts[i - 1].parts).kept_before();
    const std::int64_t kept_after = last ? now.after : common_to(plan.cuts[i].parts).kept_after();
    if (i > 0) {
      const std::int64_t made_from = plan.placed[i - 1].core_end() + common_to(plan.cuts[i - 1].parts).kept_after();
      for (std::int64_t frame = made_from; frame < now.core - kept_before; ++frame) {
        at(frame) = {FrameSource::kNone, clip - 1, 0};
      }
    }
    const Clip& clip_of_score = score.clips[i];
    const auto kept = [&](std::int64_t begin, std::int64_t end, std::int32_t junction) {
      if (now.captured_as_is()) {
        const std::int64_t shift = clip_of_score.core.begin - now.core;
        for (std::int64_t frame = begin; frame < end; ++frame) {
          at(frame) = {clip, junction, static_cast<double>(frame + shift)};
        }
      } else {
        const auto recorded_shift = static_cast<double>(clip_of_score.core.begin - now.captured->core.begin);
        for (std::int64_t frame = begin; frame < end; ++frame) {
          at(frame) = {clip, junction, now.frame_at(frame) + recorded_shift};
        }
      }
    };
    kept(now.core - kept_before, now.core, i > 0 ? clip - 1 : FrameSource::kNone);
    kept(now.core, now.core_end(), FrameSource::kNone);
    kept(now.core_end(), now.core_end() + kept_after, last ? FrameSource::kNone : clip);
  }
  // Held poses are of the frame next to them, and frames composed of several clips of none.
  for (const Item& item : score.lanes.front().items) {
    const auto* const held = std::get_if<Hold>(&item.what);
    if (held == nullptr) continue;
    const FrameSource pose = item.at.begin == 0 ? at(item.at.end) : at(item.at.begin - 1);
    for (std::int64_t frame = item.at.begin; frame < item.at.end; ++frame) at(frame).frame = pose.frame;
  }
  for (const LaneRun& run : plan.runs) {
    for (std::int64_t frame = run.frames.begin; frame < run.frames.end; ++frame) at(frame) = {};
  }
}

void place_clips(const Score& score, const std::size_t body, Synthesis& out) {
  out.clips.clear();
  for (std::size_t i = 0; i < score.clips.size(); ++i) {
    const Clip& clip = score.clips[i];
    ShownClip shown{.recording = clip.source.recording,
                    .output = {i == 0 ? 0 : clip.at.begin, i + 1 == body ? score.frames : clip.at.end},
                    .core = clip.at,
                    .first_frame = static_cast<double>(clip.core.begin),
                    .step = clip.step};
    out.clips.push_back(std::move(shown));
  }
  // Clips of single channels: from the first lane that shows them.
  for (const Lane& lane : score.lanes) {
    for (const Item& item : lane.items) {
      const auto* const use = std::get_if<ClipUse>(&item.what);
      if (use == nullptr || use->clip < body || out.clips[use->clip].channel != Channel::body) continue;
      out.clips[use->clip].channel = lane.channel;
      out.clips[use->clip].output = item.at;
    }
  }
}

void place_junctions(const Score& score, const Plan& plan, Synthesis& out) {
  out.junctions.clear();
  for (std::size_t i = 0; i + 1 < plan.placed.size(); ++i) {
    const PlacedClip& a = plan.placed[i];
    const PlacedClip& b = plan.placed[i + 1];
    const JunctionRef& junction = score.junctions[i];
    out.junctions.push_back(
        {.from = name_at_end(*a.captured),
         .to = name_at_begin(*b.captured),
         .frames = {a.core_end(), b.core},
         .cut = common_to(plan.cuts[i].parts),
         .cuts = plan.cuts[i].parts,
         .method = junction.method,
         .number = junction.number,
         .chosen = junction.chosen.empty() ? JunctionChoice() : parse_junction("1=" + junction.chosen).choice});
    assert(out.junctions.back().frames.size() == plan.cuts[i].tracks.length);
  }
}

/// Copies `frames` from `made`, which begins at output frame `from`.
void copy(const Motion& made, std::int64_t from, FrameRange frames, Motion& out) {
  const FrameRange here{frames.begin - from, frames.end - from};
  out.reset(made.shared_skeleton(), made.rate(), frames.size());
  BorrowedSource(made).read(here, out.poses({0, frames.size()}));
  for (const ScalarTrack& track : made.tracks()) {
    out.add_track({track.name, {track.values.begin() + here.begin, track.values.begin() + here.end}});
  }
}

/// Fills everything of a synthesis that follows from its score, once its motion is rendered.
void describe(Score score, const Plan& plan, const std::vector<MotionClip>& clips, Synthesis& out) {
  name_sources(score, plan, out.sources);
  place_clips(score, plan.placed.size(), out);
  place_junctions(score, plan, out);
  out.score = std::move(score);
  out.signs.clear();
  place_signs(clips, out);
}

}  // namespace

Renderer::Renderer(Plan plan, const JunctionSettings& settings, Tracks tracks)
    : plan_(std::move(plan)), settings_(settings), filler_(settings) {
  if (tracks == Tracks::shown) tracks_ = tracks_of(plan_.placed);
  if (tracks == Tracks::shown && !plan_.curves.empty()) {
    curves_ = std::make_unique<CurveRenderer>(plan_.curves, settings_);
    for (std::string& name : curves_->tracks()) {
      if (std::ranges::find(tracks_, name) == tracks_.end()) tracks_.push_back(std::move(name));
    }
  }
  if (!plan_.runs.empty()) lanes_ = std::make_unique<LaneRenderer>(plan_.runs, settings_);
}

Renderer::Renderer(Plan plan, const JunctionSettings& settings, GroupSet shown)
    : plan_(std::move(plan)), settings_(settings), filler_(settings, shown) {
  if (!plan_.runs.empty()) lanes_ = std::make_unique<LaneRenderer>(plan_.runs, settings_);
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

/// Includes the complete transitions that the frames touch, and the context on both sides of those.
Renderer::Section Renderer::section_with(FrameRange frames) const {
  const std::vector<PlacedClip>& placed = plan_.placed;
  const auto clip_at = [&](std::int64_t frame) {  // the last one whose core has begun, or the first
    const auto after = std::ranges::upper_bound(placed, frame, {}, &PlacedClip::core);
    return after == placed.begin() ? std::size_t{0} : static_cast<std::size_t>(after - placed.begin()) - 1;
  };
  Section section{.first = clip_at(frames.begin), .last = clip_at(frames.end - 1), .frames = frames};
  if (section.last + 1 < placed.size() && frames.end > placed[section.last].core_end()) ++section.last;
  if (section.first == section.last) return section;
  const std::int64_t context = filler_.context();
  const PlacedClip& first = placed[section.first];
  const PlacedClip& last = placed[section.last];
  section.frames.begin = std::min(frames.begin, std::max(first.core, first.core_end() - context));
  section.frames.end = std::max(frames.end, std::min(last.core + context, last.core_end()));
  return section;
}

/// The joints of a clip that are negated when each clip is made continuous with the previous one.
const JointSigns& Renderer::turned_in(std::size_t clip) {
  const std::size_t joints = settings_.skeleton->joint_count();
  if (turned_.empty()) turned_.emplace_back(joints, false);
  if (clip < turned_.size()) return turned_[clip];
  const JointGroups& groups = settings_.rig->groups;
  Motion left(settings_.skeleton, settings_.rate, 1);
  Motion right(settings_.skeleton, settings_.rate, 1);
  while (turned_.size() <= clip) {
    const std::size_t i = turned_.size();
    const PlacedClip& a = plan_.placed[i - 1];
    const PlacedClip& b = plan_.placed[i];
    const JointSigns& before = turned_.back();
    JointSigns turned(joints, false);
    for (const Timed part : kAllTimed) {
      const JunctionFiller::Meeting at = JunctionFiller::meeting(a, b, plan_.cuts[i - 1].parts, part);
      read_standing(a, *settings_.skeleton, {at.of_a, at.of_a + 1}, left.poses({0, 1}));
      read_standing(b, *settings_.skeleton, {at.of_b, at.of_b + 1}, right.poses({0, 1}));
      const GroupSet of_part = groups_of(part);
      for (std::size_t joint = 0; joint < joints; ++joint) {
        if (!of_part.has(groups.of[joint])) continue;
        const float dot = left.rotations()[joint].dot(right.rotations()[joint]);
        turned[joint] = (before[joint] ? -dot : dot) < 0;
      }
    }
    turned_.push_back(std::move(turned));
  }
  return turned_[clip];
}

void Renderer::render(FrameRange frames, Motion& out) {
  render_body(frames, out);
  show_over({out, frames.begin});
}

/// Shows what lanes and curves add to the whole body.
void Renderer::show_over(OutputWindow window) {
  if (lanes_) lanes_->apply(window, [&](FrameRange other, Motion& body) { render_body(other, body); });
  if (curves_) curves_->apply(window);
}

void Renderer::render_body(FrameRange frames, Motion& out) {
  if (frames.begin < 0 || frames.end > plan_.frames || frames.begin > frames.end) {
    throw Error(ErrorCode::bad_input,
                fmt::format("frames {} to {} are not in a score of {} frames", frames.begin, frames.end, plan_.frames));
  }
  std::vector<ScalarTrack> used = out.take_tracks();
  if (frames.empty()) {
    out.reset(settings_.skeleton, settings_.rate, 0);
    for (const std::string& name : tracks_) out.add_track({name, {}});
    return;
  }
  const Section section = section_with(frames);
  Motion& made = section.frames == frames ? out : window_;
  made.reset(settings_.skeleton, settings_.rate, section.frames.size());
  const OutputWindow window{made, section.frames.begin};
  signweave::fetch(std::span(plan_.placed).subspan(section.first, section.last - section.first + 1), window);
  join_section(section, window, std::move(used));
  if (&made == &out) return;
  copy(made, section.frames.begin, frames, out);
  window_.take_tracks();
}

std::vector<FoundPlace> Renderer::find_places(ClipId first, Motion& body) {
  render_body({0, plan_.frames}, body);
  if (!lanes_) return {};
  const BorrowedSource rendered(body);
  return lanes_->find_places(first, [&](FrameRange frames, Motion& out) {
    out.reset(settings_.skeleton, settings_.rate, frames.size());
    rendered.read(frames, out.poses({0, frames.size()}));
  });
}

std::vector<FoundPlace> Renderer::find_places(ClipId first) {
  if (!lanes_) return {};
  return lanes_->find_places(first, [&](FrameRange frames, Motion& out) { render_body(frames, out); });
}

void Renderer::take_places(const Score& score) {
  for (LaneRun& run : plan_.runs) {
    for (const Item& item : lane_of(score, run.channel)->items) {
      const auto* const use = std::get_if<ClipUse>(&item.what);
      if (use == nullptr) continue;
      const auto clip = std::ranges::find(run.clips, use->clip);
      if (clip != run.clips.end()) run.places[static_cast<std::size_t>(clip - run.clips.begin())] = use->place;
    }
  }
}

void Renderer::render_fetched(Motion& out, std::vector<ScalarTrack> used) {
  join_section({.first = 0, .last = plan_.placed.size() - 1, .frames = {0, plan_.frames}}, {out}, std::move(used));
  show_over({out});
}

void Renderer::join_section(const Section& section, OutputWindow window, std::vector<ScalarTrack> used) {
  const std::span clips = std::span(plan_.placed).subspan(section.first, section.last - section.first + 1);
  const std::span cuts = std::span(plan_.cuts).subspan(section.first, section.last - section.first);
  join({.clips = clips, .cuts = cuts, .turned = section.first == 0 ? nullptr : &turned_in(section.first)}, filler_,
       window, scratch_);
  if (tracks_.empty()) return;
  std::vector<PlacedClip> placed(clips.begin(), clips.end());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    placed[i].after = cuts[i].tracks.retraction_frames;
    placed[i + 1].before = cuts[i].tracks.preparation_frames;
  }
  used.resize(tracks_.size());
  for (std::size_t i = 0; i < tracks_.size(); ++i) used[i].name = tracks_[i];
  carry_tracks(placed, section.frames, used);
  for (ScalarTrack& track : used) window.motion.add_track(std::move(track));
}

std::vector<ScalarTrack> fetch(const Plan& plan, const JunctionSettings& settings, Motion& out) {
  std::vector<ScalarTrack> used_tracks = out.take_tracks();
  out.reset(settings.skeleton, settings.rate, plan.frames);
  fetch(plan.placed, {out});
  return used_tracks;
}

void render(Score score, const std::vector<MotionClip>& clips, const JunctionSettings& settings, Synthesis& out) {
  Renderer renderer(plan_of(score, clips), settings);
  render(std::move(score), renderer, clips, std::nullopt, out);
}

void render_over_body(Score score, Renderer& renderer, const std::vector<MotionClip>& clips, Synthesis& out) {
  renderer.take_places(score);
  renderer.show_over(out.motion);
  describe(std::move(score), renderer.plan(), clips, out);
}

void render(Score score, Renderer& renderer, const std::vector<MotionClip>& clips,
            std::optional<std::vector<ScalarTrack>> fetched, Synthesis& out) {
  if (fetched) {
    renderer.render_fetched(out.motion, std::move(*fetched));
  } else {
    renderer.render({0, renderer.plan().frames}, out.motion);
  }
  describe(std::move(score), renderer.plan(), clips, out);
}

}  // namespace signweave
