#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/sign.h"

namespace signweave {

/// What the name of a tier indicates. Handles names of many corpora: "RH-IDgloss", "GlossL S1", "Lexem_Gebärde_r_A",
/// "Glose MD", "gloss@A".
struct TierName {
  std::vector<std::string> words;  ///< case folded; split at punctuation, digits and "aB"
  Hand hand = Hand::both;          ///< `both` if the name indicates no hand
  std::string signer;              ///< as written: the text after '@', or "A", "S1" at the end; empty if there is none
  int sign_score = 0;              ///< 0: not a sign tier; 3: the name says gloss; 2: it says sign
  bool says_phase = false;
};

TierName read_tier_name(std::string_view name);

}  // namespace signweave
