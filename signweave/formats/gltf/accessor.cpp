#include "signweave/formats/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "signweave/formats/gltf/meshopt.h"

namespace signweave::gltf {
namespace {

[[noreturn]] void refuse_accessor(const std::string& place, const std::string& what) {
  throw Error(ErrorCode::bad_input, fmt::format("{}: {}", place, what));
}

constexpr int kFloats = TINYGLTF_COMPONENT_TYPE_FLOAT;

std::size_t component_size(int component) {
  return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component)));
}

std::size_t part_count(int type) {
  return static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
}

template <typename T>
T raw(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// The value that a normalized integer of type `Whole` represents.
template <typename Whole>
void add_normalised(std::string_view bytes, std::size_t stride, std::size_t parts, std::span<float> out) {
  constexpr auto kMost = static_cast<float>(std::numeric_limits<Whole>::max());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const char* const at = bytes.data() + i / parts * stride + i % parts * sizeof(Whole);
    out[i] = std::max(static_cast<float>(raw<Whole>(at)) / kMost, -1.0f);
  }
}

void add_numbers(int component, std::string_view bytes, std::size_t stride, std::size_t parts, std::span<float> out) {
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return add_normalised<std::int8_t>(bytes, stride, parts, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return add_normalised<std::uint8_t>(bytes, stride, parts, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return add_normalised<std::int16_t>(bytes, stride, parts, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return add_normalised<std::uint16_t>(bytes, stride, parts, out);
    default:
      for (std::size_t row = 0; row < out.size() / parts; ++row) {
        std::memcpy(out.data() + row * parts, bytes.data() + row * stride, parts * sizeof(float));
      }
  }
}

/// Millions of numbers are checked, so this is written in a form that the compiler vectorizes.
void require_finite_numbers(const Numbers& numbers, const std::string& place) {
  constexpr std::int32_t kInfinity = 0x7F800000;
  std::int32_t most = 0;
  for (const float value : numbers.values) most = std::max(most, std::bit_cast<std::int32_t>(value) & 0x7FFFFFFF);
  if (most < kInfinity) return;
  const auto odd = std::ranges::find_if(numbers.values, [](float value) { return !std::isfinite(value); });
  const auto at = static_cast<std::size_t>(odd - numbers.values.begin());
  refuse_accessor(place, fmt::format("element {} is not finite; export it again", at / numbers.parts));
}

}  // namespace

void Budget::spend(std::uint64_t count, std::uint64_t size, const std::string& what) {
  if (size != 0 && count > left_ / size) {
    throw Error(ErrorCode::unsupported, fmt::format("{}: {} would be larger than a file of its size may expand to; "
                                                    "export a part of it",
                                                    file_, what));
  }
  left_ -= count * size;
}

std::string_view Accessors::view(std::size_t index, const std::string& place) {
  const tinygltf::BufferView& view = content_.model.bufferViews[index];
  const auto part_of = [&](std::size_t buffer, std::uint64_t offset, std::uint64_t length) {
    const std::string_view bytes = content_.buffers[buffer];
    if (offset > bytes.size() || length > bytes.size() - offset) {
      refuse_accessor(place, fmt::format("bufferView {} is {} bytes from {} on, but buffer {} has {}", index, length,
                                         offset, buffer, bytes.size()));
    }
    return bytes.substr(offset, length);
  };
  const std::optional<PackedView>& packed = content_.packed[index];
  if (!packed) return part_of(static_cast<std::size_t>(view.buffer), view.byteOffset, view.byteLength);
  const auto known = unpacked_.find(index);
  if (known != unpacked_.end()) return known->second;
  const std::string here = fmt::format("{}: bufferView {}", content_.name, index);
  const std::string_view bytes = part_of(packed->buffer, packed->offset, packed->length);
  require_unpackable(*packed, here);
  budget_.spend(packed->count, packed->stride, fmt::format("bufferView {}", index));
  return unpacked_.emplace(index, unpacked(*packed, bytes, here)).first->second;
}

Accessors::ByteLayout Accessors::layout_of(std::size_t view_index, std::size_t offset, std::size_t element,
                                           std::size_t count, const std::string& place) {
  const std::string_view bytes = view(view_index, place);
  std::size_t stride = content_.model.bufferViews[view_index].byteStride;
  if (content_.packed[view_index]) stride = content_.packed[view_index]->stride;
  if (stride == 0) stride = element;
  if (stride < element) refuse_accessor(place, fmt::format("elements of {} bytes every {} bytes", element, stride));
  const bool fits = offset <= bytes.size() && element <= bytes.size() - offset &&
                    (count - 1) <= (bytes.size() - offset - element) / stride;
  if (!fits) {
    refuse_accessor(place, fmt::format("{} elements of {} bytes do not fit in bufferView {} of {}; the file is cut "
                                       "off or damaged, export it again",
                                       count, element, view_index, bytes.size()));
  }
  return {bytes.substr(offset), stride};
}

void Accessors::add_sparse(const tinygltf::Accessor& accessor, std::size_t parts, std::vector<float>& values,
                           const std::string& place) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count) {
    refuse_accessor(place, fmt::format("sparse: {} of {} elements are replaced", sparse.count, accessor.count));
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  const int component = sparse.indices.componentType;
  if (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    refuse_accessor(place, "sparse: indices are not whole numbers of 0 or more");
  }
  const ByteLayout at = layout_of(static_cast<std::size_t>(sparse.indices.bufferView),
                                  static_cast<std::size_t>(sparse.indices.byteOffset), component_size(component), count,
                                  place + ", sparse indices");
  const ByteLayout from =
      layout_of(static_cast<std::size_t>(sparse.values.bufferView), static_cast<std::size_t>(sparse.values.byteOffset),
                parts * component_size(accessor.componentType), count, place + ", sparse values");
  budget_.spend(count * parts, sizeof(float), place);
  std::vector<float> replaced(count * parts);
  add_numbers(accessor.componentType, from.bytes, from.stride, parts, replaced);
  for (std::size_t i = 0; i < count; ++i) {
    const char* const bytes = at.bytes.data() + i * at.stride;
    const std::size_t index = component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? raw<std::uint8_t>(bytes)
                              : component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? raw<std::uint16_t>(bytes)
                                                                                    : raw<std::uint32_t>(bytes);
    if (index >= accessor.count) {
      refuse_accessor(place, fmt::format("sparse: element {} of {} is replaced", index, accessor.count));
    }
    std::copy_n(replaced.begin() + static_cast<std::ptrdiff_t>(i * parts), parts,
                values.begin() + static_cast<std::ptrdiff_t>(index * parts));
  }
}

