// The body of a recording's signer, measured once until the database changes.
#include "signweave/database/database.h"
#include "signweave/features/from_source.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/retarget/mirroring.h"
#include "signweave/retarget/recorded_body.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

/// What was measured of a recording, kept until the database changes. `kept_in` returns the measures of a database by
/// generation; `make` measures a motion.
template <typename Measured, typename KeptIn, typename Make>
std::shared_ptr<const Measured> Snapshot::measured_once(const RecordingInfo& recording, KeptIn kept_in,
                                                        Make make) const {
  const Database& database = *database_;
  auto& kept = kept_in(database);
  if (recording.motion) {
    const std::lock_guard guard(database.mutex_);
    const auto at = kept.find(recording.motion->generation);
    if (database.contents_ == contents_ && at != kept.end()) return at->second;
  }
  auto made = std::make_shared<const Measured>(make(*motion(recording)));
  const std::lock_guard guard(database.mutex_);
  if (database.contents_ == contents_) kept[recording.motion->generation] = made;
  return made;
}

std::shared_ptr<const std::vector<AnnotatedLocus>> Snapshot::loci(std::size_t recording) const {
  const Database& database = *database_;
  {
    const std::lock_guard guard(database.mutex_);
    const auto at = database.kept_.loci.find(recording);
    if (database.contents_ == contents_ && at != database.kept_.loci.end()) return at->second;
  }
  const RecordingInfo& info = contents_->recordings[recording];
  std::vector<AnnotatedLocus> found;
  if (info.document != 0) {
    const std::string source = semantic_db::read_document(*transaction_, info.document, info.name);
    found = loci_in(annotation_file::read_text(info.annotation_file.empty() ? info.name : info.annotation_file, source,
                                               semantic_db::read_specification(*transaction_, info.document, info.name))
                        .document);
  }
  auto made = std::make_shared<const std::vector<AnnotatedLocus>>(std::move(found));
  const std::lock_guard guard(database.mutex_);
  if (database.contents_ == contents_) database.kept_.loci[recording] = made;
  return made;
}

std::shared_ptr<const SignerModel> Snapshot::signer(const RecordingInfo& recording) const {
  return measured_once<SignerModel>(
      recording, [](const Database& database) -> auto& { return database.kept_.signers; },
      [&](const MotionSource& motion) { return model_of(motion, recording.rig); });
}

std::shared_ptr<const Mirroring> Snapshot::mirroring(const RecordingInfo& recording) const {
  return measured_once<Mirroring>(
      recording, [](const Database& database) -> auto& { return database.kept_.mirrorings; },
      [&](const MotionSource& motion) { return mirroring_of(recorded_body(recording.name, motion, recording.rig)); });
}

}  // namespace signweave
