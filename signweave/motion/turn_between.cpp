#include "signweave/motion/turn_between.h"

namespace signweave {

Eigen::Quaternionf turn_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to) noexcept {
  return Eigen::Quaternionf::FromTwoVectors(from, to);
}

}  // namespace signweave
