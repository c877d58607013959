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

/// When the elements of ANVIL's tracks are. For anvil.cpp only.
namespace signweave::anvil {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

enum class TrackKind {
  primary,      ///< own times
  point,        ///< own points of time
  singleton,    ///< one to one with the elements of another track
  span,         ///< from one element of another track to one
  subdivision,  ///< the elements of another track, divided in time
  parts,        ///< the same without times of their own
};

/// What one element says of one attribute.
struct Value {
  std::size_t attribute = 0;  ///< its place in the track's list
  std::string text;
};

struct Element {
  pugi::xml_node node;
  pugi::xml_node group;    ///< the el-group that it stands in, if any
  std::size_t number = 0;  ///< among all elements of the file, from 1
  std::int64_t index = 0;  ///< within its track, as written
  std::vector<Value> values;
  TimeSpan span;
  bool aligned = true;
  std::size_t parent = kNone;  ///< place of the element that it belongs to, in the track that its own refers to
};

struct Track {
  std::string name;
  pugi::xml_node node;
  TrackKind kind = TrackKind::primary;
  std::string ref_name;
  std::size_t ref = kNone;  ///< the track that it refers to
  std::vector<Element> elements;
  std::unordered_map<std::int64_t, std::size_t> places;  ///< index -> place
  std::vector<AttributeSpec> attributes;                 ///< of the specification, then of the file, in their order
  std::unordered_map<std::string, std::size_t> attribute_places;
  std::size_t main = 0;            ///< the attribute that is the label
  bool has_gaps = false;           ///< of a subdivision: its elements do not fill their references
  std::vector<std::size_t> order;  ///< places by time
};

/// An attribute's value as an element's index. Throws Error{bad_input} at the node.
std::int64_t index_in(const eaf::Xml& xml, pugi::xml_node node, std::string_view attribute, std::string_view text);

/// Gives every element its time, parent and order; tracks that others refer to come first, whatever their order in the
/// file. Throws Error{bad_input, "FILE:LINE: …"}; oddities are told in `notices`.
void settle_times(const eaf::Xml& xml, std::vector<Track>& tracks, std::vector<Notice>& notices);

}  // namespace signweave::anvil
