#include "signweave/database/measure.h"

#include <fmt/format.h>

#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/database/movement.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/trace_store.h"

namespace signweave {
namespace {

RecordingFeatures nothing(const SegmentChunk& segments, std::string why_not) {
  RecordingFeatures features;
  features.why_not = std::move(why_not);
  features.phases.resize(semantic_db::phase_spans(segments).size());
  return features;
}

/// True if the features of this version are stored and sound, or there are no phases to measure.
bool has_features(const kv::ReadTransaction& snapshot, const RecordingInfo& info) {
  if (info.document == 0) return true;
  try {
    return semantic_db::read_features(snapshot, info.document, info.name).has_value();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    return false;
  }
}

Motion read_motion(const kv::ReadTransaction& snapshot, const RecordingInfo& info) {
  const motion_db::StoredMotion& stored = *info.motion;
  return motion_db::read(snapshot, stored, motion_db::read_skeleton(snapshot, stored), {0, stored.frames});
}

}  // namespace

RecordingFeatures measure_stored(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                                 const SegmentChunk& segments) {
  if (!info.motion) return nothing(segments, "annotation without motion");
  try {
    const Motion motion = read_motion(snapshot, info);
    RecordingFeatures features =
        measure_phases(motion, model_of(motion, info.rig), semantic_db::phase_spans(segments), info.clock);
    features.noise = capture_noise(motion);
    return features;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    return nothing(segments, error.what());
  }
}

std::string fault_of_features(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                              const SegmentChunk& segments) {
  const std::optional<RecordingFeatures> stored = semantic_db::read_features(snapshot, info.document, info.name);
  if (!stored || !info.motion) return {};
  const auto fault = [&](const std::string& what) {
    return fmt::format("{}: the stored features are not those of its {}; import it again, replacing its motion",
                       info.name, what);
  };
  const std::vector<TimeSpan> spans = semantic_db::phase_spans(segments);
  if (stored->phases.size() != spans.size()) return fault("segments");
  constexpr std::size_t kSample = 16;
  const Motion motion = read_motion(snapshot, info);
  const SignerModel model = model_of(motion, info.rig);
  const std::size_t step = std::max<std::size_t>(1, spans.size() / kSample);
  for (std::size_t i = 0; i < spans.size(); i += step) {
    const RecordingFeatures again = measure_phases(motion, model, std::span(spans).subspan(i, 1), info.clock);
    if (nearly_same(again.phases[0], stored->phases[i])) continue;
    return fault(fmt::format("motion (the phase from {} to {} ms)", spans[i].begin.count(), spans[i].end.count()));
  }
  return {};
}

RecordingFeatures Database::features(std::string_view name) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const RecordingInfo info = recording_in(*snapshot, name);
  if (info.document == 0) return nothing({}, "motion without annotation");
  if (auto stored = semantic_db::read_features(*snapshot, info.document, info.name)) return *std::move(stored);
  return measure_stored(*snapshot, info, semantic_db::read_segments(*snapshot, info.document, info.name));
}

bool Database::is_measured(std::string_view name) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  return has_features(*snapshot, recording_in(*snapshot, name));
}

bool Database::measure(std::string_view name) {
  require_writable();
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  const RecordingInfo info = recording_in(*transaction, name);
  if (has_features(*transaction, info)) return false;
  const SegmentChunk segments = semantic_db::read_segments(*transaction, info.document, info.name);
  semantic_db::put_features(*transaction, info.document, measure_stored(*transaction, info, segments));
  semantic_db::put_trace(*transaction, info.document, trace_stored(*transaction, info));
  transaction->commit();
  return true;
}

}  // namespace signweave
