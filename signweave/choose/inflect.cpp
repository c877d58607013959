#include "signweave/choose/inflect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "signweave/core/text.h"
#include "signweave/inflection/aim.h"
#include "signweave/inflection/edit_stroke.h"
#include "signweave/inflection/inflected_source.h"

namespace signweave {
namespace {

/// Each repetition is smaller than the one before (Liddell and Johnson 1989: repetitions shrink), but not below this.
constexpr std::array kRepetitionSizes = {1.0f, 0.8f, 0.7f, 0.65f, 0.6f};
/// Repetitions of a plural are shifted outward by this much each. Centimetres. (ours)
constexpr float kPluralShift = 6;

bool has_target(const SpaceChange& change) {
  return change.from || change.to || change.at || !change.along.empty() || change.past;
}
bool has_edit(const SpaceChange& change) {
  const SpaceChange none;
  return change.move != none.move || change.turn != none.turn || change.scale != none.scale || change.size != none.size;
}

/// The degrees between two loci as seen from between the shoulders.
float apart(const Locus& a, const Locus& b) {
  if (a.self || b.self) return a.self && b.self ? 0 : 180;
  const float cosine = a.at.normalized().dot(b.at.normalized());
  return std::acos(std::clamp(cosine, -1.0f, 1.0f)) * 180 / std::numbers::pi_v<float>;
}

LociOfSign wanted_loci(const SpaceChange& change, std::span<const LocusSetup> loci, std::size_t place,
                       const SignerBody& body) {
  const auto resolved = [&](const std::optional<LocusRef>& ref) -> std::optional<Locus> {
    if (!ref) return std::nullopt;
    return resolve(*ref, loci, place, body);
  };
  return {.from = resolved(change.from), .to = resolved(change.to), .at = resolved(change.at)};
}

/// The largest distance of a wanted locus from the captured one; none if one is not known.
std::optional<float> distance(const LociOfSign& wanted, const LociOfSign& captured) {
  float most = 0;
  for (const auto& [a, b] :
       {std::pair(wanted.from, captured.from), std::pair(wanted.to, captured.to), std::pair(wanted.at, captured.at)}) {
    if (!a) continue;
    if (!b) return std::nullopt;
    most = std::max(most, apart(*a, *b));
  }
  return most;
}

/// Finds the changes of clips of one signer.
class Inflector {
 public:
  Inflector(std::span<const LocusSetup> loci, const Snapshot& snapshot, const std::shared_ptr<const SignerRig>& rig,
            const SpaceOptions& options, std::vector<Notice>& notices)
      : loci_(loci),
        snapshot_(snapshot),
        rig_(rig),
        options_(options),
        notices_(notices),
        learned_(options.learned ? options.learned : std::make_shared<LearnedStrokes>()) {}

  void inflect(const ClipToInflect& one) {
    MotionClip& clip = *one.clip;
    clip.speed = static_cast<double>(one.change.speed);
    if (!has_target(one.change) && !has_edit(one.change)) return;
    StrokeChanger changer(*clip.source->skeleton(), rig_);
    if (!changer.why_not().empty()) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("'{}' cannot be changed in space: {}", name_of(clip), changer.why_not()));
    }
    if (has_target(one.change)) add(clip, target_change(changer, one));
    if (has_edit(one.change)) {
      SpaceChange edit = one.change;
      edit.from = edit.to = edit.at = edit.past = std::nullopt;
      edit.along.clear();
      const CapturedStroke stroke = captured_stroke(changer, *clip.source, clip.core);
      add(clip, change_of(edit_stroke(changer, stroke, edit), edit, ChangeBasis::asked));
    }
  }

 private:
  static std::string name_of(const MotionClip& clip) {
    return printable(clip.signs.empty() ? clip.recording : clip.signs.front().gloss);
  }

  ClipChange change_of(FittedChange fitted, const SpaceChange& asked, ChangeBasis basis) const {
    SpaceChange said = asked;
    said.speed = 1;
    said.repetitions = 1;
    said.outward = said.mirrored = false;
    return {.asked = to_string(said),
            .basis = basis,
            .because = {},
            .stroke = std::move(fitted.change),
            .moved_mm = fitted.moved_mm,
            .turned_degrees = fitted.turned_degrees,
            .share = fitted.share,
            .limit = fitted.share < 1 ? fitted.why : std::string(),
            .missed_mm = 0,
            .aim_degrees = 0};
  }

