#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/drawing/body_plan.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

enum class BodySide { none, left, right };

/// How a joint is drawn, from its name, its place in the hierarchy and, if names fail, the body's shape.
struct FigurePart {
  BodySide side = BodySide::none;
  bool finger = false;  ///< beyond the wrist
  bool palm = false;    ///< of the fingers, the bone from the wrist to a finger's first joint
  bool arm = false;     ///< upper arm or forearm
  bool shown = true;    ///< part of the upper body
  bool head = false;
  bool in_head = false;  ///< eyes, jaw: not drawn as bones
  bool eye = false;
};
/// The directions of a head, in its joint's own space.
struct FigureHead {
  JointIndex joint = kNoJoint;
  Eigen::Vector3f left = Eigen::Vector3f::UnitX();  ///< unit, of the person
  std::optional<Eigen::Vector3f> up;                ///< unit; given if the direction to the skull's end is not up
};
struct FigurePlan {
  std::vector<FigurePart> parts;  ///< [joint]
  std::size_t hips = 0;           ///< the joint where the trunk begins
  std::optional<FigureHead> head;
};
/// The plan of a motion of at least one frame. `rig` must be a map of its skeleton.
FigurePlan figure_plan(const Motion& motion, const RigMap& rig);

/// Weights of a face from 0 to 1; all 0 for a neutral face.
struct FigureFace {
  float brow_inner_up = 0;
  float brow_up[2] = {}, brow_down[2] = {};           ///< left, right
  float blink[2] = {}, wide[2] = {}, squint[2] = {};  ///< left, right
  float jaw = 0, close = 0, funnel = 0, pucker = 0, press = 0;
  float smile[2] = {}, stretch[2] = {};  ///< left, right
  float puff = 0;
  bool known = false;  ///< the motion has a face
};
/// Reads the face from a motion's scalar tracks named after ARKit's blend shapes; missing tracks are 0.
FigureFace figure_face(const Motion& motion, std::int64_t frame);

/// Maps one figure, in metres and facing the viewer, to pixels of its own cell.
struct FigureView {
  double left = 0, bottom = 0;  ///< pixels of x = 0 and of y = `low`
  double low = 0;               ///< metres
  double scale = 1;             ///< pixels per metre
  double near = 0, far = 0;     ///< metres of z: nearer parts are drawn in a stronger tone
  double x(const Eigen::Vector3f& at) const { return left + scale * static_cast<double>(at.x()); }
  double y(const Eigen::Vector3f& at) const { return bottom - scale * (static_cast<double>(at.y()) - low); }
};

/// The points between which bones are drawn, for the bounds of a figure. Metres, model space.
std::vector<Eigen::Vector3f> figure_points(const Skeleton& skeleton, const FigurePlan& plan, const ModelPose& pose);

/// Appends the figure's SVG elements: a line for every bone, an ellipse for the head, paths and circles for the rest.
void draw_figure(const Skeleton& skeleton, const FigurePlan& plan, const ModelPose& pose, const FigureFace& face,
                 const FigureView& view, std::string& out);

}  // namespace signweave
