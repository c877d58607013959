#include "signweave/calls/convert_call.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/annotation/declarations.h"
#include "signweave/core/text.h"
#include "signweave/database/face_part.h"
#include "signweave/database/import.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/formats/file_format.h"
#include "signweave/formats/motion_file.h"

namespace signweave::calls {
namespace {

namespace fs = std::filesystem;

/// The single recording that the files belong to.
ImportJob only_job(const std::vector<fs::path>& inputs, std::vector<Notice>& notices) {
  Pairing pairing = pair_files(inputs);
  notices.insert(notices.end(), pairing.notices.begin(), pairing.notices.end());
  if (pairing.jobs.size() == 1) return std::move(pairing.jobs[0]);
  if (pairing.jobs.empty()) throw Error(ErrorCode::bad_input, "there is no motion or annotation file to convert");
  throw Error(ErrorCode::bad_input,
              fmt::format("the files are {} recordings ('{}', '{}' …); convert one at a time", pairing.jobs.size(),
                          printable(pairing.jobs[0].name), printable(pairing.jobs[1].name)));
}

/// The annotation file next to a motion file, with the same name; none if there is none.
std::optional<fs::path> annotation_next_to(const fs::path& motion) {
  std::error_code ignored;
  for (const FileFormat& format : file_formats()) {
    if (format.kind != FileKind::annotation || !format.reads) continue;
    const fs::path path = fs::path(motion).replace_extension(format.extension);
    if (fs::is_regular_file(path, ignored)) return path;
  }
  return std::nullopt;
}

/// Throws if an output would overwrite an input.
void keep_inputs(const ImportJob& job, const std::optional<fs::path>& annotation,
                 const std::vector<std::string>& outputs) {
  for (const std::optional<fs::path>& input : {job.motion, job.annotation, job.face, annotation}) {
    if (!input) continue;
    for (const std::string& output : outputs) {
      std::error_code ignored;
      if (!fs::equivalent(*input, output, ignored)) continue;
      throw Error(ErrorCode::bad_input, output + ": is an input file; write to another file");
    }
  }
}

void read_motion_half(const ImportJob& job, const ConvertCall& call, const std::function<void(double)>& progress,
                      Exported& made) {
  motion_file::ReadOptions options = read_options(call.reading);
  options.progress = progress;
  motion_file::File file = motion_file::read(*job.motion, options);
  made.notices.insert(made.notices.end(), file.notices.begin(), file.notices.end());
  if (job.face) {
    const auto given = call.face.offset_ms ? std::optional(Seconds(*call.face.offset_ms / 1000.0)) : std::nullopt;
    const auto timecode = call.face.timecode.empty() ? std::nullopt : std::optional(call.face.timecode);
    add_face(*job.face, given_face_offset(*job.face, given, timecode).value_or(Seconds(0)), file.motion, made.notices);
  }
  if (const auto hand = side_of(call.handedness)) {
    file.motion = with_handedness(std::move(file.motion), *hand, made.info.name, made.info.rig, made.notices);
  }
  made.frames = {0, file.motion.frame_count()};
  made.info.motion_facts.layout = std::move(file.layout);
  merge_declarations(file.declarations, made.info.declarations);
  made.motion = at_rate(std::move(file.motion), call.rate, job.motion->string(), made.notices);
}

}  // namespace

Exported run(const std::vector<fs::path>& inputs, const ConvertCall& call, const std::vector<std::string>& outputs,
             const std::function<void(double)>& progress) {
  Exported made{
      .info = {}, .frames = {}, .signing_space = call.signing_space, .layout_changes = layout_changes_of(call.bvh)};
  const ImportJob job = only_job(inputs, made.notices);
  made.info.name = job.name;
  if (!call.rig.empty()) made.info.rig = read_rig_names(call.rig);
  const auto is_document = [](const std::string& path) { return extension_of(path) == ".eaf"; };
  const std::optional<fs::path> annotation = job.annotation ? job.annotation
                                             : job.motion   ? annotation_next_to(*job.motion)
                                                            : std::nullopt;
  keep_inputs(job, annotation, outputs);
  if (annotation) {
    const bool asked = job.annotation || std::ranges::any_of(outputs, is_document);
    try {
      annotation_file::File file = annotation_file::read(*annotation);
      made.info.declarations = declarations_of(file.document);
      if (std::ranges::any_of(outputs, is_document)) {
        made.notices.insert(made.notices.end(), file.notices.begin(), file.notices.end());
        made.document = std::move(file.document);
      }
    } catch (const Error& error) {
      if (asked) throw;
      made.notices.push_back(
          {{}, fmt::format("the declarations of the annotation next to it are not known: {}", error.what())});
    }
  }
  if (job.motion && !std::ranges::all_of(outputs, is_document)) read_motion_half(job, call, progress, made);
  return made;
}

SignerStance stance_of(const Motion& motion, const RigNames& rig) {
  Motion some(motion.shared_skeleton(), motion.rate());
  const std::int64_t count = std::min(motion.frame_count(), kBodyFrames);
  for (std::int64_t i = 0; i < count; ++i) some.append(motion.pose(i * motion.frame_count() / count));
  SignerModel signer = model_of(some, rig);
  return {std::move(signer), std::move(some)};
}

}  // namespace signweave::calls
