#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/output.h"
#include "signweave/core/text.h"
#include "signweave/database/database.h"
#include "signweave/database/import.h"

namespace signweave::cli {
namespace {

struct Options {
  std::string folder;
  std::string recording;
  std::vector<std::string> outputs;
  std::optional<std::int64_t> from;
  std::optional<std::int64_t> to;
  std::string joints;
  bool signing_space = false;
};

/// The joints named in "LeftHand,RightHand", with near matches for one that does not exist.
JointSet joints_named(const std::string& names, const Skeleton& skeleton) {
  JointSet joints;
  std::vector<std::string> known;
  for (const Joint& joint : skeleton.joints()) known.push_back(joint.name);
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    const std::string name(trimmed(names.substr(begin, end - begin)));
    begin = end + 1;
    if (name.empty()) continue;
    const auto joint = skeleton.find(name);
    if (!joint)
      throw Error(ErrorCode::not_found, fmt::format("no joint '{}'{}", printable(name), did_you_mean(name, known)));
    joints.push_back(*joint);
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

/// The part of a document inside a span, its times moved so that the span begins at 0. Annotations that reach over an
/// end are cut; linked files keep their place in time. Everything else of the document is carried over.
AnnotationDocument cut_document(const AnnotationDocument& document, TimeSpan span,
                                const std::vector<std::string>& outputs) {
  AnnotationDocument cut = document;
  // A file that is written now with the part in it begins where the part does.
  std::erase_if(cut.linked_files, [&](const LinkedFile& linked) {
    return std::any_of(outputs.begin(), outputs.end(), [&](const std::string& path) {
      const std::string name = std::filesystem::path(path).filename().string();
      return linked_file_name(linked.url) == name || linked_file_name(linked.relative_url) == name;
    });
  });
  for (LinkedFile& linked : cut.linked_files) linked.time_origin += span.begin;
  for (Tier& tier : cut.tiers) {
    std::erase_if(tier.annotations, [&](const Annotation& a) { return !a.span.overlaps(span); });
    for (Annotation& annotation : tier.annotations) {
      annotation.span = {std::max(annotation.span.begin, span.begin) - span.begin,
                         std::min(annotation.span.end, span.end) - span.begin};
    }
  }
  return cut;
}

}  // namespace

Run export_recording(CLI::App& verb) {
  auto options = std::make_shared<Options>();
  verb.add_option("DB", options->folder, "the database")->required();
  verb.add_option("RECORDING", options->recording, "name of the recording")->required();
  verb.add_option("-o,--output", options->outputs,
                  "file to write: " + writable_endings() + "; may be given several times")
      ->required()
      ->allow_extra_args(false)
      ->check([](const std::string& path) { return check_output(path); });
  verb.add_option("--from", options->from, "annotation time in ms to begin at");
  verb.add_option("--to", options->to, "annotation time in ms to end at");
  verb.add_option("--joints", options->joints, "joint names, separated by commas; the others are left at rest");
  verb.add_flag("--signing-space", options->signing_space, kSigningSpaceHelp);
  return [options](Io& io) {
    check_signing_space(options->signing_space, options->outputs);
    const Database database(options->folder, kv::Access::read_only);
    report_damage(database, io);
    const std::shared_ptr<const Contents> contents = database.contents();
    const RecordingInfo& info = contents->at(options->recording);
    const bool part = options->from || options->to;
    std::optional<Motion> motion;
    FrameRange frames{0, info.motion ? info.motion->frames : 0};
    const TimeSpan all = info.motion ? span_of(frames, info.clock) : TimeSpan{Milliseconds(0), Milliseconds::max()};
    const TimeSpan span{options->from ? Milliseconds(*options->from) : all.begin,
                        options->to ? Milliseconds(*options->to) : all.end};
    if (options->from && options->to && span.begin >= span.end) {
      throw Error(ErrorCode::bad_input, "--from must be before --to");
    }
    const auto is_document = [](const std::string& path) { return fold_case(path).ends_with(".eaf"); };
    const bool needs_motion = !std::ranges::all_of(options->outputs, is_document);
    if (info.motion && needs_motion) {
      if (part) frames = span.begin < span.end ? clamp(frames_of(span, info.clock), info.motion->frames) : FrameRange{};
      if (frames.empty()) {
        throw Error(ErrorCode::bad_input, fmt::format("nothing between --from and --to: the motion covers {}..{} ms",
                                                      all.begin.count(), all.end.count()));
      }
      const JointSet joints =
          options->joints.empty() ? JointSet{} : joints_named(options->joints, *database.skeleton(info.name));
      motion = database.read(info.name, frames, joints);
    }
    std::optional<AnnotationDocument> document;
    const bool needs_document = std::ranges::any_of(options->outputs, is_document);
    if (info.document != 0 && needs_document) document = database.document(info.name);
    // The annotation is cut where the frames are, so that both begin together.
    if (document && part)
      document = cut_document(*document, motion ? span_of(frames, info.clock) : span, options->outputs);
    Outgoing recording{.motion = motion ? &*motion : nullptr,
                       .layout = info.layout,
                       .document = document ? &*document : nullptr,
                       .title = info.name,
                       .signing_space = options->signing_space,
                       .rig = info.rig,
                       .declarations = info.declarations};
    for (const std::string& path : options->outputs) {
      if (!options->joints.empty() && fold_case(path).ends_with(".face.csv")) {
        throw Error(ErrorCode::bad_input, path + ": --joints leaves scalar tracks out; export it without");
      }
      write_recording(path, recording);
    }
    for (const auto& [name, value] : info.declarations) io.err << "signweave: " << value << '\n';
    if (io.json) {
      io.out << nlohmann::json{{"recording", info.name}, {"files", options->outputs}, {"frames", frames.size()}}.dump(
                    2, ' ', false, nlohmann::json::error_handler_t::replace)
             << '\n';
    }
  };
}

}  // namespace signweave::cli
