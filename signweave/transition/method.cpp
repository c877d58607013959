#include "signweave/transition/method.h"

#include "signweave/transition/fill.h"

namespace signweave {
namespace {

constexpr GapMethod kMethods[] = {
    {"taught", "the likeliest trajectory, bent as the corpus's own movements are", Offered::signing, Needs::teaching,
     fill_taught},
    {"kriging", "the likeliest trajectory from what is seen on both sides", Offered::signing, Needs::nothing,
     fill_kriging},
    {"learned", "the likeliest trajectory, and how captured transitions bend from it", Offered::signing, Needs::nothing,
     fill_learned},
    {"recorded", "bent as the captured spans are that begin and end most alike", Offered::signing, Needs::spans,
     fill_recorded},
    {"quintic", "place, velocity and acceleration at both borders", Offered::signing, Needs::nothing, fill_quintic},
    {"hermite", "place and velocity at both borders", Offered::signing, Needs::nothing, fill_hermite},
    {"inertialize", "what the left border is off the right side fades out", Offered::signing, Needs::nothing,
     fill_inertialize},
    {"sine", "from rest to rest, along the shortest arc", Offered::signing, Needs::nothing, fill_sine},
    {"gap", "each side coasts to rest while the two are cross-faded", Offered::signing, Needs::nothing, fill_coast},
    {"slerp", "at one speed along the shortest arc", Offered::evaluation, Needs::nothing, fill_slerp},
    {"crossfade", "both sides go on as they came, one fading into the other", Offered::evaluation, Needs::nothing,
     fill_crossfade},
    {"recipe", "cut where poses are most alike, linear, mean of three frames", Offered::evaluation, Needs::nothing,
     fill_recipe},
    {"hold", "stays at the left border, then leaps", Offered::evaluation, Needs::nothing, fill_hold},
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
