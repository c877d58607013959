#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/choose/captured_spans.h"
#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/render/render.h"
#include "signweave/score/result.h"

namespace signweave {

/// The first junction's method that needs data from the corpus, preferably one that needs captured spans; or null.
const TransitionMethod* method_with_needs(const std::vector<MotionClip>& clips, const TransitionMethod& of_all);

/// The declarations of the documents of the clips' recordings.
Declarations declarations_of(const Contents& contents, const std::vector<MotionClip>& clips);

/// The rig of a recording's signer. The motion is measured once as long as the database does not change.
SignerRig signer_rig_of(const Snapshot& snapshot, const RecordingInfo& recording);

/// Measures the time spent reading: the column "retrieval" of Table 1.
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

/// A score of a database's recordings, ready to be rendered: all of it or any frames, in any order, any number of
/// times. Nothing is chosen: the frames are those of the score's creation, as long as the data that transitions learn
/// from the corpus is unchanged. It sees the database as it was when opened. Used by one thread.
class OpenScore {
 public:
  /// The database must outlive it. `others` provides the frames of clips of other kinds than
  /// SourceRef::Kind::recording, which occur in scores of streams. Throws as `check` of a score and `plan_of` do;
  /// Error{not_found} for a missing recording, Error{conflict} for one that changed since, Error{unsupported} if
  /// `others` is needed but not given.
  OpenScore(const Database& database, Score score, const FindSource& others = {});
  OpenScore(const OpenScore&) = delete;
  OpenScore& operator=(const OpenScore&) = delete;

  const Score& score() const noexcept { return score_; }
  const std::shared_ptr<const Contents>& contents() const noexcept { return snapshot_.shared_contents(); }
  const std::vector<Notice>& notices() const noexcept { return notices_; }
  /// As Synthesis::declarations.
  Declarations declarations() const;
  /// Seconds spent reading so far.
  Seconds reading() const noexcept { return reading_; }

  /// As Renderer::render.
  void render(FrameRange frames, Motion& out) { renderer_->render(frames, out); }
  /// Renders all of it, with its notices. The memory of `used` is reused. Throws Error{corrupt}.
  Synthesis synthesize(Synthesis used = {});

 private:
  Snapshot snapshot_;
  Score score_;
  Seconds reading_{0};
  std::vector<MotionClip> clips_;
  std::vector<Notice> notices_;
  std::shared_ptr<const SignerRig> rig_;
  CapturedSpans captured_;
  std::optional<Renderer> renderer_;  ///< never empty; refers to the members above
};

}  // namespace signweave
