#include "app/server/frames_answer.h"
#include "app/server/routes.h"
#include "app/server/upload_files.h"
#include "signweave/calls/preview_call.h"
#include "signweave/calls/rig_answer.h"
#include "signweave/notation/answer_json.h"

namespace signweave::server {
namespace {

std::string text_of(const calls::Preview& preview, const std::string& database, const std::string& file) {
  return frames_text(preview.motion,
                     {.database = database,
                      .recording = file,
                      .declarations = preview.declarations,
                      .character = {},
                      .origin_ms = 1e3 * static_cast<double>(preview.frames.begin) * preview.rate.frame_time().count(),
                      .rig = answer_json(calls::rig_answer(preview.motion.skeleton(), preview.rig)),
                      .report = {{"piece", answer_json(preview)}}});
}

}  // namespace

wire::SchemaWriter preview_fields() {
  return wire::schema_of_call<calls::PreviewCall>();
}

ApiResponse preview_upload(Call& call) {
  auto parameters = read_parameters<calls::PreviewCall>(call);
  const std::string name = parameters.file;
  const std::string& database = call.database().name();
  const std::filesystem::path folder = call.state.uploads.look(database, call.names.at("upload"));
  const ResolveFiles resolve_files{folder};
  fields(resolve_files, parameters);
  const std::string hidden = (folder / "").string();
  try {
    const calls::Preview preview = calls::run(parameters, call.listener());
    call.declare(preview.declarations);
    for (const Notice& one : preview.notices) {
      call.notices.push_back({without_folder(one.where, hidden), one.text, one.remedies});
    }
    return file_answer(answer_format("frames"), std::filesystem::path(name).stem().string(),
                       text_of(preview, database, name));
  } catch (const Error& error) {
    throw Error(error.code(), without_folder(std::string(error.what()), hidden), error.remedies());
  }
}

}  // namespace signweave::server
