#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace signweave {

/// A value in a file's JSON and its place there, so that an error says where. The file's name and the JSON must outlive
/// it. Every read throws Error{bad_input, "FILE: PLACE: what"} where the value is not of that kind.
class JsonValue {
 public:
  JsonValue(const std::string& file, const nlohmann::json& value, std::string place = {})
      : file_(&file), value_(&value), place_(std::move(place)) {}

  [[noreturn]] void fail(const std::string& what) const;

  bool has(const std::string& key) const;  ///< false where it is null
  JsonValue operator[](const std::string& key) const;
  JsonValue operator[](std::size_t index) const;
  std::size_t size() const;               ///< of a list
  std::vector<std::string> keys() const;  ///< of an object, ascending
  float number(float least, float most) const;
  std::size_t index(std::size_t count) const;  ///< a whole number below `count`
  std::string text() const;
  /// Three numbers, each no farther from 0 than `most`.
  Eigen::Vector3f vector(float most) const;
  Eigen::Vector3f direction() const;  ///< a unit vector

 private:
  const std::string* file_;
  const nlohmann::json* value_;
  std::string place_;
};

/// The JSON of a GLB file of version 2; what follows it is not looked at. Throws Error{bad_input, "FILE: what"}.
nlohmann::json glb_json(const std::string& file, std::string_view bytes);

}  // namespace signweave
