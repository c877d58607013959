#pragma once

#include <tiny_gltf.h>

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "signweave/retarget/character.h"

namespace signweave {

/// A reader of asset.extras.signweave: every step names what it reads, so that an error says where.
class Extras {
 public:
  Extras(const std::string& file, const tinygltf::Value& value, std::string where)
      : file_(file), value_(&value), where_(std::move(where)) {}

  /// Throws Error{bad_input, "FILE: WHERE: what"}.
  [[noreturn]] void fail(const std::string& what) const;

  bool has(const std::string& key) const;
  Extras operator[](const std::string& key) const;
  Extras operator[](std::size_t index) const;
  std::size_t size() const;               ///< of a list
  std::vector<std::string> keys() const;  ///< of an object, ascending
  float number() const;                   ///< finite
  float number(float least, float most) const;
  std::string text() const;
  Eigen::Vector3f place() const;      ///< metres, within 10
  Eigen::Vector3f direction() const;  ///< a unit vector
  JointIndex joint(const Skeleton& skeleton) const;
  AngleLimits limits() const;  ///< radians, of degrees

 private:
  const std::string& file_;
  const tinygltf::Value* value_;
  std::string where_;
};

/// What `extras` (asset.extras.signweave) tells: hands, face units, sizes. `character.skeleton` is there.
void read_extras(const Extras& extras, Character& character);

}  // namespace signweave
