#include "signweave/evaluation/evaluate_aim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "signweave/inflection/learned_stroke.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Loci nearer than this are one: a token there is what the ladder would take. (design)
constexpr float kSameLocus = 10;
constexpr std::size_t kTokenFolds = 10;
/// Hands that keep to each other do not change sides: between their palms less changes than this. Metres. (ours)
constexpr float kCrossed = 0.12f;

float degrees_between(const std::optional<Locus>& a, const std::optional<Locus>& b) {
  if (!a && !b) return 0;
  if (!a || !b || a->self != b->self) return 90;
  if (a->self) return 0;
  const float cosine = a->at.normalized().dot(b->at.normalized());
  return std::acos(std::clamp(cosine, -1.0f, 1.0f)) * 180 / std::numbers::pi_v<float>;
}
float degrees_between(const LociOfSign& a, const LociOfSign& b) {
  return degrees_between(a.from, b.from) + degrees_between(a.to, b.to) + degrees_between(a.at, b.at);
}
std::vector<Locus> places_of(const LociOfSign& loci) {
  std::vector<Locus> places;
  for (const auto& locus : {loci.from, loci.to, loci.at}) {
    if (locus && !locus->self) places.push_back(*locus);
  }
  return places;
}
bool has_locus(const LociOfSign& loci, const Locus& locus) {
  return std::ranges::any_of(places_of(loci),
                             [&](const Locus& one) { return degrees_between(one, locus) <= kSameLocus; });
}
bool has_loci(const LociOfSign& loci) {
  return loci.from || loci.to || loci.at;
}
bool straight_ahead(const LociOfSign& loci) {
  const std::vector<Locus> places = places_of(loci);
  return !places.empty() && std::ranges::all_of(places, [](const Locus& one) {
    return degrees_between(one, Locus{.at = Vector3f::UnitZ()}) <= kSameLocus;
  });
}

/// A recording whose strokes are changed.
struct Stage {
  BorrowedSource source;
  StrokeChanger changer;
  Stage(const EvaluatedMotion& recording, std::shared_ptr<const SignerRig> rig)
      : source(recording.motion), changer(recording.motion.skeleton(), std::move(rig)) {}
};

/// A token with its stroke.
struct Actor {
  std::size_t token = 0;  ///< in AimEvaluation::tokens
  Stage* stage = nullptr;
  CapturedStroke stroke;
  StrokeToken seen;

  Vector3f begin() const { return stroke.palm(stroke.samples.front(), stroke.dominant); }
  Vector3f end() const { return stroke.palm(stroke.samples.back(), stroke.dominant); }
  /// Both hands act, and do not keep to each other.
  bool changes_distance() const {
    if (!seen.points.used[0] || !seen.points.used[1]) return false;
    float least = std::numeric_limits<float>::max();
    float most = 0;
    for (const CapturedStroke::Sample& sample : stroke.samples) {
      const float apart = (sample.hands[0].palm - sample.hands[1].palm).norm();
      least = std::min(least, apart);
      most = std::max(most, apart);
    }
    const Vector3f across = stroke.first(Side::left).palm - stroke.first(Side::right).palm;
    const Vector3f across_after = stroke.last(Side::left).palm - stroke.last(Side::right).palm;
    return most - least > kSamePlace || (across_after - across).norm() > kCrossed;
  }
  float unit() const { return stage->changer.body().shoulder_width; }
};

class GlossEvaluation {
 public:
  GlossEvaluation(std::span<Actor> actors, AimEvaluation::Gloss& gloss, std::vector<AimScore>& scores)
      : actors_(actors), gloss_(gloss), scores_(scores) {}

  void run() {
    std::vector<PlacedStroke> placed;
    for (const Actor& actor : actors_) {
      if (!has_loci(actor.seen.loci)) continue;
      placed.push_back({.loci = actor.seen.loci,
                        .begin = actor.begin() / actor.unit(),
                        .end = actor.end() / actor.unit(),
                        .both_hands = actor.changes_distance()});
    }
    gloss_.with_loci = placed.size();
    gloss_points_ = 2 * std::ranges::count_if(actors_, [](const Actor& one) { return points_at_locus(one); }) >
                    static_cast<std::ptrdiff_t>(actors_.size());
    gloss_.role = role_of_strokes(placed);
    if (gloss_.role != SpaceRole::none) {
      leave_tokens_out();
      leave_loci_out();
    }
    predict_from_elsewhere();
    compare_repetitions();
  }

 private:
  using Chosen = std::vector<std::size_t>;  ///< indices of actors

