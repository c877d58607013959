#include "signweave/evaluation/judge.h"

#include <set>

namespace signweave {

std::vector<std::size_t> Judgement::worse_in() const {
  std::vector<std::size_t> worse;
  for (std::size_t i = 0; i < collections.size(); ++i) {
    if (collections[i].low > 1) worse.push_back(i);
  }
  return worse;
}

bool Judgement::wins() const {
  return all.value < 1 && worse_in().empty();
}

Judgement judge(const MethodScores& method, const MethodScores& other, std::span<const EvaluatedSpan> spans,
                std::span<const std::size_t> collection_of, std::size_t collections, Bootstrap& bootstrap) {
  std::vector<std::set<std::size_t>> recordings(collections);
  for (const EvaluatedSpan& span : spans) recordings[collection_of[span.recording]].insert(span.recording);
  std::vector<ClusteredScore> all;
  std::vector<std::vector<ClusteredScore>> apart(collections);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const std::size_t collection = collection_of[spans[i].recording];
    const ClusteredScore score{.cluster = recordings[collection].size() > 1 ? spans[i].recording : i,
                               .score = {method.spans[i].at(HandChoice::moving, Measure::wrist).value,
                                         other.spans[i].at(HandChoice::moving, Measure::wrist).value},
                               .collection = collection,
                               .part = spans[i].group};
    all.push_back(score);
    apart[collection].push_back(score);
  }
  Judgement judgement{.method = method.name, .collections = {}, .all = bootstrap.estimate(all, Pooling::ratio)};
  for (const auto& scores : apart) judgement.collections.push_back(bootstrap.estimate(scores, Pooling::ratio));
  return judgement;
}

}  // namespace signweave
