#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "signweave/formats/fbx/scene.h"
#include "signweave/formats/fbx/tree.h"

/// Takes (FBX: animation stacks), built from the objects of a file and their connections.
namespace signweave::fbx {

struct Object {
  const Record* record = nullptr;
  std::size_t node = kNone;  ///< in the scene, for a Model
};

/// The objects of a file by their id.
class ObjectTable {
 public:
  /// Returns false if the id is taken.
  bool add(std::int64_t number, const Object& object) { return objects_.emplace(number, object).second; }
  const Object* find(std::int64_t number) const {
    const auto found = objects_.find(number);
    return found == objects_.end() ? nullptr : &found->second;
  }

 private:
  std::unordered_map<std::int64_t, Object> objects_;
};

/// A connection: `from` belongs to `to`, or to one of its properties.
struct Link {
  const Object* from = nullptr;
  const Object* to = nullptr;  ///< null: the scene
  std::string_view property;
};
using Links = std::vector<Link>;

/// The connections between objects of the table, in the file's order.
Links links_of(const Source& source, const Record& root, const ObjectTable& table);

std::vector<Take> takes_of(const Source& source, const Record& objects, const ObjectTable& table, const Links& links);

/// An object's name without its class: for "Model::Hips" and for the binary form "Hips\0\1Model" it is Hips.
std::string object_name(std::string_view text);

}  // namespace signweave::fbx
