#include <fmt/format.h>

#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/formats/eaf.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

/// Faults of one recording's document: that it is there, reads, and gives the segments that are stored beside it.
void check_document(const kv::ReadTransaction& snapshot, const RecordingInfo& info, std::vector<std::string>& faults) {
  const std::string source = semantic_db::read_document(snapshot, info.document, info.name);
  const SegmentChunk stored = semantic_db::read_segments(snapshot, info.document, info.name);
  const AnnotationDocument document = eaf::read_text(info.annotation_file, source).document;
  const SegmentChunk made = segments_of(document, signs_in(document, info.tiers).signs);
  ByteWriter stored_bytes;
  ByteWriter made_bytes;
  encode(stored, stored_bytes);
  encode(made, made_bytes);
  if (stored_bytes.bytes() != made_bytes.bytes()) {
    faults.push_back(
        fmt::format("{}: the stored segments are not those of the stored annotation; import it again", info.name));
  }
}

}  // namespace

std::vector<std::string> Database::check(const Progress& progress) const {
  std::vector<std::string> faults;
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const catalogue::Head head = catalogue::read_head(*snapshot);
  for (std::uint32_t slot = 0; slot < head.recordings; ++slot) {
    if (progress) progress(static_cast<double>(slot) / head.recordings);
    try {
      const RecordingInfo info = catalogue::read_recording(*snapshot, slot);
      if (info.motion) {
        for (const std::string& fault : motion_db::check(*snapshot, *info.motion)) {
          faults.push_back(info.name + ": " + fault);
        }
      }
      if (info.document != 0) check_document(*snapshot, info, faults);
    } catch (const Error& error) {  // one damaged recording does not hide the others
      faults.emplace_back(error.what());
    }
  }
  return faults;
}

}  // namespace signweave
