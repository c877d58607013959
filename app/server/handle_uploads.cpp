#include <fmt/format.h>

#include <cassert>
#include <type_traits>

#include <algorithm>

#include "app/calls/import_call.h"
#include "app/calls/inspect_call.h"
#include "app/server/routes.h"
#include "signweave/core/atomic_file.h"

namespace signweave::server {
namespace {

using nlohmann::json;

/// A call's file is named by its plain name in the upload.
void resolve(std::string& file, const std::filesystem::path& folder, std::string_view field) {
  if (file.empty()) return;
  Uploads::require_plain(file);
  const std::filesystem::path path = folder / file;
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(ErrorCode::not_found, fmt::format("{}: the upload has no file '{}'; put it first", field, file));
  }
  file = path.string();
}

/// Does so with every field of a call that names a file, whatever fields it has.
struct ResolveFiles {
  const std::filesystem::path& folder;

  template <class Member>
  void operator()(const calls::Field& field, Member& member) const {
    if constexpr (std::is_same_v<Member, std::string>) {
      if (field.is_file) resolve(member, folder, field.name);
    } else {
      assert(!field.is_file);
    }
  }
};

/// A table of pairs tells paths; one that comes over the network may only name files beside it.
void require_plain_table(const std::string& table) {
  if (table.empty()) return;
  if (read_file(table, 16'000'000).find_first_of("/\\") != std::string::npos) {
    throw Error(ErrorCode::bad_input, "pairs: the table may only name files of the upload, without folders");
  }
}

/// Takes the server's folder out of every text: nobody needs to know of it.
json without_folder(json value, const std::string& folder) {
  if (value.is_string()) {
    auto text = value.get<std::string>();
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
    return text;
  }
  if (value.is_structured()) {
    for (json& one : value) one = without_folder(std::move(one), folder);
  }
  return value;
}

/// What a job over the files of an upload tells: every recording as soon as it is over.
class Told {
 public:
  Told(const Pairing& pairing, std::string folder, JobContext& job) : folder_(std::move(folder)), job_(job) {
    report_["notices"] = without_folder(calls::json_of(pairing.notices), folder_);
    job_.tell(report_);
  }
  void add(json recording) {
    report_["recordings"].push_back(without_folder(std::move(recording), folder_));
    job_.tell(report_);
  }
  calls::Listener listener() {
    return {.notice = {},
            .fault = [this](const std::string& line) { report_["faults"].push_back(without_folder(line, folder_)); },
            .stage = {},
            .progress = [this](double fraction) { job_.advance(fraction); }};
  }
  const json& report() const { return report_; }

 private:
  std::string folder_;
  JobContext& job_;
  json report_ = {{"recordings", json::array()}, {"notices", json::array()}, {"faults", json::array()}};
};

/// Does the work of an import.
json import_files(Database& database, const Pairing& pairing, const ImportOptions& options, const std::string& folder,
                  JobContext& job) {
  Told told(pairing, folder, job);
  const calls::Listener listener = told.listener();
  calls::run(database, pairing, options, listener, [&](const calls::Imported& imported) {
    json one = calls::json_of(imported);
    const std::optional<RecordingInfo> info = database.info(imported.name);
    one["declarations"] = !info ? json::object() : calls::declarations_json(info->declarations);
    told.add(std::move(one));
  });
  calls::learn(database, listener);
  return told.report();
}

/// An upload that a job reads: nobody changes it meanwhile.
struct HeldUpload {
  std::filesystem::path folder;
  ImportOptions options;
  Pairing pairing;
};

/// Of checked fields. What is thrown releases the upload.
HeldUpload hold_upload(Call& call, calls::ImportCall parameters) {
  const std::string& upload = call.names.at("upload");
  Uploads& uploads = call.state.uploads;
  HeldUpload held{.folder = uploads.hold(call.database().name(), upload), .options = {}, .pairing = {}};
  try {
    const ResolveFiles resolve_files{held.folder};
    fields(resolve_files, parameters);
    require_plain_table(parameters.pairs);
    held.options = calls::options_of(parameters);
    held.pairing = calls::pairing_of(
        parameters, parameters.pairs.empty() ? std::vector{held.folder} : std::vector<std::filesystem::path>{});
    if (held.pairing.jobs.empty()) throw Error(ErrorCode::bad_input, "the upload has no motion or annotation file");
    return held;
  } catch (...) {
    uploads.release(upload, false);
    throw;
  }
}

bool all_done(const json& result) {
  return std::ranges::none_of(result["recordings"], [](const json& one) { return one["outcome"] == "failed"; });
}

}  // namespace

calls::SchemaWriter import_fields() {
  return calls::schema_of_call<calls::ImportCall>();
}

ApiResponse open_upload(Call& call) {
  const std::string id = call.state.uploads.open(call.database().name());
  return json_answer(call.state.uploads.describe(call.database().name(), id), 201);
}

ApiResponse show_upload(Call& call) {
  return json_answer(call.state.uploads.describe(call.database().name(), call.names.at("upload")));
}

ApiResponse discard_upload(Call& call) {
  call.state.uploads.discard(call.database().name(), call.names.at("upload"));
  return json_answer(json{{"discarded", call.names.at("upload")}});
}

void require_upload(const Call& call) {
  call.state.uploads.require_open(call.database().name(), call.names.at("upload"), call.names.at("file"));
}

ApiResponse put_file(Call& call) {
  return json_answer(call.state.uploads.put(call.database().name(), call.names.at("upload"), call.names.at("file"),
                                            call.request.body_file, call.request.body));
}

ApiResponse import_upload(Call& call) {
  const auto parameters = read_parameters<calls::ImportCall>(call);
  ServedDatabase& served = call.database();
  const std::string upload = call.names.at("upload");
  Uploads& uploads = call.state.uploads;
  const HeldUpload held = hold_upload(call, parameters);
  const bool some = !parameters.recordings.empty();  // the others may be wanted later
  try {
    const std::string id = call.state.jobs.start(
        {.name = "import"}, served.name(), [&served, &uploads, upload, held, some](JobContext& job) {
          json result;
          try {
            served.change([&](Database& database) {
              result = import_files(database, held.pairing, held.options, held.folder.string() + "/", job);
            });
          } catch (...) {  // it may be tried again, with other parameters
            uploads.release(upload, false);
            throw;
          }
          uploads.release(upload, !some && all_done(result));
          return result;
        });
    return json_answer(json{{"job", id}}, 202);
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
            Told told(held.pairing, held.folder.string() + "/", job);
            calls::inspect(served.database(), held.pairing, held.options, held.folder.string() + ".inspected",
                           told.listener(), [&](nlohmann::ordered_json one) { told.add(std::move(one)); });
            uploads.release(upload, false);
            return told.report();
          } catch (...) {
            uploads.release(upload, false);
            throw;
          }
        });
    return json_answer(json{{"job", id}}, 202);
  } catch (...) {
    uploads.release(upload, false);
    throw;
  }
}

ApiResponse list_jobs(Call& call) {
  return json_answer(call.state.jobs.describe_all());
}

ApiResponse show_job(Call& call) {
  return json_answer(call.state.jobs.describe(call.names.at("job")));
}

ApiResponse cancel_job(Call& call) {
  call.state.jobs.cancel(call.names.at("job"));
  return json_answer(call.state.jobs.describe(call.names.at("job")), 202);
}

}  // namespace signweave::server
