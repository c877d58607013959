#include "demo/script.h"

namespace signweave::demo {

Script meteo() {
  return {.name = "meteo",
          .units = {{"BONJOUR", "METEO", "FRANCE"},
                    {"HIER", "NORD", "VENT", "FORT", "SUD", "ORAGE"},
                    {"MONTAGNE", "NEIGE", "FROID", "METEO", "FRANCE", "NORD", "SUD"},
                    {"ATTENTION",
                     "AUJOURD'HUI",
                     "SIX JUILLET",
                     "LE-TEMPS-PREVU",  // numbers in the unit: 1 to 4
                     "BRETAGNE",
                     "MATIN",
                     "NUAGES",
                     "APRES-MIDI",
                     "PLUIE",  // 5 to 9, today's prediction
                     "DEMAIN",
                     "SOLEIL-BRILLER",
                     "CHAUD-SEC-FERA",
                     "NAGER",  // 10 to 13
                     "CE-SERA-LE-MOMENT",
                     "VENDREDI",  // 14, 15
                     "NUAGES",
                     "NUIT",
                     "EN-MER",
                     "MATIN",
                     "BROUILLARD"}},  // 16 to 20, Friday's
          .transition_mean = 735ms,
          .transition_deviation = 224ms,
          .sink = 0.12f};
}

Script villes() {
  return {.name = "villes",
          .units = {{"VANNES", "PARIS", "LYON", "BREST"},
                    {"NANTES", "MARSEILLE", "QUIMPER", "RENNES"},
                    {"LORIENT", "BORDEAUX", "LE MANS", "TOULOUSE"},
                    {"LILLE", "SAINT-MALO", "STRASBOURG", "BRETAGNE"},
                    {"RENNES", "BREST", "LE MANS", "VANNES"},
                    {"PARIS", "MARSEILLE", "NANTES", "QUIMPER"},
                    {"BORDEAUX", "VANNES", "LYON", "LE MANS"}},
          .transition_mean = 1064ms,
          .transition_deviation = 289ms,
          .sink = 0.72f};
}

}  // namespace signweave::demo
