#include "signweave/formats/motion_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "signweave/core/atomic_file.h"
#include "signweave/core/bytes.h"
#include "signweave/core/text.h"
#include "signweave/formats/asf/asf.h"
#include "signweave/formats/fbx/fbx.h"
#include "signweave/formats/file_format.h"
#include "signweave/formats/gltf/read.h"

namespace signweave::motion_file {
namespace {

namespace fs = std::filesystem;

File read_bvh(const fs::path& path, const ReadOptions& options) {
  bvh::File file = bvh::read(path, {.up = options.up,
                                    .unit = options.unit,
                                    .root_unit = options.root_unit,
                                    .root_columns = options.root_columns,
                                    .mirror = options.mirror,
                                    .progress = options.progress});
  return {.motion = std::move(file.motion),
          .layout = std::move(file.layout),
          .notices = std::move(file.notices),
          .format = {}};
}

File read_asf(const fs::path& path, const ReadOptions& options) {
  asf::File file =
      asf::read(path, {.skeleton = options.skeleton.empty() ? std::nullopt : std::optional(options.skeleton),
                       .unit = options.unit,
                       .up = options.up,
                       .rate = options.rate,
                       .progress = options.progress});
  return {.motion = std::move(file.motion), .layout = {}, .notices = std::move(file.notices), .format = {}};
}

std::vector<fs::path> with_skeleton(const fs::path& path, const ReadOptions& options) {
  return {path, options.skeleton.empty() ? asf::skeleton_of(path) : options.skeleton};
}

File read_fbx(const fs::path& path, const ReadOptions& options) {
  fbx::File file =
      fbx::read(path, {.take = options.take, .rate = options.rate, .unit = options.unit, .progress = options.progress});
  return {.motion = std::move(file.motion), .layout = {}, .notices = std::move(file.notices), .format = {}};
}

File read_gltf(const fs::path& path, const ReadOptions& options) {
  gltf::ReadFile file = gltf::read(
      path, {.take = options.take, .rate = options.rate, .unit = options.unit, .progress = options.progress});
  return {.motion = std::move(file.motion),
          .layout = {},
          .notices = std::move(file.notices),
          .format = {},
          .declarations = std::move(file.declarations)};
}

std::vector<fs::path> with_buffers(const fs::path& path, const ReadOptions&) {
  std::vector<fs::path> files = gltf::files_of(path);
  std::error_code ignored;  // reading tells what is not there
  std::erase_if(files, [&](const fs::path& file) { return file != path && !fs::is_regular_file(file, ignored); });
  return files;
}

std::vector<fs::path> only_itself(const fs::path& path, const ReadOptions&) {
  return {path};
}

/// One reading option: the parameter of an import and its value.
struct Telling {
  std::string_view option;
  std::string text;  ///< empty: not given
};

std::vector<Telling> tellings(const ReadOptions& options) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  return {{"up", !options.up                     ? ""
                 : *options.up == bvh::UpAxis::z ? "z"
                                                 : "y"},
          {"unit", number(options.unit)},
          {"root_unit", number(options.root_unit)},
          {"root_order", options.root_columns == bvh::RootColumns::rotation_first ? "rotation_first" : ""},
          {"mirror", options.mirror ? "yes" : ""},
          {"source_rate", options.rate ? to_string(*options.rate) : ""},
          {"skeleton", options.skeleton.empty() ? "" : "given"},
          {"take", options.take}};  // the last, for a name may hold anything
}

struct MotionReader {
  std::string_view extension;
  std::string_view takes;  ///< the options that it knows, each between blanks
  File (*read)(const fs::path&, const ReadOptions&);
  std::vector<fs::path> (*files)(const fs::path&, const ReadOptions&);  ///< everything that is read
};

constexpr MotionReader kMotionReaders[] = {
    {".bvh", " up unit root_unit root_order mirror ", read_bvh, only_itself},
    {".amc", " up unit source_rate skeleton ", read_asf, with_skeleton},
    {".fbx", " unit source_rate take ", read_fbx, only_itself},
    {".glb", " unit source_rate take ", read_gltf, with_buffers},
    {".gltf", " unit source_rate take ", read_gltf, with_buffers},
};

const MotionReader& reader_for(const fs::path& path) {
  const FileFormat* format = file_format(path);
  for (const MotionReader& reader : kMotionReaders) {
    if (format != nullptr && format->extension == reader.extension) return reader;
  }
  throw Error(ErrorCode::unsupported,
              fmt::format("{}: is not a motion file {}", path.string(), readable_extensions(FileKind::motion)));
}

bool knows(const MotionReader& reader, std::string_view option) {
  return reader.takes.find(fmt::format(" {} ", option)) != std::string_view::npos;
}

}  // namespace

File read(const fs::path& path, const ReadOptions& options) {
  const MotionReader& reader = reader_for(path);
  File file = reader.read(path, options);
  file.format = file_format(path)->name;
  for (const Telling& one : tellings(options)) {
    if (one.text.empty() || knows(reader, one.option)) continue;
    file.notices.push_back(
        {path.string(), fmt::format("{} does not apply to {} files and was ignored", one.option, file.format)});
  }
  return file;
}

std::uint64_t fingerprint(const fs::path& path, const ReadOptions& options) {
  const std::vector<fs::path> files = reader_for(path).files(path, options);
  if (files.size() == 1) return file_checksum(files[0]);
  ByteWriter all;
  for (const fs::path& file : files) all.number(file_checksum(file));
  return checksum(all.bytes());
}

std::string given_options(const fs::path& path, const ReadOptions& options) {
  const MotionReader& reader = reader_for(path);
  std::string line;
  for (const Telling& one : tellings(options)) {
    // Another skeleton is another fingerprint.
    if (one.text.empty() || one.option == "skeleton" || !knows(reader, one.option)) continue;
    std::string option(one.option);
    std::ranges::replace(option, '_', '-');  // the spelling of stored lines
    line += fmt::format("{}{}={}", line.empty() ? "" : ";", option, one.text);
  }
  return line;
}

ReadOptions options_in(std::string_view line) {
  ReadOptions options;
  while (!line.empty()) {
    const std::size_t equals = line.find('=');
    const std::string_view option = line.substr(0, equals);
    const std::string_view rest = equals == line.npos ? std::string_view() : line.substr(equals + 1);
    const std::size_t end = option == "take" ? rest.size() : std::min(rest.find(';'), rest.size());
    const std::string text(rest.substr(0, end));
    line = end < rest.size() ? rest.substr(end + 1) : std::string_view();
    const auto number = [&] {
      double value = 0;
      std::from_chars(text.data(), text.data() + text.size(), value);
      return value;
    };
    if (option == "up") options.up = text == "z" ? bvh::UpAxis::z : bvh::UpAxis::y;
    if (option == "unit") options.unit = number();
    if (option == "root-unit") options.root_unit = number();
    if (option == "root-order") options.root_columns = bvh::RootColumns::rotation_first;
    if (option == "mirror") options.mirror = true;
    if (option == "source-rate") options.rate = parse_frame_rate(text);
    if (option == "take") options.take = text;
  }
  return options;
}

}  // namespace signweave::motion_file