  void add(MotionClip& clip, ClipChange change) {
    if (change.share < 1) {
      notices_.push_back({clip.recording,
                          fmt::format("'{}': {:.0f} % of '{}' is reached: {}", name_of(clip), 100 * change.share,
                                      change.asked, change.limit),
                          {},
                          "space"});
    }
    if (is_as_captured(change.stroke)) {
      clip.changes.push_back(std::move(change));
      return;
    }
    change.stroke.before = std::max<std::int64_t>(clip.core.begin - clip.whole.begin, 1);
    change.stroke.after = std::max<std::int64_t>(clip.whole.end - clip.core.end, 1);
    clip.source = std::make_shared<InflectedSource>(clip.source, rig_, clip.core, change.stroke);
    clip.noise = nullptr;
    clip.changes.push_back(std::move(change));
  }

  std::vector<Locus> resolved(const std::vector<LocusRef>& places, std::size_t place, const SignerBody& body) const {
    std::vector<Locus> found;
    for (const LocusRef& ref : places) found.push_back(resolve(ref, loci_, place, body));
    return found;
  }

  ClipChange target_change(StrokeChanger& changer, const ClipToInflect& one) {
    const MotionClip& clip = *one.clip;
    SpaceChange asked = one.change;
    asked.move = asked.turn = {};
    asked.scale = {1, 1, 1};
    asked.size = 1;
    const CapturedStroke stroke = captured_stroke(changer, *clip.source, clip.core);
    if (!asked.along.empty()) {
      return change_of(take_along(changer, stroke, resolved(asked.along, one.place, changer.body()), asked.keeps_turn),
                       asked, ChangeBasis::asked);
    }
    if (asked.past) {
      const Locus past = resolve(*asked.past, loci_, one.place, changer.body());
      return change_of(take_past(changer, stroke, past, asked.keeps_turn), asked, ChangeBasis::asked);
    }
    return aimed_change(changer, stroke, clip, one.place, asked);
  }

  ClipChange aimed_change(StrokeChanger& changer, const CapturedStroke& stroke, const MotionClip& clip,
                          std::size_t place, const SpaceChange& asked) {
    const LociOfSign wanted = wanted_loci(asked, loci_, place, changer.body());
    const LociOfSign captured = loci_of(clip, changer.body());
    const std::optional<float> off = distance(wanted, captured);
    const SpaceRole role = role_of(clip, stroke, changer, asked);
    if (role == SpaceRole::none && !asked.at) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("'{}' has no role in space, so it cannot go from or to a locus; give its role, such as "
                              "{}=forward, or sign it at the locus: at @left",
                              name_of(clip), name_of(clip)));
    }
    if (off && *off <= kCapturedLocus && role != SpaceRole::aim) {  // a finger can always point exactly
      ClipChange change = change_of({}, asked, ChangeBasis::captured);
      change.because = fmt::format("'{}' was captured within {:.0f}° of it", name_of(clip), std::max(1.0f, *off));
      return change;
    }
    std::string why_not = "its loci are not annotated";
    const bool is_verb = role != SpaceRole::aim && role != SpaceRole::none && (asked.from || asked.to);
    if (is_verb && !clip.signs.empty() && !clip.mirrored) {
      const auto learned = learned_->of(snapshot_, clip.signs.front().gloss, role);
      why_not = learned->why_not;
      if (learned->stroke) {
        const Prediction prediction = learned->stroke->predict(wanted);
        why_not = prediction.why_outside;
        if (prediction.inside) {
          ClipChange change =
              change_of(change_to(changer, stroke, phase_points(changer, *clip.source, stroke), prediction.points),
                        asked, ChangeBasis::learned);
          change.because = why_learned(*learned->stroke, prediction);
          change.missed_mm = prediction.error_mm;
          return change;
        }
      }
    }
    const Aimed aimed = aim_stroke(changer, stroke, role, wanted, captured);
    ClipChange change = change_of(aimed.fitted, asked, ChangeBasis::geometric);
    change.because = role == SpaceRole::aim ? fmt::format("'{}' points at it", name_of(clip))
                                            : why_geometric(fmt::format("'{}'", name_of(clip)), why_not);
    change.missed_mm = 1000 * std::max(aimed.begin_missed, aimed.end_missed);
    change.aim_degrees = aimed.aim_error;
    return change;
  }

  LociOfSign loci_of(const MotionClip& clip, const SignerBody& body) const {
    if (clip.signs.empty() || clip.mirrored) return {};
    const Contents& contents = snapshot_.contents();
    const RecordingInfo& info = contents.at(clip.recording);
    return captured_loci(snapshot_, static_cast<std::size_t>(&info - contents.recordings.data()),
                         clip.signs.front().span, body);
  }

  SpaceRole role_of(const MotionClip& clip, const CapturedStroke& stroke, const StrokeChanger& changer,
                    const SpaceChange& asked) {
    if (!clip.signs.empty()) {
      if (const std::optional<SpaceRole> role = signweave::role_of(options_.roles, clip.signs.front().gloss)) {
        return *role;
      }
    }
    const SpaceRole role = guessed_role(stroke, changer);
    const bool needs_role = !asked.at || role == SpaceRole::aim;  // any sign can be made at a locus
    if (needs_role && role != SpaceRole::none) {
      notices_.push_back(
          {clip.recording,
           fmt::format("the role of '{}' is guessed from its movement: {}; give it in a table of roles to be sure",
                       name_of(clip), signweave::name_of(role)),
           {},
           "guessed_role"});
    }
    return role;
  }

  std::span<const LocusSetup> loci_;
  const Snapshot& snapshot_;
  const std::shared_ptr<const SignerRig>& rig_;
  const SpaceOptions& options_;
  std::vector<Notice>& notices_;
  std::shared_ptr<LearnedStrokes> learned_;
};

}  // namespace

