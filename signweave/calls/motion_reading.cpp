#include "signweave/calls/motion_reading.h"

#include "signweave/formats/face/face_csv.h"

namespace signweave::calls {
std::string check_timecode(const std::string& text) {
  return face_csv::seconds_of(text, {60, 1}) ? std::string() : "expected HH:MM:SS:FF, such as 10:20:30:15";
}

motion_file::ReadOptions read_options(const MotionReading& reading) {
  motion_file::ReadOptions result;
  if (!reading.up.empty()) result.up = reading.up == "z" ? bvh::UpAxis::z : bvh::UpAxis::y;
  if (!reading.unit.empty()) result.unit = parse_unit(reading.unit);
  if (!reading.root_unit.empty()) result.root_unit = parse_unit(reading.root_unit);
  if (reading.root_order == "rotation_first") result.root_columns = bvh::RootColumns::rotation_first;
  result.mirror = reading.mirror;
  if (!reading.source_rate.empty()) result.rate = parse_frame_rate(reading.source_rate);
  result.take = reading.take;
  result.skeleton = reading.skeleton;
  return result;
}

}  // namespace signweave::calls
