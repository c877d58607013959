#include "signweave/choose/candidate.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

/// The reason why a sign cannot be signed, or an empty string.
std::string obstacle(const RecordingInfo& info, const Sign& sign) {
  if (!info.motion) return "its recording has no motion";
  const auto stroke = sign.stroke_span();
  if (!stroke) return "it has no stroke";
  const FrameRange frames = frames_of(*stroke, info.clock);
  if (frames.begin < -1 || frames.end > info.motion->frames + 1) {  // allows a frame of rounding on either side
    return fmt::format("its stroke reaches outside the motion, which has {} frames", info.motion->frames);
  }
  return {};
}

/// The frames of a span; at least one if it is inside the motion.
FrameRange core_frames(TimeSpan span, const RecordingInfo& info) {
  FrameRange frames = frames_of(span, info.clock);
  if (frames.begin == frames.end) ++frames.end;  // shorter than half a frame
  return clamp(frames, info.motion->frames);
}

/// The row of a sign of a recording; kNoRow if the table lacks it.
RowId row_of(const Segments& segments, std::size_t recording, const Sign& sign) {
  const SegmentTable::RowRange range = segments.tier_rows(static_cast<std::uint32_t>(recording), sign.tier);
  const RowId first = first_row(range, [&](RowId row) { return segments.span(row).begin >= sign.span.begin; });
  for (RowId row = first; row < range.end && segments.span(row).begin == sign.span.begin; ++row) {
    if (segments.kind(row) == RowKind::sign && segments.span(row) == sign.span && segments.text(row) == sign.gloss) {
      return row;
    }
  }
  return kNoRow;
}

/// Fills in the rows of its signs.
void find_rows(const Contents& contents, Candidate& candidate) {
  if (candidate.signs.empty()) return;
  candidate.first_row = row_of(contents.segments, candidate.recording, candidate.signs.front());
  candidate.last_row = row_of(contents.segments, candidate.recording, candidate.signs.back());
}

std::vector<Candidate> gloss_candidates(const Contents& contents, const GlossRef& wanted) {
  const std::vector<RowId> tokens = tokens_of(contents, wanted.gloss);
  if (tokens.empty()) {
    throw Error(ErrorCode::not_found, fmt::format("no sign '{}' in this database{}", printable(wanted.gloss),
                                                  did_you_mean(wanted.gloss, contents.segments.glosses())));
  }
  if (wanted.token > tokens.size()) {
    throw Error(ErrorCode::not_found,
                fmt::format("no token {} of '{}': there are {}, counted by recording name, then time", wanted.token,
                            printable(wanted.gloss), tokens.size()));
  }
  std::vector<Candidate> result;
  std::string first_obstacle;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (wanted.token != 0 && wanted.token != i + 1) continue;
    const std::uint32_t recording = contents.segments.recording(tokens[i]);
    const RecordingInfo& info = contents.recordings[recording];
    Sign sign = sign_at(contents.segments, tokens[i]);
    std::string why = obstacle(info, sign);
    if (why.empty()) {
      std::vector<Sign> signs;
      signs.push_back(std::move(sign));
      if (auto candidate = candidate_of_run(contents, recording, std::move(signs))) {
        candidate->token = i + 1;
        result.push_back(std::move(*candidate));
      }
    } else if (first_obstacle.empty()) {
      first_obstacle = fmt::format("token {} in '{}': {}", i + 1, info.name, why);
    }
  }
  if (result.empty()) {
    throw Error(ErrorCode::not_found,
                fmt::format("'{}' cannot be signed: {}", printable(wanted.gloss), first_obstacle));
  }
  return result;
}

Candidate piece_candidate(const Contents& contents, const SignRef& place) {
  const RecordingInfo& info = contents.at(place.recording);
  if (!info.motion) throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion", info.name));
  Candidate piece;
  piece.recording = static_cast<std::size_t>(&info - contents.recordings.data());
  piece.core = core_frames(place.span, info);
  piece.whole = piece.core;
  const FrameRange asked = frames_of(place.span, info.clock);
  if (piece.core.empty() || asked.begin < -1 || asked.end > info.motion->frames + 1) {
    const TimeSpan all = span_of({0, info.motion->frames}, info.clock);
    throw Error(ErrorCode::bad_input,
                fmt::format("'{}'@{}..{} reaches outside the motion, which covers {}..{} ms", info.name,
                            place.span.begin.count(), place.span.end.count(), all.begin.count(), all.end.count()));
  }
  for (Sign& sign : main_signs_of(contents.segments, static_cast<std::uint32_t>(piece.recording))) {
    if (place.span.contains(sign.span)) piece.signs.push_back(std::move(sign));
  }
  piece.at_strokes = false;
  find_rows(contents, piece);
  return piece;
}

}  // namespace

std::vector<RowId> tokens_of(const Contents& contents, std::string_view gloss) {
  const Segments& segments = contents.segments;
  std::vector<RowId> tokens = segments.signs_with(match_form(gloss));
  // Recordings are numbered by name. If several tiers (two hands) have the gloss at the same time, the row order
  // decides.
  std::stable_sort(tokens.begin(), tokens.end(), [&](RowId a, RowId b) {
    return std::pair(segments.recording(a), segments.span(a).begin) <
           std::pair(segments.recording(b), segments.span(b).begin);
  });
  return tokens;
}

std::vector<Candidate> candidates_for(const Contents& contents, const SignRef& sign) {
  if (sign.kind == SignRef::Kind::gloss) return gloss_candidates(contents, sign.gloss);
  std::vector<Candidate> one;
  one.push_back(piece_candidate(contents, sign));
  return one;
}

std::optional<Candidate> candidate_of_run(const Contents& contents, std::size_t recording, std::vector<Sign> signs) {
  const RecordingInfo& info = contents.recordings[recording];
  const auto has_stroke = [](const Sign& sign) { return sign.stroke_span().has_value(); };
  const auto first = std::find_if(signs.begin(), signs.end(), has_stroke);
  if (!info.motion || first == signs.end()) return std::nullopt;
  const auto last = std::find_if(signs.rbegin(), signs.rend(), has_stroke).base() - 1;
  Candidate run;
  run.recording = recording;
  run.core = core_frames({first->stroke_span()->begin, last->stroke_span()->end}, info);
  run.whole = clamp(frames_of({first->span.begin, last->span.end}, info.clock), info.motion->frames);
  // Phases that extend beyond their sign must not make the whole smaller than its core.
  run.whole = {std::min(run.whole.begin, run.core.begin), std::max(run.whole.end, run.core.end)};
  if (run.core.empty()) return std::nullopt;
  run.signs.assign(first, last + 1);
  run.left_out.assign(signs.begin(), first);
  run.left_out.insert(run.left_out.end(), last + 1, signs.end());
  find_rows(contents, run);
  return run;
}

void extend_with(Candidate& last, const Candidate& next) {
  last.signs.insert(last.signs.end(), next.signs.begin(), next.signs.end());
  last.left_out.insert(last.left_out.end(), next.left_out.begin(), next.left_out.end());
  last.core.end = next.core.end;
  last.whole.end = next.whole.end;
  last.last_row = next.last_row;
}

}  // namespace signweave
