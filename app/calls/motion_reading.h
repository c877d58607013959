#pragma once

#include <string>

#include "app/calls/field.h"
#include "signweave/formats/bvh.h"

namespace signweave::calls {

/// How a motion file is to be read. Empty texts: as the file says, or guessed.
struct MotionReading {
  std::string up;
  std::string unit;
  std::string root_unit;
  std::string root_order;
  bool mirror = false;
};

/// Empty, or why `text` is no unit.
std::string check_unit(const std::string& text);

template <class Visit>
void fields(Visit& visit, MotionReading& reading) {
  visit(Field{.name = "up", .help = "the file's vertical axis; guessed where not given", .one_of = {"y", "z"}},
        reading.up);
  visit(Field{.name = "unit",
              .help = "the file's unit: cm, m, mm, in or metres per unit; guessed where not given",
              .or_number = true,
              .check = check_unit},
        reading.unit);
  visit(Field{.name = "root_unit",
              .help = "the unit of the root's position where it is another",
              .or_number = true,
              .check = check_unit},
        reading.root_unit);
  visit(Field{.name = "root_order",
              .help = "declared: as CHANNELS says; rotation_first: the root's columns hold the rotation first",
              .one_of = {"declared", "rotation_first"}},
        reading.root_order);
  visit(Field{.name = "mirror", .help = "the file's space is left-handed"}, reading.mirror);
}

/// Of checked fields.
bvh::ReadOptions read_options(const MotionReading& reading);

}  // namespace signweave::calls
