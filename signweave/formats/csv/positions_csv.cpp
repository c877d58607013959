#include "signweave/formats/csv/positions_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/csv/csv_text.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
std::string positions_csv_heading(const Skeleton& skeleton) {
  std::string text = "frame,time_s";
  const auto add = [&](const std::string& name) {
    for (const char axis : {'x', 'y', 'z'}) text += ',' + csv_field(name + '.' + axis);
  };
  for (const Joint& joint : skeleton.joints()) add(joint.name);
  for (const Tip& tip : skeleton.tips()) add(skeleton.joint(tip.joint).name + " tip");
  return text + '\n';
}

std::string positions_csv_row(const Motion& motion, std::int64_t frame) {
  const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
  std::string text = fmt::format("{},{:.6f}", frame, static_cast<double>(frame) * motion.rate().frame_time().count());
  const auto add = [&](const Eigen::Vector3f& p) {
    fmt::format_to(std::back_inserter(text), ",{:.6f},{:.6f},{:.6f}", p.x(), p.y(), p.z());
  };
  for (const Eigen::Vector3f& position : pose.positions) add(position);
  for (const Tip& tip : motion.skeleton().tips()) add(position_of(tip, pose));
  return text + '\n';
}

void write_positions_csv(const std::filesystem::path& path, const Motion& motion,
                         const std::function<void(double fraction)>& progress) {
  AtomicFile file(path);
  file.write(positions_csv_heading(motion.skeleton()));
  constexpr std::int64_t kEvery = 256;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    if (progress && frame % kEvery == 0)
      progress(static_cast<double>(frame) / static_cast<double>(motion.frame_count()));
    file.write(positions_csv_row(motion, frame));
  }
  file.commit();
}

}  // namespace signweave
