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
  float curvature = 0;                                     ///< of the path, 1/metre; 0 if the hand hardly moves
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();          ///< unit; zero: no fingers
  Eigen::Vector3f fingers = Eigen::Vector3f::Zero();       ///< unit; zero: no fingers
  Eigen::Vector3f elbow = Eigen::Vector3f::Zero();         ///< signer-centred, shoulder widths; zero: no elbow
  float openness = 0;
  Handshape handshape;
  Zone zone;
  Contact contact = Contact::none;
};

/// The movement of one hand over a phase.
struct HandOver {
  static constexpr std::size_t kProfile = 16;
  bool known = false;                     ///< false: the rig lacks this hand, and everything below is zero
  HandAt begin;                           ///< at the first frame
  HandAt end;                             ///< at the last frame
  float path_length = 0;                  ///< metres: speed summed over time
  float displacement = 0;                 ///< metres, straight from begin to end, relative to the signer
  float mean_speed = 0;                   ///< metres a second
  float peak_speed = 0;                   ///< metres a second
  float peak_time = 0;                    ///< position of the peak in the phase, in [0, 1]
  float mean_acceleration = 0;            ///< mean magnitude, metres a second squared
  float mean_curvature = 0;               ///< 1/metre, weighted by speed
  std::array<float, kProfile> profile{};  ///< speed at equal steps from first to last frame; metres a second
};

/// The measurements of one phase of a sign.
struct PhaseFeatures {
  float seconds = 0;               ///< duration of the phase's frames; 0: shorter than a frame
  bool known = false;              ///< false: nothing could be measured, only `seconds` is valid
  std::array<HandOver, 2> hands;   ///< [Side]
  float hands_distance_begin = 0;  ///< metres between the palms; 0 unless both hands are known
  float hands_distance_end = 0;
  TrunkFrame trunk_begin;  ///< at the first frame; zero: unknown
  TrunkFrame trunk_end;    ///< at the last frame
};

/// The measurements of the phases of one recording.
struct RecordingFeatures {
  std::string why_not;                ///< empty, or the reason why nothing was measured: one line with its fix
  float shoulder_width = 0;           ///< metres; 0 if nothing was measured
  std::vector<PhaseFeatures> phases;  ///< one for each requested phase
  CaptureNoise noise;                 ///< noise of the motion; empty: not measured
};

/// The version of the measurement: features stored under another version are measured again. Increment with every
/// change that yields other values.
inline constexpr std::uint16_t kFeatureVersion = 3;
/// The version with the same values but without the noise; it can still be read.
inline constexpr std::uint16_t kFeaturesWithoutNoise = 2;

/// Returns the rig of a motion and the body that it moves.
SignerModel model_of(const Motion& motion, const RigNames& names = {});

/// Returns the features over some frames; `measured` must contain them, and there must be at least one.
PhaseFeatures features_over(const HandMotion& measured, FrameRange frames, FrameRate rate, const SignerBody& body);

/// Returns the features of phases given in annotation time. A phase shorter than a frame has the features of the frame
/// at its begin; of a phase that extends beyond the motion, the part inside is measured. A phase outside the motion, or
/// one with non-finite frames, is not known.
RecordingFeatures measure_phases(const Motion& motion, const SignerModel& model, std::span<const TimeSpan> phases,
                                 const FrameClock& clock);

/// Returns false if any value is not finite.
bool finite(const PhaseFeatures& phase) noexcept;

/// Returns whether two measurements are equal up to rounding differences between compilers.
bool nearly_same(const PhaseFeatures& a, const PhaseFeatures& b) noexcept;

/// The stored form; the layout is described in phase_features_record.cpp. `decode_features` returns nullopt if another
/// version measured them, and throws Error{corrupt} on bytes that `encode` cannot have written.
void encode(const RecordingFeatures& features, ByteWriter& out);
std::optional<RecordingFeatures> decode_features(ByteReader& in);

}  // namespace signweave
