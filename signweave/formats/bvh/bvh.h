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

/// BVH (Biovision hierarchy) motion files. Channels and Euler orders are known here only.
namespace signweave::bvh {

/// One number per frame in the file. Stored on disk: never renumber.
enum class Channel : std::uint8_t { x_position, y_position, z_position, x_rotation, y_rotation, z_rotation };

enum class UpAxis : std::uint8_t { y, z };

/// How the root's six columns are to be understood. Stored on disk: never renumber.
enum class RootColumns : std::uint8_t {
  declared,        ///< as CHANNELS says
  rotation_first,  ///< CHANNELS says positions first, but the columns hold the rotation first: some exporters do this
};

/// What the file looked like, so that the motion can be written back as it came. Kept with a recording.
struct Layout {
  std::vector<std::vector<Channel>> channels;  ///< [joint], in file order; none for a joint without channels
  UpAxis up = UpAxis::y;
  bool mirrored = false;    ///< the file's space is left-handed (option --mirror)
  double unit = 0.01;       ///< metres per file unit, for offsets and positions
  double root_unit = 0.01;  ///< metres per file unit, for the root's positions and offset
  RootColumns root_columns = RootColumns::declared;
  std::string frame_time;  ///< as printed in the file; empty: printed from the motion's rate
  friend bool operator==(const Layout&, const Layout&) = default;
};

struct ReadOptions {
  std::optional<UpAxis> up{};         ///< guessed from the posed frames where not given
  std::optional<double> unit{};       ///< metres per file unit; guessed from the summed bone lengths where not given
  std::optional<double> root_unit{};  ///< as `unit` where not given
  RootColumns root_columns = RootColumns::declared;
  bool mirror = false;                              ///< the file's space is left-handed
  std::function<void(double fraction)> progress{};  ///< called now and then; may throw to cancel
};

/// A file as read: the motion in metres, Y up, right-handed, and what is needed to write it back.
struct File {
  Motion motion;
  Layout layout;
  std::vector<Notice> notices;  ///< what was guessed, snapped, found odd
};

/// Reads a file through a window, so text and motion never lie in memory together.
/// Throws Error{bad_input, "FILE:LINE: …"} for anything that is no whole BVH file.
File read(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from text; `name` stands for the file in errors.
File read_text(std::string name, std::string_view text, const ReadOptions& options = {});

/// A layout for a motion that did not come from a BVH file: centimetres, Y up, ZXY rotations, positions on each
/// translated joint.
Layout default_layout(const Skeleton& skeleton);

/// What of a layout is to be otherwise.
struct LayoutWishes {
  std::optional<std::array<Channel, 3>> order{};  ///< of the rotations, each once, as their columns stand
  std::optional<UpAxis> up{};
  std::optional<double> unit{};  ///< metres per file unit, of offsets and all positions
};

/// The layout, but for what is wished. With an order every joint has three rotations in it, after its positions.
Layout with(Layout layout, const LayoutWishes& wishes);

/// True where `layout` can write motions of this skeleton (same joint count; positions for every translated joint).
bool fits(const Layout& layout, const Skeleton& skeleton) noexcept;

/// Writes a motion as its layout says, whole or not at all. Euler angles are unwrapped towards the frame before; at
/// gimbal lock the free angle keeps still. Throws Error{io}; Error{bad_input} where the layout does not fit.
void write(const std::filesystem::path& path, const Motion& motion, const Layout& layout,
           const std::function<void(double fraction)>& progress = {});
/// The same as text.
std::string write_text(const Motion& motion, const Layout& layout);

/// For the store.
void encode(const Layout& layout, ByteWriter& out);
Layout decode_layout(ByteReader& in);

}  // namespace signweave::bvh
