#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signweave/formats/fbx/tree.h"

/// The objects of an FBX file that define bones and their animation, with their connections resolved.
namespace signweave::fbx {

inline constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The parts of FBX' transform that a node has in addition to those that are animated; see local.h. Degrees and file
/// units.
struct Node {
  std::string name;  ///< as in the file, without "Model::"
  std::string type;  ///< LimbNode, Null, Mesh …
  std::size_t place = 0;
  std::size_t parent = kNone;
  std::vector<std::size_t> children;  ///< in the file's order
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d scaling = Eigen::Vector3d::Ones();
  Eigen::Vector3d pre_rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d post_rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d scaling_offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d scaling_pivot = Eigen::Vector3d::Zero();
  int rotation_order = 0;        ///< FBX' number: XYZ, XZY, YZX, YXZ, ZXY, ZYX (the first axis turns first), spheric
  bool rotation_active = false;  ///< if false, rotation order, pre- and post-rotation are ignored
  int inherit = 1;               ///< FBX' number: RrSs, RSrs, Rrs (without the parent's own scale)
};

enum class Animated : std::uint8_t { translation, rotation, scaling, other };

/// The animation of one property of a node.
struct Channel {
  std::size_t node = kNone;
  Animated what = Animated::other;
  std::string property;
  std::size_t layer = 0;                          ///< of its take
  std::array<const Record*, 3> curves{};          ///< x, y, z; null if not animated
  std::array<std::optional<double>, 3> values{};  ///< used without a curve; if not given, the node's own
};

/// A blend shape's animation.
struct Morph {
  std::string name;
  const Record* curve = nullptr;
  std::size_t layer = 0;  ///< of its take
};

struct Take {
  std::string name;
  std::int64_t start = 0;  ///< in FBX' ticks
  std::int64_t stop = 0;   ///< not after `start` if the file does not contain it
  std::vector<Channel> channels;
  std::vector<Morph> morphs;
};

struct Settings {
  std::array<int, 3> axes{0, 1, 2};  ///< which of the file's axes are right, up, front
  std::array<int, 3> signs{1, 1, 1};
  bool has_axes = false;
  double unit_factor = 1;  ///< centimetres
  bool has_unit = false;
  std::int64_t time_mode = 0;
  double custom_rate = 0;
};

struct Scene {
  Settings settings;
  std::vector<Node> nodes;
  std::vector<Take> takes;
};

/// The scene of a tree, which must outlive it. Throws as Source::fail does.
Scene scene_of(const Source& source, const Record& root);

/// The value record of a property in Properties70, or null: its values from the fifth on are the property's.
const Record* property(const Record* object, std::string_view name) noexcept;

}  // namespace signweave::fbx
