#include "signweave/choose/select.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>

#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

constexpr std::string_view kNoLabel;  // no sign has an empty label

float& term(TargetTerms& terms, TargetTerm which) {
  return terms[static_cast<std::size_t>(which)];
}

constexpr float weight_of(TargetTerm which) {
  return kTargetWeights[static_cast<std::size_t>(which)];
}

/// Reads single poses, opening each recording once.
class PoseReader {
 public:
  explicit PoseReader(const Snapshot& snapshot) : snapshot_(snapshot) {}

  const Pose& at(std::size_t recording, std::int64_t frame) {
    const auto [found, fresh] = poses_.try_emplace({recording, frame});
    if (!fresh) return found->second;
    std::unique_ptr<MotionSource>& source = sources_[recording];
    if (!source) source = snapshot_.motion(snapshot_.contents().recordings[recording]);
    Pose pose(*source->skeleton());
    source->read({frame, frame + 1}, {pose.rotations, pose.translations});
    return found->second = std::move(pose);
  }

 private:
  const Snapshot& snapshot_;
  std::map<std::size_t, std::unique_ptr<MotionSource>> sources_;
  std::map<std::pair<std::size_t, std::int64_t>, Pose> poses_;
};

/// Mean over the joints, radians.
double rotation_between(const Pose& a, const Pose& b) {
  // Skeletons of one corpus may differ; poses that cannot be compared get the maximum distance. If the rigs are
  // unknown, joining them is rejected later.
  if (a.rotations.size() != b.rotations.size()) return 3.2;
  double sum = 0;
  for (std::size_t i = 1; i < a.rotations.size(); ++i) {  // without the root, which is aligned away
    const double cosine = std::min(1.0, std::abs(static_cast<double>(a.rotations[i].dot(b.rotations[i]))));
    sum += 2.0 * std::acos(cosine);
  }
  return a.rotations.size() > 1 ? sum / static_cast<double>(a.rotations.size() - 1) : 0.0;
}

/// Without measurements: the rotation, in radians, that costs as much as a join to a randomly chosen token. (ours)
constexpr double kBlindRotation = 0.4;

/// Data of a place's candidates that does not depend on its neighbours.
struct Tokens {
  std::shared_ptr<const JoinEnds> ends;
  std::vector<RowId> neighbour;                ///< [candidate] the row that it follows in its recording, or kNoRow
  std::vector<std::string_view> label_before;  ///< [candidate] label of the gloss recorded before, or kNoLabel
  std::vector<std::string_view> label_after;   ///< [candidate]
  std::vector<std::pair<RowId, std::uint32_t>> by_last;   ///< last row and candidate, ascending
  std::vector<TargetTerms> terms;                         ///< [candidate] weighted; left and right are 0
  std::vector<float> own;                                 ///< [candidate] phases, outlier, defects
  std::vector<float> made_before;                         ///< [candidate] preparation
  std::vector<float> made_after;                          ///< [candidate] retraction
  std::vector<std::pair<std::size_t, FrameRange>> cores;  ///< [candidate] recording and core
  std::string_view first_label = kNoLabel;                ///< label of the gloss that this place begins with
  std::string_view last_label = kNoLabel;                 ///< and ends with
};

