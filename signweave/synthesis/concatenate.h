#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/features/duration_fit.h"
#include "signweave/features/hand_motion.h"
#include "signweave/motion/motion.h"
#include "signweave/motion/motion_source.h"
#include "signweave/synthesis/junction_choice.h"
#include "signweave/synthesis/transition.h"
#include "signweave/transition/joint_groups.h"

namespace signweave {

/// A stretch of a recording, ready to be joined. Its frames are read when they are needed, straight into the result.
struct Stretch {
  std::string recording;
  std::shared_ptr<const MotionSource> source;  ///< the recording's motion
  FrameRange whole;         ///< what may be used of it: the core with the first preparation and the last retraction
  FrameRange core;          ///< the frames of the recording that are kept as they are; inside `whole`, not empty
  FrameClock clock;         ///< of the recording
  std::vector<Sign> signs;  ///< in the recording's annotation time
  Milliseconds pause_before{0};
  JunctionChoice junction{};  ///< of the junction before it
  /// Of its motion, in the joints of `source`; null: not known, or shown on another skeleton.
  std::shared_ptr<const CaptureNoise> noise = nullptr;
};

/// Where an output frame comes from: of a recording where every part of the body is as captured.
struct FrameSource {
  static constexpr std::int32_t kNone = -1;
  std::int32_t stretch = kNone;   ///< index of the stretch whose recording it shows, or kNone
  std::int32_t junction = kNone;  ///< index of the junction whose transition it belongs to, or kNone
  double frame = 0;               ///< where `stretch` is given: the (fractional) frame of the recording
};

/// One place where two stretches were joined.
struct Junction {
  std::string from;  ///< gloss of the last sign before, or the recording's name
  std::string to;
  FrameRange frames;    ///< output frames between the two strokes
  TransitionCut cut;    ///< what is kept of all parts together
  TransitionCuts cuts;  ///< [Timed] what is kept of each
  std::string method;
  std::size_t number = 0;   ///< by which it is named: 1 is that of the first two stretches, or of their places
  JunctionChoice chosen{};  ///< what was told for it alone
};

/// Where a stretch lies in the result.
struct Placed {
  std::string recording;
  FrameRange output;       ///< output frames of its core, with its preparation if it is first, its retraction if last
  FrameRange core;         ///< output frames of its core
  double first_frame = 0;  ///< frame of the recording at core.begin
  double step = 1;         ///< frames of the recording per output frame
};

/// A sign as it lies in the result.
struct PlacedSign {
  Sign sign;  ///< times are output time; its phases fill it
  std::size_t stretch = 0;
  TimeSpan recorded;  ///< where it was in its recording
};

/// What was made, and of what.
struct Synthesis {
  Motion motion;
  std::vector<FrameSource> sources;  ///< [output frame]
  std::vector<Placed> stretches;
  std::vector<Junction> junctions;  ///< [stretch − 1]
  std::vector<PlacedSign> signs;    ///< in time order
  std::vector<Notice> notices;
  /// What the sources' documents say of themselves and must not be lost on the way: properties "signweave:…", such as
  /// that a demo's shapes are placeholders. Name and value, each once.
  std::vector<std::pair<std::string, std::string>> declarations;
};

/// How stretches from other recordings are brought to where the signer of the reference stretch stands.
enum class Alignment {
  automatic,  ///< `ground` for stretches of other recordings than the reference, none for its own
  ground,     ///< every stretch: shift on the ground and turn about the vertical
  none,       ///< all sources come from one session
};

/// Which joint of the result is what.
struct SignerRig {
  SignerModel signer;
  JointGroups groups;
};
/// Measured over at most kBodyFrames of a stretch's core.
SignerRig signer_rig_of(const Stretch& stretch);

/// A day of signing at a hundred frames a second. Frame rates come from files: a wrong one must not ask for a terabyte.
inline constexpr std::int64_t kMostFrames = std::int64_t{24} * 60 * 60 * 100;

struct ConcatenateOptions {
  const TransitionMethod* method = nullptr;  ///< null: the default
  Milliseconds duration{0};                  ///< of each transition at tempo 1, without pauses
  /// Where given, tells the duration of each transition from what the hands have to do. Borrowed.
  const DurationFit* fit = nullptr;
  /// What the method has learned, and the captured spans that it may need; null: the default. Borrowed.
  const TransitionModel* model = nullptr;
  const SignerRig* rig = nullptr;  ///< of the reference; null: told from its frames and names. Borrowed
  double tempo = 1;                ///< above 1 is faster; positive
  FrameRate rate{0, 1};            ///< of the output; 0: the highest of the sources
  Alignment alignment = Alignment::automatic;
  std::int64_t most_frames = kMostFrames;  ///< a result that would have more is refused before a frame is read
  std::size_t reference = 0;  ///< the stretch that gives skeleton and standing: in an edit, one of the edited recording
};

/// Joins stretches (the paper's Algorithm 1 between each two of them, for each part of the body with a cut of its own).
/// Every core is kept as captured: at the source's own rate and tempo 1 its rotations have the source's bits, up to the
/// quaternion's sign and the root's alignment; else they are the source interpolated at the stated frame. Alignment
/// always goes to where the reference's signer stands, so nothing drifts. The result has the reference's skeleton.
///
/// Scalar tracks come along: a track that one of the sources has is in the result, at 0 where a source lacks it, and
/// goes over in each transition from where it was to where it will be.
///
/// `used` is an older result whose memory may be used again. Throws Error{bad_input} where skeletons differ in more
/// than offsets (naming the joint; see put_on_skeleton), or nothing is to be joined; Error{corrupt} where frames are
/// damaged.
Synthesis concatenate(const std::vector<Stretch>& stretches, const ConcatenateOptions& options, Synthesis used = {});

}  // namespace signweave
