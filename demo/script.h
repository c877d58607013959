#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "demo/random.h"
#include "demo/signs.h"
#include "signweave/core/time.h"

namespace signweave::demo {

/// What a recording says: units (signs between two rests) of glosses, and how long its transitions take.
struct Script {
  std::string name;
  std::vector<std::vector<std::string_view>> units;
  Milliseconds transition_mean{0};       ///< retraction + preparation of neighbours
  Milliseconds transition_deviation{0};  ///< of the same
  float sink = 0;                        ///< how far the hands sink towards rest in the middle of a transition, 0 to 1
};

/// The weather forecast of the paper's section 5.1, 735 ± 224 ms. Its last unit is the paper's own sequence of 20
/// glosses. Counting the tokens of one gloss from 1:
/// - scenario 1 replaces BRETAGNE#1, DEMAIN#1, VENDREDI#1 and MATIN#2 by the cities VANNES, MARSEILLE, RENNES, LE MANS;
///   none is the neighbour of another, so that makes 8 junctions;
/// - scenario 2 swaps today's prediction, BRETAGNE#1 .. PLUIE#1 (BRETAGNE MATIN NUAGES APRES-MIDI PLUIE), for Friday's,
///   NUAGES#2 .. BROUILLARD#1 (NUAGES NUIT EN-MER MATIN BROUILLARD). Friday's ends the recording: 3 junctions.
/// The units before use none of these glosses, so the numbers stay true.
Script meteo();

/// City names recited, the hands sinking to rest between, 1064 ± 289 ms. Each city at least once; VANNES, MARSEILLE,
/// RENNES, LE MANS and some others twice.
Script villes();

/// The whole corpus: meteo and villes, then as many further recordings of about two minutes as make the minutes asked
/// for (none where those two are enough). Their units are 4 to 9 signs long and come from a small grammar
/// (corpus_scripts.cpp), the rarest words first, so that at 44 minutes nearly every word of the table occurs five times
/// or more. The same minutes give the same scripts.
std::vector<Script> corpus_scripts(double minutes);

/// A sign at its time. Frames; the phases touch: [begin, stroke_begin) is the preparation, then stroke, then
/// retraction.
struct PlacedSign {
  const SignShape* shape = nullptr;  ///< a row of sign_table()
  Token token = {};                  ///< what is special about this one
  std::int64_t begin = 0;
  std::int64_t stroke_begin = 0;
  std::int64_t stroke_end = 0;
  std::int64_t end = 0;
};

struct Timeline {
  FrameRate rate;
  std::vector<PlacedSign> signs;  ///< in order; neighbours of one unit touch
  std::int64_t frames = 0;        ///< with the rests before, between and after
};

/// True where the hands rest after that sign.
bool ends_unit(const Timeline& timeline, std::size_t sign) noexcept;

/// Where hands rest: between sentences in front of the belly, before the first and after the last along the hips.
enum class Rest { belly, hips };
/// `to_model` coordinates of the wrist.
Eigen::Vector3f rest_place(Rest rest = Rest::belly);

/// Gives every sign its frames and its token. Every bound is a whole number of milliseconds as well as of frames, and
/// the durations of transitions (within units, and those across a rest by themselves) have the script's mean and
/// deviation to within rounding: longer ways take longer. Throws Error{unsupported} for a rate whose frames meet whole
/// milliseconds less often than every 50 ms.
Timeline schedule(const Script& script, FrameRate rate, Random& random);

/// About how long a recording of that script is, seconds.
double expected_seconds(const Script& script);

}  // namespace signweave::demo
