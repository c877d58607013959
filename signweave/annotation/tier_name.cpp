#include "signweave/annotation/tier_name.h"

#include <algorithm>
#include <cctype>

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::string_view kGlossWords[] = {"gloss",    "glosses", "glosse", "glossen", "glose",     "gloses",
                                            "glosa",    "glosas",  "glossa", "idgloss", "idglosses", "idglose",
                                            "idgloses", "lexem",   "lexeme", "lexemes", "lexeem",    "lexème",
                                            "lexèmes",  "lexema",  "lexemas"};
constexpr std::string_view kSignWords[] = {"sign",     "signs",  "signe",   "signes", "signo", "signos",  "segno",
                                           "segni",    "sinal",  "sinais",  "seña",   "señas", "gebärde", "gebärden",
                                           "gebaerde", "gebaar", "gebaren", "tecken", "znak",  "viittoma"};
constexpr std::string_view kPhaseWords[] = {"phase", "phases", "fase", "fases", "phasen", "fasen"};
constexpr std::string_view kRightWords[] = {"r",     "rh",     "right",  "rhand",   "righthand", "md",    "droite",
                                            "droit", "rechts", "rechte", "direita", "derecha",   "destra"};
constexpr std::string_view kLeftWords[] = {"l",      "lh",    "left",  "lhand",    "lefthand",  "mg",
                                           "gauche", "links", "linke", "esquerda", "izquierda", "sinistra"};
/// Tiers *about* signs: their meaning, form or comments on them.
constexpr std::string_view kOtherWords[] = {
    "translation", "traduction", "übersetzung", "vertaling",   "tradução",  "traducción", "meaning",     "sens",
    "bedeutung",   "comment",    "comments",    "commentaire", "kommentar", "note",       "notes",       "mouth",
    "mouthing",    "mundbild",   "mundgestik",  "handshape",   "location",  "movement",   "orientation", "type",
    "class",       "pos",        "role",        "sentence",    "phrase",    "language",   "langue",      "text",
    "variant",     "status",     "check",       "question",    "citation",  "nonmanual",  "gaze",        "hamnosys"};

template <std::size_t N>
bool is_among(std::string_view word, const std::string_view (&words)[N]) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

enum class Letter { upper, lower, digit, none };

Letter kind_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte >= 0x80) return Letter::lower;  // part of a letter beyond ASCII
  if (std::isdigit(byte) != 0) return Letter::digit;
  if (std::isupper(byte) != 0) return Letter::upper;
  return std::islower(byte) != 0 ? Letter::lower : Letter::none;
}

/// The words as written.
std::vector<std::string> split(std::string_view name) {
  std::vector<std::string> words;
  Letter before = Letter::none;
  for (const char c : name) {
    const Letter now = kind_of(c);
    if (now != Letter::none) {
      const bool joins = before != Letter::none && (before == Letter::digit) == (now == Letter::digit) &&
                         !(before == Letter::lower && now == Letter::upper);
      if (!joins) words.emplace_back();
      words.back() += c;
    }
    before = now;
  }
  return words;
}

bool is_number(std::string_view word) {
  return !word.empty() && kind_of(word.front()) == Letter::digit;
}

}  // namespace

TierName read_tier_name(std::string_view name) {
  TierName result;
  const std::string form = match_form(name);
  const std::size_t at = form.find('@');
  if (at != std::string::npos) result.signer = std::string(trimmed(std::string_view(form).substr(at + 1)));
  const std::vector<std::string> written = split(std::string_view(form).substr(0, at));
  for (const std::string& word : written) result.words.push_back(fold_case(word));
  bool about = false;
  for (std::string& word : result.words) {
    // "RHIDgloss", "lhgloss": the hand is written together with the word.
    if (word.size() > 5 && (word.starts_with("rh") || word.starts_with("lh")) &&
        is_among(std::string_view(word).substr(2), kGlossWords)) {
      result.hand = word[0] == 'r' ? Hand::right : Hand::left;
      word.erase(0, 2);
    }
    if (is_among(word, kGlossWords)) result.sign_score = 3;
    if (is_among(word, kSignWords)) result.sign_score = std::max(result.sign_score, 2);
    if (is_among(word, kPhaseWords)) result.says_phase = true;
    if (is_among(word, kOtherWords)) about = true;
    if (is_among(word, kRightWords)) result.hand = Hand::right;
    if (is_among(word, kLeftWords)) result.hand = Hand::left;
  }
  if (about || result.says_phase) result.sign_score = 0;
  if (result.signer.empty() && written.size() > 1) {
    const std::string& last = written.back();
    const std::string& before = written[written.size() - 2];
    const auto is_letter = [](const std::string& word) {
      return word.size() == 1 && kind_of(word.front()) == Letter::upper && word != "R" && word != "L";
    };
    if (is_letter(last)) result.signer = last;
    if (is_number(last) && written.size() > 2 && is_letter(before)) result.signer = before + last;
  }
  return result;
}

}  // namespace signweave
