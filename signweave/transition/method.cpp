#include "signweave/transition/method.h"

#include "signweave/transition/fill.h"

namespace signweave {
namespace {

constexpr GapMethod kMethods[] = {
    {"taught", "the most likely trajectory, bent as the corpus's own movements are", Offered::signing, Needs::teaching,
     fill_taught},
    {"kriging", "the most likely trajectory from the frames on both sides", Offered::signing, Needs::nothing,
     fill_kriging},
    {"learned", "the most likely trajectory, corrected as captured transitions deviate", Offered::signing,
     Needs::nothing, fill_learned},
    {"recorded", "bent like the captured spans with the most similar borders", Offered::signing, Needs::spans,
     fill_recorded},
    {"quintic", "position, velocity and acceleration at both borders", Offered::signing, Needs::nothing, fill_quintic},
    {"hermite", "position and velocity at both borders", Offered::signing, Needs::nothing, fill_hermite},
    {"inertialize", "the left border's offset from the right side fades out", Offered::signing, Needs::nothing,
     fill_inertialize},
    {"sine", "from rest to rest, along the shortest arc", Offered::signing, Needs::nothing, fill_sine},
    {"gap", "each side coasts to rest while the two are cross-faded", Offered::signing, Needs::nothing, fill_coast},
    {"slerp", "at constant speed along the shortest arc", Offered::evaluation, Needs::nothing, fill_slerp},
    {"crossfade", "both sides continue as they came, one fading into the other", Offered::evaluation, Needs::nothing,
     fill_crossfade},
    {"recipe", "cut where poses are most similar, linear, mean of three frames", Offered::evaluation, Needs::nothing,
     fill_recipe},
    {"hold", "stays at the left border, then jumps", Offered::evaluation, Needs::nothing, fill_hold},
};

}  // namespace

std::span<const GapMethod> gap_methods() noexcept {
  return kMethods;
}

const GapMethod* find_gap_method(std::string_view name) noexcept {
  for (const GapMethod& method : kMethods) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

}  // namespace signweave
