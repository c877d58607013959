#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace signweave {

/// A value in a file's JSON and its path there, used in error messages. The file's name and the JSON must outlive it.
/// Every read throws Error{bad_input, "FILE: PATH: what"} if the value has another type.
class JsonValue {
 public:
  JsonValue(const std::string& file, const nlohmann::json& value, std::string place = {})
      : file_(&file), value_(&value), place_(std::move(place)) {}

  [[noreturn]] void fail(const std::string& what) const;

  bool has(const std::string& key) const;  ///< false also if it is null
  JsonValue operator[](const std::string& key) const;
  JsonValue operator[](std::size_t index) const;
  std::size_t size() const;               ///< of an array
  std::vector<std::string> keys() const;  ///< of an object, ascending
  float number(float least, float most) const;
  std::size_t index(std::size_t count) const;  ///< an integer below `count`
  std::string text() const;
  /// Three numbers, each with magnitude at most `most`.
  Eigen::Vector3f vector(float most) const;
  Eigen::Vector3f direction() const;  ///< a unit vector

 private:
  const std::string* file_;
  const nlohmann::json* value_;
  std::string place_;
};

/// Returns the JSON of a GLB file of version 2; the rest of the file is ignored. Throws Error{bad_input, "FILE: what"}.
nlohmann::json glb_json(const std::string& file, std::string_view bytes);

}  // namespace signweave
