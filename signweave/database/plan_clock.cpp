#include "signweave/database/plan_clock.h"

#include <fmt/format.h>

#include <cmath>

namespace signweave {
namespace {

/// Returns the annotation time of frame 0 that the document states for a motion file, or none.
std::optional<Seconds> linked_origin(const AnnotationDocument& document, const std::string& motion_file) {
  for (const LinkedFile& linked : document.linked_files) {
    for (const std::string& url : {linked.url, linked.relative_url}) {
      if (linked_file_name(url) == motion_file) return -Seconds(linked.time_origin);
    }
  }
  return std::nullopt;
}

FrameClock clock_through(const SyncPoint& first, const SyncPoint& second) {
  if (first.frame == second.frame) {
    throw Error(ErrorCode::bad_input, fmt::format("sync: both points are at frame {:g}; give two frames", first.frame));
  }
  FrameClock clock;
  clock.frame_time = (second.time - first.time) / (second.frame - first.frame);
  clock.origin = first.time - first.frame * clock.frame_time;
  return clock;
}

/// Returns the clock that the user set, or none. Throws for a clock that no recording can have.
std::optional<FrameClock> given_clock(const ImportJob& job, const ImportOptions& options, FrameRate rate) {
  FrameClock clock{rate.frame_time(), Seconds(0)};
  if (options.sync.size() == 2) {
    clock = clock_through(options.sync[0], options.sync[1]);
  } else if (!options.sync.empty()) {
    throw Error(ErrorCode::bad_input, "sync: give two points", {{"offset_ms", ""}});
  } else if (job.offset || options.offset) {
    clock.origin = job.offset ? *job.offset : *options.offset;
  } else {
    return std::nullopt;
  }
  const double drift = clock.frame_time / rate.frame_time();
  if (std::abs(clock.origin.count()) <= 1e6 && drift > 0.5 && drift < 2.0) return clock;
  if (options.sync.empty()) {
    throw Error(ErrorCode::bad_input, "offset_ms: an offset is a number of milliseconds, at most 1,000,000,000");
  }
  throw Error(ErrorCode::bad_input,
              fmt::format("sync: frame 0 would be at {:.6g} s and a frame {:.6g} times as long as in the "
                          "motion file; give the two points in the order of their times",
                          clock.origin.count(), drift));
}

/// Returns the clock of a recording without motion: it applies once the motion is imported.
PlannedClock clock_without_motion(const PlanInput& input, FrameRate rate) {
  const ImportOptions& options = input.options;
  if (options.offset || input.job.offset) return {*given_clock(input.job, options, rate), true};
  if (!options.sync.empty()) {
    throw Error(ErrorCode::bad_input, input.name() + ": sync points need the motion; import it too, or give an offset",
                {{"offset_ms", ""}});
  }
  if (input.known != nullptr) return {input.known->clock, input.known->clock_given};
  return {};
}

}  // namespace

PlannedClock plan_clock(const PlanInput& input, const PlannedMotion& motion,
                        const std::optional<AnnotationDocument>& document) {
  const RecordingInfo* known = input.known;
  if (!motion.part && !input.motion_known()) return clock_without_motion(input, motion.rate);
  if (const std::optional<FrameClock> given = given_clock(input.job, input.options, motion.rate)) return {*given, true};
  PlannedClock planned{.clock = {motion.rate.frame_time(), Seconds(0)},
                       .given = known != nullptr && known->clock_given};
  if (planned.given) {  // keeps its drift, even if the frame rate differs now
    planned.clock.origin = known->clock.origin;
    if (known->motion) planned.clock.frame_time *= known->clock.frame_time / known->motion->rate.frame_time();
  } else if (document) {
    const std::string file = input.job.motion ? input.job.motion->filename().string() : known->motion_facts.file;
    std::optional<Seconds> origin = linked_origin(*document, file);
    if (!origin && known != nullptr) origin = linked_origin(*document, known->motion_facts.file);
    planned.clock.origin = origin.value_or(Seconds(0));
  }
  return planned;
}

void report_uncovered(const std::vector<Sign>& signs, const FrameClock& clock, std::int64_t frames,
                      const std::string& where, std::vector<Notice>& notices) {
  std::size_t outside = 0;
  std::string first;
  for (const Sign& sign : signs) {
    const FrameRange range = frames_of(sign.span, clock);
    if (range.begin >= 0 && range.end <= frames) continue;
    if (outside++ == 0) first = fmt::format("{} at {} ms", sign.gloss, sign.span.begin.count());
  }
  if (outside == 0) return;
  notices.push_back({where,
                     fmt::format("{} of {} signs lie outside the motion (the first: {}); do both start "
                                 "together?",
                                 outside, signs.size(), first),
                     {{"offset_ms", ""}, {"sync", ""}}});
}

}  // namespace signweave
