#include "signweave/calls/evaluation_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "signweave/annotation/sign.h"
#include "signweave/core/text.h"
#include "signweave/database/database.h"
#include "signweave/database/import.h"
#include "signweave/evaluation/annotated_loci.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave::calls {
namespace {

namespace fs = std::filesystem;

/// Opens the database in a folder; null if the folder is no database but may hold motion files.
std::unique_ptr<Database> database_in(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return nullptr;
  try {
    return std::make_unique<Database>(path, kv::Access::read_only);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::not_found) return nullptr;
    throw;
  }
}

/// Reads a file, and reads it again with the right column order if the root's columns are swapped, which makes every
/// pose wrong.
motion_file::File read_motion(const fs::path& path, const MotionReading& words, const Listener& listener) {
  motion_file::ReadOptions options = read_options(words);
  motion_file::File file = motion_file::read(path, options);
  if (!file.layout || !words.root_order.empty() || file.motion.frame_count() == 0) return file;
  const RigMap rig = map_rig(file.motion);
  for (const Defect& defect : find_defects(file.motion, rig)) {
    if (defect.kind == DefectKind::scale) {
      listener.notify({path.string(), defect.text});
    }
    if (defect.kind != DefectKind::permuted_root) continue;
    options.root_columns = bvh::RootColumns::rotation_first;
    listener.notify({path.string(), "the root's columns have the rotation first, and are read accordingly"});
    return motion_file::read(path, options);
  }
  return file;
}

/// Signs and the clock that relates them to frames, found as `import` finds them.
struct Annotated {
  std::vector<Sign> signs;
  FrameClock clock;
  std::optional<AnnotationDocument> document = {};
};
Annotated annotation_of(const ImportJob& job, FrameRate rate) {
  Annotated found{.signs = {}, .clock = {rate.frame_time(), Seconds(0)}};
  if (!job.annotation) return found;
  // Unsound annotations are refused: signs left out would silently be missing from the evaluation.
  found.document = annotation_file::read(*job.annotation, annotation_file::Unsound::refused).document;
  const AnnotationDocument& document = *found.document;
  found.signs = signs_in(document, guess_tier_names(document)).signs;
  for (const LinkedFile& linked : document.linked_files) {
    for (const std::string& url : {linked.url, linked.relative_url}) {
      if (linked_file_name(url) == job.motion->filename().string()) found.clock.origin = -Seconds(linked.time_origin);
    }
  }
  return found;
}

/// Reads the loci of the signs.
void add_loci(const AnnotationDocument& document, EvaluatedMotion& recording, const Listener& listener) {
  if (!recording.signer.body) return;
  AnnotatedLoci found = annotated_loci(document, recording.signs, *recording.signer.body);
  for (Notice& notice : found.notices) {
    notice.where = fmt::format("{}, tier {}", recording.name, notice.where);
    listener.notify(notice);
  }
  recording.loci = std::move(found.of);
}

/// Adds one recording; if it fails, reports it, so that the others continue.
template <class Read>
void add(const std::string& name, Read read, EvaluationInput& input, const Listener& listener) {
  try {
    EvaluatedMotion recording = read();
    // If a recording were present twice, one copy would train the model that the other is evaluated with.
    const auto twin = std::ranges::find_if(input.recordings, [&](const EvaluatedMotion& other) {
      return other.motion.frame_count() == recording.motion.frame_count() &&
             std::ranges::equal(other.motion.rotations(), recording.motion.rotations(),
                                [](const auto& a, const auto& b) { return a.coeffs() == b.coeffs(); });
    });
    if (twin != input.recordings.end()) {
      listener.notify({"left out: " + recording.name, "the same motion as " + twin->name});
      input.left_out.push_back(name);
      return;
    }
    input.recordings.push_back(std::move(recording));
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) throw;
    input.left_out.push_back(name);
    const std::string line = std::string("left out: ").append(error.what());
    if (error.code() == ErrorCode::unsupported) {  // a short motion, or one without hands, is no fault
      listener.notify({"", line});
    } else {
      listener.report_fault(line);
    }
  }
}

