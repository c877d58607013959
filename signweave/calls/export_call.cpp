#include "signweave/calls/export_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "signweave/core/text.h"
#include "signweave/database/import.h"

namespace signweave::calls {
namespace {

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

/// The part of a document inside a span, with its times shifted so that the span begins at 0. Annotations that extend
/// beyond the span are cut; linked files keep their position in time. Everything else is carried over.
AnnotationDocument cut_document(const AnnotationDocument& document, TimeSpan span,
                                const std::vector<std::string>& outputs) {
  AnnotationDocument cut = document;
  // A file that is written by this export begins at time 0, so its old link is dropped.
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

/// Removes all tiers from a document except these and their ancestors. Throws for one that does not exist.
void keep_tiers(AnnotationDocument& document, const std::vector<std::string>& wanted) {
  std::vector<std::string> known;
  for (const Tier& tier : document.tiers) known.push_back(tier.id);
  std::set<std::string> kept;
  for (const std::string& name : wanted) {
    const Tier* tier = document.find_tier(name);
    if (tier == nullptr) {
      throw Error(ErrorCode::not_found, fmt::format("no tier '{}'{}", printable(name), did_you_mean(name, known)));
    }
    for (; tier != nullptr && kept.insert(tier->id).second; tier = document.find_tier(tier->parent)) {
    }
  }
  std::erase_if(document.tiers, [&](const Tier& tier) { return !kept.contains(tier.id); });
}

}  // namespace

FileContent Exported::content() const {
  return {
      .motion = motion ? &*motion : nullptr,
      .document = document ? &*document : nullptr,
      .layout = character ? std::nullopt : info.motion_facts.layout,
      .layout_changes = layout_changes,
      .title = regenerated.empty() ? info.name : fmt::format("{}, in part made by {}", info.name, regenerated_by->name),
      .rig = character ? RigNames{} : info.rig,
      .signing_space = signing_space,
      .from_above = from_above,
      .loci = loci,
      .declarations = info.declarations,
      .character = character ? character->plain : std::filesystem::path()};
}

Exported run(const Database& database, const ExportCall& call, const std::vector<std::string>& outputs) {
  const Snapshot snapshot = database.snapshot();
  Exported made{.info = snapshot.contents().at(call.recording),
                .signing_space = call.signing_space,
                .from_above = call.from_above,
                .layout_changes = layout_changes_of(call.bvh)};
  const RecordingInfo& info = made.info;
  const bool part = call.from || call.to;
  made.frames = {0, info.motion ? info.motion->frames : 0};
  const TimeSpan all = info.motion ? span_of(made.frames, info.clock) : TimeSpan{Milliseconds(0), Milliseconds::max()};
  const TimeSpan span{call.from ? Milliseconds(*call.from) : all.begin, call.to ? Milliseconds(*call.to) : all.end};
  if (call.from && call.to && span.begin >= span.end) {
    throw Error(ErrorCode::bad_input, "'from' must be before 'to'");
  }
  if (!call.transition.empty() && call.regenerate.empty()) {
    throw Error(ErrorCode::bad_input, "'transition' applies only to 'regenerate': give both");
  }
  const auto is_document = [](const std::string& path) { return extension_of(path) == ".eaf"; };
  if (info.motion && !std::ranges::all_of(outputs, is_document)) {
    if (part)
      made.frames = span.begin < span.end ? clamp(frames_of(span, info.clock), info.motion->frames) : FrameRange{};
    if (made.frames.empty()) {
      throw Error(ErrorCode::bad_input, fmt::format("nothing between 'from' and 'to': the motion covers {}..{} ms",
                                                    all.begin.count(), all.end.count()));
    }
    const JointSet joints = call.joints.empty() ? JointSet{} : joints_named(call.joints, *database.skeleton(info.name));
    Motion motion = database.read(info.name, made.frames, joints);
    if (!call.regenerate.empty()) {
      made.regenerated = gaps_of(call.regenerate, info, made.frames);
      made.regenerated_by =
          call.transition.empty() ? &transition_methods().front() : find_transition_method(call.transition);
      regenerate(snapshot,
                 {.info = info,
                  .shown = made.frames,
                  .joints = joints,
                  .gaps = made.regenerated,
                  .method = *made.regenerated_by},
                 motion, made.notices);
    }
    if (!call.loci.empty()) {
      const std::optional<SignerBody>& body = snapshot.signer(info)->body;
      made.loci = marked_loci(call.loci, body ? *body : SignerBody());
    }
    made.motion = at_rate(std::move(motion), call.rate, info.name, made.notices);
  }
  if (!call.regenerate.empty() && !made.motion) {
    throw Error(ErrorCode::bad_input, info.motion ? "'regenerate' generates motion: request a motion file"
                                                  : fmt::format("regenerate: '{}' has no motion", info.name));
  }
  if (info.document != 0 && std::ranges::any_of(outputs, is_document)) made.document = database.document(info.name);
  if (made.document && part) {
    made.document = cut_document(*made.document, made.motion ? span_of(made.frames, info.clock) : span, outputs);
  }
  if (made.document && !call.tiers.empty()) keep_tiers(*made.document, call.tiers);
  for (const std::string& path : outputs) {
    if (!call.joints.empty() && extension_of(path) == ".face.csv") {
      throw Error(ErrorCode::bad_input, path + ": 'joints' leaves scalar tracks out; export it without");
    }
  }
  return made;
}

void show_on(Exported& made, const SignerStance& stance, SharedCharacter character) {
  if (made.motion) made.motion = on_character(*made.motion, stance, character->character, made.notices);
  made.character = std::move(character);
}

std::vector<RegeneratedAnswer> regenerated_of(const Exported& exported) {
  std::vector<RegeneratedAnswer> list;
  for (const FrameRange& frames : exported.regenerated) {
    list.push_back({.span = span_of(frames, exported.info.clock),
                    .recorded_frames = frames,
                    .method = exported.regenerated_by->name});
  }
  return list;
}

}  // namespace signweave::calls
