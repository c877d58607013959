#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/formats/bvh/bvh.h"

/// Reading of motion files in every supported format. The format is determined by the file's extension (see
/// file_format.h).
namespace signweave::motion_file {

/// Options for reading a file. Each format uses some of them; the others are ignored with a notice.
struct ReadOptions {
  std::optional<bvh::UpAxis> up{};    ///< the file's vertical axis
  std::optional<double> unit{};       ///< metres per file unit
  std::optional<double> root_unit{};  ///< metres per file unit of the root's positions
  bvh::RootColumns root_columns = bvh::RootColumns::declared;
  bool mirror = false;               ///< the file's space is left-handed
  std::optional<FrameRate> rate{};   ///< frames per second, if the file does not say or is resampled
  std::string take{};                ///< name or number, from 1, of one of several takes; empty: the first
  std::filesystem::path skeleton{};  ///< the file of the skeleton if it is a separate one; empty: it is searched for
  std::function<void(double fraction)> progress{};  ///< called now and then; may throw to cancel
};

struct File {
  Motion motion;
  std::optional<bvh::Layout> layout;  ///< of BVH only: the file's layout, for writing it back
  std::vector<Notice> notices;        ///< what was guessed, repaired, or is unusual
  std::string format;                 ///< "BVH"
  Declarations declarations;          ///< of the file
};

/// Reads a motion file: metres, Y up, right-handed. Throws Error{unsupported} for an extension that no reader supports,
/// and what the format's own reader throws.
File read(const std::filesystem::path& path, const ReadOptions& options = {});

/// A fingerprint of everything that a file is read from: its bytes and those of the files next to it. Throws Error{io}.
std::uint64_t fingerprint(const std::filesystem::path& path, const ReadOptions& options = {});

/// The options as one line, which the database stores to compare two readings of a file; empty for default options. For
/// formats without a layout: for a BVH file the layout contains them.
std::string given_options(const std::filesystem::path& path, const ReadOptions& options);

/// Parses such a line.
ReadOptions options_in(std::string_view line);

}  // namespace signweave::motion_file
