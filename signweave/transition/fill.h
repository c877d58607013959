#pragma once

#include "signweave/transition/method.h"

/// The fill functions of the methods. Internal to this module.
namespace signweave {

void fill_coast(const GapJob& job, MutablePoses out) noexcept;
void fill_hold(const GapJob& job, MutablePoses out) noexcept;
void fill_slerp(const GapJob& job, MutablePoses out) noexcept;
void fill_sine(const GapJob& job, MutablePoses out) noexcept;
void fill_crossfade(const GapJob& job, MutablePoses out) noexcept;
void fill_recipe(const GapJob& job, MutablePoses out) noexcept;
void fill_hermite(const GapJob& job, MutablePoses out) noexcept;
void fill_quintic(const GapJob& job, MutablePoses out) noexcept;
void fill_inertialize(const GapJob& job, MutablePoses out) noexcept;
void fill_kriging(const GapJob& job, MutablePoses out) noexcept;
void fill_taught(const GapJob& job, MutablePoses out) noexcept;
void fill_learned(const GapJob& job, MutablePoses out) noexcept;
void fill_recorded(const GapJob& job, MutablePoses out) noexcept;

}  // namespace signweave
