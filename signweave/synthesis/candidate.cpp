#include "signweave/synthesis/candidate.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

/// Why a sign cannot be signed, or nothing.
std::string obstacle(const RecordingInfo& info, const Sign& sign) {
  if (!info.motion) return "its recording has no motion";
  const auto stroke = sign.stroke_span();
  if (!stroke) return "it has no stroke";
  if (clamp(frames_of(*stroke, info.clock), info.motion->frames).empty()) {
    return fmt::format("its stroke lies outside the motion, which has {} frames", info.motion->frames);
  }
  return {};
}

// An inferred stroke holds the whole sign, its own transitions too, so an annotated token is preferred; but a good join
// may outweigh it. In the unit of the join cost: radians, mean over the joints.
constexpr double kInferredCost = 0.15;

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
    const std::uint32_t recording = contents.segments.row(tokens[i]).recording;
    const RecordingInfo& info = contents.recordings[recording];
    Sign sign = sign_at(contents.segments, tokens[i]);
    std::string why = obstacle(info, sign);
    if (why.empty()) {
      const double cost = sign.inferred ? kInferredCost : 0.0;
      std::vector<Sign> signs;
      signs.push_back(std::move(sign));
      if (auto candidate = candidate_of_run(contents, recording, std::move(signs))) {
        candidate->token = i + 1;
        candidate->cost = cost;
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

Candidate piece_candidate(const Contents& contents, const Place& place) {
  const RecordingInfo& info = contents.at(place.recording);
  if (!info.motion) throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion", info.name));
  Candidate piece;
  piece.recording = static_cast<std::size_t>(&info - contents.recordings.data());
  piece.core = clamp(frames_of(place.span, info.clock), info.motion->frames);
  piece.whole = piece.core;
  if (piece.core.empty()) {
    const TimeSpan all = span_of({0, info.motion->frames}, info.clock);
    throw Error(ErrorCode::bad_input,
                fmt::format("'{}'@{}..{} lies outside the motion, which covers {}..{} ms", info.name,
                            place.span.begin.count(), place.span.end.count(), all.begin.count(), all.end.count()));
  }
  const SegmentTable::RowRange rows = contents.segments.recording_rows(static_cast<std::uint32_t>(piece.recording));
  for (RowId row = rows.begin; row < rows.end; ++row) {
    const SegmentRow& sign = contents.segments.row(row);
    if (sign.kind == RowKind::sign && place.span.contains(sign.span)) {
      piece.signs.push_back(sign_at(contents.segments, row));
    }
  }
  std::sort(piece.signs.begin(), piece.signs.end(),
            [](const Sign& a, const Sign& b) { return a.span.begin < b.span.begin; });
  return piece;
}

}  // namespace

std::vector<RowId> tokens_of(const Contents& contents, std::string_view gloss) {
  const SegmentTable& table = contents.segments;
  const std::uint32_t label = table.find_label(match_form(gloss));
  if (label == SegmentTable::kNone) return {};
  const std::span<const RowId> rows = table.with_label(RowKind::sign, label);
  std::vector<RowId> tokens(rows.begin(), rows.end());
  // Recordings are numbered by name. Several tiers (two hands) may have the gloss at one time: the row order decides
  // then.
  std::stable_sort(tokens.begin(), tokens.end(), [&](RowId a, RowId b) {
    const SegmentRow& left = table.row(a);
    const SegmentRow& right = table.row(b);
    return left.recording != right.recording ? left.recording < right.recording : left.span.begin < right.span.begin;
  });
  return tokens;
}

std::vector<Candidate> candidates_for(const Contents& contents, const Place& place) {
  if (place.kind == Place::Kind::gloss) return gloss_candidates(contents, place.gloss);
  std::vector<Candidate> one;
  one.push_back(piece_candidate(contents, place));
  return one;
}

std::optional<Candidate> candidate_of_run(const Contents& contents, std::size_t recording, std::vector<Sign> signs) {
  const RecordingInfo& info = contents.recordings[recording];
  const auto first = signs.front().stroke_span();
  const auto last = signs.back().stroke_span();
  if (!info.motion || !first || !last) return std::nullopt;
  Candidate run;
  run.recording = recording;
  run.core = clamp(frames_of({first->begin, last->end}, info.clock), info.motion->frames);
  run.whole = clamp(frames_of({signs.front().span.begin, signs.back().span.end}, info.clock), info.motion->frames);
  // Phases that reach outside their sign must not make the whole smaller than its core.
  run.whole = {std::min(run.whole.begin, run.core.begin), std::max(run.whole.end, run.core.end)};
  if (run.core.empty()) return std::nullopt;
  run.signs = std::move(signs);
  return run;
}

}  // namespace signweave