/// The absolute path, without a trailing slash.
fs::path whole_path(const fs::path& path) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// The folder that determines a file's collection: below a given folder, the first folder under it; for a file in that
/// folder itself or given by its own path, the folder that contains it.
std::string collection_of(const fs::path& file, const std::vector<fs::path>& given) {
  const fs::path whole = whole_path(file);
  for (const fs::path& path : given) {
    const fs::path folder = whole_path(path);
    const fs::path below = whole.lexically_relative(folder);
    if (below.empty() || *below.begin() == "..") continue;
    if (below == ".") break;  // the file itself was given
    return (std::distance(below.begin(), below.end()) > 1 ? folder / *below.begin() : folder).string();
  }
  return whole.parent_path().string();
}

/// Names each collection after its folder, unless two folders have the same name.
void name_collections(EvaluationInput& input) {
  std::map<std::string, std::set<std::string>> of_name;
  const auto name_of = [](const std::string& path) { return fs::path(path).filename().string(); };
  for (const EvaluatedMotion& one : input.recordings) of_name[name_of(one.collection)].insert(one.collection);
  for (EvaluatedMotion& one : input.recordings) {
    if (of_name[name_of(one.collection)].size() == 1) one.collection = name_of(one.collection);
  }
}

void add_database(const Database& database, const std::string& name, EvaluationInput& input, const Listener& listener) {
  report_damage(database, listener);
  const std::shared_ptr<const Contents> contents = database.contents();
  for (std::size_t i = 0; i < contents->recordings.size(); ++i) {
    const RecordingInfo& info = contents->recordings[i];
    listener.advance(static_cast<double>(i) / static_cast<double>(contents->recordings.size()));
    if (!info.motion) continue;
    add(
        info.name,
        [&] {
          Motion motion = database.read(info.name);
          const RigMap rig = map_rig(motion, info.rig);
          EvaluatedMotion one =
              evaluated_motion(info.name, std::move(motion), rig,
                               signs_of(contents->segments, static_cast<std::uint32_t>(i)), info.clock);
          one.collection = name;
          one.performer = info.signer;
          if (info.document != 0) add_loci(database.document(info.name), one, listener);
          return one;
        },
        input, listener);
  }
}

void add_files(const std::vector<fs::path>& paths, const MotionReading& reading, EvaluationInput& input,
               const Listener& listener) {
  const Pairing pairing = pair_files(paths);
  for (std::size_t i = 0; i < pairing.jobs.size(); ++i) {
    const ImportJob& job = pairing.jobs[i];
    listener.advance(static_cast<double>(i) / static_cast<double>(pairing.jobs.size()));
    if (!job.motion) continue;
    add(
        job.motion->string(),
        [&] {
          motion_file::File file = read_motion(*job.motion, reading, listener);
          if (file.motion.frame_count() == 0) {
            throw Error(ErrorCode::unsupported, job.motion->string() + ": no frames, so nothing can be cut out");
          }
          const RigMap rig = map_rig(file.motion);
          Annotated annotated = annotation_of(job, file.motion.rate());
          EvaluatedMotion one = evaluated_motion(job.motion->string(), std::move(file.motion), rig,
                                                 std::move(annotated.signs), annotated.clock);
          one.collection = collection_of(*job.motion, paths);
          if (annotated.document) add_loci(*annotated.document, one, listener);
          return one;
        },
        input, listener);
  }
}

}  // namespace

EvaluationInput read_evaluation_input(const std::vector<std::string>& paths, const MotionReading& reading,
                                      const Listener& listener) {
  EvaluationInput input;
  listener.begin("reading");
  std::vector<fs::path> files;
  for (const std::string& path : paths) {
    if (const std::unique_ptr<Database> database = database_in(path)) {
      add_database(*database, whole_path(path).string(), input, listener);
    } else {
      files.emplace_back(path);
    }
  }
  if (!files.empty()) add_files(files, reading, input, listener);
  name_collections(input);
  return input;
}

EvaluationInput read_evaluation_input(const Database& database, const Listener& listener) {
  EvaluationInput input;
  listener.begin("reading");
  add_database(database, {}, input, listener);
  return input;
}

}  // namespace signweave::calls
