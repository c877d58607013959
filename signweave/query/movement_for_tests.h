#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "signweave/query/movement.h"
#include "signweave/rig/test_rig.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// Gives a motion a face that repeatedly opens the mouth and raises the brows, and never puffs the cheeks: that track
/// is omitted, as `face_csv::resampled` does.
inline void add_face(Motion& motion, unsigned seed) {
  ScalarTrack jaw{.name = "jawOpen", .values = {}};
  ScalarTrack brows{.name = "browInnerUp", .values = {}};
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const auto at = static_cast<float>(frame) + static_cast<float>(seed);
    jaw.values.push_back(0.5f + 0.5f * std::sin(0.13f * at));
    brows.values.push_back(std::max(0.0f, std::sin(0.05f * at)));
  }
  motion.add_track(std::move(jaw));
  motion.add_track(std::move(brows));
}

/// A randomly moving person, as a motion with its rig and body.
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

/// Movement in memory, measured by the code that measures what is stored.
class TestMovement : public Movement {
 public:
  enum class From { columns, frames };
  explicit TestMovement(From from = From::columns) : from_(from) {}

  /// Adds the next recording with its rows.
  void add(TestMotion motion, const std::vector<MovementRow>& rows, const RecordingFeatures& features = {}) {
    recordings_.push_back({.motion = std::move(motion)});
    TestRecording& recording = recordings_.back();
    recording.trace = std::make_shared<const HandTrace>(trace_hands(recording.motion.motion, recording.motion.model));
    recording.columns = measure_rows(rows, features, *recording.trace, recording.motion.clock);
    recording.source = std::make_unique<MemorySource>(recording.motion.motion);
    recording.eyes = gaze_source(*recording.source, recording.motion.model.rig);
  }
  /// Number of reads of track values.
  std::size_t track_reads() const noexcept { return track_reads_; }
  /// One value of one row of the first recording.
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
  std::int64_t frame_count(std::uint32_t recording) const override {
    return recordings_[recording].motion.motion.frame_count();
  }
  std::vector<float> track(std::uint32_t recording, std::string_view name, FrameRange frames) const override {
    ++track_reads_;
    const std::vector<ScalarTrack>& tracks = recordings_[recording].motion.motion.tracks();
    const auto at = std::ranges::find(tracks, name, &ScalarTrack::name);
    if (at != tracks.end()) return {at->values.begin() + frames.begin, at->values.begin() + frames.end};
    const bool at_rest = !tracks.empty() && name == "cheekPuff";
    return std::vector<float>(at_rest ? static_cast<std::size_t>(frames.size()) : 0);
  }
  std::vector<Gaze> gaze(std::uint32_t recording, FrameRange frames) const override {
    const TestRecording& from = recordings_[recording];
    return from.eyes ? gaze_over(*from.source, *from.eyes, frames) : std::vector<Gaze>();
  }
  bool has_track(std::string_view name) const override {
    const std::vector<std::string> known = tracks();
    return std::ranges::find(known, name) != known.end();
  }
  std::vector<std::string> tracks() const override {
    std::set<std::string> names;
    for (const TestRecording& recording : recordings_) {
      for (const ScalarTrack& track : recording.motion.motion.tracks()) names.insert({track.name, "cheekPuff"});
    }
    return {names.begin(), names.end()};
  }

 private:
  struct TestRecording {
    TestMotion motion;
    std::shared_ptr<const HandTrace> trace;
    MovementColumns columns;
    std::unique_ptr<MemorySource> source;
    std::optional<GazeSource> eyes;
  };
  From from_;
  mutable std::size_t track_reads_ = 0;
  std::vector<TestRecording> recordings_;
};

/// Two randomly moving persons, one in each recording of `weather_corpus`, the second with a face, so every example in
/// docs/query.md about movement has an answer.
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
    TestMotion motion(600, 21 + recording);
    if (recording == 1) add_face(motion.motion, 3);
    movement->add(std::move(motion), rows);
  }
  return movement;
}

}  // namespace signweave