Tokens tokens_of(const Snapshot& snapshot, std::span<const Candidate> candidates) {
  const Contents& contents = snapshot.contents();
  const Segments& table = contents.segments;
  Tokens tokens;
  std::vector<JoinPoint> begins;
  std::vector<JoinPoint> ends;
  std::vector<const SignJoin*> joins;
  std::map<std::size_t, std::shared_ptr<const RecordingJoins>> read;
  const auto join_of = [&](std::size_t recording, RowId row) -> const SignJoin* {
    if (row == kNoRow) return nullptr;
    std::shared_ptr<const RecordingJoins>& of = read[recording];
    if (!of) of = snapshot.joins(recording);
    return of->find(row);
  };
  for (const Candidate& candidate : candidates) {
    const SignJoin* first = candidate.at_strokes ? join_of(candidate.recording, candidate.first_row) : nullptr;
    const SignJoin* last = candidate.at_strokes ? join_of(candidate.recording, candidate.last_row) : nullptr;
    begins.push_back(first != nullptr ? first->begin : JoinPoint{});
    ends.push_back(last != nullptr ? last->end : JoinPoint{});
    joins.push_back(first);
    tokens.cores.emplace_back(candidate.recording, candidate.core);
    const RowId before = candidate.first_row == kNoRow ? kNoRow : neighbour_before(table, candidate.first_row);
    const RowId after = candidate.last_row == kNoRow ? kNoRow : neighbour_after(table, candidate.last_row);
    tokens.neighbour.push_back(before);
    tokens.label_before.push_back(before == kNoRow ? kNoLabel : table.label(before));
    tokens.label_after.push_back(after == kNoRow ? kNoLabel : table.label(after));
    if (candidate.last_row != kNoRow) {
      tokens.by_last.emplace_back(candidate.last_row, static_cast<std::uint32_t>(tokens.cores.size() - 1));
    }
    TargetTerms terms{};
    if (candidate.at_strokes && !candidate.signs.empty()) {
      const Sign& front = candidate.signs.front();
      const Sign& back = candidate.signs.back();
      const bool inferred = front.inferred || back.inferred;
      term(terms, TargetTerm::phases) = inferred ? weight_of(TargetTerm::phases) : 0;
      const auto lacks = [](const Sign& sign, TimeSpan span) {
        return !sign.inferred && span.duration() <= Milliseconds(0);
      };
      if (lacks(front, front.preparation_span())) {
        term(terms, TargetTerm::preparation) = weight_of(TargetTerm::preparation);
      }
      if (lacks(back, back.retraction_span())) term(terms, TargetTerm::retraction) = weight_of(TargetTerm::retraction);
    }
    term(terms, TargetTerm::defects) =
        weight_of(TargetTerm::defects) * defect_cost(contents.recordings[candidate.recording].defects, candidate.whole);
    tokens.terms.push_back(terms);
  }
  std::sort(tokens.by_last.begin(), tokens.by_last.end());
  tokens.ends = std::make_shared<const JoinEnds>(begins, ends);
  const std::vector<float> outliers = outliers_of(joins);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    TargetTerms& terms = tokens.terms[i];
    term(terms, TargetTerm::outlier) = weight_of(TargetTerm::outlier) * outliers[i];
    tokens.own.push_back(term(terms, TargetTerm::phases) + term(terms, TargetTerm::outlier) +
                         term(terms, TargetTerm::defects));
    tokens.made_before.push_back(term(terms, TargetTerm::preparation));
    tokens.made_after.push_back(term(terms, TargetTerm::retraction));
  }
  const Candidate& one = candidates.front();
  if (one.first_row != kNoRow) tokens.first_label = table.label(one.first_row);
  if (one.last_row != kNoRow) tokens.last_label = table.label(one.last_row);
  return tokens;
}

}  // namespace

struct Selector::State {
  const Snapshot& snapshot;
  JoinScale scale;
  PoseReader poses;
  std::map<std::pair<RowId, std::size_t>, std::shared_ptr<const Tokens>> known;  ///< by first row and size
  std::shared_ptr<const Tokens> before;
  std::vector<TargetTerms> terms;  ///< [candidate] of the last place

  std::shared_ptr<const Tokens> look_up(std::span<const Candidate> candidates) {
    // The tokens of a gloss are always the same, so the first identifies them.
    const bool gloss = candidates.front().token > 0 && candidates.front().first_row != kNoRow;
    if (!gloss) return std::make_shared<const Tokens>(tokens_of(snapshot, candidates));
    std::shared_ptr<const Tokens>& tokens = known[{candidates.front().first_row, candidates.size()}];
    if (!tokens) tokens = std::make_shared<const Tokens>(tokens_of(snapshot, candidates));
    return tokens;
  }