Numbers Accessors::read(int index, const Wanted& wanted) {
  const tinygltf::Accessor& accessor = content_.model.accessors[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("{}: accessor {}", content_.name, index);
  const std::size_t parts = part_count(accessor.type);
  if (accessor.type != wanted.type) {
    refuse_accessor(place, fmt::format("elements of {} numbers where {} are needed", parts, part_count(wanted.type)));
  }
  const bool whole = accessor.componentType != kFloats;
  if (whole && !(wanted.normalized_too && accessor.normalized && component_size(accessor.componentType) < 4)) {
    refuse_accessor(place, wanted.normalized_too
                               ? "whole numbers that are not normalized bytes or shorts; export floats"
                               : "whole numbers where floats are needed; export floats");
  }
  if (accessor.count == 0) refuse_accessor(place, "it has no elements");
  if (wanted.count && *wanted.count != accessor.count) {
    refuse_accessor(place, fmt::format("{} elements where {} are needed", accessor.count, *wanted.count));
  }
  const bool look = wanted.type != TINYGLTF_TYPE_MAT4 && !wanted.checked_by_caller;
  if (const auto known = read_.find(index); known != read_.end()) {
    if (look) require_finite_numbers(known->second, place);
    return known->second;
  }

  Numbers numbers{.values = {}, .count = accessor.count, .parts = parts};
  const std::size_t element = parts * component_size(accessor.componentType);
  ByteLayout layout;
  if (accessor.bufferView >= 0) {
    layout =
        layout_of(static_cast<std::size_t>(accessor.bufferView), accessor.byteOffset, element, accessor.count, place);
  }
  const auto* const start = layout.bytes.data();
  const bool as_they_are = start != nullptr && !whole && !accessor.sparse.isSparse && layout.stride == element &&
                           reinterpret_cast<std::uintptr_t>(start) % alignof(float) == 0;
  if (as_they_are) {
    numbers.values = {reinterpret_cast<const float*>(start), accessor.count * parts};
  } else {
    budget_.spend(accessor.count, parts * sizeof(float), fmt::format("accessor {}", index));
    std::vector<float>& values = owned_.emplace_back(accessor.count * parts);
    if (start != nullptr) add_numbers(accessor.componentType, layout.bytes, layout.stride, parts, values);
    if (accessor.sparse.isSparse) add_sparse(accessor, parts, values, place);
    numbers.values = values;
  }
  if (look) require_finite_numbers(numbers, place);
  return read_.emplace(index, numbers).first->second;
}

}  // namespace signweave::gltf
