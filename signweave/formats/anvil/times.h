#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/formats/anvil/spec.h"
#include "signweave/formats/eaf/xml.h"

/// The times of the elements of ANVIL's tracks. For anvil.cpp only.
namespace signweave::anvil {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

enum class TrackKind {
  primary,      ///< own times
  point,        ///< own points of time
  singleton,    ///< one to one with the elements of another track
  span,         ///< from one element of another track to a second one
  subdivision,  ///< the elements of another track, divided in time
  parts,        ///< a subdivision without times of its own
};

/// The value of one attribute of one element.
struct Value {
  std::size_t attribute = 0;  ///< its index in the track's list
  std::string text;
};

struct Element {
  pugi::xml_node node;
  pugi::xml_node group;    ///< the el-group that contains it, if any
  std::size_t number = 0;  ///< among all elements of the file, from 1
  std::int64_t index = 0;  ///< within its track, as written
  std::vector<Value> values;
  TimeSpan span;
  bool aligned = true;
  std::size_t parent = kNone;  ///< index of the element that it belongs to, in the track that its own refers to
};

struct Track {
  std::string name;
  pugi::xml_node node;
  TrackKind kind = TrackKind::primary;
  std::string ref_name;
  std::size_t ref = kNone;  ///< the track that it refers to
  std::vector<Element> elements;
  std::unordered_map<std::int64_t, std::size_t> places;  ///< element index as written -> position in `elements`
  std::vector<AttributeSpec> attributes;  ///< first those of the specification, then those of the file, in their order
  std::unordered_map<std::string, std::size_t> attribute_places;
  std::size_t main = 0;            ///< the attribute used as the label
  bool has_gaps = false;           ///< of a subdivision: its elements do not fill their references
  std::vector<std::size_t> order;  ///< positions in `elements`, by time
};

/// An attribute's value as an element's index. Throws Error{bad_input} at the node.
std::int64_t index_in(const eaf::Xml& xml, pugi::xml_node node, std::string_view attribute, std::string_view text);

/// Sets the time, parent and order of every element; tracks that others refer to are processed first, whatever their
/// order in the file. Throws Error{bad_input, "FILE:LINE: …"}; oddities are reported in `notices`.
void settle_times(const eaf::Xml& xml, std::vector<Track>& tracks, std::vector<Notice>& notices);

}  // namespace signweave::anvil