std::set<std::size_t> generated_before(const Utterance& utterance) {
  std::set<std::size_t> places;
  for (std::size_t i = 0; i < utterance.places.size(); ++i) {
    if (!is_changed(utterance.places[i])) continue;
    places.insert(i);
    places.insert(i + 1);
  }
  return places;
}

std::vector<SpaceChange> repetitions_of(const SpaceChange& change) {
  std::vector<SpaceChange> all(std::max<std::size_t>(change.repetitions, 1), change);
  for (std::size_t i = 1; i < all.size(); ++i) {
    all[i].size *= kRepetitionSizes[std::min(i, kRepetitionSizes.size() - 1)];
    if (change.outward) all[i].move[0] -= kPluralShift * static_cast<float>(i);
  }
  return all;
}

void check_loci(const SpaceChange& change, std::span<const LocusSetup> loci, std::size_t place) {
  const SignerBody body;  // only where the chest is depends on it
  const LociOfSign wanted = wanted_loci(change, loci, place, body);
  for (const std::optional<Locus>& locus : {wanted.from, wanted.to, wanted.at}) require_in_front(locus);
  for (const LocusRef& ref : change.along) resolve(ref, loci, place, body);
  if (change.past) resolve(*change.past, loci, place, body);
}

void prefer_loci(const Snapshot& snapshot, const SpaceChange& change, std::span<const LocusSetup> loci,
                 std::size_t place, std::vector<Candidate>& candidates) {
  if (!change.from && !change.to && !change.at) return;
  std::vector<std::optional<float>> distances;
  float least = std::numeric_limits<float>::infinity();
  for (const Candidate& candidate : candidates) {
    const auto signer = snapshot.signer(snapshot.contents().recordings[candidate.recording]);
    std::optional<float> off;
    if (signer->body && !candidate.signs.empty()) {
      off = distance(wanted_loci(change, loci, place, *signer->body),
                     captured_loci(snapshot, candidate.recording, candidate.signs.front().span, *signer->body));
    }
    if (off) least = std::min(least, *off);
    distances.push_back(off);
  }
  if (!std::isfinite(least)) return;
  const float most = least <= kCapturedLocus ? kCapturedLocus : least + kLociApart;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!distances[i] || *distances[i] > most) continue;
    if (kept != i) candidates[kept] = std::move(candidates[i]);
    ++kept;
  }
  candidates.resize(kept);
}

void inflect(std::span<const ClipToInflect> clips, std::span<const LocusSetup> loci, const Snapshot& snapshot,
             const std::shared_ptr<const SignerRig>& rig, const SpaceOptions& options, std::vector<Notice>& notices) {
  Inflector inflector(loci, snapshot, rig, options, notices);
  for (const ClipToInflect& clip : clips) inflector.inflect(clip);
}

void read_changed(std::span<MotionClip> clips, const std::shared_ptr<const SignerRig>& rig) {
  for (MotionClip& clip : clips) {
    for (const ClipChange& change : clip.changes) {
      if (is_as_captured(change.stroke)) continue;
      clip.source = std::make_shared<InflectedSource>(clip.source, rig, clip.core, change.stroke);
      clip.noise = nullptr;
    }
  }
}

}  // namespace signweave
