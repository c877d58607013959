#include "signweave/formats/gltf/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <limits>

#include "signweave/core/text.h"

namespace signweave::gltf {
namespace {

[[noreturn]] void refuse_packed(const std::string& place, const std::string& what) {
  throw Error(ErrorCode::bad_input, fmt::format("{}: EXT_meshopt_compression: {}", place, what));
}

bool stride_fits(const PackedView& view) {
  if (view.mode != "ATTRIBUTES") return view.stride == 2 || view.stride == 4;
  if (view.filter == "OCTAHEDRAL") return view.stride == 4 || view.stride == 8;
  if (view.filter == "QUATERNION") return view.stride == 8;
  return view.stride >= 4 && view.stride <= 256 && view.stride % 4 == 0;
}

}  // namespace

void require_unpackable(const PackedView& view, const std::string& place) {
  const bool known_mode = view.mode == "ATTRIBUTES" || view.mode == "TRIANGLES" || view.mode == "INDICES";
  if (!known_mode) refuse_packed(place, fmt::format("no mode '{}'", printable(view.mode)));
  const bool known_filter = view.filter == "NONE" || view.filter == "OCTAHEDRAL" || view.filter == "QUATERNION" ||
                            view.filter == "EXPONENTIAL";
  if (!known_filter || (view.mode != "ATTRIBUTES" && view.filter != "NONE")) {
    refuse_packed(place, fmt::format("no filter '{}' of {}", printable(view.filter), view.mode));
  }
  if (!stride_fits(view)) {
    refuse_packed(place,
                  fmt::format("elements of {} bytes with mode {} and filter {}", view.stride, view.mode, view.filter));
  }
  if (view.count > std::numeric_limits<std::uint32_t>::max() || (view.mode == "TRIANGLES" && view.count % 3 != 0)) {
    refuse_packed(place, fmt::format("{} elements with mode {}", view.count, view.mode));
  }
}

std::string unpacked(const PackedView& view, std::string_view bytes, const std::string& place) {
  std::string out(view.count * view.stride, '\0');
  const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data());
  int fault = 0;
  if (view.mode == "ATTRIBUTES") {
    fault = meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, from, bytes.size());
  } else if (view.mode == "TRIANGLES") {
    fault = meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, from, bytes.size());
  } else {
    fault = meshopt_decodeIndexSequence(out.data(), view.count, view.stride, from, bytes.size());
  }
  if (fault != 0) refuse_packed(place, "its bytes are damaged; copy or export the file again");
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  return out;
}

}  // namespace signweave::gltf
