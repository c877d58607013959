#include "signweave/database/learn.h"

#include <algorithm>

#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/database/joins.h"
#include "signweave/features/transition_stats.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

// Limits of a fit of durations; recordings and transitions are evenly spread.
constexpr std::size_t kMostFittedRecordings = 24;
constexpr std::size_t kMostFittedTransitions = 400;

bool is_stroke(const Phase& phase) {
  return phase.kind == PhaseKind::stroke;
}

/// Adds the annotated transitions of one recording.
void add_transitions(const Snapshot& snapshot, std::uint32_t recording, std::vector<TimedTransition>& out) {
  const Segments& segments = snapshot.contents().segments;
  const std::vector<Sign> signs = signs_of(segments, recording);
  std::vector<AnnotatedTransition> transitions = transitions_in(signs);
  std::erase_if(transitions, [](const AnnotatedTransition& one) { return one.inferred; });
  if (transitions.empty()) return;
  const RecordingFeatures features = snapshot.features(recording);
  const auto places = phase_places_of(segments, recording);
  if (!features.why_not.empty() || places.size() != signs.size()) return;
  for (const AnnotatedTransition& one : transitions) {
    const std::vector<Phase>& from = signs[one.from].phases;
    const std::vector<Phase>& to = signs[one.to].phases;
    const auto last = std::ranges::find_if(from.rbegin(), from.rend(), is_stroke);
    const auto first = std::ranges::find_if(to, is_stroke);
    if (last == from.rend() || first == to.end()) continue;
    const std::size_t before = places[one.from][static_cast<std::size_t>(from.rend() - last) - 1];
    const std::size_t after = places[one.to][static_cast<std::size_t>(first - to.begin())];
    if (std::max(before, after) >= features.phases.size()) continue;
    out.push_back({.task = task_between(features.phases[before], features.phases[after], features.shoulder_width),
                   .duration = one.span.duration(),
                   .recording = recording});
  }
}

void count_signs(const Segments& segments, semantic_db::Learned& learned) {
  for (const Segments::Member& member : segments.members()) {
    for (RowId row = 0; row < member.table.size(); ++row) {
      if (member.table.kind(row) != RowKind::sign || member.numbers[member.table.recording(row)] == Segments::kNone)
        continue;
      ++(member.table.inferred(row) ? learned.unphased_signs : learned.phased_signs);
    }
  }
}

/// True if a stored record is recent enough: a few more recordings change little.
bool still_hold(const semantic_db::Learned& stored, std::uint64_t changes) noexcept {
  return stored.changes <= changes && changes - stored.changes <= changes / 16;
}

}  // namespace

std::vector<TimedTransition> timed_transitions(const Snapshot& snapshot) {
  const Contents& contents = snapshot.contents();
  std::vector<std::uint32_t> recordings;
  for (std::uint32_t i = 0; i < contents.recordings.size(); ++i) {
    if (contents.recordings[i].motion && contents.recordings[i].document != 0) recordings.push_back(i);
  }
  const std::size_t used = std::min(recordings.size(), kMostFittedRecordings);
  std::vector<TimedTransition> all;
  for (std::size_t i = 0; i < used; ++i) {
    add_transitions(snapshot, recordings[i * recordings.size() / used], all);
  }
  if (all.size() <= kMostFittedTransitions) return all;
  std::vector<TimedTransition> some;
  for (std::size_t i = 0; i < kMostFittedTransitions; ++i) some.push_back(all[i * all.size() / kMostFittedTransitions]);
  return some;
}

semantic_db::Learned learn_from(const Snapshot& snapshot) {
  semantic_db::Learned learned{.weights = learn_joins(snapshot), .durations = {}};
  const Contents& contents = snapshot.contents();
  // Inferred transitions are gaps between signs that contain their own transitions, so their task is unknown.
  if (contents.transitions.count > 0 && !contents.transitions.inferred) {
    learned.durations = fit_durations(timed_transitions(snapshot));
  }
  count_signs(contents.segments, learned);
  learned.residuals = learn_movements(snapshot);
  return learned;
}

bool nearly_same(const semantic_db::Learned& a, const semantic_db::Learned& b) noexcept {
  return nearly_same(a.weights, b.weights) && nearly_same(a.durations, b.durations) &&
         nearly_same(a.residuals, b.residuals) && a.phased_signs == b.phased_signs &&
         a.unphased_signs == b.unphased_signs;
}

std::shared_ptr<const semantic_db::Learned> Snapshot::learned() const {
  const Database& database = *database_;
  {
    const std::lock_guard guard(database.mutex_);
    if (database.contents_ == contents_ && database.kept_.learned) return database.kept_.learned;
  }
  std::optional<semantic_db::Learned> stored;
  try {
    stored = semantic_db::read_learned(*transaction_);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
  }
  const bool hold = stored && still_hold(*stored, catalogue::read_head(*transaction_).changes);
  auto made = std::make_shared<const semantic_db::Learned>(hold ? *stored : learn_from(*this));
  const std::lock_guard guard(database.mutex_);
  if (database.contents_ == contents_) database.kept_.learned = made;
  return made;
}

bool Database::learn() {
  require_writable();
  try {  // before the contents are read, which are often not needed
    const std::unique_ptr<kv::ReadTransaction> before = store_->read();
    const std::optional<semantic_db::Learned> stored = semantic_db::read_learned(*before);
    if (stored && still_hold(*stored, catalogue::read_head(*before).changes)) return false;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
  }
  const Snapshot now = snapshot();
  semantic_db::Learned learned = learn_from(now);
  learned.changes = catalogue::read_head(*now.transaction_).changes;
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  semantic_db::put_learned(*transaction, learned);
  transaction->commit();
  return true;
}

}  // namespace signweave
