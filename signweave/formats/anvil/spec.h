#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/eaf/xml.h"

/// ANVIL's specification files: what tracks there may be, and what their elements hold. For anvil.cpp only.
namespace signweave::anvil {

struct AttributeSpec {
  std::string name;
  std::string values;    ///< name of the set of its values; empty where any text may stand
  bool display = false;  ///< ANVIL draws it in the track
};

struct TrackSpec {
  std::string name;  ///< with its groups, "Hands.right.phase"
  std::string type;  ///< as written
  std::string ref;   ///< the track that it refers to, as a whole name; empty: none
  std::vector<AttributeSpec> attributes;
};

struct Specification {
  std::vector<TrackSpec> tracks;
  /// The track of this name, or null.
  const TrackSpec* find(std::string_view name) const noexcept;
};

/// Throws Error{bad_input, "NAME:LINE: …"} for what is no specification.
Specification parse_specification(std::string name, std::string_view text);

}  // namespace signweave::anvil
