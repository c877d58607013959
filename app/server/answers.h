#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/wire/fault.h"
#include "app/wire/prebuilt.h"
#include "signweave/annotation/declarations.h"
#include "signweave/calls/change_calls.h"
#include "signweave/calls/evaluation_answer.h"
#include "signweave/calls/import_call.h"
#include "signweave/calls/inspect_call.h"
#include "signweave/calls/synthesis_call.h"
#include "signweave/core/answer.h"

/// The answers that only the server gives, or that it extends: see core/answer.h.
namespace signweave::server {

inline AnswerField declarations_field() {
  return {.name = "declarations",
          .help = "what the recordings declare of themselves: show it together with the answer"};
}

struct DatabaseRow {
  std::string name;
  bool writable = false;
  std::size_t recordings = 0;
  Declarations declarations;
};
template <class Visit>
void fields(Visit& visit, const DatabaseRow& row) {
  visit.type("DatabaseRow");
  visit(AnswerField{.name = "name"}, row.name);
  visit(AnswerField{.name = "writable"}, row.writable);
  visit(AnswerField{.name = "recordings"}, row.recordings);
  visit(declarations_field(), row.declarations);
}
struct DatabasesAnswer {
  std::vector<DatabaseRow> databases;
};
template <class Visit>
void fields(Visit& visit, const DatabasesAnswer& answer) {
  visit.type("Databases");
  visit(AnswerField{.name = "databases"}, answer.databases);
}

/// A character that motion can be shown on.
struct CharacterRow {
  std::string name;
  std::string file;
  double height = 0;
  std::vector<std::string> face_units;
};
template <class Visit>
void fields(Visit& visit, const CharacterRow& row) {
  visit.type("CharacterRow");
  visit(AnswerField{.name = "name"}, row.name);
  visit(AnswerField{.name = "file"}, row.file);
  visit(AnswerField{.name = "height", .help = "metres"}, row.height);
  visit(AnswerField{.name = "face_units"}, row.face_units);
}
struct CharactersAnswer {
  std::vector<CharacterRow> characters;
};
template <class Visit>
void fields(Visit& visit, const CharactersAnswer& answer) {
  visit.type("Characters");
  visit(AnswerField{.name = "characters"}, answer.characters);
}

/// A video or sound that an annotation links.
struct MediaRow {
  std::string file;
  std::string mime;
  std::int64_t origin_ms = 0;
  OrNull<std::string> url;
};
template <class Visit>
void fields(Visit& visit, const MediaRow& row) {
  visit.type("MediaRow");
  visit(AnswerField{.name = "file", .help = "its plain name"}, row.file);
  visit(AnswerField{.name = "mime"}, row.mime);
  visit(AnswerField{.name = "origin_ms", .help = "time of the medium at annotation time 0"}, row.origin_ms);
  visit(AnswerField{.name = "url", .help = "null: the server does not have it"}, row.url);
}
struct MediaAnswer {
  std::vector<MediaRow> media;
};
template <class Visit>
void fields(Visit& visit, const MediaAnswer& answer) {
  visit.type("Media");
  visit(AnswerField{.name = "media"}, answer.media);
}

struct RenderedFile {
  std::string file;
  std::uint64_t bytes = 0;
};
template <class Visit>
void fields(Visit& visit, const RenderedFile& rendered) {
  visit.type("RenderedFile");
  visit(AnswerField{.name = "file"}, rendered.file);
  visit(AnswerField{.name = "bytes"}, rendered.bytes);
}

/// The report of a synthesis as the server gives it.
struct SynthesisReply {
  calls::SynthesisAnswer answer;
  Declarations declarations;
  std::vector<Notice> notices;
};
template <class Visit>
void fields(Visit& visit, const SynthesisReply& reply) {
  visit.type("Synthesis");
  answer_fields(visit, reply.answer);
  visit(declarations_field(), reply.declarations);
  visit(AnswerField{.name = "notices"}, reply.notices);
}

/// The report of an evaluation as the server gives it.
struct EvaluationReply {
  calls::EvaluationAnswer answer;
  std::string plot;
  Declarations declarations;
  std::vector<Notice> notices;
};
template <class Visit>
void fields(Visit& visit, const EvaluationReply& reply) {
  visit.type("Evaluation");
  evaluation_fields(visit, reply.answer);
  visit(AnswerField{.name = "plot", .help = "the summary with intervals, an SVG document"}, reply.plot);
  visit(declarations_field(), reply.declarations);
  visit(AnswerField{.name = "notices"}, reply.notices);
}

struct UploadedFileRow {
  std::string file;
  std::uint64_t bytes = 0;
};
template <class Visit>
void fields(Visit& visit, const UploadedFileRow& row) {
  visit(AnswerField{.name = "file"}, row.file);
  visit(AnswerField{.name = "bytes"}, row.bytes);
}
struct UploadAnswer {
  std::string upload;
  std::vector<UploadedFileRow> files;
};
template <class Visit>
void fields(Visit& visit, const UploadAnswer& answer) {
  visit.type("Upload");
  visit(AnswerField{.name = "upload"}, answer.upload);
  visit(AnswerField{.name = "files"}, answer.files);
}
struct UploadedFile {
  std::string file;
  std::uint64_t bytes = 0;
  std::uint64_t upload_bytes = 0;
};
template <class Visit>
void fields(Visit& visit, const UploadedFile& file) {
  visit.type("UploadedFile");
  visit(AnswerField{.name = "file"}, file.file);
  visit(AnswerField{.name = "bytes"}, file.bytes);
  visit(AnswerField{.name = "upload_bytes", .help = "of all files of the upload"}, file.upload_bytes);
}
struct Discarded {
  std::string upload;
};
template <class Visit>
void fields(Visit& visit, const Discarded& discarded) {
  visit.type("Discarded");
  visit(AnswerField{.name = "discarded"}, discarded.upload);
}

struct JobBegun {
  std::string job;
};
template <class Visit>
void fields(Visit& visit, const JobBegun& begun) {
  visit.type("JobBegun");
  visit(AnswerField{.name = "job"}, begun.job);
}

/// A recording that a job imported, with what it declares.
struct ImportedReply {
  calls::Imported imported;
  Declarations declarations;
};
template <class Visit>
void fields(Visit& visit, const ImportedReply& reply) {
  fields(visit, reply.imported);
  visit.type("ImportedReply");
  visit(declarations_field(), reply.declarations);
}

/// What a job has done so far with the files of an upload.
template <class Recording>
struct FilesResult {
  std::vector<Recording> recordings;
  std::vector<Notice> notices;
  std::vector<std::string> faults;
};
template <class Visit, class Recording>
void fields(Visit& visit, const FilesResult<Recording>& result) {
  visit.type(std::is_same_v<Recording, ImportedReply> ? "ImportResult" : "InspectResult");
  visit(AnswerField{.name = "recordings"}, result.recordings);
  visit(AnswerField{.name = "notices"}, result.notices);
  visit(AnswerField{.name = "faults"}, result.faults);
}
using ImportResult = FilesResult<ImportedReply>;
using InspectResult = FilesResult<calls::Inspected>;

/// What a job has stored again so far.
struct RelayoutResult {
  std::size_t recordings = 0;
  std::vector<std::string> changed;
  std::vector<std::string> faults;
};
template <class Visit>
void fields(Visit& visit, const RelayoutResult& result) {
  visit.type("RelayoutResult");
  visit(AnswerField{.name = "recordings", .help = "how many are to be stored again"}, result.recordings);
  visit(AnswerField{.name = "changed", .help = "the names of those that were"}, result.changed);
  visit(AnswerField{.name = "faults"}, result.faults);
}

struct JobAnswer {
  std::string job;
  std::string kind;
  std::string database;
  std::string_view state;
  double fraction = 0;
  std::optional<wire::Prebuilt<ImportResult, InspectResult, RelayoutResult, EvaluationReply>> result;
  std::optional<wire::Prebuilt<wire::FaultAnswer>> error;
};
template <class Visit>
void fields(Visit& visit, const JobAnswer& job) {
  visit.type("Job");
  visit(AnswerField{.name = "job"}, job.job);
  visit(AnswerField{.name = "kind", .one_of = {"inspect", "import", "relayout", "evaluate"}}, job.kind);
  visit(AnswerField{.name = "database"}, job.database);
  visit(AnswerField{.name = "state", .one_of = {"waiting", "running", "done", "failed", "cancelled"}}, job.state);
  visit(AnswerField{.name = "fraction", .minimum = 0, .maximum = 1}, job.fraction);
  visit(AnswerField{.name = "result", .help = "as far as the job is"}, job.result);
  visit(AnswerField{.name = "error"}, job.error);
}
struct JobsAnswer {
  std::vector<JobAnswer> jobs;
};
template <class Visit>
void fields(Visit& visit, const JobsAnswer& answer) {
  visit.type("Jobs");
  visit(AnswerField{.name = "jobs", .help = "without their results"}, answer.jobs);
}

}  // namespace signweave::server
