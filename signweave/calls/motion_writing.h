#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/core/error.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/motion/motion.h"

namespace signweave::calls {

/// Returns why `text` is not a rate that can be written; empty if it is.
std::string check_rate(const std::string& text);
/// Returns why `text` is not a unit; empty if it is.
std::string check_unit(const std::string& text);
/// Metres per unit: "cm", "m", "mm", "in", or a number of metres.
std::optional<double> parse_unit(const std::string& text);

/// How to write a BVH file. Empty texts: as in the recording's own file.
struct BvhWriting {
  std::string order;
  std::string up;
  std::string unit;
};

template <class Visit>
void fields(Visit& visit, BvhWriting& writing) {
  visit(Field{.name = "bvh_order",
              .help = "in .bvh: the order of the rotation columns; as in the recording's own file if not given",
              .one_of = {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}},
        writing.order);
  visit(Field{.name = "bvh_up", .help = "in .bvh: the vertical axis", .one_of = {"y", "z"}}, writing.up);
  visit(Field{.name = "bvh_unit",
              .help = "in .bvh: cm, m, mm, in or metres per unit",
              .or_number = true,
              .check = check_unit},
        writing.unit);
}

/// Requires checked fields.
bvh::LayoutChanges layout_changes_of(const BvhWriting& writing);

/// The rate at which to write a motion. Empty: its own.
struct RateWriting {
  std::string rate;
  std::string method = "slerp";
};

template <class Visit>
void fields(Visit& visit, RateWriting& writing) {
  visit(Field{.name = "rate",
              .help = "frames a second of the result; its own if not given",
              .or_number = true,
              .check = check_rate},
        writing.rate);
  visit(Field{.name = "rate_method",
              .help = "slerp: the shortest arc between two captured frames, linear for positions and tracks; nearest: "
                      "the nearer of the two",
              .shows_default = true,
              .one_of = {"slerp", "nearest"}},
        writing.method);
}

/// Requires checked fields. Adds what was done to `notices`, about `where`.
Motion at_rate(Motion motion, const RateWriting& writing, const std::string& where, std::vector<Notice>& notices);

}  // namespace signweave::calls
