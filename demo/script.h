#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "demo/random.h"
#include "demo/signs.h"
#include "signweave/core/time.h"

namespace signweave::demo {

/// The content of a recording: units (signs between two rests) of glosses, and the duration of its transitions.
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
///   no two of them are neighbours, so that gives 8 junctions;
/// - scenario 2 swaps today's prediction, BRETAGNE#1 .. PLUIE#1 (BRETAGNE MATIN NUAGES APRES-MIDI PLUIE), for Friday's,
///   NUAGES#2 .. BROUILLARD#1 (NUAGES NUIT EN-MER MATIN BROUILLARD). Friday's ends the recording: 3 junctions.
/// The units before use none of these glosses, so the numbers remain valid.
Script meteo();

/// A recital of city names in which the hands sink to rest between them, 1064 ± 289 ms. Each city occurs at least once;
/// VANNES, MARSEILLE, RENNES, LE MANS and some others twice.
Script villes();

/// The whole corpus: meteo and villes, then as many further recordings of about two minutes as the requested minutes
/// need (none if those two suffice). Their units are 4 to 9 signs long and come from a small grammar
/// (script_corpus.cpp), the rarest words first, so that at 44 minutes nearly every word of the table occurs five times
/// or more. The same minutes give the same scripts.
std::vector<Script> corpus_scripts(double minutes);

/// A sign at its time. Frames; the phases are contiguous: [begin, stroke_begin) is the preparation, then stroke, then
/// retraction.
struct PlacedSign {
  const SignShape* shape = nullptr;  ///< a row of sign_table()
  Token token = {};                  ///< the variation of this token
  std::int64_t begin = 0;
  std::int64_t stroke_begin = 0;
  std::int64_t stroke_end = 0;
  std::int64_t end = 0;
};

struct Timeline {
  FrameRate rate;
  std::vector<PlacedSign> signs;  ///< in order; neighbours of one unit touch
  std::int64_t frames = 0;        ///< including the rests before, between and after
};

/// Whether the hands rest after that sign.
bool ends_unit(const Timeline& timeline, std::size_t sign) noexcept;

/// Rest positions: in front of the belly between sentences, along the hips before the first and after the last.
enum class Rest { belly, hips };
/// `to_model` coordinates of the wrist.
Eigen::Vector3f rest_place(Rest rest = Rest::belly);

/// Gives every sign its frames and its token. Every bound is a whole number of milliseconds and of frames, and the
/// durations of transitions (those within units, and separately those across a rest) have the script's mean and
/// deviation up to rounding; longer paths take longer. Throws Error{unsupported} for a rate whose frames coincide with
/// whole milliseconds less often than every 50 ms.
Timeline schedule(const Script& script, FrameRate rate, Random& random);

/// Duration of a stroke without the token's own tempo, seconds.
double stroke_seconds(const SignShape& sign, const Token& token);

/// Approximate duration of a recording of that script, seconds.
double expected_seconds(const Script& script);

}  // namespace signweave::demo
