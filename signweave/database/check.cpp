#include "signweave/database/check.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/database/catalogue.h"
#include "signweave/database/check_listener.h"
#include "signweave/database/learn.h"
#include "signweave/database/measure.h"
#include "signweave/database/tables.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/table_store.h"
#include "signweave/semantic_db/trace_store.h"

namespace signweave {
namespace {

/// Checks one recording's document: it exists and is readable (else this throws), the stored segments are those of the
/// document, and the stored features are those of motion and segments.
void check_document(const kv::ReadTransaction& snapshot, const RecordingInfo& info, bool motion_sound,
                    CheckListener& listener) {
  const std::string source = semantic_db::read_document(snapshot, info.document, info.name);
  const SegmentChunk stored = semantic_db::read_segments(snapshot, info.document, info.name);
  if (const std::string fault = semantic_db::fault_of_document(snapshot, info.document, info.name); !fault.empty()) {
    listener.fault(fault);
  }
  const std::string specification = semantic_db::read_specification(snapshot, info.document, info.name);
  const AnnotationDocument document = annotation_file::read_text(info.annotation_file, source, specification).document;
  const SegmentChunk made = segments_of(document, signs_in(document, info.tiers).signs);
  ByteWriter stored_bytes;
  ByteWriter made_bytes;
  encode(stored, stored_bytes);
  encode(made, made_bytes);
  if (stored_bytes.bytes() != made_bytes.bytes()) {
    listener.fault(
        fmt::format("{}: the stored segments are not those of the stored annotation; import it again", info.name));
    return;
  }
  const std::optional<HandTrace> trace = semantic_db::read_trace(snapshot, info.document, info.name);
  if (trace && info.motion && trace->samples() > 0 && trace->frames != info.motion->frames) {
    listener.fault(
        fmt::format("{}: the stored trace of the hands is not that of its motion; import it again, "
                    "replacing its motion",
                    info.name));
  }
  if (!motion_sound) return;  // features measured from a damaged motion prove nothing
  const std::string fault = fault_of_features(snapshot, info, stored);
  if (!fault.empty()) listener.fault(fault);
}

/// Checks that learning from the corpus gives the stored record again. Not compared if a recording is damaged.
void check_learned(const Database& database, const kv::ReadTransaction& snapshot, CheckListener& listener) {
  const char* repair = "signing learns it again; import any file again to store it";
  try {
    const std::optional<semantic_db::Learned> stored = semantic_db::read_learned(snapshot);
    if (!stored || stored->changes != catalogue::read_head(snapshot).changes) return;
    const Snapshot now = database.snapshot();
    if (!now.contents().faults.empty() || nearly_same(*stored, learn_from(now))) return;
    listener.fault(fmt::format("what was learned: it does not match the recordings; {}", repair));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    listener.fault(fmt::format("what was learned: the stored record is damaged; {}", repair));
  }
}

/// Checks that the segment tables contain the recordings' own segments.
void check_tables(const std::shared_ptr<const kv::ReadTransaction>& snapshot, CheckListener& listener) {
  const auto fault = [&](std::string_view what) {
    listener.fault(fmt::format("segment tables: {}; the next import or removal rebuilds them", what));
  };
  try {
    const std::optional<Segments> stored = semantic_db::read_tables(snapshot);
    std::vector<std::string> faults;
    const Segments made(tables::table_of_all(*snapshot, faults));
    if (!stored || !faults.empty()) return;  // no tables yet, or the damage is already reported
    const auto whole = [](const Segments& segments) {
      std::vector<SegmentTable::RecordingRef> parts;
      for (std::uint32_t i = 0; i < segments.recording_count(); ++i) parts.push_back(segments.part(i));
      return SegmentTable::merged(parts);
    };
    const SegmentTable one = whole(*stored);
    const SegmentTable other = whole(made);
    if (!std::ranges::equal(one.bytes(), other.bytes())) fault("they differ from the recordings' segments");
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    fault("a stored record is damaged");
  }
}

class Collect : public CheckListener {
 public:
  explicit Collect(const Database::Progress& progress) : progress_(progress) {}

  void begin(std::uint32_t recordings) override { result_.recordings = recordings; }
  void slot(std::uint32_t number, const std::string&) override {
    if (progress_) progress_(static_cast<double>(number) / result_.recordings);
  }
  void alive() override {}
  void fault(const std::string& text) override { result_.faults.push_back(text); }
  CheckResult take() { return std::move(result_); }

 private:
  const Database::Progress& progress_;
  CheckResult result_;
};

}  // namespace

void check_slots(const Database& database, std::uint32_t first, CheckListener& listener) {
  const std::shared_ptr<const kv::ReadTransaction> snapshot = database.store_->read();
  const std::uint32_t recordings = catalogue::read_head(*snapshot).recordings;
  listener.begin(recordings);
  for (std::uint32_t slot = first; slot < recordings; ++slot) {
    listener.slot(slot, fmt::format("catalogue entry {}", slot));
    try {
      const RecordingInfo info = catalogue::read_recording(*snapshot, slot);
      listener.slot(slot, info.name);
      bool motion_sound = true;
      if (info.motion) {
        for (const std::string& fault : motion_db::check(*snapshot, *info.motion, [&] { listener.alive(); })) {
          listener.fault(info.name + ": " + fault);
          motion_sound = false;
        }
      }
      if (info.document != 0) check_document(*snapshot, info, motion_sound, listener);
    } catch (const Error& error) {  // continue with the other recordings
      listener.fault(error.what());
    }
  }
  check_tables(snapshot, listener);
  check_learned(database, *snapshot, listener);
  try {
    catalogue::read_sweep_list(*snapshot);
  } catch (const Error&) {
    listener.fault("sweep list: it is damaged; no recording needs it, and opening the database for writing repairs it");
  }
}

CheckResult check(const Database& database, const Database::Progress& progress) {
  Collect collect(progress);
  check_slots(database, 0, collect);
  return collect.take();
}

}  // namespace signweave
