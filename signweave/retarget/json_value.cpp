#include "signweave/retarget/json_value.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

/// Parsed JSON takes about thirty times its size; characters have 0.1 MiB.
constexpr std::size_t kMostJson = 16u << 20;

std::size_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i > 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
  return value;
}

}  // namespace

nlohmann::json glb_json(const std::string& file, std::string_view bytes) {
  const auto refuse = [&](const std::string& what) { throw Error(ErrorCode::bad_input, file + ": " + what); };
  // Header: magic, version, total length. First chunk: its length, its type, its bytes.
  if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF") refuse("not a GLB file");
  if (word(bytes, 4) != 2) refuse("only GLB version 2 is supported");
  if (word(bytes, 8) > bytes.size()) {
    refuse(fmt::format("truncated: {} bytes of {}", bytes.size(), word(bytes, 8)));
  }
  const std::size_t length = word(bytes, 12);
  if (bytes.substr(16, 4) != "JSON") refuse("a GLB file must begin with JSON");
  if (length > bytes.size() - 20) refuse("its JSON is longer than the file");
  if (length > kMostJson) refuse("its JSON is larger than 16 MiB");
  const std::string_view text = bytes.substr(20, length);
  nlohmann::json json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded()) refuse("its JSON cannot be read");
  return json;
}

void JsonValue::fail(const std::string& what) const {
  throw Error(ErrorCode::bad_input,
              place_.empty() ? fmt::format("{}: {}", *file_, what) : fmt::format("{}: {}: {}", *file_, place_, what));
}
bool JsonValue::has(const std::string& key) const {
  if (!value_->is_object()) return false;
  const auto found = value_->find(key);
  return found != value_->end() && !found->is_null();
}
JsonValue JsonValue::operator[](const std::string& key) const {
  if (!has(key)) fail("no " + key);
  return {*file_, value_->at(key), place_.empty() ? printable(key) : place_ + "." + printable(key)};
}
JsonValue JsonValue::operator[](std::size_t index) const {
  if (index >= size()) fail("too short");
  return {*file_, value_->at(index), fmt::format("{}[{}]", place_, index)};
}
std::size_t JsonValue::size() const {
  if (!value_->is_array()) fail("not an array");
  return value_->size();
}
std::vector<std::string> JsonValue::keys() const {
  if (!value_->is_object()) fail("not an object");
  std::vector<std::string> result;
  for (const auto& item : value_->items()) result.push_back(item.key());
  return result;
}
float JsonValue::number(float least, float most) const {
  if (!value_->is_number()) fail("not a number");
  const auto value = value_->get<double>();
  if (!(value >= least && value <= most)) fail(fmt::format("{} is not between {} and {}", value, least, most));
  return static_cast<float>(value);
}
std::size_t JsonValue::index(std::size_t count) const {
  if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() >= count) fail("not a valid index");
  return static_cast<std::size_t>(value_->get<std::uint64_t>());
}
std::string JsonValue::text() const {
  if (!value_->is_string()) fail("not a string");
  return value_->get<std::string>();
}
Eigen::Vector3f JsonValue::vector(float most) const {
  if (size() != 3) fail("expected three numbers");
  return {(*this)[0].number(-most, most), (*this)[1].number(-most, most), (*this)[2].number(-most, most)};
}
Eigen::Vector3f JsonValue::direction() const {
  const Eigen::Vector3f made = vector(1e3f);
  if (std::abs(made.norm() - 1) > 0.01f) fail("not a unit vector");
  return made.normalized();
}

}  // namespace signweave
