#include "signweave/formats/write_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/formats/file_format.h"
#include "signweave/formats/writers.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

std::string extension_fault(std::string_view where, std::string_view extension,
                            const std::vector<std::string_view>& extensions) {
  const std::string wrong =
      extension.empty() ? "has no extension" : fmt::format("'{}' cannot be written here", printable(extension));
  return fmt::format("{}: {}; use {}", printable(where), wrong, fmt::join(extensions, " "));
}

/// Null if the extension has no writer.
const FileWriter* find_writer(std::string_view extension) {
  const std::span<const FileFormat> formats = file_formats();
  const auto format = std::ranges::find(formats, extension, &FileFormat::extension);
  return format != formats.end() && format->writes() ? &format->writer : nullptr;
}

const FileWriter& writer_for(std::string_view extension, std::string_view where) {
  if (const FileWriter* writer = find_writer(extension)) return *writer;
  throw Error(ErrorCode::bad_input, extension_fault(where, extension, writable_extensions()));
}

/// Throws if the content lacks what the format holds.
void require_parts(const FileWriter& writer, const FileContent& content, const std::string& where) {
  if (writer.holds == FileWriter::Holds::annotation) {
    if (content.document != nullptr || content.synthesis != nullptr) return;
    throw Error(ErrorCode::not_found, where + ": the recording has no annotation to write");
  }
  if (content.motion == nullptr) throw Error(ErrorCode::not_found, where + ": the recording has no motion to write");
  if (writer.holds == FileWriter::Holds::tracks && content.motion->tracks().empty()) {
    throw Error(ErrorCode::not_found, where + ": the motion has no scalar tracks to write");
  }
  if (writer.text == writers::gltf_text && !content.character.empty()) {
    throw Error(ErrorCode::unsupported, where + ": a character is written as .glb, in one file with its pictures");
  }
}

/// Checks, before the first file is written, that each has a writer and its folder exists.
void check_outputs(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    writer_for(extension_of(path), path);
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !fs::is_directory(folder, ignored)) {
      throw Error(ErrorCode::io, fmt::format("{}: there is no folder '{}'; make it first", path, folder.string()));
    }
  }
}

}  // namespace

FileContent content_of(const Synthesis& synthesis) {
  return {.motion = &synthesis.motion, .synthesis = &synthesis, .declarations = synthesis.declarations};
}

std::string extension_of(const std::string& path) {
  const FileFormat* format = file_format(path);
  return format != nullptr ? std::string(format->extension) : fold_case(fs::path(path).extension().string());
}

std::string check_extension(const std::string& path, const std::vector<std::string_view>& extensions) {
  const std::string extension = extension_of(path);
  const bool known = std::ranges::find(extensions, extension) != extensions.end();
  return known ? std::string() : extension_fault(path, extension, extensions);
}

std::string file_text(std::string_view extension, const FileContent& content, const std::string& where) {
  const FileWriter& writer = writer_for(extension, where);
  require_parts(writer, content, where);
  return writer.text(content);
}

void write_file(const std::string& path, const FileContent& content) {
  const FileWriter& writer = writer_for(extension_of(path), path);
  require_parts(writer, content, path);
  if (writer.write != nullptr && content.character.empty()) {
    writer.write(path, content);
    return;
  }
  const std::string text = writer.text(content);
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void write_files(const std::vector<std::string>& paths, FileContent content) {
  check_outputs(paths);
  for (const std::string& path : paths) {
    if (extension_of(path) == ".bvh") content.motion_file = fs::path(path).filename().string();
  }
  for (const std::string& path : paths) write_file(path, content);
}

void save(const Synthesis& synthesis, const std::vector<std::string>& paths) {
  write_files(paths, content_of(synthesis));
}

std::uint64_t estimated_bytes(const std::string& path, const FileContent& content) {
  constexpr std::int64_t kMany = 20'000;
  constexpr std::int64_t kSome = 32;
  const FileWriter* writer = find_writer(extension_of(path));
  const bool grows = writer != nullptr && writer->grows;
  if (!grows || content.motion == nullptr || content.motion->frame_count() < kMany) return 0;
  const std::int64_t frames = content.motion->frame_count();
  const auto bytes_of_first = [&](std::int64_t count) {
    const std::int64_t begin = frames / 2;
    const Motion part = content.motion->slice({begin, begin + count});
    FileContent some = content;
    some.motion = &part;
    some.synthesis = nullptr;
    return writer->text(some).size();
  };
  const std::uint64_t one = bytes_of_first(1);
  return one + (bytes_of_first(1 + kSome) - one) * static_cast<std::uint64_t>(frames - 1) / kSome;
}

void require_room(const std::string& path, std::uint64_t bytes) {
  std::error_code error;
  const fs::space_info space = fs::space(fs::absolute(path).parent_path(), error);
  if (error || bytes <= space.available) return;
  throw Error(ErrorCode::io, fmt::format("{}: takes about {}, and the disk has {} free; name a place on another disk, "
                                         "or write a shorter part",
                                         path, size_text(bytes), size_text(space.available)));
}

}  // namespace signweave
