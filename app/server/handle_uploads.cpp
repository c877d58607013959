#include <fmt/format.h>

#include <cassert>
#include <type_traits>

#include <algorithm>

#include "app/calls/import_call.h"
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

/// Does the work of an import; tells every recording as soon as it is over.
json import_files(Database& database, const Pairing& pairing, const ImportOptions& options, const std::string& folder,
                  JobContext& job) {
  json recordings = json::array();
  json faults = json::array();
  // Of the server's folders nobody needs to know.
  const auto plain = [&](std::string text) {
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
    return text;
  };
  const auto told = [&] {
    json notices = json::array();
    for (const Notice& notice : pairing.notices) {
      notices.push_back({{"where", plain(notice.where)}, {"text", plain(notice.text)}});
    }
    return json{{"recordings", recordings}, {"notices", std::move(notices)}, {"faults", faults}};
  };
  const calls::Listener listener{.notice = {},
                                 .fault = [&](const std::string& line) { faults.push_back(plain(line)); },
                                 .stage = {},
                                 .progress = [&](double fraction) { job.advance(fraction); }};
  calls::run(database, pairing, options, listener, [&](const calls::Imported& imported) {
    json one = calls::json_of(imported);
    if (one.contains("error")) one["error"] = plain(one["error"].get<std::string>());
    if (one.contains("notices")) {
      for (json& notice : one["notices"]) {
        for (auto& [key, text] : notice.items()) text = plain(text.get<std::string>());
      }
    }
    if (one.contains("not_measured")) one["not_measured"] = plain(one["not_measured"].get<std::string>());
    const std::optional<RecordingInfo> info = database.info(imported.name);
    one["declarations"] = !info ? json::object() : calls::declarations_json(info->declarations);
    recordings.push_back(std::move(one));
    job.tell(told());
  });
  calls::learn(database, listener);
  return told();
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
  auto parameters = read_parameters<calls::ImportCall>(call);
  ServedDatabase& served = call.database();
  const std::string upload = call.names.at("upload");
  Uploads& uploads = call.state.uploads;
  const std::filesystem::path folder = uploads.hold(served.name(), upload);
  try {
    const ResolveFiles resolve_files{folder};
    fields(resolve_files, parameters);
    require_plain_table(parameters.pairs);
    const ImportOptions options = calls::options_of(parameters);
    const Pairing pairing = calls::pairing_of(
        parameters, parameters.pairs.empty() ? std::vector{folder} : std::vector<std::filesystem::path>{});
    if (pairing.jobs.empty()) throw Error(ErrorCode::bad_input, "the upload has no motion or annotation file");
    const std::string id = call.state.jobs.start(
        {.name = "import"}, served.name(), [&served, &uploads, upload, folder, options, pairing](JobContext& job) {
          json result;
          try {
            served.change([&](Database& database) {
              result = import_files(database, pairing, options, folder.string() + "/", job);
            });
          } catch (...) {  // it may be tried again, with other parameters
            uploads.release(upload, false);
            throw;
          }
          uploads.release(upload, all_done(result));
          return result;
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
