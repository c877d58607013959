#include "signweave/database/joins.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/database/measure.h"
#include "signweave/features/transition_stats.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

RecordingJoins joins_of(const Segments& table, std::uint32_t recording, const RecordingFeatures& features) {
  RecordingJoins joins;
  joins.why_not = features.why_not;
  const std::vector<std::vector<std::size_t>> places = phase_places_of(table, recording);
  const SegmentTable::RowRange rows = table.recording_rows(recording);
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (table.kind(row) != RowKind::sign) continue;
    SignJoin join{.row = row};
    const std::vector<std::size_t>& phases = places[joins.signs.size()];
    const PhaseFeatures* first = nullptr;
    const PhaseFeatures* last = nullptr;
    TimeSpan strokes{};
    std::size_t at = 0;
    float path = 0;  // since the first stroke, including the phases between strokes
    for (const RowId child : table.children(row)) {
      if (table.kind(child) != RowKind::phase) continue;
      const std::size_t place = at < phases.size() ? phases[at++] : features.phases.size();
      if (place >= features.phases.size()) continue;
      const PhaseFeatures& measured = features.phases[place];
      const bool stroke = table.phase(child) == PhaseKind::stroke;
      if (first == nullptr && !stroke) continue;
      for (const HandOver& hand : measured.hands) path += hand.path_length;
      if (!stroke) continue;
      if (first == nullptr) {
        first = &measured;
        strokes = table.span(child);
      }
      last = &measured;
      strokes.end = table.span(child).end;
      join.path = path;
    }
    if (first != nullptr) {
      join.begin = join_point(*first, true);
      join.end = join_point(*last, false);
      join.stroke_seconds = static_cast<float>(Seconds(strokes.duration()).count());
    }
    joins.signs.push_back(join);
  }
  return joins;
}

// Limits of learning.
constexpr std::size_t kMostRecordings = 256;
constexpr std::size_t kMostPairs = 1024;
constexpr std::size_t kMostOthers = 4;           // compared on each side of a pair
constexpr std::size_t kMostTokensOfAGloss = 64;  // from which those are chosen

/// Returns the step with which at most `most` of `count` items are taken.
std::size_t step_of(std::size_t count, std::size_t most) {
  return std::max<std::size_t>(1, (count + most - 1) / most);
}

/// Two signs that follow each other in one recording.
struct Pair {
  std::uint32_t recording = 0;
  const SignJoin* from = nullptr;
  const SignJoin* to = nullptr;
  Seconds seconds{0};
};

class Learner {
 public:
  explicit Learner(const Snapshot& snapshot) : table_(snapshot.contents().segments) {
    const Contents& contents = snapshot.contents();
    const std::size_t recordings = contents.recordings.size();
    joins_.resize(recordings);
    for (std::size_t i = 0; i < recordings; i += step_of(recordings, kMostRecordings)) {
      if (!contents.recordings[i].motion || contents.recordings[i].document == 0) continue;
      joins_[i] = snapshot.joins(i);
      const auto recording = static_cast<std::uint32_t>(i);
      for (const AnnotatedTransition& transition : transitions_in(signs_of(table_, recording))) {
        const SignJoin& from = joins_[i]->signs[transition.from];
        const SignJoin& to = joins_[i]->signs[transition.to];
        if (from.end.known == 0 || to.begin.known == 0) continue;
        pairs_.push_back({recording, &from, &to, Seconds(transition.span.duration())});
      }
      for (const SignJoin& sign : joins_[i]->signs) {
        if (sign.begin.known != 0) signs_.push_back(&sign);
      }
    }
    mean_ = contents.transitions.count > 0 ? Seconds(contents.transitions.mean) : Seconds(0.5);
  }

  JoinWeights learned() const {
    if (pairs_.empty()) return {};
    const float limit = speed_limit();
    std::vector<JoinComparison> comparisons;
    for (std::size_t i = 0; i < pairs_.size(); i += step_of(pairs_.size(), kMostPairs)) {
      const Pair& pair = pairs_[i];
      const JoinTerms recorded = join_terms(pair.from->end, pair.to->begin, mean_, limit);
      const auto add = [&](const JoinPoint& a, const JoinPoint& b) {
        comparisons.push_back(
            {recorded, join_terms(a, b, mean_, limit), pair.recording, static_cast<std::uint32_t>(i)});
      };
      for (const SignJoin* other : others(*pair.to, i)) add(pair.from->end, other->begin);
      for (const SignJoin* other : others(*pair.from, i)) add(other->end, pair.to->begin);
    }
    return learn_join_weights(comparisons, limit);
  }

 private:
  /// The speed that one in ten hands exceeds on the straight line between recorded neighbours, shoulder widths a
  /// second.
  float speed_limit() const {
    std::vector<float> speeds;
    for (const Pair& pair : pairs_) {
      const double seconds = std::max(pair.seconds, kShortestJoin).count();
      for (std::size_t side = 0; side < 2; ++side) {
        const unsigned hand = static_cast<unsigned>(JoinPoint::kHand) << (3 * side);
        if ((pair.from->end.known & pair.to->begin.known & hand) == 0) continue;
        double sum = 0;
        for (std::size_t k = JoinPoint::kPlace + 3 * side; k < JoinPoint::kPlace + 3 * side + 3; ++k) {
          const double distance =
              static_cast<double>(pair.to->begin.values[k]) - static_cast<double>(pair.from->end.values[k]);
          sum += distance * distance;
        }
        speeds.push_back(static_cast<float>(std::sqrt(sum) / seconds));
      }
    }
    if (speeds.empty()) return JoinWeights{}.speed_limit;
    const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(9 * (speeds.size() - 1) / 10);
    std::nth_element(speeds.begin(), at, speeds.end());
    return std::max(*at, 0.1f);
  }

