#include "signweave/synthesis/concatenate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "signweave/core/error.h"
#include "signweave/motion/blend.h"
#include "signweave/synthesis/carry_tracks.h"
#include "signweave/synthesis/laid.h"
#include "signweave/synthesis/place_signs.h"

namespace signweave {
namespace {

void check_skeletons(const std::vector<Stretch>& stretches, const Stretch& reference) {
  for (const Stretch& stretch : stretches) {
    if (stretch.source->skeleton() == reference.source->skeleton()) continue;
    const auto differs = difference(*reference.source->skeleton(), *stretch.source->skeleton());
    if (!differs) continue;
    throw Error(ErrorCode::bad_input,
                fmt::format("recordings '{}' and '{}' have different skeletons: {}; only motions with "
                            "the same joints can be joined",
                            reference.recording, stretch.recording, *differs));
  }
}

FrameRate highest_rate(const std::vector<Stretch>& stretches) {
  FrameRate highest = stretches[0].source->rate();
  for (const Stretch& stretch : stretches) {
    if (stretch.source->rate().hertz() > highest.hertz()) highest = stretch.source->rate();
  }
  return highest;
}

const std::string& name_at_end(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.back().gloss;
}
const std::string& name_at_begin(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.front().gloss;
}

/// A day of signing at a hundred frames a second. Frame rates come from files: a wrong one must not ask for a terabyte.
constexpr std::int64_t kMostFrames = 24 * 60 * 60 * 100;

void check_length(const std::vector<Stretch>& stretches, std::int64_t frames, FrameRate rate) {
  if (frames >= 0 && frames <= kMostFrames) return;
  const auto slowest =
      std::ranges::min_element(stretches, {}, [](const Stretch& stretch) { return stretch.source->rate().hertz(); });
  throw Error(ErrorCode::bad_input,
              fmt::format("the result would have more than {} frames at {} frames a second ('{}' has {}); sign fewer "
                          "signs, or give a lower --rate",
                          kMostFrames, to_string(rate), slowest->recording, to_string(slowest->source->rate())));
}

/// Where everything will lie: Algorithm 1 before any frame is touched.
struct Plan {
  std::vector<Laid> laid;
  std::vector<TransitionCut> cuts;  ///< [stretch − 1]
  std::int64_t frames = 0;
};

Plan plan_of(const std::vector<Stretch>& stretches, const ConcatenateOptions& options, FrameRate rate,
             const TransitionMethod& method) {
  Plan plan;
  plan.laid.reserve(stretches.size());
  plan.cuts.reserve(stretches.size());
  for (const Stretch& stretch : stretches) plan.laid.push_back(lay(stretch, rate, options.tempo));
  plan.laid.front().before = plan.laid.front().preparation;
  plan.laid.back().after = plan.laid.back().retraction;
  plan.laid.front().core = plan.laid.front().before;
  for (std::size_t i = 1; i < plan.laid.size(); ++i) {
    Laid& a = plan.laid[i - 1];
    Laid& b = plan.laid[i];
    const Milliseconds pause = stretches[i].pause_before;
    const double seconds = Seconds(options.duration + pause).count() / options.tempo;
    const TransitionCut cut = method.cut({.length = std::max<std::int64_t>(1, std::llround(seconds * rate.hertz())),
                                          .retraction = a.retraction,
                                          .preparation = b.preparation,
                                          .frames_per_second = rate.hertz(),
                                          .pause = pause > Milliseconds(0)});
    a.after = cut.retraction_frames;
    b.before = cut.preparation_frames;
    b.core = a.core_end() + cut.length;
    plan.cuts.push_back(cut);
  }
  plan.frames = plan.laid.back().end();
  check_length(stretches, plan.frames, rate);
  return plan;
}

/// Fills the output with the frames of the stretches, one after the other, and with what lies between them.
class Filler {
 public:
  Filler(const Plan& plan, const ConcatenateOptions& options, Synthesis& out)
      : plan_(plan), options_(options), out_(out) {}

