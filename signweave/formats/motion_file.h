#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/formats/bvh/bvh.h"

/// Motion files of every format that is read. Which one a file is, its ending tells (see file_format.h).
namespace signweave::motion_file {

/// What a file may be told to be read with. Each format takes some of it; of the rest a notice says that it was passed
/// over.
struct ReadOptions {
  std::optional<bvh::UpAxis> up{};    ///< the file's vertical axis
  std::optional<double> unit{};       ///< metres per file unit
  std::optional<double> root_unit{};  ///< metres per file unit of the root's positions
  bvh::RootColumns root_columns = bvh::RootColumns::declared;
  bool mirror = false;               ///< the file's space is left-handed
  std::optional<FrameRate> rate{};   ///< frames a second, where the file does not tell or is resampled
  std::string take{};                ///< name or number, from 1, of one of several; empty: the first
  std::filesystem::path skeleton{};  ///< the file of the skeleton where it is one of its own; empty: looked for
  std::function<void(double fraction)> progress{};  ///< called now and then; may throw to cancel
};

struct File {
  Motion motion;
  std::optional<bvh::Layout> layout;  ///< how the file looked, for writing it back; of BVH only
  std::vector<Notice> notices;        ///< what was guessed, mended, found odd
  std::string format;                 ///< "BVH"
  Declarations declarations;          ///< of the file
};

/// Reads a motion file: metres, Y up, right-handed. Throws Error{unsupported} for an ending that no reader has, and as
/// the format's own reader does.
File read(const std::filesystem::path& path, const ReadOptions& options = {});

/// Changes with everything that a file is read from: its bytes and those of the files beside it. Throws Error{io}.
std::uint64_t fingerprint(const std::filesystem::path& path, const ReadOptions& options = {});

/// What the options say, as one line for the store that two readings are compared by; empty where they say nothing. For
/// formats without a layout: of a BVH file the layout tells it.
std::string given_options(const std::filesystem::path& path, const ReadOptions& options);

/// What such a line says, in options.
ReadOptions options_in(std::string_view line);

}  // namespace signweave::motion_file
