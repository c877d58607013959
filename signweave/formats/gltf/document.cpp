#include "signweave/formats/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "signweave/core/error.h"

namespace signweave::gltf {

static_assert(std::endian::native == std::endian::little,
              "glTF's numbers are little-endian, and are copied as they are");
static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Vector4f) == 16 && sizeof(Eigen::Matrix4f) == 64);

Document::Document(std::size_t most_bytes, std::string too_large)
    : most_bytes_(most_bytes), too_large_(std::move(too_large)) {
  model_.buffers.emplace_back();
}

int Document::add(const void* bytes, std::size_t size, std::size_t count, int component, int type, int target) {
  std::vector<unsigned char>& data = model_.buffers[0].data;
  const std::size_t begin = (data.size() + 3) / 4 * 4;
  if (begin > most_bytes_ || size > most_bytes_ - begin) throw Error(ErrorCode::unsupported, too_large_);
  data.resize(begin);
  const auto* first = static_cast<const unsigned char*>(bytes);
  data.insert(data.end(), first, first + size);

  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = begin;
  view.byteLength = size;
  view.target = target;
  model_.bufferViews.push_back(std::move(view));
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = count;
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int Document::scalars(std::span<const float> values, bool with_bounds) {
  const int index = add_list(values, values.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 0);
  if (with_bounds) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    model_.accessors.back().minValues = {*low};
    model_.accessors.back().maxValues = {*high};
  }
  return index;
}

int Document::vectors(std::span<const Eigen::Vector3f> values, VectorUse use) {
  const int index = add_list(values, values.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                             use.vertices ? TINYGLTF_TARGET_ARRAY_BUFFER : 0);
  if (use.with_bounds) {
    Eigen::Vector3f low = values[0];
    Eigen::Vector3f high = values[0];
    for (const Eigen::Vector3f& value : values) {
      low = low.cwiseMin(value);
      high = high.cwiseMax(value);
    }
    model_.accessors.back().minValues = {low.x(), low.y(), low.z()};
    model_.accessors.back().maxValues = {high.x(), high.y(), high.z()};
  }
  return index;
}

int Document::quaternions(std::span<const Eigen::Vector4f> values) {
  return add_list(values, values.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, 0);
}

int Document::matrices(std::span<const Eigen::Matrix4f> values) {
  return add_list(values, values.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4, 0);
}

int Document::joints(std::span<const int> values) {
  const bool narrow = std::all_of(values.begin(), values.end(), [](int joint) { return joint < 256; });
  if (narrow) {
    std::vector<std::uint8_t> rows;
    for (const int joint : values) rows.insert(rows.end(), {static_cast<std::uint8_t>(joint), 0, 0, 0});
    return add_list(std::span<const std::uint8_t>(rows), values.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                    TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
  }
  std::vector<std::uint16_t> rows;
  for (const int joint : values) rows.insert(rows.end(), {static_cast<std::uint16_t>(joint), 0, 0, 0});
  return add_list(std::span<const std::uint16_t>(rows), values.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                  TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
}

int Document::full_weights(std::size_t count) {
  std::vector<std::uint8_t> rows;
  for (std::size_t i = 0; i < count; ++i) rows.insert(rows.end(), {255, 0, 0, 0});
  const int index = add_list(std::span<const std::uint8_t>(rows), count, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                             TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
  model_.accessors.back().normalized = true;
  return index;
}

int Document::indices(std::span<const std::uint32_t> values) {
  if (std::all_of(values.begin(), values.end(), [](std::uint32_t index) { return index < 65'535; })) {
    const std::vector<std::uint16_t> narrow(values.begin(), values.end());
    return add_list(std::span<const std::uint16_t>(narrow), values.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                    TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }
  return add_list(values, values.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                  TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

std::vector<float> key_times(FrameRate rate, std::int64_t frames) {
  std::vector<float> times;
  times.reserve(static_cast<std::size_t>(frames));
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const auto time = static_cast<float>(static_cast<double>(frame) * static_cast<double>(rate.denominator) /
                                         static_cast<double>(rate.numerator));
    if (frame > 0 && time <= times.back()) {
      throw Error(
          ErrorCode::unsupported,
          fmt::format(
              "frame {} at {} frames a second: glTF cannot distinguish its time from that of the previous frame; "
              "write a part of the motion",
              frame, to_string(rate)));
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace signweave::gltf