  /// Stretch i, and the transition before it.
  void fill(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const std::int64_t shared = i == 0 ? 0 : plan_.cuts[i - 1].overlap();
    const FrameRange own{now.begin() + shared, now.end()};
    faded_.reset(out_.motion.shared_skeleton(), out_.motion.rate(), shared);
    read_frames(now, {now.begin(), own.begin}, faded_.poses({0, shared}));
    read_frames(now, own, out_.motion.poses(own));
    align_to_home(i, own);
    if (i > 0) join(plan_.laid[i - 1], now, plan_.cuts[i - 1], own);
    tell_sources(i);
  }

 private:
  bool is_aligned(std::size_t i) const {
    const std::string& home = plan_.laid[options_.reference].stretch->recording;
    return options_.alignment == Alignment::ground ||
           (options_.alignment == Alignment::automatic && plan_.laid[i].stretch->recording != home);
  }

  /// Where the reference's signer stands, while stretch i is filled: the frames that tell are there already, but for a
  /// stretch before the reference.
  const Standing& home(std::size_t i) {
    if (home_) return *home_;
    const Laid& reference = plan_.laid[options_.reference];
    if (options_.reference <= i) {
      home_ = standing_over(out_.motion, {reference.core, reference.core_end()});
    } else {
      const MotionSource& source = *reference.stretch->source;
      Motion core;
      core.reset(source.skeleton(), source.rate(), reference.stretch->core.size());
      source.read(reference.stretch->core, core.poses({0, core.frame_count()}));
      home_ = standing_over(core, {0, core.frame_count()});
    }
    return *home_;
  }

  void align_to_home(std::size_t i, FrameRange own) {
    if (!is_aligned(i)) return;
    const Laid& now = plan_.laid[i];
    const GroundTransform transform = align(standing_over(out_.motion, {now.core, now.core_end()}), home(i));
    for (std::int64_t k = 0; k < faded_.frame_count(); ++k) apply(transform, out_.motion.skeleton(), faded_.pose(k));
    for (std::int64_t frame = own.begin; frame < own.end; ++frame)
      apply(transform, out_.motion.skeleton(), out_.motion.pose(frame));
  }

  /// The transition: Algorithm 1, lines 3 to 6. What both sides keep of it is there already.
  void join(const Laid& a, const Laid& b, const TransitionCut& cut, FrameRange own) {
    const std::int64_t shared = cut.overlap();
    // Each stretch keeps its quaternions' signs from frame to frame, so one sign a joint makes the whole of it go on
    // from the side before. It is chosen where the two meet: in the middle of a cross-fade, so that there the shorter
    // arc is taken. Choosing anew for each frame would make a joint jump where the sides pass half a turn apart.
    const PoseView left = shared > 0 ? out_.motion.pose(b.begin() + shared / 2) : out_.motion.pose(a.end() - 1);
    const PoseView right = shared > 0 ? PoseView(faded_.pose(shared / 2)) : PoseView(out_.motion.pose(b.begin()));
    for (std::size_t joint = 0; joint < left.rotations.size(); ++joint) {
      if (left.rotations[joint].dot(right.rotations[joint]) < 0) turn_signs(joint, own);
    }
    for (std::int64_t k = 0; k < shared; ++k) {
      const MutablePoseView pose = out_.motion.pose(b.begin() + k);
      const PoseView other = faded_.pose(k);
      const float weight = crossfade_weight(k, shared);
      slerp_as_signed(pose.rotations, other.rotations, weight, pose.rotations);
      for (std::size_t t = 0; t < pose.translations.size(); ++t) {
        pose.translations[t] += weight * (other.translations[t] - pose.translations[t]);
      }
    }
    if (cut.gap() > 0) fill_gap(a, b, cut);
  }

  void turn_signs(std::size_t joint, FrameRange own) {
    for (std::int64_t k = 0; k < faded_.frame_count(); ++k) faded_.pose(k).rotations[joint].coeffs() *= -1.0f;
    for (std::int64_t frame = own.begin; frame < own.end; ++frame) {
      out_.motion.pose(frame).rotations[joint].coeffs() *= -1.0f;
    }
  }

  void fill_gap(const Laid& a, const Laid& b, const TransitionCut& cut) {
    // The context may reach into the strokes: it is only looked at.
    const std::int64_t last = a.end() - 1;
    const std::int64_t before = std::min(cut.blend_frames, last - a.core);
    const std::int64_t after = std::min(cut.blend_frames, b.end() - 1 - b.begin());
    const auto pose = [&](std::int64_t frame) { return PoseView(out_.motion.pose(frame)); };
    gap_.between({pose(last), pose(last - before), before}, {pose(b.begin()), pose(b.begin() + after), after},
                 b.begin() - a.end(), kEaseSeconds * out_.motion.rate().hertz());
    for (std::int64_t frame = a.end(); frame < b.begin(); ++frame) {
      gap_.fill(frame - a.end(), out_.motion.pose(frame));
    }
  }

