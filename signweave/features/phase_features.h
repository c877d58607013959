#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/features/capture_noise.h"
#include "signweave/features/hand_motion.h"

namespace signweave {

/// One hand at one end of a phase (the paper, section 4.2: position and direction at both ends).
struct HandAt {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();      ///< signer-centred, shoulder widths
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();      ///< metres a second, signer's axes
  Eigen::Vector3f acceleration = Eigen::Vector3f::Zero();  ///< metres a second squared, signer's axes
  float curvature = 0;                                     ///< of the path, 1/metre; 0 where the hand hardly moves
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();          ///< unit; zero: no fingers
  Eigen::Vector3f fingers = Eigen::Vector3f::Zero();       ///< unit; zero: no fingers
  Eigen::Vector3f elbow = Eigen::Vector3f::Zero();         ///< signer-centred, shoulder widths; zero: no elbow
  float openness = 0;
  Handshape handshape;
  Zone zone;
  Contact contact = Contact::none;
};

/// How one hand moves over a phase.
struct HandOver {
  static constexpr std::size_t kProfile = 16;
  bool known = false;                     ///< false: the rig lacks this hand, and everything below is zero
  HandAt begin;                           ///< at the first frame
  HandAt end;                             ///< at the last frame
  float path_length = 0;                  ///< metres: speed summed over time
  float displacement = 0;                 ///< metres, straight from begin to end, seen from the signer
  float mean_speed = 0;                   ///< metres a second
  float peak_speed = 0;                   ///< metres a second
  float peak_time = 0;                    ///< of the peak, in [0, 1] of the phase
  float mean_acceleration = 0;            ///< of its length; metres a second squared
  float mean_curvature = 0;               ///< 1/metre, weighted by speed
  std::array<float, kProfile> profile{};  ///< speed at equal steps from first to last frame; metres a second
};

/// What is measured of one phase of a sign.
struct PhaseFeatures {
  float seconds = 0;               ///< of the frames of the phase; 0: it is shorter than a frame
  bool known = false;              ///< false: nothing could be measured, `seconds` alone counts
  std::array<HandOver, 2> hands;   ///< [Side]
  float hands_distance_begin = 0;  ///< metres between the palms; 0 unless both hands are known
  float hands_distance_end = 0;
  TrunkFrame trunk_begin;  ///< at the first frame; zero: not known
  TrunkFrame trunk_end;    ///< at the last frame
};

/// What is measured of the phases of one recording.
struct RecordingFeatures {
  std::string why_not;                ///< empty, or why nothing was measured: one line with its mend
  float shoulder_width = 0;           ///< metres; 0 where nothing was measured
  std::vector<PhaseFeatures> phases;  ///< one for each phase that was asked for
  CaptureNoise noise;                 ///< of the motion; empty: not measured
};

/// The number of the way of measuring: features that were stored under another are measured anew. Count it up with any
/// change that gives other numbers.
inline constexpr std::uint16_t kFeatureVersion = 3;
/// The same numbers without the noise: read as they are.
inline constexpr std::uint16_t kFeaturesWithoutNoise = 2;

/// The rig of a motion and the body that it moves.
SignerModel model_of(const Motion& motion, const RigNames& names = {});

/// The features over some frames, which `measured` must hold and of which there is at least one.
PhaseFeatures features_over(const HandMotion& measured, FrameRange frames, FrameRate rate, const SignerBody& body);

/// The features of phases, given as annotation time. A phase shorter than a frame has those of the frame at its begin;
/// of one that reaches beyond the motion, the part within is measured. One that lies outside is not known, nor one
/// whose frames are no numbers.
RecordingFeatures measure_phases(const Motion& motion, const SignerModel& model, std::span<const TimeSpan> phases,
                                 const FrameClock& clock);

/// False where a number is none: of a motion whose numbers are none.
bool finite(const PhaseFeatures& phase) noexcept;

/// True where two measurements say the same, give or take what another compiler rounds otherwise.
bool nearly_same(const PhaseFeatures& a, const PhaseFeatures& b) noexcept;

/// As they are stored; the layout is drawn in feature_record.cpp. `decode_features` gives none where another version
/// measured, and throws Error{corrupt} on bytes that `encode` cannot have written.
void encode(const RecordingFeatures& features, ByteWriter& out);
std::optional<RecordingFeatures> decode_features(ByteReader& in);

}  // namespace signweave
