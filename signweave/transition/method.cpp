#include "signweave/transition/method.h"

#include "signweave/transition/fill.h"

namespace signweave {
namespace {

constexpr GapMethod kMethods[] = {
    {"kriging", "the likeliest way from a tenth of a second on either side", Offered::signing, false, fill_kriging},
    {"learned", "the likeliest way, and what captured transitions bend from it", Offered::signing, false, fill_learned},
    {"recorded", "bent as the captured spans are that begin and end most alike", Offered::signing, true, fill_recorded},
    {"quintic", "place, velocity and acceleration at both borders", Offered::signing, false, fill_quintic},
    {"hermite", "place and velocity at both borders", Offered::signing, false, fill_hermite},
    {"inertialize", "what the left border is off the right side fades out", Offered::signing, false, fill_inertialize},
    {"sine", "from rest to rest, along the shortest arc", Offered::signing, false, fill_sine},
    {"gap", "each side coasts to rest while the two are cross-faded", Offered::signing, false, fill_coast},
    {"slerp", "at one speed along the shortest arc", Offered::evaluation, false, fill_slerp},
    {"crossfade", "both sides go on as they came, one fading into the other", Offered::evaluation, false,
     fill_crossfade},
    {"recipe", "cut where poses are most alike, linear, mean of three frames", Offered::evaluation, false, fill_recipe},
    {"hold", "stays at the left border, then leaps", Offered::evaluation, false, fill_hold},
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
