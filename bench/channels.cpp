// What parts of their own cost: an utterance of six signs in which the weak hand, then also the head, show other signs
// over three places, against the same places signed by the whole body. In "mirrored" the hand shows the sign of the
// other hand, and in "held" it keeps a pose. The first signing of a database is not counted.
//
// Arguments: --quick takes fewer rounds. --only NAME signs one case, for profilers: --only two_parts --rounds 100.

#include <array>
#include <cstdlib>
#include <string>

#include "bench/measure.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/notation/utterance.h"
#include "tests/demo_database.h"

namespace {

using namespace signweave;

struct Case {
  const char* name;
  const char* text;
  const char* goal;
};
constexpr const char* kWhole = "BRETAGNE VANNES MATIN LYON PLUIE SOLEIL-BRILLER";
constexpr std::array kCases = {
    Case{"one_part", "BRETAGNE [VANNES MATIN LYON | weak: BROUILLARD] PLUIE SOLEIL-BRILLER", "-"},
    Case{"two_parts", "BRETAGNE [VANNES MATIN LYON | weak: BROUILLARD | head: PARIS] PLUIE SOLEIL-BRILLER", "<= 1.5"},
    Case{"mirrored", "BRETAGNE [VANNES MATIN LYON | weak: BREST | head: PARIS] PLUIE SOLEIL-BRILLER", "<= 1.5"},
    Case{"held", "BRETAGNE{weak hold ..LYON} VANNES MATIN LYON PLUIE SOLEIL-BRILLER", "<= 1.5"},
};

}  // namespace

int main(int count, char** arguments) {
  bool quick = false;
  std::string only;
  int rounds = 0;
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--quick") quick = true;
    if (argument == "--only" && i + 1 < count) only = arguments[i + 1];
    if (argument == "--rounds" && i + 1 < count) rounds = std::atoi(arguments[i + 1]);
  }
  if (rounds == 0) rounds = quick ? 11 : 101;
  const bench::Folder folder("channels");
  const auto database = demo_database(folder.path() / "corpus.db", 2.0);
  Synthesis memory;
  const auto sign = [&](const char* text) {
    return [&, utterance = parse_utterance(text)] {
      Synthesized made = synthesize(*database, utterance, {}, std::move(memory));
      memory = std::move(made.result);
      bench::keep(memory);
    };
  };
  for (const Case& one : kCases) {
    if (!only.empty() && only != one.name) continue;
    bench::print(fmt::format("channels/{}", one.name), 1e3, "ms", bench::compare(rounds, sign(one.text), sign(kWhole)),
                 one.goal);
  }
  return 0;
}
