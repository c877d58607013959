#include "signweave/formats/csv/rotations_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/csv/csv_text.h"

namespace signweave {

std::string rotations_csv_heading(const Skeleton& skeleton) {
  std::string text = "frame,time_s";
  for (const Joint& joint : skeleton.joints()) {
    if (joint.translated) {
      for (const char* axis : {".tx", ".ty", ".tz"}) text += ',' + csv_field(joint.name + axis);
    }
    for (const char* number : {".qx", ".qy", ".qz", ".qw"}) text += ',' + csv_field(joint.name + number);
  }
  return text + '\n';
}

std::string rotations_csv_row(const Motion& motion, std::int64_t frame) {
  const Skeleton& skeleton = motion.skeleton();
  const PoseView pose = motion.pose(frame);
  std::string text = fmt::format("{},{:.6f}", frame, static_cast<double>(frame) * motion.rate().frame_time().count());
  for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
    if (const auto translation = skeleton.translation_of(static_cast<JointIndex>(joint))) {
      const Eigen::Vector3f& t = pose.translations[*translation];
      fmt::format_to(std::back_inserter(text), ",{},{},{}", t.x(), t.y(), t.z());
    }
    const Eigen::Quaternionf& q = pose.rotations[joint];
    fmt::format_to(std::back_inserter(text), ",{},{},{},{}", q.x(), q.y(), q.z(), q.w());
  }
  return text + '\n';
}

void write_rotations_csv(const std::filesystem::path& path, const Motion& motion,
                         const std::function<void(double fraction)>& progress) {
  AtomicFile file(path);
  file.write(rotations_csv_heading(motion.skeleton()));
  constexpr std::int64_t kEvery = 256;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    if (progress && frame % kEvery == 0)
      progress(static_cast<double>(frame) / static_cast<double>(motion.frame_count()));
    file.write(rotations_csv_row(motion, frame));
  }
  file.commit();
}

}  // namespace signweave
