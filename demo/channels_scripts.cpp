#include "demo/channels.h"

namespace signweave::demo {

using enum Marking;

ChannelScript mains() {
  constexpr Side left = Side::left;
  return {.name = "mains",
          .units = {{.places = {{"BONJOUR"}, {"METEO"}, {"CARTE"}, {"SOMMET"}}},
                    {.places = {{"DEMAIN"}, {"NORD"}, {"SOLEIL-BRILLER"}, {"OUEST"}, {"ORAGE"}},
                     .held = {{"REGION", 1, 3, 150ms}}},
                    {.places = {{"NEIGE"}, {"SOMMET"}, {"ORAGE"}, {"FORT"}, {"BROUILLARD"}}},
                    {.places = {{"PREMIER"}, {"LUNDI"}, {"DEUXIEME"}, {"MARDI"}, {"TROISIEME"}, {"JEUDI"}},
                     .held = {{"LISTE", 0, 4, 200ms}}},
                    {.places = {{"BREST"}, {"QUIMPER", left}, {"RENNES"}, {"LYON", left}, {"LILLE"}, {"SUD", left}}},
                    {.places = {{"MOI"}, {"PARLER"}, {"SUD"}, {"PEU"}, {"EST"}, {"NEIGE"}},
                     .held = {{"REGION", 2, 4, 50ms}}},
                    {.places = {{"CARTE"}, {"ARRIVER"}, {"TRAVAILLER"}, {"PARLER"}, {"MOI"}, {"METEO"}}}},
          .tiers = {.glosses = {"Glose MG", "Glose MD"},
                    .phases = {"Phase MG", "Phase MD"},
                    .preparation = "Préparation",
                    .stroke = "Stroke",
                    .hold = "Tenue",
                    .retraction = "Rétraction"}};
}

ChannelScript visage() {
  return {.name = "visage",
          .units = {{.places = {{"BONJOUR", Side::right, "bonjour"}, {"METEO", Side::right, "météo"}}},
                    {.places = {{"DEMAIN", Side::right, "demain"}, {"PLEUVOIR", Side::right, "pleuvoir"}},
                     .marked = {{brows_raised, 0, 1}}},
                    {.places = {{"DEMAIN", Side::right, "demain"}, {"NON", Side::right, "non"}, {"PLEUVOIR"}},
                     .marked = {{head_shake, 1, 2}}},
                    {.places = {{"PARIS", Side::right, "Paris"},
                                {"NANTES", Side::right, "Nantes"},
                                {"BREST", Side::right, "Brest"},
                                {"MARSEILLE", Side::right, "Marseille"}},
                     .marked = {{gaze_right, 1, 2}}},
                    {.places = {{"NEIGE", Side::right, "neige"}, {"OU", Side::right, "où"}},
                     .marked = {{brows_lowered, 0, 1}}},
                    {.places = {{"EST", Side::right, "est"}, {"NORD", Side::right, "nord"}, {"SUD"}},
                     .held = {{"REGION", 0, 2, 180ms}},
                     .marked = {{gaze_left, 0, 1}, {head_shake, 2, 2}}},
                    {.places = {{"LYON", Side::right, "Lyon"}, {"SOLEIL-BRILLER", Side::right, "soleil"}},
                     .marked = {{brows_raised, 0, 1}}},
                    {.places = {{"OUI", Side::right, "oui"}, {"SOLEIL-BRILLER", Side::right, "soleil"}},
                     .marked = {{head_nod, 0, 0}, {gaze_right, 1, 1}}},
                    {.places = {{"ORAGE", Side::right, "orage"}, {"QUAND", Side::right, "quand"}},
                     .marked = {{brows_lowered, 0, 1}}},
                    {.places = {{"SAMEDI", Side::right, "samedi"},
                                {"VANNES", Side::right, "Vannes"},
                                {"RENNES", Side::right, "Rennes"}},
                     .marked = {{gaze_left, 1, 2}}},
                    {.places = {{"MERCI", Side::right, "merci"}, {"AU-REVOIR", Side::right, "au revoir"}}}},
          .tiers = {.glosses = {"GlossL", "GlossR"},
                    .phases = {"PhaseL", "PhaseR"},
                    .preparation = "Preparation",
                    .stroke = "Stroke",
                    .hold = "Hold",
                    .retraction = "Retraction"}};
}

}  // namespace signweave::demo
