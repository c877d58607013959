#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/sign.h"

namespace signweave {

/// What the name of a tier says. Names of many corpora: "RH-IDgloss", "GlossL S1", "Lexem_Gebärde_r_A", "Glose MD",
/// "gloss@A".
struct TierName {
  std::vector<std::string> words;  ///< case folded; split at punctuation, digits and "aB"
  Hand hand = Hand::both;          ///< both where it says nothing
  std::string signer;              ///< as written: what follows '@', or "A", "S1" at the end; empty where there is none
  int sign_score = 0;              ///< 0: no sign tier; 3: says gloss; 2: says sign
  bool says_phase = false;
};

TierName read_tier_name(std::string_view name);

}  // namespace signweave
