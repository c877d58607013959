#include "signweave/choose/learned_strokes.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/choose/open_score.h"

namespace signweave {
namespace {

bool any(const LociOfSign& loci) noexcept {
  return loci.from || loci.to || loci.at;
}

/// Describes the strokes of tokens, each on its own signer.
class StrokeReader {
 public:
  explicit StrokeReader(const Snapshot& snapshot) : snapshot_(snapshot) {}

  /// None if the signer's arms are unknown or nothing is annotated.
  std::optional<StrokeToken> read(const Candidate& candidate) {
    const RecordingInfo& info = snapshot_.contents().recordings[candidate.recording];
    const std::shared_ptr<const SignerModel> signer = snapshot_.signer(info);
    if (!signer->body || candidate.signs.empty()) return std::nullopt;
    const LociOfSign loci = captured_loci(snapshot_, candidate.recording, candidate.signs.front().span, *signer->body);
    if (!any(loci)) return std::nullopt;
    if (recording_ != candidate.recording) open(candidate.recording, info);
    if (!changer_->why_not().empty()) return std::nullopt;
    const CapturedStroke stroke = captured_stroke(*changer_, *source_, candidate.core);
    return StrokeToken{.points = phase_points(*changer_, *source_, stroke), .loci = loci};
  }

 private:
  void open(std::size_t recording, const RecordingInfo& info) {
    recording_ = recording;
    source_ = snapshot_.motion(info);
    changer_.emplace(*source_->skeleton(), std::make_shared<const SignerRig>(signer_rig_of(snapshot_, info)));
  }

  const Snapshot& snapshot_;
  std::optional<std::size_t> recording_;
  std::shared_ptr<const MotionSource> source_;
  std::optional<StrokeChanger> changer_;
};

}  // namespace

LociOfSign captured_loci(const Snapshot& snapshot, std::size_t recording, TimeSpan sign, const SignerBody& body) {
  const auto found = loci_over(*snapshot.loci(recording), sign);
  const auto resolved = [&](LocusTier tier) -> std::optional<Locus> {
    const std::optional<LocusRef>& ref = found[static_cast<std::size_t>(tier)];
    if (!ref || (ref->kind == LocusRef::Kind::name && !is_built_in_locus(ref->name))) return std::nullopt;
    return resolve(*ref, {}, 0, body);
  };
  return {.from = resolved(LocusTier::from), .to = resolved(LocusTier::to), .at = resolved(LocusTier::at)};
}

std::shared_ptr<const LearnedStroke::Learned> LearnedStrokes::of(const Snapshot& snapshot, const std::string& gloss,
                                                                 SpaceRole role) {
  const std::lock_guard guard(mutex_);
  if (contents_ != snapshot.shared_contents()) {
    contents_ = snapshot.shared_contents();
    known_.clear();
  }
  std::shared_ptr<const LearnedStroke::Learned>& known = known_[{gloss, role}];
  if (known) return known;
  SignRef sign;
  sign.gloss.gloss = gloss;
  const std::vector<Candidate> candidates = candidates_for(*contents_, sign);
  StrokeReader reader(snapshot);
  std::vector<StrokeToken> tokens;
  const std::size_t step = (candidates.size() + kMostLearnedTokens - 1) / kMostLearnedTokens;
  for (std::size_t i = 0; i < candidates.size(); i += std::max<std::size_t>(step, 1)) {
    if (std::optional<StrokeToken> token = reader.read(candidates[i])) tokens.push_back(std::move(*token));
  }
  const SignerBody body =
      snapshot.signer(contents_->recordings[candidates.front().recording])->body.value_or(SignerBody{});
  known = std::make_shared<const LearnedStroke::Learned>(LearnedStroke::learn(tokens, role, body));
  return known;
}

}  // namespace signweave
