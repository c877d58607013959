#include "signweave/query/vocabulary.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "signweave/query/keywords.h"
#include "signweave/query/movement_term.h"

namespace signweave {

Vocabulary vocabulary(const Segments& segments) {
  std::map<std::string, std::size_t, std::less<>> tokens;
  for (const Segments::Member& member : segments.members()) {
    const SegmentTable& table = member.table;
    for (const std::uint32_t label : table.labels_of(RowKind::sign)) {
      const std::span<const RowId> rows = table.with_label(RowKind::sign, label);
      const auto counts = [&](RowId row) { return member.numbers[table.recording(row)] != Segments::kNone; };
      const auto found = member.whole ? std::ssize(rows) : std::ranges::count_if(rows, counts);
      if (found > 0) tokens[std::string(table.text_at(label))] += static_cast<std::size_t>(found);
    }
  }
  std::set<std::string, std::less<>> signers;
  for (std::uint32_t recording = 0; recording < segments.recording_count(); ++recording) {
    const SegmentTable::RecordingRef part = segments.part(recording);
    for (const SegmentTable::TierRows& tier : part.table->tiers_of(part.recording)) {
      const std::string_view signer = part.table->text_at(tier.signer);
      if (!signer.empty() && !signers.contains(signer)) signers.emplace(signer);
    }
  }
  Vocabulary result{.glosses = {},
                    .tiers = segments.tiers(),
                    .recordings = segments.recordings(),
                    .signers = {signers.begin(), signers.end()}};
  result.glosses.reserve(tokens.size());
  for (const auto& [gloss, count] : tokens) result.glosses.push_back({gloss, count});
  return result;
}

std::vector<LabelCount> labels_of(const Segments& segments, std::string_view tier) {
  std::map<std::string, std::size_t, std::less<>> annotations;
  for (const Segments::Member& member : segments.members()) {
    const SegmentTable& table = member.table;
    const std::uint32_t number = table.find_tier(tier);
    if (number == SegmentTable::kNone) continue;
    std::unordered_map<std::uint32_t, std::size_t> counts;  // by the table's label numbers
    for (std::uint32_t recording = 0; recording < table.recording_count(); ++recording) {
      const SegmentTable::TierRows* rows = table.tier_rows(recording, number);
      if (rows == nullptr || member.numbers[recording] == Segments::kNone) continue;
      for (RowId row = rows->own().begin; row < rows->own().end; ++row) ++counts[table.label(row)];
    }
    for (const auto& [label, count] : counts) {
      if (!table.text_at(label).empty()) annotations[std::string(table.text_at(label))] += count;
    }
  }
  std::vector<LabelCount> result;
  result.reserve(annotations.size());
  for (const auto& [label, count] : annotations) result.push_back({label, count});
  return result;
}

LanguageWords language_words() {
  LanguageWords words{.fields = words_of(kFields),
                      .links = words_of(kLinks),
                      .phases = words_of(kPhaseKinds),
                      .hands = words_of(kHands),
                      .two_handed = words_of(kHandsClasses),
                      .functions = words_of(kQuantities),
                      .points = point_words()};
  words.functions.emplace_back("like");
  return words;
}

}  // namespace signweave
