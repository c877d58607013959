#include "app/server/answers.h"
#include "app/server/routes.h"
#include "app/server/upload_files.h"
#include "signweave/calls/import_call.h"
#include "signweave/calls/inspect_call.h"

namespace signweave::server {
namespace {

using nlohmann::json;

/// Reads the state of a job.
struct JobCall {
  std::string job;
  std::size_t from = 0;
};

template <class Visit>
void fields(Visit& visit, JobCall& call) {
  visit(calls::Field{.name = "job", .help = "the id returned by the call that began the job", .required = true},
        call.job);
  visit(calls::Field{.name = "from",
                     .help = "index of the first entry to return of the result's list of recordings, counted from "
                             "0; for clients that already have the earlier ones",
                     .range = calls::Range{std::int64_t{0}, std::int64_t{1'000'000'000}}},
        call.from);
}

/// Reports the progress of a job over the files of an upload: each recording as soon as it is finished.
class JobReport {
 public:
  JobReport(const Pairing& pairing, std::string folder, JobContext& job) : folder_(std::move(folder)), job_(job) {
    const ImportResult result{.recordings = {}, .notices = pairing.notices, .faults = {}};
    job_.report(without_folder(answer_json<json>(result), folder_));
  }
  void add(json recording) { job_.add("recordings", without_folder(std::move(recording), folder_)); }
  calls::Listener listener() {
    return {.notice = {},
            .fault = [this](const std::string& line,
                            const Remedies&) { job_.add("faults", without_folder(line, folder_)); },
            .stage = {},
            .progress = [this](double fraction) { job_.advance(fraction); }};
  }

 private:
  std::string folder_;
  JobContext& job_;
};

/// Runs an import; false if a recording failed.
bool import_files(Database& database, const Pairing& pairing, const ImportOptions& options, const std::string& folder,
                  JobContext& job) {
  JobReport report(pairing, folder, job);
  const calls::Listener listener = report.listener();
  bool good = true;
  calls::run(database, pairing, options, listener, [&](const calls::Imported& imported) {
    if (imported.error) good = false;
    const std::optional<RecordingInfo> info = database.info(imported.name);
    report.add(answer_json<json>(ImportedReply{imported, info ? info->declarations : Declarations()}));
  });
  calls::learn(database, listener);
  return good;
}

/// An upload that a job reads; it cannot be changed meanwhile.
struct HeldUpload {
  std::filesystem::path folder;
  ImportOptions options;
  Pairing pairing;
};

/// Expects checked fields. Releases the upload if it throws.
HeldUpload hold_upload(Call& call, calls::ImportCall parameters) {
  const std::string& upload = call.names.at("upload");
  Uploads& uploads = call.state.uploads;
  HeldUpload held{.folder = uploads.hold(call.database().name(), upload), .options = {}, .pairing = {}};
  try {
    const ResolveFiles resolve_files{held.folder};
    fields(resolve_files, parameters);
    held.options = calls::options_of(parameters);
    // A table received over the network may only name files of the upload.
    held.pairing = calls::pairing_of(
        parameters, parameters.pairs.empty() ? std::vector{held.folder} : std::vector<std::filesystem::path>{}, true);
    if (held.pairing.jobs.empty()) throw Error(ErrorCode::bad_input, "the upload has no motion or annotation file");
    return held;
  } catch (...) {
    uploads.release(upload, false);
    throw;
  }
}

}  // namespace

wire::SchemaWriter import_fields() {
  return wire::schema_of_call<calls::ImportCall>();
}

wire::SchemaWriter job_fields() {
  return wire::schema_of_call<JobCall>();
}

ApiResponse open_upload(Call& call) {
  const std::string id = call.state.uploads.open(call.database().name());
  return json_answer(answer_json<json>(call.state.uploads.describe(call.database().name(), id)), 201);
}

ApiResponse show_upload(Call& call) {
  return json_answer(answer_json<json>(call.state.uploads.describe(call.database().name(), call.names.at("upload"))));
}

ApiResponse discard_upload(Call& call) {
  call.state.uploads.discard(call.database().name(), call.names.at("upload"));
  return json_answer(answer_json(Discarded{call.names.at("upload")}));
}

void require_upload(const Call& call) {
  call.state.uploads.require_open(call.database().name(), call.names.at("upload"), call.names.at("file"));
}

ApiResponse remove_file(Call& call) {
  Uploads& uploads = call.state.uploads;
  uploads.take_away(call.database().name(), call.names.at("upload"), call.names.at("file"));
  return json_answer(answer_json<json>(uploads.describe(call.database().name(), call.names.at("upload"))));
}

ApiResponse put_file(Call& call) {
  return json_answer(
      answer_json<json>(call.state.uploads.put(call.database().name(), call.names.at("upload"), call.names.at("file"),
                                               call.request.body_file, call.request.body)));
}

ApiResponse import_upload(Call& call) {
  const auto parameters = read_parameters<calls::ImportCall>(call);
  ServedDatabase& served = call.database();
  const std::string upload = call.names.at("upload");
  Uploads& uploads = call.state.uploads;
  const HeldUpload held = hold_upload(call, parameters);
  const bool some = !parameters.recordings.empty();  // the others may be needed later
  try {
    const std::string id = call.state.jobs.start(
        {.name = "import"}, served.name(), [&served, &uploads, upload, held, some](JobContext& job) {
          bool good = false;
          try {
            served.change([&](Database& database) {
              good = import_files(database, held.pairing, held.options, held.folder.string() + "/", job);
            });
          } catch (...) {  // it may be tried again with other parameters
            uploads.release(upload, false);
            throw;
          }
          uploads.release(upload, !some && good);
          return json();  // the result is what was reported
        });
    return json_answer(answer_json(JobBegun{id}), 202);
  } catch (...) {
    uploads.release(upload, false);
    throw;
  }
}

ApiResponse inspect_upload(Call& call) {
  const auto parameters = read_parameters<calls::ImportCall>(call);
  ServedDatabase& served = call.database();
  const std::string upload = call.names.at("upload");
  Uploads& uploads = call.state.uploads;
  const HeldUpload held = hold_upload(call, parameters);
  try {
    const std::string id = call.state.jobs.start(
        {.name = "inspect", .changes = false}, served.name(), [&served, &uploads, upload, held](JobContext& job) {
          try {
            JobReport report(held.pairing, held.folder.string() + "/", job);
            calls::inspect(served.database(), held.pairing, held.options, held.folder.string() + ".inspected",
                           report.listener(), [&](const calls::Inspected& one) { report.add(answer_json<json>(one)); });
            uploads.release(upload, false);
            return json();  // the result is what was reported
          } catch (...) {
            uploads.release(upload, false);
            throw;
          }
        });
    return json_answer(answer_json(JobBegun{id}), 202);
  } catch (...) {
    uploads.release(upload, false);
    throw;
  }
}

ApiResponse list_jobs(Call& call) {
  return json_answer(answer_json<json>(call.state.jobs.describe_all()));
}

ApiResponse show_job(Call& call) {
  const auto parameters = read_parameters<JobCall>(call);
  return json_answer(answer_json<json>(call.state.jobs.describe(parameters.job, parameters.from)));
}

ApiResponse cancel_job(Call& call) {
  call.state.jobs.cancel(call.names.at("job"));
  return json_answer(answer_json<json>(call.state.jobs.describe(call.names.at("job"))), 202);
}

}  // namespace signweave::server
