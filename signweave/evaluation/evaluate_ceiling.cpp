#include <cmath>
#include <limits>

#include "signweave/evaluation/evaluate.h"

namespace signweave {
namespace {

using Eigen::Vector3f;
using Path = std::span<const Vector3f>;

constexpr double kNoError = std::numeric_limits<double>::infinity();
constexpr float kVelocityReach = 0.1f;  // seconds: converts a velocity at a border to a distance. (ours)

/// Mean distance of a piece from the wanted path, over the frames between, after shifting its ends to meet. Stops if it
/// exceeds `most`.
double error_of(Path clip, Path wanted, double most) {
  const std::size_t last = wanted.size() - 1;
  const Vector3f begin = wanted[0] - clip[0];
  const Vector3f turn = (wanted[last] - clip[last]) - begin;
  const double enough = most * static_cast<double>(last - 1);
  double sum = 0;
  for (std::size_t i = 1; i < last && sum < enough; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(last);
    sum += static_cast<double>((clip[i] + begin + share * turn - wanted[i]).norm());
  }
  return sum / static_cast<double>(last - 1);
}

/// Dissimilarity of the borders, from their frames and those outside of them only. Squared metres.
float border_distance(Path path, std::size_t at, Path wanted, std::size_t wanted_at, std::size_t last, float hertz) {
  const auto velocity = [&](Path of, std::size_t from) { return Vector3f(hertz * (of[from + 1] - of[from])); };
  const float reach = kVelocityReach * kVelocityReach;
  return (path[at] - wanted[wanted_at]).squaredNorm() + (path[at + last] - wanted[wanted_at + last]).squaredNorm() +
         reach * (velocity(path, at - 1) - velocity(wanted, wanted_at - 1)).squaredNorm() +
         reach * (velocity(path, at + last) - velocity(wanted, wanted_at + last)).squaredNorm();
}

bool alike(const EvaluatedMotion& a, const EvaluatedMotion& b) {
  return a.signer.body && b.signer.body && a.motion.rate() == b.motion.rate() &&
         std::abs(a.signer.body->shoulder_width - b.signer.body->shoulder_width) <=
             kLikeBody * a.signer.body->shoulder_width &&
         !difference(a.motion.skeleton(), b.motion.skeleton());
}

/// The nearest piece to a span.
struct Nearest {
  double by_borders = kNoError;
  double knowing = kNoError;
};

Nearest nearest_to(std::span<const EvaluatedMotion> recordings, const EvaluatedSpan& span,
                   const std::vector<bool>& like) {
  const EvaluatedMotion& own = recordings[span.recording];
  const Path wanted = own.tracks[static_cast<std::size_t>(span.moving)].seen;
  const auto wanted_at = static_cast<std::size_t>(span.frames.begin - 1);
  const auto last = static_cast<std::size_t>(span.frames.size() + 1);
  const auto hertz = static_cast<float>(own.motion.rate().hertz());
  const std::int64_t apart = std::llround(kApart.count() * own.motion.rate().hertz());
  Nearest nearest;
  float least = std::numeric_limits<float>::infinity();
  if (wanted_at == 0 || wanted_at + last + 1 >= wanted.size()) return nearest;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    if (!like[r]) continue;
    const EvaluatedMotion& other = recordings[r];
    const Path path = other.tracks[static_cast<std::size_t>(span.moving)].seen;
    std::int64_t spoiled = -1;  // the last unusable frame
    for (std::size_t end = 0; end < path.size(); ++end) {
      if (other.unusable[end]) spoiled = static_cast<std::int64_t>(end);
      if (end < last + 2) continue;
      const std::size_t at = end - last - 1;  // the left border; `end` is one past the right border
      if (static_cast<std::int64_t>(at) - 1 <= spoiled) continue;
      if (r == span.recording) {
        const auto begin = static_cast<std::int64_t>(at);
        if (begin <= span.frames.end + apart &&
            begin + static_cast<std::int64_t>(last) + apart >= span.frames.begin - 1)
          continue;
      } else if (const float one = border_distance(path, at, wanted, wanted_at, last, hertz); one < least) {
        least = one;
        nearest.by_borders = error_of(path.subspan(at, last + 1), wanted.subspan(wanted_at, last + 1), kNoError);
      }
      nearest.knowing = std::min(
          nearest.knowing, error_of(path.subspan(at, last + 1), wanted.subspan(wanted_at, last + 1), nearest.knowing));
    }
  }
  return nearest;
}

}  // namespace

std::vector<MethodScores> evaluate_ceiling(std::span<const EvaluatedMotion> recordings,
                                           std::span<const EvaluatedSpan> spans) {
  std::vector<MethodScores> scores = {{"nearest", {}}, {"ceiling", {}}};
  for (MethodScores& row : scores) row.spans.resize(spans.size());
  std::vector<bool> like;
  std::size_t like_whom = recordings.size();
  const std::size_t step = (spans.size() + kMostCeilings - 1) / kMostCeilings;
  for (std::size_t i = 0; i < spans.size(); i += step) {
    const EvaluatedMotion& own = recordings[spans[i].recording];
    if (spans[i].recording != like_whom) {
      like_whom = spans[i].recording;
      like.clear();
      for (const EvaluatedMotion& other : recordings) like.push_back(alike(own, other));
    }
    if (!own.signer.body) continue;
    const Nearest nearest = nearest_to(recordings, spans[i], like);
    const auto put = [&](double metres, MethodScores& row) {
      if (!std::isfinite(metres)) return;
      for (const HandChoice hand : {static_cast<HandChoice>(spans[i].moving), HandChoice::moving}) {
        row.spans[i].at(hand, Measure::wrist).value = 1000 * metres;
        row.spans[i].at(hand, Measure::wrist_widths).value =
            metres / static_cast<double>(own.signer.body->shoulder_width);
      }
    };
    put(nearest.by_borders, scores[0]);
    put(nearest.knowing, scores[1]);
  }
  return scores;
}

}  // namespace signweave