  /// The replacement cost of the unknown parts of a join: their share of the cost of a random choice; for a join
  /// without any known features, the rotation of the joints.
  float unknown(const Tokens& a, std::size_t from, const Tokens& b, std::size_t to) {
    constexpr int kParts = 7;
    const unsigned both = static_cast<unsigned>(a.ends->end(from).known) & b.ends->begin(to).known;
    if (both != 0) return static_cast<float>(kParts - std::popcount(both)) / kParts;
    const auto [recording, core] = a.cores[from];
    const auto [next_recording, next_core] = b.cores[to];
    const Pose last = poses.at(recording, core.end - 1);
    return static_cast<float>(rotation_between(last, poses.at(next_recording, next_core.begin)) / kBlindRotation);
  }

  /// True if all joins between two places use the same parts of the body.
  static bool alike(const Tokens& a, const Tokens& b) {
    const std::uint8_t* one = a.ends->known();
    const std::uint8_t* other = b.ends->known();
    return one != nullptr && other != nullptr && *one == *other && *one != 0;
  }
};

Selector::Selector(const Snapshot& snapshot, const SelectOptions& options)
    : state_(new State{.snapshot = snapshot,
                       .scale = {.weights = snapshot.learned()->weights, .transition = options.transition},
                       .poses = PoseReader(snapshot),
                       .known = {},
                       .before = {},
                       .terms = {}}) {}
Selector::~Selector() = default;
Selector::Selector(Selector&&) noexcept = default;
Selector& Selector::operator=(Selector&&) noexcept = default;

const JoinScale& Selector::scale() const noexcept {
  return state_->scale;
}

TargetTerms Selector::target(std::size_t candidate) const {
  return state_->terms[candidate];
}

PlaceCosts Selector::next(const Choice& choice) {
  State& state = *state_;
  const std::shared_ptr<const Tokens> tokens = state.look_up(choice.candidates);
  const std::size_t count = choice.candidates.size();
  PlaceCosts place{.ends = tokens->ends,
                   .own = tokens->own,
                   .added_before = {},
                   .made_before = tokens->made_before,
                   .made_after = tokens->made_after,
                   .kept = std::vector<std::uint32_t>(count, PlaceCosts::kNone),
                   .joins = {}};
  state.terms = tokens->terms;
  if (state.before) {
    const Tokens& before = *state.before;
    if (before.last_label != kNoLabel) {
      for (std::size_t i = 0; i < count; ++i) {
        if (tokens->label_before[i] == before.last_label) continue;
        term(state.terms[i], TargetTerm::left) = weight_of(TargetTerm::left);
        place.own[i] += weight_of(TargetTerm::left);
      }
    }
    if (tokens->first_label != kNoLabel) {
      for (const std::string_view after : before.label_after) {
        place.added_before.push_back(after == tokens->first_label ? 0 : weight_of(TargetTerm::right));
      }
    }
    for (std::size_t i = 0; i < count && choice.pause_before == Milliseconds(0); ++i) {
      if (tokens->neighbour[i] == kNoRow) continue;
      const auto at = std::lower_bound(before.by_last.begin(), before.by_last.end(),
                                       std::pair(tokens->neighbour[i], std::uint32_t{0}));
      if (at != before.by_last.end() && at->first == tokens->neighbour[i]) place.kept[i] = at->second;
    }
    if (!State::alike(before, *tokens)) {
      place.joins.reserve(before.cores.size() * count);
      for (std::size_t a = 0; a < before.cores.size(); ++a) {
        for (std::size_t b = 0; b < count; ++b) {
          const JoinTerms terms = join_terms(before.ends->end(a), tokens->ends->begin(b), state.scale.transition,
                                             state.scale.weights.speed_limit);
          place.joins.push_back(cost_of(terms, state.scale.weights.weights) + state.unknown(before, a, *tokens, b));
        }
      }
    }
  }
  state.before = tokens;
  return place;
}

