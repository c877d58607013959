#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "signweave/query/movement.h"
#include "signweave/rig/test_rig.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// A person who moves by chance, as a motion with its rig and body.
struct TestMotion {
  Motion motion;
  SignerModel model;
  FrameClock clock;

  explicit TestMotion(std::int64_t frames, unsigned seed, FrameRate rate = {60, 1})
      : motion(moving(whole_person(), frames, seed, rate)), model{.rig = rig_of_signer(motion.skeleton()), .body = {}} {
    model.body = signer_body(motion, model.rig);
    clock.frame_time = rate.frame_time();
  }
};

/// Movement in memory, measured by what measures what is stored.
class TestMovement : public Movement {
 public:
  enum class From { columns, frames };
  explicit TestMovement(From from = From::columns) : from_(from) {}

  /// The next recording and its rows.
  void add(TestMotion motion, const std::vector<MovementRow>& rows, const RecordingFeatures& features = {}) {
    recordings_.push_back({std::move(motion), nullptr, {}});
    Recording& recording = recordings_.back();
    recording.trace = std::make_shared<const HandTrace>(trace_hands(recording.motion.motion, recording.motion.model));
    recording.columns = measure_rows(rows, features, *recording.trace, recording.motion.clock);
  }
  /// One number of one row of the first recording.
  float& at(Column column, RowId row) { return recordings_.front().columns[place_of(column)][row]; }

  ColumnValues column(Column column, std::uint32_t recording) const override {
    if (from_ == From::frames) return {};
    return {recordings_[recording].columns[place_of(column)], nullptr};
  }
  float shoulder_width(std::uint32_t recording) const override { return recordings_[recording].trace->shoulder_width; }
  FrameClock clock(std::uint32_t recording) const override { return recordings_[recording].motion.clock; }
  std::shared_ptr<const HandTrace> hands(std::uint32_t recording) const override {
    return recordings_[recording].trace;
  }
  std::vector<PointTrack> points(std::uint32_t recording, std::span<const Part> parts,
                                 FrameRange range) const override {
    const TestMotion& motion = recordings_[recording].motion;
    return track_points(motion.motion, motion.model, parts, range);
  }

 private:
  struct Recording {
    TestMotion motion;
    std::shared_ptr<const HandTrace> trace;
    MovementColumns columns;
  };
  From from_;
  std::vector<Recording> recordings_;
};

/// Two persons who move by chance, one in each recording of `weather_corpus`: so every example in docs/query.md about
/// movement has an answer.
inline std::unique_ptr<TestMovement> weather_movement(const Segments& segments) {
  auto movement = std::make_unique<TestMovement>();
  for (std::uint32_t recording = 0; recording < segments.recording_count(); ++recording) {
    const SegmentTable::RowRange range = segments.recording_rows(recording);
    std::vector<MovementRow> rows;
    for (RowId row = range.begin; row < range.end; ++row) {
      const RowId parent = segments.parent(row);
      rows.push_back({.kind = segments.kind(row) == RowKind::unit ? RowKind::annotation : segments.kind(row),
                      .phase = segments.phase(row),
                      .parent = range.contains(parent) ? parent - range.begin : kNoRow,
                      .span = segments.span(row)});
    }
    movement->add(TestMotion(600, 21 + recording), rows);
  }
  return movement;
}

}  // namespace signweave
