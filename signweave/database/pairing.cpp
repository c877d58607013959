#include "signweave/database/pairing.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/formats/file_format.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

/// Returns the role of a file in an import; `product` if an import cannot read it.
FileKind kind_of(const fs::path& path) {
  const FileFormat* format = file_format(path);
  return format == nullptr || !format->reads ? FileKind::product : format->kind;
}

[[noreturn]] void refuse_kind(const fs::path& path) {
  throw Error(
      ErrorCode::unsupported,
      fmt::format("{}: neither a motion file {}, an annotation file {} nor a face capture, which has "
                  "the name of its motion, NAME.face.csv",
                  path.string(), readable_extensions(FileKind::motion), readable_extensions(FileKind::annotation)));
}

struct Files {
  std::vector<fs::path> motions;
  std::vector<fs::path> annotations;
  std::vector<fs::path> faces;
};

void take(const fs::path& path, Files& files) {
  switch (kind_of(path)) {
    case FileKind::motion:
      files.motions.push_back(path);
      break;
    case FileKind::annotation:
      files.annotations.push_back(path);
      break;
    case FileKind::face:
      files.faces.push_back(path);
      break;
    case FileKind::motion_part:
    case FileKind::product:
      break;
  }
}

/// Returns the motion file of this folder and stem, or none; the preferred one of several.
std::optional<fs::path> motion_called(const fs::path& stem) {
  std::error_code ignored;
  for (const FileFormat& format : file_formats()) {
    if (format.kind != FileKind::motion || !format.reads) continue;
    fs::path path = stem;
    path += format.extension;
    if (fs::is_regular_file(path, ignored)) return path;
  }
  return std::nullopt;
}

/// Pairs each motion with the face capture next to it, even if only the motion is an input, and each face capture with
/// its motion, even if only the face is an input. Reports a face without a motion.
void pair_faces(const std::vector<fs::path>& faces, std::vector<ImportJob>& jobs, std::vector<Notice>& notices) {
  std::error_code ignored;
  for (ImportJob& job : jobs) {
    if (!job.motion || job.face || job.no_face) continue;
    const fs::path face = job.motion->parent_path() / (job.motion->stem().string() + ".face.csv");
    if (fs::is_regular_file(face, ignored)) job.face = face;
  }
  const auto joined = [](const fs::path& folder, const fs::path& stem) {
    std::error_code unresolved;
    return fs::weakly_canonical(folder.empty() ? "." : folder, unresolved) / stem;
  };
  for (const fs::path& face : faces) {
    const fs::path stem = joined(face.parent_path(), face.stem().stem());
    const auto job = std::find_if(jobs.begin(), jobs.end(), [&](const ImportJob& one) {
      return one.motion && joined(one.motion->parent_path(), one.motion->stem()) == stem;
    });
    const std::optional<fs::path> motion = motion_called(face.parent_path() / face.stem().stem());
    if (job != jobs.end()) {
      if (!job->no_face) job->face = face;
    } else if (motion) {
      ImportJob with_motion;
      with_motion.motion = *motion;
      with_motion.face = face;
      jobs.push_back(std::move(with_motion));
    } else {
      notices.push_back(
          {face.string(), fmt::format("a face without its motion, passed over; put it next to the motion "
                                      "file '{}' {}",
                                      printable(stem.filename().string()), readable_extensions(FileKind::motion))});
    }
  }
}

