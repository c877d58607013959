#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/core/error.h"
#include "signweave/motion/motion.h"

/// BVH (Biovision hierarchy) motion files. Channels and Euler orders are confined to this module.
namespace signweave::bvh {

/// One number per frame in the file. Stored on disk: never renumber.
enum class Channel : std::uint8_t { x_position, y_position, z_position, x_rotation, y_rotation, z_rotation };

enum class UpAxis : std::uint8_t { y, z };

/// How to interpret the root's six columns. Stored on disk: never renumber.
enum class RootColumns : std::uint8_t {
  declared,        ///< as CHANNELS declares
  rotation_first,  ///< CHANNELS lists positions first, but the columns hold the rotation first, as some exporters write
                   ///< it
};

/// The form of the file, needed to write the motion back unchanged. Stored with a recording.
struct Layout {
  std::vector<std::vector<Channel>> channels;  ///< [joint], in file order; empty for a joint without channels
  UpAxis up = UpAxis::y;
  bool mirrored = false;    ///< the file's space is left-handed (option --mirror)
  double unit = 0.01;       ///< metres per file unit, for offsets and positions
  double root_unit = 0.01;  ///< metres per file unit, for the root's positions and offset
  RootColumns root_columns = RootColumns::declared;
  std::string frame_time;  ///< as printed in the file; if empty, printed from the motion's rate
  friend bool operator==(const Layout&, const Layout&) = default;
};

struct ReadOptions {
  std::optional<UpAxis> up{};         ///< if not given, guessed from the posed frames
  std::optional<double> unit{};       ///< metres per file unit; if not given, guessed from the summed bone lengths
  std::optional<double> root_unit{};  ///< if not given, `unit`
  RootColumns root_columns = RootColumns::declared;
  bool mirror = false;                              ///< the file's space is left-handed
  std::function<void(double fraction)> progress{};  ///< called from time to time; may throw to cancel
};

/// A file as read: the motion in metres, Y up, right-handed, and what is needed to write it back.
struct File {
  Motion motion;
  Layout layout;
  std::vector<Notice> notices;  ///< what was guessed, snapped or found to be unusual
};

/// Reads a file through a window, so that the whole text and the motion are never in memory together.
/// Throws Error{bad_input, "FILE:LINE: …"} if the file is not a complete BVH file.
File read(const std::filesystem::path& path, const ReadOptions& options = {});
/// Reads from text; `name` is the file name in errors.
File read_text(std::string name, std::string_view text, const ReadOptions& options = {});

/// The layout for a motion that did not come from a BVH file: centimetres, Y up, ZXY rotations, and positions on each
/// translated joint.
Layout default_layout(const Skeleton& skeleton);

/// Changes to a layout; what is not given stays as it is.
struct LayoutChanges {
  std::optional<std::array<Channel, 3>> order{};  ///< of the rotations, each axis once, in column order
  std::optional<UpAxis> up{};
  std::optional<double> unit{};  ///< metres per file unit, of offsets and all positions
};

/// Returns the layout with the changes applied. If an order is given, every joint has three rotations in it, after its
/// positions.
Layout with(Layout layout, const LayoutChanges& changes);

/// True if `layout` can write motions of this skeleton (same joint count; positions for every translated joint).
bool fits(const Layout& layout, const Skeleton& skeleton) noexcept;

/// Writes a motion in the given layout, atomically. Euler angles are unwrapped towards the previous frame; at gimbal
/// lock the free angle does not change. Throws Error{io}, and Error{bad_input} if the layout does not fit the skeleton.
void write(const std::filesystem::path& path, const Motion& motion, const Layout& layout,
           const std::function<void(double fraction)>& progress = {});
/// Returns the same file as text.
std::string write_text(const Motion& motion, const Layout& layout);

/// Serialization for the store.
void encode(const Layout& layout, ByteWriter& out);
Layout decode_layout(ByteReader& in);

}  // namespace signweave::bvh
