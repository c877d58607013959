#pragma once

#include <optional>
#include <string>

#include "signweave/calls/field.h"
#include "signweave/calls/motion_writing.h"
#include "signweave/formats/motion_file.h"

namespace signweave::calls {

/// How to read a motion file. Empty texts: as the file says, or guessed. Settings that a format does not have are
/// ignored with a notice.
struct MotionReading {
  std::string up;
  std::string unit;
  std::string root_unit;
  std::string root_order;
  bool mirror = false;
  std::string source_rate;
  std::string take;
  std::string skeleton;
};

template <class Visit>
void fields(Visit& visit, MotionReading& reading) {
  visit(Field{.name = "up", .help = "the file's vertical axis; guessed if not given", .one_of = {"y", "z"}},
        reading.up);
  visit(Field{.name = "unit",
              .help = "the file's unit: cm, m, mm, in or metres per unit; guessed if not given",
              .or_number = true,
              .check = check_unit},
        reading.unit);
  visit(Field{.name = "root_unit",
              .help = "the unit of the root's position if it differs",
              .or_number = true,
              .check = check_unit},
        reading.root_unit);
  visit(Field{.name = "root_order",
              .help = "declared: as CHANNELS says; rotation_first: the root's columns hold the rotation first",
              .one_of = {"declared", "rotation_first"}},
        reading.root_order);
  visit(Field{.name = "mirror", .help = "the file's space is left-handed"}, reading.mirror);
  visit(Field{.name = "source_rate",
              .help = "frames a second, such as 120 or 30000/1001, of a file that does not say or is resampled",
              .or_number = true,
              .check = check_rate},
        reading.source_rate);
  visit(Field{.name = "take", .help = "which of a file's several takes: its name or number; the first if not given"},
        reading.take);
  visit(Field{.name = "skeleton",
              .help = "the file of the skeleton if it is a separate one; searched for if not given",
              .is_file = true,
              .type_name = "FILE"},
        reading.skeleton);
}

/// Returns why `text` is not a timecode; empty if it is.
std::string check_timecode(const std::string& text);

/// When a face capture begins relative to its motion. Without either: at the same time.
struct FacePlacing {
  std::optional<double> offset_ms;
  std::string timecode;
};

template <class Visit>
void fields(Visit& visit, FacePlacing& face) {
  visit(Field{.name = "face_offset_ms", .help = "the motion's time of a face capture's first row; else 0"},
        face.offset_ms);
  visit(Field{.name = "face_timecode",
              .help = "HH:MM:SS:FF of the motion's frame 0, on the clock of the face capture",
              .check = check_timecode},
        face.timecode);
}

/// Requires checked fields.
motion_file::ReadOptions read_options(const MotionReading& reading);

}  // namespace signweave::calls
