#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/eaf/xml.h"

/// ANVIL's specification files: the possible tracks and the attributes of their elements. For anvil.cpp only.
namespace signweave::anvil {

struct AttributeSpec {
  std::string name;
  std::string values;    ///< name of the set of its values; empty if any text is allowed
  bool display = false;  ///< ANVIL draws it in the track
};

struct TrackSpec {
  std::string name;  ///< with its groups, "Hands.right.phase"
  std::string type;  ///< as written
  std::string ref;   ///< full name of the track that it refers to; empty for none
  std::vector<AttributeSpec> attributes;
};

struct Specification {
  std::vector<TrackSpec> tracks;
  /// The track of this name, or null.
  const TrackSpec* find(std::string_view name) const noexcept;
};

/// Throws Error{bad_input, "NAME:LINE: …"} if the text is not a specification.
Specification parse_specification(std::string name, std::string_view text);

}  // namespace signweave::anvil
