#include "signweave/evaluation/folds.h"

#include <map>
#include <set>
#include <string>

namespace signweave {
namespace {

/// Assigns a number to each distinct key, in the order of the recordings.
template <class KeyOf>
Folds numbered(std::span<const EvaluatedMotion> recordings, std::string_view by, KeyOf key_of) {
  Folds folds{.of = {}, .count = 0, .by = by};
  std::map<std::string, std::size_t> numbers;
  for (const EvaluatedMotion& recording : recordings) {
    folds.of.push_back(numbers.try_emplace(key_of(recording), numbers.size()).first->second);
  }
  folds.count = numbers.size();
  return folds;
}

/// Joins collections that share a performer.
void join_by_performer(std::span<const EvaluatedMotion> recordings, Folds& folds) {
  std::map<std::string, std::size_t> fold_of;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    if (recordings[i].performer.empty()) continue;
    const auto [known, is_new] = fold_of.try_emplace(recordings[i].performer, folds.of[i]);
    if (is_new || known->second == folds.of[i]) continue;
    const std::size_t gone = folds.of[i];
    const std::size_t stays = known->second;
    for (std::size_t& fold : folds.of) fold = fold == gone ? stays : fold;
    for (auto& [performer, fold] : fold_of) fold = fold == gone ? stays : fold;
  }
  folds.count = std::set<std::size_t>(folds.of.begin(), folds.of.end()).size();
}

}  // namespace

Folds folds_of(std::span<const EvaluatedMotion> recordings) {
  Folds folds = numbered(recordings, "collection", [](const EvaluatedMotion& one) { return one.collection; });
  if (folds.count > 1) join_by_performer(recordings, folds);
  if (folds.count > 1) return folds;
  folds = numbered(recordings, "signer", [](const EvaluatedMotion& one) { return one.performer; });
  std::set<std::string> known;
  for (const EvaluatedMotion& one : recordings) {
    if (!one.performer.empty()) known.insert(one.performer);
  }
  if (known.size() > 1) return folds;
  folds = {.of = {}, .count = recordings.size(), .by = "recording"};
  for (std::size_t i = 0; i < recordings.size(); ++i) folds.of.push_back(i);
  return folds;
}

}  // namespace signweave
