#pragma once

#include "signweave/features/hand_motion.h"

namespace signweave {

/// Returns whether a handshape is one of the unmarked B, A, S, C, O, 1 and 5, the only ones of a weak hand that is held
/// with another handshape than the strong hand's (the dominance condition, Battison 1978). Tolerant: it examines only
/// how far each finger is bent, and the thumb only to separate 1 from L. So it accepts the fists in which the thumb is
/// elsewhere (E, M, N, T), and four straight fingers whatever the thumb does. Zero, as of a hand without fingers,
/// counts as a flat hand.
bool is_unmarked(const Handshape& shape) noexcept;

/// Above this distance two hands have different handshapes. The hands of one sign in which both move are at most
/// 0.021 apart for the synthetic signer.
inline constexpr float kOtherHandshape = 0.15f;
bool handshapes_differ(const Handshape& a, const Handshape& b) noexcept;

}  // namespace signweave
