#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

#include "signweave/annotation/declarations.h"
#include "signweave/core/error.h"

namespace signweave::gltf {

/// EXT_meshopt_compression of a view: the location of its packed bytes and the size they unpack to.
struct PackedView {
  std::size_t buffer = 0;
  std::uint64_t offset = 0;  ///< bytes
  std::uint64_t length = 0;  ///< bytes
  std::uint64_t stride = 0;  ///< bytes of one element, unpacked
  std::uint64_t count = 0;   ///< elements
  std::string mode;          ///< ATTRIBUTES, TRIANGLES or INDICES
  std::string filter;        ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// The morph targets of a mesh.
struct MorphMesh {
  std::string name;
  std::size_t targets = 0;
  std::vector<std::string> target_names;  ///< [target]; empty if it has none
};

/// A parsed file, checked as far as that is possible without its numbers. The bytes it was parsed from must outlive it.
struct Content {
  std::string name;                               ///< the file name in errors
  tinygltf::Model model;                          ///< without buffers, meshes, materials and pictures
  std::vector<std::optional<PackedView>> packed;  ///< [view]
  std::vector<MorphMesh> meshes;                  ///< [mesh]
  Declarations declarations;                      ///< extras "signweave:…" of the file's asset
  std::vector<nlohmann::json> tracks;             ///< [animation] the `tracks` of its extras, or null
  std::vector<bool> is_light;                     ///< [node]
  std::vector<std::string_view> buffers;  ///< [buffer] its bytes; empty for one that is only a placeholder for others
  std::deque<std::string> owned;          ///< those bytes that do not occur verbatim in the file
  std::uint64_t byte_count = 0;           ///< of the file and of all external buffers

  /// True if our own writer wrote it.
  bool is_ours() const { return model.asset.generator == "signweave"; }
};

/// Parses a .glb or .gltf. External buffers must lie in `folder` or below; if that is empty, none may be read. Throws
/// Error{bad_input} or Error{unsupported}, "FILE: …", and as `read_file` does.
Content content_of(const std::string& name, std::string_view bytes, const std::filesystem::path& folder);

/// The external buffers of a file, in its folder or below.
std::vector<std::filesystem::path> outside_buffers(const std::string& name, std::string_view bytes,
                                                   const std::filesystem::path& folder);

}  // namespace signweave::gltf
