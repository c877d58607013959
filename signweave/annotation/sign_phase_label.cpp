#include <algorithm>

#include "signweave/annotation/sign.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

struct KnownLabel {
  std::string_view word;  ///< case folded, NFC
  PhaseKind kind;
};

/// Labels are matched whole, not by prefix: an unknown label is better reported than guessed. English, French, German,
/// Dutch, Portuguese, Spanish.
constexpr KnownLabel kLabels[] = {
    {"p", PhaseKind::preparation},
    {"prep", PhaseKind::preparation},
    {"preparation", PhaseKind::preparation},
    {"prép", PhaseKind::preparation},
    {"préparation", PhaseKind::preparation},
    {"vorb", PhaseKind::preparation},
    {"vorbereitung", PhaseKind::preparation},
    {"voorb", PhaseKind::preparation},
    {"voorbereiding", PhaseKind::preparation},
    {"preparação", PhaseKind::preparation},
    {"preparacao", PhaseKind::preparation},
    {"preparación", PhaseKind::preparation},
    {"preparacion", PhaseKind::preparation},
    {"s", PhaseKind::stroke},
    {"str", PhaseKind::stroke},
    {"stroke", PhaseKind::stroke},
    {"strokes", PhaseKind::stroke},
    {"coup", PhaseKind::stroke},
    {"noyau", PhaseKind::stroke},
    {"réalisation", PhaseKind::stroke},
    {"realisation", PhaseKind::stroke},
    {"ausführung", PhaseKind::stroke},
    {"kern", PhaseKind::stroke},
    {"slag", PhaseKind::stroke},
    {"golpe", PhaseKind::stroke},
    {"núcleo", PhaseKind::stroke},
    {"nucleo", PhaseKind::stroke},
    {"execução", PhaseKind::stroke},
    {"execucao", PhaseKind::stroke},
    {"r", PhaseKind::retraction},
    {"ret", PhaseKind::retraction},
    {"retr", PhaseKind::retraction},
    {"retract", PhaseKind::retraction},
    {"retraction", PhaseKind::retraction},
    {"recovery", PhaseKind::retraction},
    {"rest", PhaseKind::retraction},
    {"rétr", PhaseKind::retraction},
    {"rétraction", PhaseKind::retraction},
    {"repos", PhaseKind::retraction},
    {"retraktion", PhaseKind::retraction},
    {"rückzug", PhaseKind::retraction},
    {"rückführung", PhaseKind::retraction},
    {"ruhe", PhaseKind::retraction},
    {"retractie", PhaseKind::retraction},
    {"terugtrekking", PhaseKind::retraction},
    {"rust", PhaseKind::retraction},
    {"retração", PhaseKind::retraction},
    {"retracao", PhaseKind::retraction},
    {"repouso", PhaseKind::retraction},
    {"retracción", PhaseKind::retraction},
    {"retraccion", PhaseKind::retraction},
    {"reposo", PhaseKind::retraction},
    {"h", PhaseKind::hold},
    {"hold", PhaseKind::hold},
    {"stroke hold", PhaseKind::hold},
    {"pre hold", PhaseKind::hold},
    {"pre stroke hold", PhaseKind::hold},
    {"prestroke hold", PhaseKind::hold},
    {"post hold", PhaseKind::hold},
    {"post stroke hold", PhaseKind::hold},
    {"poststroke hold", PhaseKind::hold},
    {"independent hold", PhaseKind::hold},
    {"tenue", PhaseKind::hold},
    {"maintien", PhaseKind::hold},
    {"halten", PhaseKind::hold},
    {"haltephase", PhaseKind::hold},
    {"houd", PhaseKind::hold},
    {"vasthouden", PhaseKind::hold},
    {"retenção", PhaseKind::hold},
    {"retencao", PhaseKind::hold},
    {"suspensão", PhaseKind::hold},
    {"retención", PhaseKind::hold},
    {"retencion", PhaseKind::hold},
};

/// Maps "Stroke_2" and "retr." to "stroke" and "retr": separators become blanks, a counter or full stop at the end is
/// dropped.
std::string plain(std::string folded) {
  std::replace_if(
      folded.begin(), folded.end(), [](char c) { return c == '_' || c == '-'; }, ' ');
  const std::size_t last = folded.find_last_not_of(" .0123456789");
  if (last != std::string::npos) folded.resize(last + 1);
  return folded;
}

}  // namespace

PhaseKind phase_kind_of(std::string_view label, const TierNames& names) {
  const std::string folded = fold_case(match_form(label));
  if (const auto own = names.phase_labels.find(folded); own != names.phase_labels.end()) return own->second;
  const std::string word = plain(folded);
  for (const KnownLabel& known : kLabels) {
    if (known.word == word) return known.kind;
  }
  return PhaseKind::other;
}

std::string_view name_of(PhaseKind kind) noexcept {
  switch (kind) {
    case PhaseKind::preparation:
      return "preparation";
    case PhaseKind::stroke:
      return "stroke";
    case PhaseKind::retraction:
      return "retraction";
    case PhaseKind::hold:
      return "hold";
    case PhaseKind::other:
      return "other";
  }
  return "other";
}

}  // namespace signweave
