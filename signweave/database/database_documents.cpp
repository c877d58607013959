#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/semantic_db/documents.h"
#include "signweave/xpath/evaluate.h"

// Queries of the annotation documents themselves, and how a database stores them.

namespace signweave {
namespace {

std::uint64_t document_of(const RecordingInfo& info) {
  if (info.document != 0) return info.document;
  throw Error(ErrorCode::not_found,
              fmt::format("recording '{}' has no annotation; import its annotation file too", printable(info.name)));
}

std::vector<xpath::Value> values_in(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                                    const xpath::Expression& expression, const xpath::EvaluateLimits& limits) {
  const std::string name = info.annotation_file.empty() ? info.name : info.annotation_file;
  if (expression.excerpt()) {
    const std::optional<std::string> part = semantic_db::read_excerpt(
        snapshot, info.document, expression.excerpt()->what, expression.excerpt()->name, info.name);
    if (part) return xpath::evaluate(expression, name, *part, limits);
  }
  return xpath::evaluate(expression, name, semantic_db::read_document(snapshot, info.document, info.name), limits);
}

}  // namespace

std::optional<StoredAnnotation> Database::annotation(std::string_view recording, std::string_view id) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const RecordingInfo info = recording_in(*snapshot, recording);
  return semantic_db::read_annotation(*snapshot, document_of(info), id, info.name);
}

std::vector<StoredAnnotation> Database::tier(std::string_view recording, std::string_view tier) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const RecordingInfo info = recording_in(*snapshot, recording);
  return semantic_db::read_tier(*snapshot, document_of(info), tier, info.name);
}

std::vector<XPathAnswer> Database::xpath(const xpath::Expression& expression, const XPathLimits& limits) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  std::vector<RecordingInfo> recordings;
  if (limits.recordings.empty()) {
    const std::uint32_t count = catalogue::read_head(*snapshot).recordings;
    for (std::uint32_t slot = 0; slot < count; ++slot) {
      try {
        RecordingInfo info = catalogue::read_recording(*snapshot, slot);
        if (info.document != 0) recordings.push_back(std::move(info));
      } catch (const Error& error) {  // a damaged entry: `check` reports it
        if (error.code() != ErrorCode::corrupt) throw;
      }
    }
  } else {
    for (const std::string& name : limits.recordings) {
      recordings.push_back(recording_in(*snapshot, name));
      document_of(recordings.back());
    }
  }
  std::ranges::sort(recordings, {}, &RecordingInfo::name);
  std::vector<XPathAnswer> answers;
  for (const RecordingInfo& info : recordings) {
    xpath::EvaluateLimits rest{.limit = limits.limit, .deadline = limits.deadline};
    if (rest.limit) *rest.limit -= answers.size();
    if (rest.limit == 0) break;
    for (xpath::Value& value : values_in(*snapshot, info, expression, rest)) {
      answers.push_back({info.name, std::move(value)});
    }
  }
  return answers;
}

bool Database::relayout_document(std::string_view name, DocumentStorage storage) {
  require_writable();
  // One transaction: a crash leaves the old records or the new. The content of the database stays the same, so this
  // does not count as a change.
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  const RecordingInfo info = recording_in(*transaction, name);
  if (info.document == 0 || semantic_db::storage_of(*transaction, info.document) == storage) return false;
  const std::string text = semantic_db::read_document(*transaction, info.document, info.name);
  const std::string specification = semantic_db::read_specification(*transaction, info.document, info.name);
  semantic_db::erase_document(*transaction, info.document);
  semantic_db::put_document(*transaction, info.document, text, specification, storage);
  if (semantic_db::read_document(*transaction, info.document, info.name) != text) {
    throw Error(ErrorCode::io, fmt::format("{}: the document does not read back as it was written; check memory and "
                                           "disk, and try again",
                                           printable(info.name)));
  }
  transaction->commit();
  return true;
}

std::optional<DocumentStorage> Database::document_storage(std::string_view name) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const RecordingInfo info = recording_in(*snapshot, name);
  if (info.document == 0) return std::nullopt;
  return semantic_db::storage_of(*snapshot, info.document);
}

DocumentStorage Database::document_storage() const {
  return catalogue::read_head(*store_->read()).documents;
}

void Database::set_document_storage(DocumentStorage storage) {
  require_writable();
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  catalogue::Head head = catalogue::read_head(*transaction);
  head.documents = storage;
  catalogue::write_head(*transaction, head);
  transaction->commit();
}

}  // namespace signweave