bool are_neighbours(const Contents& contents, const Candidate& a, const Candidate& b) {
  if (a.recording != b.recording || a.last_row == kNoRow || b.first_row == kNoRow) return false;
  return neighbour_before(contents.segments, b.first_row) == a.last_row;
}

namespace {

/// The costs of every candidate, given the other choices.
std::vector<std::vector<CandidateCosts>> explain(std::span<const PlaceCosts> places,
                                                 const std::vector<std::vector<TargetTerms>>& targets,
                                                 const std::vector<std::size_t>& chosen, const JoinScale& scale) {
  std::vector<std::vector<CandidateCosts>> all(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PlaceCosts& place = places[i];
    for (std::size_t c = 0; c < place.size(); ++c) {
      CandidateCosts costs{.target = targets[i][c]};
      if (i > 0) {
        const PlaceCosts& before = places[i - 1];
        costs.kept = place.kept[c] == chosen[i - 1];
        if (!costs.kept) {
          const JoinTerms terms = join_terms(before.ends->end(chosen[i - 1]), place.ends->begin(c), scale.transition,
                                             scale.weights.speed_limit);
          for (std::size_t k = 0; k < kJoinTerms; ++k) {
            costs.join[k] = terms[k] * scale.weights.weights[k];
            costs.join_cost += costs.join[k];
          }
          if (!place.joins.empty()) {
            const float whole = place.joins[chosen[i - 1] * place.size() + c];
            costs.join_unknown = std::max(0.0f, whole - costs.join_cost);
            costs.join_cost = whole;
          }
        }
      }
      if (costs.kept) term(costs.target, TargetTerm::preparation) = 0;
      float after = 0;
      if (i + 1 < places.size()) {
        const PlaceCosts& next = places[i + 1];
        if (!next.added_before.empty()) term(costs.target, TargetTerm::right) = next.added_before[c];
        after = transition_cost(place, c, next, chosen[i + 1], scale);
        if (next.kept[chosen[i + 1]] == c) {
          term(costs.target, TargetTerm::retraction) = 0;
        } else {  // counted in `target`; the other place counts its own preparation
          after -= place.made_after[c] + next.made_before[chosen[i + 1]];
        }
      }
      for (const float one : costs.target) costs.target_cost += one;
      costs.cost = costs.target_cost + costs.join_cost + after;
      all[i].push_back(costs);
    }
  }
  return all;
}

}  // namespace

Selection select(const Snapshot& snapshot, std::span<const Choice> choices, const SelectOptions& options) {
  Selection selection;
  selection.transition = options.transition;
  if (choices.empty()) return selection;
  // With one candidate everywhere there is nothing to choose and nothing to look up.
  selection.measured = options.explain || std::any_of(choices.begin(), choices.end(),
                                                      [](const Choice& c) { return c.candidates.size() > 1; });
  if (!selection.measured) {
    selection.chosen.assign(choices.size(), 0);
    selection.join_costs.assign(choices.size(), 0.0);
    return selection;
  }
  Selector selector(snapshot, options);
  std::vector<PlaceCosts> places;
  std::vector<std::vector<TargetTerms>> targets;
  places.reserve(choices.size());
  for (const Choice& choice : choices) {
    places.push_back(selector.next(choice));
    if (!options.explain) continue;
    targets.emplace_back();
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) targets.back().push_back(selector.target(i));
  }
  Path path = best_path(places, selector.scale());
  selection.chosen = std::move(path.chosen);
  selection.total = path.total;
  selection.weights = selector.scale().weights;
  selection.join_costs.push_back(0);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const std::size_t a = selection.chosen[i - 1];
    const std::size_t b = selection.chosen[i];
    const bool kept = places[i].kept[b] == a;
    const float made = places[i - 1].made_after[a] + places[i].made_before[b];
    selection.join_costs.push_back(
        kept ? 0.0 : static_cast<double>(transition_cost(places[i - 1], a, places[i], b, selector.scale()) - made));
  }
  if (options.explain) selection.explained = explain(places, targets, selection.chosen, selector.scale());
  return selection;
}

}  // namespace signweave
