#include "signweave/live/stream_setup.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/choose/notices.h"
#include "signweave/live/live_curves.h"

namespace signweave {

std::string key_of(const MotionClip& clip) {
  std::string key = fmt::format("{}:{}-{}-{}-{}{}{}", clip.recording, clip.whole.begin, clip.core.begin, clip.core.end,
                                clip.whole.end, clip.at_rest ? " rest" : "", clip.mirrored ? " mirrored" : "");
  if (clip.speed != 1) key += fmt::format(" x{}", clip.speed);
  for (const ClipChange& change : clip.changes) key += fmt::format(" {:x}", checksum_of(change.stroke));
  return key;
}

std::shared_ptr<LiveClip> place_rest(const StreamSetup& setup) {
  auto rest = std::make_shared<LiveClip>();
  rest->captured = {.recording = setup.header.layout_from,
                    .source = setup.living,
                    .whole = {0, LivingRest::kFrames},
                    .core = {0, LivingRest::kFrames},
                    .clock = {setup.header.rate.frame_time(), Seconds(0)},
                    .signs = {},
                    .fingerprint = setup.skeleton.fingerprint,
                    .kind = SourceRef::Kind::rest};
  setup.builder->place_frames(*rest);
  return rest;
}

std::unique_ptr<StreamSetup> set_up(SharedSigningCache& cache, const Snapshot& snapshot,
                                    const std::shared_ptr<const Contents>& contents, const MotionClip& first,
                                    const PlayerOptions& options) {
  auto setup = std::make_unique<StreamSetup>();
  const auto say = [&](std::optional<Notice> notice) {
    if (notice) setup->notices.push_back(std::move(*notice));
  };
  const SynthesisOptions& synthesis = options.synthesis;
  const TransitionMethod* const method = synthesis.method != nullptr ? synthesis.method : &transition_methods().front();
  setup->rig = cache.rig(snapshot, first.recording);
  setup->fit = cache.durations(contents, synthesis.duration);
  if (method->fill->needs != Needs::nothing) {
    setup->spans = cache.spans(snapshot, first, *setup->rig, method->fill->needs);
    if (method->fill->needs == Needs::spans) say(notice_without_captured(method->name, setup->spans->transitions));
  }
  const JunctionSettings settings{.skeleton = first.source->skeleton(),
                                  .rate = synthesis.rate.value_or(first.source->rate()),
                                  .method = method,
                                  .rig = setup->rig.get(),
                                  .model = setup->spans != nullptr ? setup->spans->model.get() : nullptr};
  std::vector<std::string> tracks = cache.tracks(*contents, first.recording);
  if (options.face) {
    for (std::string& name : authored_tracks(synthesis.non_manuals.expressions)) {
      if (std::ranges::find(tracks, name) == tracks.end()) tracks.push_back(std::move(name));
    }
  }
  setup->builder.emplace(settings, TransitionTiming{.fit = setup->fit.get(), .tempo = synthesis.tempo},
                         std::move(tracks), synthesis.alignment, first);
  if (!synthesis.duration.fixed) say(notice_without_durations(*setup->fit));
  if (options.idle == Idle::living_rest) {
    const std::shared_ptr<const KnownRest> known = cache.rest(snapshot, first, *setup->rig);
    RestPose rest = known->rest;
    Motion alone(settings.skeleton, settings.rate);
    alone.append(rest.pose.view());
    apply(align(standing_over(alone, {0, 1}), setup->builder->home()), *settings.skeleton, rest.pose.view());
    rest.tracks.assign(setup->builder->tracks().size(), 0.0f);
    for (std::size_t i = 0; i < known->tracks.size(); ++i) {
      const auto at = std::ranges::find(setup->builder->tracks(), known->tracks[i]);
      if (at == setup->builder->tracks().end()) continue;
      rest.tracks[static_cast<std::size_t>(at - setup->builder->tracks().begin())] = known->rest.tracks[i];
    }
    setup->living =
        std::make_shared<const LivingRest>(settings.skeleton, settings.rate, setup->rig->signer.rig, std::move(rest),
                                           setup->builder->tracks(), LivingRestOptions{.seed = cache.new_seed()});
  }
  const Milliseconds fixed = synthesis.duration.fixed.value_or(Milliseconds(-1));
  setup->key =
      fmt::format("{} {} {}/{} {} {} {} {} {} {}", cache.state_number(contents), method->name, settings.rate.numerator,
                  settings.rate.denominator, synthesis.tempo, fixed.count(), synthesis.duration.fitted,
                  static_cast<int>(synthesis.alignment), setup->builder->tracks().size(), key_of(first));
  setup->skeleton = source_of(first);
  setup->header = {.skeleton = settings.skeleton,
                   .rate = settings.rate,
                   .tracks = setup->builder->tracks(),
                   .layout_from = first.recording,
                   .declarations = *cache.declarations(contents)};
  return setup;
}

}  // namespace signweave
