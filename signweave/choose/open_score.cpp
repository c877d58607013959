#include "signweave/choose/open_score.h"

#include <fmt/format.h>

#include <chrono>
#include <map>

#include "signweave/choose/handedness.h"
#include "signweave/choose/inflect.h"
#include "signweave/choose/notices.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/core/error.h"

namespace signweave {
namespace {

using Clock = std::chrono::steady_clock;

void require_unchanged(const RecordingInfo& info, const SourceRef& source) {
  if (source.fingerprint == 0 || source.fingerprint == info.motion_facts.fingerprint) return;
  throw Error(ErrorCode::conflict,
              fmt::format("recording '{}' changed since this score was made; sign its utterance again", info.name));
}

}  // namespace

const TransitionMethod* method_with_needs(const std::vector<MotionClip>& clips, const TransitionMethod& of_all) {
  const TransitionMethod* found = nullptr;
  for (std::size_t i = 1; i < clips.size(); ++i) {
    const TransitionMethod* const own = clips[i].junction.method;
    const TransitionMethod& method = own != nullptr ? *own : of_all;
    if (method.fill->needs == Needs::spans) return &method;
    if (method.fill->needs == Needs::teaching) found = &method;
  }
  return found;
}

Declarations declarations_of(const Contents& contents, const std::vector<MotionClip>& clips) {
  Declarations declarations;
  for (const MotionClip& clip : clips) {
    if (!clip.recording.empty()) add_declarations(contents.at(clip.recording), declarations);
  }
  return declarations;
}

SignerRig signer_rig_of(const Snapshot& snapshot, const RecordingInfo& recording) {
  SignerModel signer = *snapshot.signer(recording);
  JointGroups groups = joint_groups(*snapshot.motion(recording)->skeleton(), signer.rig);
  return {std::move(signer), std::move(groups)};
}

void TimedSource::read(FrameRange frames, MutablePoses out) const {
  const auto start = Clock::now();
  source_->read(frames, out);
  spent_ += Clock::now() - start;
}

void TimedSource::read_tracks(FrameRange frames, std::span<const std::span<float>> out) const {
  const auto start = Clock::now();
  source_->read_tracks(frames, out);
  spent_ += Clock::now() - start;
}

OpenScore::OpenScore(const Database& database, Score score, const FindSource& others)
    : snapshot_(database.snapshot()), score_(std::move(score)) {
  check(score_, "score");
  const Contents& contents = snapshot_.contents();
  std::map<std::string, ScoreSource> sources;
  const auto find = [&](const SourceRef& source) {
    if (source.kind != SourceRef::Kind::recording) {
      if (others) return others(source);
      throw Error(ErrorCode::unsupported,
                  "score: it was made by a stream and has frames of no recording (kind 'rest' or 'shown'); sign its "
                  "utterance again");
    }
    const auto [at, is_new] = sources.try_emplace(source.recording);
    const RecordingInfo& info = contents.at(source.recording);
    require_unchanged(info, source);
    if (is_new) {
      at->second = {std::make_shared<TimedSource>(snapshot_.motion(info), reading_),
                    snapshot_.joins(static_cast<std::size_t>(&info - contents.recordings.data()))->noise};
    }
    return at->second;
  };
  const std::shared_ptr<const MotionSource> home = find(score_.skeleton).motion;
  clips_ = clips_of(score_, find);
  mirror_marked(clips_, snapshot_, notices_);
  put_on_skeleton(clips_, score_.skeleton.recording, *home, contents, notices_);
  rig_ = std::make_shared<const SignerRig>(signer_rig_of(snapshot_, contents.at(score_.skeleton.recording)));
  read_changed(clips_, rig_);
  if (const TransitionMethod* const asking = method_with_needs(clips_, transition_methods().front())) {
    captured_ = captured_spans(snapshot_, *home->skeleton(), rig_->groups, asking->fill->needs);
  }
  renderer_.emplace(plan_of(score_, clips_), JunctionSettings{.skeleton = home->skeleton(),
                                                              .rate = score_.rate,
                                                              .method = &transition_methods().front(),
                                                              .rig = rig_.get(),
                                                              .model = captured_.model.get()});
}

Synthesis OpenScore::synthesize(Synthesis used) {
  Synthesis out;
  out.motion = std::move(used.motion);
  out.sources = std::move(used.sources);
  signweave::render(score_, *renderer_, clips_, std::nullopt, out);
  out.notices = notices_;
  out.declarations = declarations();
  return out;
}

Declarations OpenScore::declarations() const {
  return declarations_of(snapshot_.contents(), clips_);
}

}  // namespace signweave
