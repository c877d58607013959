#include "signweave/formats/motion_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "signweave/core/atomic_file.h"
#include "signweave/core/bytes.h"
#include "signweave/core/text.h"
#include "signweave/formats/file_format.h"

namespace signweave::motion_file {
namespace {

namespace fs = std::filesystem;

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

const MotionReader& reader_for(const fs::path& path) {
  const FileFormat* format = file_format(path);
  if (format != nullptr && format->reader.read != nullptr) return format->reader;
  throw Error(ErrorCode::unsupported,
              fmt::format("{}: is not a motion file {}", path.string(), readable_extensions(FileKind::motion)));
}

bool knows(const MotionReader& reader, std::string_view option) {
  return reader.options.find(fmt::format(" {} ", option)) != std::string_view::npos;
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