Files walk(const std::vector<fs::path>& inputs, std::vector<Notice>& notices) {
  Files files;
  for (const fs::path& input : inputs) {
    std::error_code fault;
    const fs::file_status status = fs::status(input, fault);
    if (!fs::exists(status)) throw Error(ErrorCode::not_found, input.string() + ": no such file or folder");
    if (!fs::is_directory(status)) {
      if (kind_of(input) == FileKind::product) refuse_kind(input);
      take(input, files);
      continue;
    }
    std::size_t others = 0;
    fs::recursive_directory_iterator entry(input, fs::directory_options::skip_permission_denied, fault);
    for (; !fault && entry != fs::recursive_directory_iterator(); entry.increment(fault)) {
      if (!entry->is_regular_file(fault)) continue;
      if (kind_of(entry->path()) == FileKind::product) {
        ++others;
      } else {
        take(entry->path(), files);
      }
    }
    if (fault) throw Error(ErrorCode::io, fmt::format("{}: cannot be listed: {}", input.string(), fault.message()));
    if (others > 0)
      notices.push_back({input.string(), fmt::format("{} of other kinds passed over",
                                                     others == 1 ? "1 file" : fmt::format("{} files", others))});
  }
  for (const fs::path& input : inputs) {
    if (files.motions.empty() && kind_of(input) == FileKind::motion_part) {
      notices.push_back({input.string(), fmt::format("holds no motion of its own; name the motion files next to it {}",
                                                     readable_extensions(FileKind::motion))});
    }
  }
  for (std::vector<fs::path>* list : {&files.motions, &files.annotations, &files.faces}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  return files;
}

/// Of several motion files with one folder and stem, such as a recording and its exports, keeps the one of the
/// preferred format, and those that are inputs themselves.
void prefer_one(const std::vector<fs::path>& inputs, std::vector<fs::path>& motions, std::vector<Notice>& notices) {
  std::map<fs::path, fs::path> best;  // by path without extension
  const auto rank = [](const fs::path& path) { return file_format(path) - file_formats().data(); };
  for (const fs::path& motion : motions) {
    fs::path& one = best[motion.parent_path() / motion.stem()];
    if (one.empty() || rank(motion) < rank(one)) one = motion;
  }
  std::erase_if(motions, [&](const fs::path& motion) {
    const fs::path& one = best[motion.parent_path() / motion.stem()];
    if (one == motion || std::find(inputs.begin(), inputs.end(), motion) != inputs.end()) return false;
    notices.push_back(
        {motion.string(), fmt::format("passed over for '{}' next to it; name the file itself to import it",
                                      printable(one.filename().string()))});
    return true;
  });
}

/// A row of a CSV file (RFC 4180: quotes are doubled inside quotes, a field may contain line breaks).
struct Row {
  std::size_t line = 1;
  std::vector<std::string> fields;
};

std::vector<Row> parse_csv(std::string_view text, const std::string& name) {
  std::vector<Row> rows;
  std::size_t line = 1;
  std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while (i < text.size()) {
    Row row{line, {""}};
    bool quoted = false;
    for (; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '\n') ++line;
      if (quoted) {
        if (c != '"') {
          row.fields.back() += c;
        } else if (i + 1 < text.size() && text[i + 1] == '"') {
          row.fields.back() += '"';
          ++i;
        } else {
          quoted = false;
        }
      } else if (c == '"' && row.fields.back().empty()) {
        quoted = true;
      } else if (c == ',') {
        row.fields.emplace_back();
      } else if (c == '\n') {
        ++i;
        break;
      } else if (c != '\r') {
        row.fields.back() += c;
      }
    }
    if (quoted) {
      throw Error(ErrorCode::bad_input, fmt::format("{}:{}: a quote is opened and never closed", name, row.line));
    }
    if (row.fields.size() > 1 || !trimmed(row.fields[0]).empty()) rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ImportJob> read_pairs(const fs::path& table, bool plain_files) {
  std::vector<ImportJob> jobs;
  for (const Row& row : parse_csv(read_file(table, std::size_t{1} << 28), table.string())) {
    const auto field = [&](std::size_t i) {
      return i < row.fields.size() ? std::string(trimmed(row.fields[i])) : std::string();
    };
    if (jobs.empty() && fold_case(field(0)) == "motion") continue;
    const auto fail = [&](const std::string& what) {
      throw Error(ErrorCode::bad_input, fmt::format("{}:{}: {}", table.string(), row.line, what));
    };
    if (row.fields.size() > 7) {
      fail("more than the seven columns motion, annotation, signer, offset, face, face offset, name");
    }
    ImportJob job;
    job.signer = field(2);
    job.name = field(6);
    job.given_name = !job.name.empty();
    const auto path_of = [&](const std::string& text, FileKind kind) -> std::optional<fs::path> {
      if (text.empty()) return std::nullopt;
      if (plain_files && text.find_first_of("/\\") != std::string::npos) {
        fail(fmt::format("'{}' lies in another folder; the table may only name files next to it", printable(text)));
      }
      const fs::path path = fs::path(text).is_absolute() ? fs::path(text) : table.parent_path() / text;
      std::error_code ignored;
      if (!fs::exists(path, ignored)) fail(fmt::format("no file '{}'", text));
      if (kind_of(path) != kind) {
        fail(fmt::format("'{}' is not {} file", text,
                         kind == FileKind::motion ? "a motion"
                         : kind == FileKind::face ? "a face (.face.csv)"
                                                  : "an annotation"));
      }
      return path;
    };
    job.motion = path_of(field(0), FileKind::motion);
    job.annotation = path_of(field(1), FileKind::annotation);
    if (!job.motion && !job.annotation) fail("a row needs a motion or an annotation");
    job.no_face = field(4) == "-";
    if (!job.no_face) job.face = path_of(field(4), FileKind::face);
    if (job.face && !job.motion) fail("a face needs its motion in the same row");
    const auto offset_of = [&](const std::string& text) -> std::optional<Seconds> {
      if (text.empty()) return std::nullopt;
      double ms = 0;
      const char* end = text.data() + text.size();
      if (std::from_chars(text.data(), end, ms).ptr != end || !std::isfinite(ms)) {
        fail(fmt::format("the offset '{}' is not a number of milliseconds", printable(text)));
      }
      return Seconds(ms / 1000.0);
    };
    job.offset = offset_of(field(3));
    job.face_offset = offset_of(field(5));
    if (job.face_offset && !job.face) fail("a face offset without a face");
    jobs.push_back(std::move(job));
  }
  return jobs;
}

/// Returns the names of the motion files that an annotation file links. None if the file cannot be read: importing it
/// reports why.
std::set<std::string> linked_motions(const fs::path& annotation) {
  std::set<std::string> names;
  try {
    for (const LinkedFile& linked : annotation_file::read(annotation).document.linked_files) {
      for (const std::string& url : {linked.url, linked.relative_url}) {
        if (kind_of(linked_file_name(url)) == FileKind::motion) names.insert(linked_file_name(url));
      }
    }
  } catch (const Error&) {
  }
  return names;
}

fs::path stem_path(const ImportJob& job) {
  const fs::path& file = job.motion ? *job.motion : *job.annotation;
  return file.parent_path() / file.stem();
}

/// Names the jobs that a table does not name after their stems, prefixed with as many folders as make the names unique.
void name_jobs(std::vector<ImportJob>& jobs) {
  std::vector<std::size_t> depth(jobs.size(), 0);
  for (;;) {
    std::map<std::string, std::vector<std::size_t>> by_name;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      if (jobs[i].given_name) {
        by_name[jobs[i].name].push_back(i);
        continue;
      }
      std::error_code ignored;
      fs::path path = fs::absolute(stem_path(jobs[i]), ignored).lexically_normal();
      fs::path name = path.filename();
      for (std::size_t up = 0; up < depth[i] && path.has_parent_path(); ++up) {
        path = path.parent_path();
        if (path.filename().empty()) break;
        name = path.filename() / name;
      }
      jobs[i].name = name.generic_string();
      by_name[jobs[i].name].push_back(i);
    }
    bool again = false;
    for (const auto& [name, same] : by_name) {
      if (same.size() == 1 || depth[same[0]] > 64) continue;
      for (const std::size_t i : same) ++depth[i];
      again = true;
    }
    if (!again) return;
  }
}

}  // namespace

