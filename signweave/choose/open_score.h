#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/choose/captured_spans.h"
#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/render/render.h"
#include "signweave/score/result.h"

namespace signweave {

/// The first method of a junction that needs something of the corpus, captured spans before all; or null.
const TransitionMethod* method_with_needs(const std::vector<MotionClip>& clips, const TransitionMethod& of_all);

/// What the documents of the clips' recordings declare of themselves.
std::vector<std::pair<std::string, std::string>> declarations_of(const Contents& contents,
                                                                 const std::vector<MotionClip>& clips);

/// Of the signer of a recording, whose motion is measured once as long as nothing in the database changes.
SignerRig signer_rig_of(const Snapshot& snapshot, const RecordingInfo& recording);

/// Measures how long reading takes: the column "retrieval" of Table 1.
class TimedSource final : public MotionSource {
 public:
  /// Adds to `spent`, which must outlive it.
  TimedSource(std::unique_ptr<MotionSource> source, Seconds& spent) : source_(std::move(source)), spent_(spent) {}

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return source_->skeleton(); }
  FrameRate rate() const noexcept override { return source_->rate(); }
  std::int64_t frame_count() const noexcept override { return source_->frame_count(); }
  std::span<const std::string> tracks() const noexcept override { return source_->tracks(); }
  void read(FrameRange frames, MutablePoses out) const override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override;

 private:
  std::unique_ptr<MotionSource> source_;
  Seconds& spent_;
};

/// A score of a database's recordings, ready to be rendered: the whole of it, or any frames, in any order, any number
/// of times. Nothing is chosen: its frames are those that it had when it was made, as long as what the corpus teaches
/// its transitions stays the same. It sees the database as it was when it was opened. Belongs to one thread.
class OpenScore {
 public:
  /// The database must outlive it. `others`: gives the frames of clips of another kind than SourceRef::Kind::recording,
  /// as a score of a stream has them. Throws as `check` of a score and `plan_of` do, Error{not_found} for a recording
  /// that is not there, Error{conflict} for one that changed since, Error{unsupported} where `others` is missing.
  OpenScore(const Database& database, Score score, const FindSource& others = {});
  OpenScore(const OpenScore&) = delete;
  OpenScore& operator=(const OpenScore&) = delete;

  const Score& score() const noexcept { return score_; }
  const std::shared_ptr<const Contents>& contents() const noexcept { return snapshot_.shared_contents(); }
  const std::vector<Notice>& notices() const noexcept { return notices_; }
  /// As Synthesis::declarations.
  std::vector<std::pair<std::string, std::string>> declarations() const;
  /// Seconds spent reading so far.
  Seconds reading() const noexcept { return reading_; }

  /// As Renderer::render.
  void render(FrameRange frames, Motion& out) { renderer_->render(frames, out); }
  /// All of it, with what is reported of it. The memory of `used` is used again. Throws Error{corrupt}.
  Synthesis synthesize(Synthesis used = {});

 private:
  Snapshot snapshot_;
  Score score_;
  Seconds reading_{0};
  std::vector<MotionClip> clips_;
  std::vector<Notice> notices_;
  SignerRig rig_;
  CapturedSpans captured_;
  std::optional<Renderer> renderer_;  ///< never empty; refers to what comes before it
};

}  // namespace signweave
