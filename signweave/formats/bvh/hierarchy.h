#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "signweave/core/text_reader.h"
#include "signweave/formats/bvh/bvh.h"

/// The HIERARCHY half of a BVH file. Internal to formats/bvh.
namespace signweave::bvh {

/// The joints in the file's units and axes.
struct Hierarchy {
  std::vector<Joint> joints;                   ///< depth first, as in the file
  std::vector<Tip> tips;                       ///< in file order
  std::vector<std::vector<Channel>> channels;  ///< [joint]
  std::size_t channel_count = 0;               ///< numbers per frame
};

/// The spelling of each channel, [Channel].
inline constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                                  "Xrotation", "Yrotation", "Zrotation"};

/// Lengths and angles beyond this are not measurements, and would overflow the arithmetic.
inline constexpr double kLargest = 1e9;

/// True if a word is this keyword, ignoring case.
bool is_keyword(std::string_view word, std::string_view keyword) noexcept;

/// Reads a number within ±kLargest; `what` names it in errors.
double checked_number(TextReader& reader, std::string_view what);

/// Reads from HIERARCHY to the brace that closes the root; nesting does not use the call stack. Throws
/// Error{bad_input}.
Hierarchy read_hierarchy(TextReader& reader, std::vector<Notice>& notices);

}  // namespace signweave::bvh