std::string linked_file_name(std::string_view url) {
  std::string name(url.substr(url.find_last_of("/\\") == url.npos ? 0 : url.find_last_of("/\\") + 1));
  std::string decoded;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned value = 0;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::from_chars(name.data() + i + 1, name.data() + i + 3, value, 16).ptr == name.data() + i + 3) {
      decoded += static_cast<char>(value);
      i += 2;
    } else {
      decoded += name[i];
    }
  }
  return decoded;
}

Pairing pair_files(const std::vector<fs::path>& inputs, const std::optional<fs::path>& pairs_table, bool plain_files) {
  Pairing result;
  Files files = walk(inputs, result.notices);
  prefer_one(inputs, files.motions, result.notices);
  std::vector<ImportJob> jobs;
  std::set<fs::path> used;
  const auto same_file = [](const fs::path& path) {
    std::error_code ignored;
    return fs::weakly_canonical(path, ignored);
  };
  if (pairs_table) {
    jobs = read_pairs(*pairs_table, plain_files);
    for (const ImportJob& job : jobs) {
      if (job.motion) used.insert(same_file(*job.motion));
      if (job.annotation) used.insert(same_file(*job.annotation));
    }
  }
  const auto forget_used = [&](std::vector<fs::path>& list) {
    std::erase_if(list, [&](const fs::path& path) { return used.contains(same_file(path)); });
  };
  forget_used(files.motions);
  forget_used(files.annotations);

  std::map<fs::path, std::set<std::string>> links;  // of annotation files; read only for a motion without a partner
  std::set<fs::path> paired;
  for (const fs::path& motion : files.motions) {
    ImportJob job;
    job.motion = motion;
    std::vector<fs::path> same_stem;
    for (const fs::path& annotation : files.annotations) {
      if (annotation.stem() != motion.stem()) continue;
      if (annotation.parent_path() == motion.parent_path()) job.annotation = annotation;
      same_stem.push_back(annotation);
    }
    if (!job.annotation && same_stem.size() == 1) {
      const auto rivals = std::count_if(files.motions.begin(), files.motions.end(),
                                        [&](const fs::path& other) { return other.stem() == motion.stem(); });
      if (rivals == 1) job.annotation = same_stem[0];
    }
    if (!job.annotation) {
      for (const fs::path& annotation : files.annotations) {
        if (!links.contains(annotation)) links[annotation] = linked_motions(annotation);
        if (links[annotation].contains(motion.filename().string())) job.annotation = annotation;
      }
    }
    if (job.annotation) paired.insert(*job.annotation);
    jobs.push_back(std::move(job));
  }
  for (const fs::path& annotation : files.annotations) {
    if (paired.contains(annotation)) continue;
    ImportJob job;
    job.annotation = annotation;
    jobs.push_back(std::move(job));
  }
  pair_faces(files.faces, jobs, result.notices);
  name_jobs(jobs);
  std::sort(jobs.begin(), jobs.end(), [](const ImportJob& a, const ImportJob& b) { return a.name < b.name; });
  for (std::size_t i = 1; i < jobs.size(); ++i) {
    if (jobs[i].name == jobs[i - 1].name) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("two recordings would be called '{}'; rename a file", jobs[i].name));
    }
  }
  result.jobs = std::move(jobs);
  return result;
}

}  // namespace signweave