  void leave_tokens_out() {
    for (std::size_t fold = 0; fold < std::min(kTokenFolds, actors_.size()); ++fold) {
      Chosen others;
      std::vector<StrokeToken> tokens;
      for (std::size_t i = 0; i < actors_.size(); ++i) {
        if (i % kTokenFolds == fold || !has_loci(actors_[i].seen.loci)) continue;
        others.push_back(i);
        tokens.push_back(actors_[i].seen);
      }
      const auto learned = LearnedStroke::learn(tokens, gloss_.role, actors_.front().stage->changer.body());
      if (!learned.stroke) return;
      for (std::size_t i = fold; i < actors_.size(); i += kTokenFolds) {
        if (!has_loci(actors_[i].seen.loci)) continue;
        const Prediction prediction = learned.stroke->predict(actors_[i].seen.loci);
        take(AimMethod::seen, prediction, others, i, prediction.inside);
      }
    }
  }

  void leave_loci_out() {
    std::vector<Locus> loci;
    for (const Actor& actor : actors_) {
      for (const Locus& locus : places_of(actor.seen.loci)) {
        if (std::ranges::none_of(loci, [&](const Locus& one) { return degrees_between(one, locus) <= kSameLocus; })) {
          loci.push_back(locus);
        }
      }
    }
    for (const Locus& locus : loci) leave_out(locus);
  }

  void leave_out(const Locus& locus) {
    Chosen others;
    Chosen left_out;
    for (std::size_t i = 0; i < actors_.size(); ++i) {
      if (!has_loci(actors_[i].seen.loci)) continue;
      (has_locus(actors_[i].seen.loci, locus) ? left_out : others).push_back(i);
    }
    if (others.empty()) return;
    std::vector<StrokeToken> tokens;
    for (const std::size_t i : others) tokens.push_back(actors_[i].seen);
    const SignerBody& body = actors_.front().stage->changer.body();
    const auto learned = LearnedStroke::learn(tokens, gloss_.role, body);
    const auto cubic = LearnedStroke::learn(tokens, gloss_.role, body, LearnedStroke::Model::cubic_alone);
    if (!learned.stroke) gloss_.why_not_learned = learned.why_not;
    for (const std::size_t i : left_out) {
      const LociOfSign& wanted = actors_[i].seen.loci;
      bool near = false;
      if (learned.stroke && cubic.stroke) {
        const Prediction prediction = learned.stroke->predict(wanted);
        near = prediction.inside;
        take(AimMethod::learned, prediction, others, i, near);
        take(AimMethod::cubic, cubic.stroke->predict(wanted), others, i, near);
      }
      const auto distance = [&](std::size_t other) { return degrees_between(actors_[other].seen.loci, wanted); };
      aim(AimMethod::nearest, *std::ranges::min_element(others, {}, distance), i, near);
      const auto ahead = std::ranges::find_if(others, [&](std::size_t other) {
        return straight_ahead(actors_[other].seen.loci) && same_kinds(actors_[other].seen.loci, wanted);
      });
      if (ahead != others.end()) aim(AimMethod::citation, *ahead, i, near);
    }
  }

  static bool same_kinds(const LociOfSign& a, const LociOfSign& b) {
    const auto kind = [](const std::optional<Locus>& one) { return !one ? 0 : one->self ? 1 : 2; };
    return kind(a.from) == kind(b.from) && kind(a.to) == kind(b.to) && kind(a.at) == kind(b.at);
  }

  void take(AimMethod method, const Prediction& prediction, const Chosen& others, std::size_t target, bool near) {
    const std::size_t source = others[prediction.nearest];
    Actor& from = actors_[source];
    const FittedChange fitted = change_to(from.stage->changer, from.stroke, from.seen.points, prediction.points);
    AimScore& score = add(method, source, target, fitted, near);
    score.expected_mm = static_cast<double>(prediction.error_mm);
    score.expected_degrees = static_cast<double>(prediction.error_degrees);
  }

