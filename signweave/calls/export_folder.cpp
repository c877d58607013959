#include "signweave/calls/export_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "signweave/calls/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/file_format.h"

namespace signweave::calls {
namespace {

namespace fs = std::filesystem;

/// File names that are distinct regardless of case.
std::vector<std::string> distinct_names(const std::vector<RecordingInfo>& recordings) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const RecordingInfo& info : recordings) {
    const std::string name = file_name_of(info.name);
    std::string free = name;
    for (int n = 2; !taken.insert(fold_case(free)).second; ++n) free = fmt::format("{}_{}", name, n);
    names.push_back(std::move(free));
  }
  return names;
}

std::vector<RecordingInfo> wanted_recordings(const Contents& contents, const std::vector<std::string>& names) {
  if (names.empty()) return contents.recordings;
  std::vector<RecordingInfo> wanted;
  for (const std::string& name : names) {
    const RecordingInfo& info = contents.at(name);
    if (std::ranges::find(wanted, name, &RecordingInfo::name) == wanted.end()) wanted.push_back(info);
  }
  return wanted;
}

bool has_tracks(const RecordingInfo& info) {
  return info.motion && !info.motion->tracks.empty();
}

FileKind kind_of(const std::string& extension) {
  return file_format("x" + extension)->kind;
}

/// True if the recording has content for a file with this extension.
bool has_part(const RecordingInfo& info, const std::string& extension) {
  switch (kind_of(extension)) {
    case FileKind::annotation:
      return info.document != 0;
    case FileKind::face:
      return has_tracks(info);
    default:
      return info.motion.has_value();
  }
}

void check_extensions(const std::vector<std::string>& extensions) {
  for (const std::string& extension : extensions) {
    if (const std::string fault = check_extension("x" + extension, writable_extensions()); !fault.empty()) {
      throw Error(ErrorCode::bad_input, fmt::format("as: '{}' cannot be written; use {}", printable(extension),
                                                    fmt::join(writable_extensions(), " ")));
    }
  }
}

/// The wanted tiers that a recording's document has.
std::vector<std::string> tiers_in(const AnnotationDocument& document, const std::vector<std::string>& wanted) {
  std::vector<std::string> found;
  for (const std::string& tier : wanted) {
    if (document.find_tier(tier) != nullptr) found.push_back(tier);
  }
  return found;
}

/// [recording] its wanted tiers. Throws for a tier that no recording has.
std::vector<std::vector<std::string>> tiers_of(const Database& database, const std::vector<RecordingInfo>& recordings,
                                               const std::vector<std::string>& wanted) {
  std::vector<std::vector<std::string>> tiers(recordings.size());
  if (wanted.empty()) return tiers;
  std::set<std::string> known;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    if (recordings[i].document == 0) continue;
    const AnnotationDocument document = database.document(recordings[i].name);
    for (const Tier& tier : document.tiers) known.insert(tier.id);
    tiers[i] = tiers_in(document, wanted);
  }
  for (const std::string& tier : wanted) {
    if (known.contains(tier)) continue;
    throw Error(ErrorCode::not_found,
                fmt::format("no recording has a tier '{}'{}", printable(tier),
                            did_you_mean(tier, std::vector<std::string>(known.begin(), known.end()))));
  }
  return tiers;
}

/// A row of pairs.csv: motion, annotation, signer, offset, face, face offset, name.
std::vector<std::string> pair_row(const RecordingInfo& info, const std::vector<std::string>& files, bool part) {
  std::vector<std::string> row(7);
  for (const std::string& file : files) {
    const FileFormat* format = file_format(file);
    if (format == nullptr || !format->reads) continue;
    const std::string name = fs::path(file).filename().string();
    if (format->kind == FileKind::motion && row[0].empty()) row[0] = name;
    if (format->kind == FileKind::annotation && row[1].empty()) row[1] = name;
    if (format->kind == FileKind::face) row[4] = name;
  }
  row[2] = info.signer;
  // A part begins at time 0 of its annotation.
  if (!row[0].empty() && !row[1].empty())
    row[3] = fmt::format("{:.6g}", part ? 0.0 : info.clock.origin.count() * 1000.0 + 0.0);
  if (row[0].empty()) row[4].clear();
  if (!row[4].empty()) {
    row[5] = "0";
  } else if (!row[0].empty()) {
    row[4] = "-";
  }
  row[6] = info.name;
  return row;
}

}  // namespace

std::string file_name_of(const std::string& recording) {
  std::string name = recording;
  std::ranges::replace_if(
      name,
      [](char c) {
        return static_cast<unsigned char>(c) < 0x20 ||
               std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
      },
      '_');
  return name.starts_with('.') ? "_" + name : name;
}

FolderExported run(const Database& database, const FolderExport& call, const Listener& listener) {
  static const std::vector<std::string> kReadAgain = {".bvh", ".face.csv", ".eaf"};
  const std::vector<std::string>& extensions = call.extensions.empty() ? kReadAgain : call.extensions;
  check_extensions(extensions);
  const std::shared_ptr<const Contents> contents = database.contents();
  const std::vector<RecordingInfo> recordings = wanted_recordings(*contents, call.recordings);
  const std::vector<std::vector<std::string>> tiers = tiers_of(database, recordings, call.call.tiers);
  const std::vector<std::string> names = distinct_names(recordings);
  const bool part = call.call.from || call.call.to;
  std::error_code error;
  fs::create_directories(call.folder, error);
  if (error) throw Error(ErrorCode::io, fmt::format("{}: cannot be made: {}", call.folder.string(), error.message()));

  FolderExported done{.recordings = recordings.size()};
  std::vector<std::vector<std::string>> pairs = {
      {"motion", "annotation", "signer", "offset", "face", "face offset", "name"}};
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const RecordingInfo& info = recordings[i];
    std::vector<std::string> files;
    for (const std::string& extension : extensions) {
      const bool empty = kind_of(extension) == FileKind::annotation && !call.call.tiers.empty() && tiers[i].empty();
      if (has_part(info, extension) && !empty) files.push_back((call.folder / (names[i] + extension)).string());
    }
    if (files.empty()) {
      listener.notify({info.name, fmt::format("has nothing for {}", fmt::join(extensions, " "))});
      continue;
    }
    ExportCall one = call.call;
    one.recording = info.name;
    one.tiers = tiers[i];
    const Exported made = run(database, one, files);
    listener.notify_all(made.notices);
    FileContent content = made.content();
    const auto advance = [&](double fraction) {
      listener.advance((static_cast<double>(i) + fraction) / static_cast<double>(recordings.size()));
    };
    content.progress = advance;
    advance(0);
    for (const std::string& file : files) write_file(file, content);
    done.files.insert(done.files.end(), files.begin(), files.end());
    merge_declarations(made.info.declarations, done.declarations);
    if (info.motion && std::abs(info.clock.frame_time.count() * info.motion->rate.hertz() - 1) > 1e-9) {
      listener.notify(
          {info.name,
           "its annotation's clock differs from that of its frames, which pairs.csv cannot express; give sync "
           "points when you import it again",
           {{"sync", ""}}});
    }
    pairs.push_back(pair_row(info, files, part));
  }
  AtomicFile table(call.folder / "pairs.csv");
  table.write(format_csv(pairs));
  table.commit();
  return done;
}

}  // namespace signweave::calls
