#include "app/calls/motion_reading.h"

namespace signweave::calls {
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