  void tell_sources(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const auto stretch = static_cast<std::int32_t>(i);
    const std::int64_t shared_before = i == 0 ? 0 : plan_.cuts[i - 1].overlap();
    const std::int64_t shared_after = i + 1 == plan_.laid.size() ? 0 : plan_.cuts[i].overlap();
    const auto at = [&](std::int64_t frame) -> FrameSource& { return out_.sources[static_cast<std::size_t>(frame)]; };
    if (i > 0) {
      const std::int64_t made_from = plan_.laid[i - 1].end() - shared_before;
      for (std::int64_t frame = made_from; frame < now.begin() + shared_before; ++frame) {
        at(frame) = {FrameSource::kNone, stretch - 1, 0};
      }
    }
    const auto kept = [&](std::int64_t begin, std::int64_t end, std::int32_t junction) {
      if (now.captured_as_is()) {
        const std::int64_t shift = now.stretch->core.begin - now.core;
        for (std::int64_t frame = begin; frame < end; ++frame) {
          at(frame) = {stretch, junction, static_cast<double>(frame + shift)};
        }
      } else {
        for (std::int64_t frame = begin; frame < end; ++frame) at(frame) = {stretch, junction, now.frame_at(frame)};
      }
    };
    kept(now.begin() + shared_before, now.core, i > 0 ? stretch - 1 : FrameSource::kNone);
    kept(now.core, now.core_end(), FrameSource::kNone);
    kept(now.core_end(), now.end() - shared_after, i + 1 < plan_.laid.size() ? stretch : FrameSource::kNone);
  }

  const Plan& plan_;
  const ConcatenateOptions& options_;
  Synthesis& out_;
  Motion faded_;  ///< the frames of a stretch that are cross-faded with the one before
  GapFiller gap_;
  std::optional<Standing> home_;
};

}  // namespace

Synthesis concatenate(const std::vector<Stretch>& stretches, const ConcatenateOptions& options, Synthesis used) {
  if (stretches.empty()) throw Error(ErrorCode::bad_input, "nothing to join");
  const Stretch& reference = stretches.at(options.reference);
  check_skeletons(stretches, reference);
  const TransitionMethod& method = options.method != nullptr ? *options.method : transition_methods().front();
  const FrameRate rate = options.rate.numerator > 0 ? options.rate : highest_rate(stretches);
  const Plan plan = plan_of(stretches, options, rate, method);

  Synthesis out;
  std::vector<ScalarTrack> used_tracks = used.motion.take_tracks();
  out.motion = std::move(used.motion);
  out.sources = std::move(used.sources);
  out.motion.reset(reference.source->skeleton(), rate, plan.frames);
  out.sources.resize(static_cast<std::size_t>(plan.frames));
  Filler filler(plan, options, out);
  for (std::size_t i = 0; i < plan.laid.size(); ++i) filler.fill(i);

  for (std::size_t i = 0; i < plan.laid.size(); ++i) {
    const Laid& laid = plan.laid[i];
    const FrameRange core{laid.core, laid.core_end()};
    out.stretches.push_back({.recording = stretches[i].recording,
                             .output = {i == 0 ? 0 : core.begin, i + 1 == plan.laid.size() ? plan.frames : core.end},
                             .core = core,
                             .first_frame = laid.frame_at(core.begin),
                             .step = laid.step});
    if (i == 0) continue;
    out.junctions.push_back({.from = name_at_end(stretches[i - 1]),
                             .to = name_at_begin(stretches[i]),
                             .frames = {plan.laid[i - 1].core_end(), laid.core},
                             .cut = plan.cuts[i - 1],
                             .method = std::string(method.name)});
    assert(out.junctions.back().frames.size() == plan.cuts[i - 1].length);
  }
  carry_tracks(plan.laid, std::move(used_tracks), out.motion);
  place_signs(stretches, out);
  return out;
}

}  // namespace signweave