  void aim(AimMethod method, std::size_t source, std::size_t target, bool near) {
    Actor& from = actors_[source];
    try {
      const Aimed aimed =
          aim_stroke(from.stage->changer, from.stroke, gloss_.role, actors_[target].seen.loci, from.seen.loci);
      add(method, source, target, aimed.fitted, near);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::bad_input) throw;  // a locus behind the signer
    }
  }

  void predict_from_elsewhere() {
    const std::size_t count = actors_.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (actors_[i].changes_distance()) continue;
      std::size_t nearest = i;
      float least = std::numeric_limits<float>::max();
      for (std::size_t j = 0; j < count; ++j) {
        const auto [begin, end] = ends_for(i, j);
        const float away = std::max((actors_[j].begin() - begin).norm(), (actors_[j].end() - end).norm());
        if (away < kOtherPlace || away >= least || actors_[j].changes_distance()) continue;
        least = away;
        nearest = j;
      }
      if (nearest == i) continue;
      const auto [begin, end] = ends_for(i, nearest);
      const Aimed aimed = aim_between(actors_[nearest].stage->changer, actors_[nearest].stroke, begin, end);
      add(AimMethod::ends, nearest, i, aimed.fitted, true);
    }
  }
  /// The ends of a stroke for the body of another one, metres.
  std::pair<Vector3f, Vector3f> ends_for(std::size_t stroke, std::size_t other) const {
    const float scale = actors_[other].unit() / actors_[stroke].unit();
    return {scale * actors_[stroke].begin(), scale * actors_[stroke].end()};
  }

  void compare_repetitions() {
    for (std::size_t i = 0; i < actors_.size(); ++i) {
      for (std::size_t j = i + 1; j < actors_.size(); ++j) {
        const CapturedStroke& a = actors_[i].stroke;
        const CapturedStroke& b = actors_[j].stroke;
        const bool near = (a.first(b.dominant).palm - b.first(b.dominant).palm).norm() < kSamePlace &&
                          (a.last(b.dominant).palm - b.last(b.dominant).palm).norm() < kSamePlace;
        const bool aimed = has_loci(actors_[i].seen.loci) && has_loci(actors_[j].seen.loci);
        if (!near || (aimed && degrees_between(actors_[i].seen.loci, actors_[j].seen.loci) > 1)) continue;
        add(AimMethod::floor, i, j, {}, true);
      }
    }
  }

  HandInSpace last_of(const Actor& actor, const ChangePose& change) const {
    const Side side = actor.stroke.dominant;
    Pose pose = actor.stroke.samples.back().pose;
    if (change) change(1, pose.view());
    return actor.stage->changer.look(std::as_const(pose).view(), actor.stroke.space, side);
  }

  AimScore& add(AimMethod method, std::size_t source, std::size_t target, const FittedChange& fitted, bool near) {
    Actor& from = actors_[source];
    const Actor& goal = actors_[target];
    std::array<PathSpline, 2> paths;
    for (std::size_t side = 0; side < 2; ++side) {
      if (fitted.change.arms[side]) paths[side] = PathSpline(fitted.change.arms[side]->path);
    }
    const ChangePose change = [&](float time, MutablePoseView pose) {
      from.stage->changer.apply(fitted.change, paths, from.stroke.space, 1, time, pose);
    };
    const PhasePoints made = phase_points(from.stage->changer, from.stage->source, from.stroke, change);
    const bool points = method != AimMethod::ends && gloss_.role == SpaceRole::aim && gloss_points_ &&
                        from.stage->changer.has_index(goal.stroke.dominant);
    const LociOfSign& loci = goal.seen.loci;
    const std::optional<Locus> pointed_at = !points ? std::nullopt : loci.at ? loci.at : loci.to;
    HandInSpace last;
    if (goal.stroke.dominant == from.stroke.dominant) last = last_of(from, change);
    scores_.push_back(
        {.method = method,
         .token = goal.token,
         .source = from.token,
         .near = near,
         .share = fitted.share,
         .errors = aim_errors({made, last}, {goal.seen.points, {}}, goal.stroke.dominant, pointed_at, goal.unit())});
    return scores_.back();
  }

  static bool points_at_locus(const Actor& actor) {
    const LociOfSign& loci = actor.seen.loci;
    const std::optional<Locus>& locus = loci.at ? loci.at : loci.to;
    if (!locus || !actor.stage->changer.has_index(actor.stroke.dominant)) return false;
    const HandInSpace& hand = actor.stroke.last(actor.stroke.dominant);
    return (hand.index_tip - hand.index_base).normalized().dot(locus->at.normalized()) > 0.8f;
  }

  std::span<Actor> actors_;
  bool gloss_points_ = false;  ///< the index finger is stretched towards the locus
  AimEvaluation::Gloss& gloss_;
  std::vector<AimScore>& scores_;
};

bool is_usable(const EvaluatedMotion& recording, FrameRange core) {
  if (core.begin < 0 || core.end > recording.motion.frame_count() || core.size() < 2) return false;
  for (std::int64_t frame = core.begin; frame < core.end; ++frame) {
    if (recording.unusable[static_cast<std::size_t>(frame)]) return false;
  }
  return true;
}

/// The tokens of glosses, by gloss.
class Tokens {
 public:
  Tokens(std::span<const EvaluatedMotion> recordings, AimEvaluation& made) : recordings_(recordings), made_(made) {
    for (std::size_t r = 0; r < recordings.size(); ++r) add_recording(r);
  }
  std::map<std::string, std::vector<AimToken>> of;  ///< [gloss]