  /// Returns other tokens of the sign's gloss, evenly spread; if there are none, other signs.
  std::vector<const SignJoin*> others(const SignJoin& sign, std::size_t seed) const {
    const std::uint32_t own = table_.recording(sign.row);
    const TimeSpan own_span = table_.span(sign.row);
    std::vector<const SignJoin*> all;
    const std::vector<RowId>& tokens = tokens_of(table_.label(sign.row));
    for (std::size_t i = 0; i < tokens.size(); i += step_of(tokens.size(), kMostTokensOfAGloss)) {
      const RowId row = tokens[i];
      const std::uint32_t other = table_.recording(row);
      if (!joins_[other]) continue;
      // The same sign on the tier of the other hand does not count as another token.
      const TimeSpan span = table_.span(row);
      const bool same = other == own && span.begin < own_span.end && own_span.begin < span.end;
      if (row == sign.row || same) continue;
      const SignJoin* join = joins_[other]->find(row);
      if (join != nullptr && join->begin.known != 0) all.push_back(join);
    }
    std::vector<const SignJoin*> some;
    for (std::size_t i = 0; i < all.size(); i += step_of(all.size(), kMostOthers)) some.push_back(all[i]);
    // 7919 is prime, so different pairs get different signs.
    for (std::size_t i = 1; all.empty() && i <= kMostOthers; ++i) {
      const SignJoin* join = signs_[(seed * 7919 + i * (signs_.size() / 5 + 1)) % signs_.size()];
      if (join->row != sign.row) some.push_back(join);
    }
    return some;
  }

  const std::vector<RowId>& tokens_of(std::string_view gloss) const {
    const auto [at, added] = tokens_.try_emplace(gloss);
    if (added) at->second = table_.signs_with(gloss);
    return at->second;
  }

  const Segments& table_;
  mutable std::map<std::string_view, std::vector<RowId>> tokens_;
  std::vector<std::shared_ptr<const RecordingJoins>> joins_;  ///< [recording], null: not used
  std::vector<Pair> pairs_;
  std::vector<const SignJoin*> signs_;  ///< whose joins are known
  Seconds mean_{0.5};                   ///< mean duration of the transitions
};

}  // namespace

JoinWeights learn_joins(const Snapshot& snapshot) {
  return Learner(snapshot).learned();
}

const SignJoin* RecordingJoins::find(RowId row) const noexcept {
  const auto at = std::ranges::lower_bound(signs, row, {}, &SignJoin::row);
  return at != signs.end() && at->row == row ? &*at : nullptr;
}

RowId neighbour_before(const Segments& segments, RowId sign) noexcept {
  const TimeSpan own = segments.span(sign);
  const SegmentTable::RowRange rows = segments.tier_rows_of(sign);
  for (RowId row = sign; row-- > rows.begin;) {
    if (segments.kind(row) != RowKind::sign) continue;
    const TimeSpan before = segments.span(row);
    if (before.end > own.begin || before.duration() <= Milliseconds(0)) continue;
    return own.begin - before.end < kRest ? row : kNoRow;
  }
  return kNoRow;
}

RowId neighbour_after(const Segments& segments, RowId sign) noexcept {
  const TimeSpan own = segments.span(sign);
  const SegmentTable::RowRange rows = segments.tier_rows_of(sign);
  for (RowId row = sign + 1; row < rows.end; ++row) {
    if (segments.kind(row) != RowKind::sign) continue;
    const TimeSpan after = segments.span(row);
    if (after.begin < own.end || after.duration() <= Milliseconds(0)) continue;
    return after.begin - own.end < kRest ? row : kNoRow;
  }
  return kNoRow;
}

RecordingFeatures Snapshot::features(std::size_t recording) const {
  const RecordingInfo& info = contents_->recordings[recording];
  RecordingFeatures features;
  try {
    if (info.document != 0) {
      std::optional<RecordingFeatures> stored = semantic_db::read_features(*transaction_, info.document, info.name);
      features = stored ? *std::move(stored)
                        : measure_stored(*transaction_, info,
                                         semantic_db::read_segments(*transaction_, info.document, info.name));
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    features.why_not = error.what();
  }
  return features;
}

std::shared_ptr<const RecordingJoins> Snapshot::joins(std::size_t recording) const {
  const Database& database = *database_;
  {
    const std::lock_guard guard(database.mutex_);
    const auto at = database.kept_.joins.find(recording);
    if (database.contents_ == contents_ && at != database.kept_.joins.end()) return at->second;
  }
  RecordingFeatures measured = features(recording);
  auto made =
      std::make_shared<RecordingJoins>(joins_of(contents_->segments, static_cast<std::uint32_t>(recording), measured));
  if (!measured.noise.rotations.empty()) {
    made->noise = std::make_shared<const CaptureNoise>(std::move(measured.noise));
  }
  const std::lock_guard guard(database.mutex_);
  if (database.contents_ == contents_) database.kept_.joins[recording] = made;
  return made;
}

}  // namespace signweave