  /// Reads the strokes of some tokens of one gloss. Those with other joints than the first are left out.
  std::vector<Actor> actors(const std::vector<AimToken>& tokens, std::size_t gloss) {
    std::vector<Actor> found;
    for (const AimToken& token : tokens) {
      const EvaluatedMotion& recording = recordings_[token.recording];
      if (found.size() == kMostAimTokens ||
          recording.motion.skeleton().joint_count() != first_of(tokens).motion.skeleton().joint_count() ||
          !(recording.motion.skeleton() == first_of(tokens).motion.skeleton())) {
        ++made_.left_out;
        continue;
      }
      Stage& stage = *stages_.at(token.recording);
      const Sign& sign = recording.signs[token.sign];
      Actor actor{.token = made_.tokens.size(), .stage = &stage};
      actor.stroke = captured_stroke(stage.changer, stage.source, frames_of(*sign.stroke_span(), recording.clock));
      actor.seen.points = phase_points(stage.changer, stage.source, actor.stroke);
      if (!recording.loci.empty()) actor.seen.loci = recording.loci[token.sign];
      made_.tokens.push_back(token);
      made_.tokens.back().gloss = gloss;
      found.push_back(std::move(actor));
    }
    return found;
  }

 private:
  const EvaluatedMotion& first_of(const std::vector<AimToken>& tokens) const {
    return recordings_[tokens.front().recording];
  }
  void add_recording(std::size_t r) {
    const EvaluatedMotion& recording = recordings_[r];
    if (recording.signs.empty()) return;
    auto stage =
        std::make_unique<Stage>(recording, std::make_shared<SignerRig>(SignerRig{recording.signer, recording.groups}));
    if (!stage->changer.why_not().empty()) {
      made_.left_out += recording.signs.size();
      return;
    }
    stages_[r] = std::move(stage);
    for (std::size_t i = 0; i < recording.signs.size(); ++i) {
      const Sign& sign = recording.signs[i];
      const std::optional<TimeSpan> span = sign.stroke_span();
      if (!span || !is_usable(recording, frames_of(*span, recording.clock))) {
        ++made_.left_out;
        continue;
      }
      of[sign.gloss].push_back({.recording = r, .sign = i});
    }
  }

  std::span<const EvaluatedMotion> recordings_;
  AimEvaluation& made_;
  std::map<std::size_t, std::unique_ptr<Stage>> stages_;  ///< [recording]
};

/// Where a palm can be for a locus: the signer's own is before the chest.
Vector3f palm_for(const Locus& locus) {
  if (locus.self) return {0, -0.4f, 0.7f};
  return locus.at / std::max(locus.at.norm(), 1.0f);
}

}  // namespace

std::string_view name_of(AimMethod method) noexcept {
  switch (method) {
    case AimMethod::seen:
      return "seen";
    case AimMethod::learned:
      return "learned";
    case AimMethod::cubic:
      return "cubic";
    case AimMethod::nearest:
      return "nearest";
    case AimMethod::citation:
      return "citation";
    case AimMethod::ends:
      return "ends";
    case AimMethod::floor:
      return "floor";
  }
  return {};
}

SpaceRole role_of_strokes(std::span<const PlacedStroke> strokes) {
  std::size_t both = 0;
  std::size_t verbs = 0;
  float forward = 0;
  float backward = 0;
  for (const PlacedStroke& one : strokes) {
    if (!one.loci.from || !one.loci.to) continue;
    ++verbs;
    if (one.both_hands) ++both;
    const Vector3f from = palm_for(*one.loci.from);
    const Vector3f to = palm_for(*one.loci.to);
    forward += (from - one.begin).norm() + (to - one.end).norm();
    backward += (to - one.begin).norm() + (from - one.end).norm();
  }
  if (strokes.empty()) return SpaceRole::none;
  if (2 * verbs <= strokes.size()) return SpaceRole::aim;
  if (2 * both > verbs) return SpaceRole::both;
  return forward <= backward ? SpaceRole::forward : SpaceRole::backward;
}

AimEvaluation evaluate_aim(std::span<const EvaluatedMotion> recordings, const EvaluationProgress& progress) {
  AimEvaluation made;
  Tokens tokens(recordings, made);
  std::size_t done = 0;
  for (const auto& [name, of_gloss] : tokens.of) {
    std::vector<Actor> actors = tokens.actors(of_gloss, made.glosses.size());
    made.glosses.push_back({.name = name, .tokens = actors.size()});
    GlossEvaluation(actors, made.glosses.back(), made.scores).run();
    if (progress) progress(static_cast<double>(++done) / static_cast<double>(tokens.of.size()));
  }
  return made;
}

}  // namespace signweave
