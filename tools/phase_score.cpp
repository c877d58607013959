#include "tools/phase_score.h"

#include <fmt/format.h>

#include <cassert>
#include <functional>
#include <set>

namespace signweave {
namespace {

double f1_of(std::size_t right, std::size_t missed, std::size_t wrong) {
  const std::size_t sum = 2 * right + missed + wrong;
  return sum == 0 ? 0 : 2 * static_cast<double>(right) / static_cast<double>(sum);
}

/// The moments more than kBorder away from every change of label.
std::vector<std::size_t> inner_moments(const LabelledTrack& recording) {
  const std::vector<Seconds>& times = recording.track.times;
  std::vector<bool> inner(times.size(), true);
  for (std::size_t change = 1; change < times.size(); ++change) {
    if (recording.labels[change] == recording.labels[change - 1]) continue;
    for (std::size_t i = change; i-- > 0 && times[change] - times[i] <= kBorder;) inner[i] = false;
    for (std::size_t i = change; i < times.size() && times[i] - times[change] <= kBorder; ++i) inner[i] = false;
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (inner[i]) result.push_back(i);
  }
  return result;
}

SplitScore score_left_out(std::span<const LabelledTrack> recordings, const TrainingOptions& options, std::string name,
                          const std::function<bool(const LabelledTrack&)>& left_out) {
  std::vector<const LabelledTrack*> learnt;
  for (const LabelledTrack& recording : recordings) {
    if (!left_out(recording)) learnt.push_back(&recording);
  }
  const PhaseModel model = train(learnt, options);
  SplitScore result{.name = std::move(name)};
  for (const LabelledTrack& recording : recordings) {
    if (!left_out(recording)) continue;
    const std::vector<MotionPhase> predicted = predicted_phases(model, recording);
    result.score.add(recording.labels, predicted);
    for (const std::size_t i : inner_moments(recording))
      result.inner.add({&recording.labels[i], 1}, {&predicted[i], 1});
  }
  return result;
}

}  // namespace

void PhaseScore::add(std::span<const MotionPhase> truth, std::span<const MotionPhase> predicted) {
  assert(truth.size() == predicted.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ++counts[static_cast<std::size_t>(truth[i])][static_cast<std::size_t>(predicted[i])];
  }
}

std::size_t PhaseScore::frames() const noexcept {
  std::size_t sum = 0;
  for (const auto& row : counts) {
    for (const std::size_t count : row) sum += count;
  }
  return sum;
}

double PhaseScore::f1(MotionPhase phase) const noexcept {
  const auto p = static_cast<std::size_t>(phase);
  std::size_t missed = 0;
  std::size_t wrong = 0;
  for (std::size_t other = 0; other < kMotionPhases; ++other) {
    if (other == p) continue;
    missed += counts[p][other];
    wrong += counts[other][p];
  }
  return f1_of(counts[p][p], missed, wrong);
}

double PhaseScore::macro_f1() const noexcept {
  double sum = 0;
  for (std::size_t phase = 0; phase < kMotionPhases; ++phase) sum += f1(static_cast<MotionPhase>(phase));
  return sum / kMotionPhases;
}

double PhaseScore::rest_accuracy() const noexcept {
  std::size_t wrong = 0;
  for (std::size_t phase = 1; phase < kMotionPhases; ++phase) wrong += counts[0][phase] + counts[phase][0];
  return frames() == 0 ? 0 : 1 - static_cast<double>(wrong) / static_cast<double>(frames());
}

double PhaseScore::rest_macro_f1() const noexcept {
  std::size_t missed = 0;
  std::size_t wrong = 0;
  for (std::size_t phase = 1; phase < kMotionPhases; ++phase) {
    missed += counts[0][phase];
    wrong += counts[phase][0];
  }
  return 0.5 * (f1_of(counts[0][0], missed, wrong) + f1_of(frames() - counts[0][0] - missed - wrong, missed, wrong));
}

std::vector<SplitScore> score_users_left_out(std::span<const LabelledTrack> recordings,
                                             const TrainingOptions& options) {
  std::set<char> users;
  for (const LabelledTrack& recording : recordings) users.insert(recording.user());
  std::vector<SplitScore> result;
  for (const char user : users) {
    result.push_back(score_left_out(recordings, options, fmt::format("user {} left out", user),
                                    [user](const LabelledTrack& recording) { return recording.user() == user; }));
  }
  return result;
}

std::vector<SplitScore> score_files_left_out(std::span<const LabelledTrack> recordings,
                                             const TrainingOptions& options) {
  std::vector<SplitScore> result;
  for (const LabelledTrack& one : recordings) {
    result.push_back(score_left_out(recordings, options, fmt::format("file {} left out", one.name),
                                    [&one](const LabelledTrack& recording) { return &recording == &one; }));
  }
  return result;
}

std::string table_of(std::span<const SplitScore> scores) {
  std::string text = fmt::format("{:<18}{:>7}", "", "frames");
  for (std::size_t phase = 0; phase < kMotionPhases; ++phase) {
    text += fmt::format("{:>12}", name_of(static_cast<MotionPhase>(phase)));
  }
  text += fmt::format("{:>8}{:>11}{:>11}{:>13}\n", "macro", "rest/non", "its macro", "inner macro");
  const auto line = [&](std::string_view name, std::span<const SplitScore> mean_of) {
    const auto mean = [&](const auto& value) {
      double sum = 0;
      for (const SplitScore& one : mean_of) sum += value(one.score);
      return sum / static_cast<double>(mean_of.size());
    };
    double inner = 0;
    for (const SplitScore& one : mean_of) inner += one.inner.macro_f1() / static_cast<double>(mean_of.size());
    std::size_t frames = 0;
    for (const SplitScore& one : mean_of) frames += one.score.frames();
    text += fmt::format("{:<18}{:>7}", name, frames);
    for (std::size_t phase = 0; phase < kMotionPhases; ++phase) {
      text +=
          fmt::format("{:>12.3f}", mean([&](const PhaseScore& s) { return s.f1(static_cast<MotionPhase>(phase)); }));
    }
    text += fmt::format("{:>8.3f}{:>11.3f}{:>11.3f}{:>13.3f}\n", mean([](const PhaseScore& s) { return s.macro_f1(); }),
                        mean([](const PhaseScore& s) { return s.rest_accuracy(); }),
                        mean([](const PhaseScore& s) { return s.rest_macro_f1(); }), inner);
  };
  for (const SplitScore& one : scores) line(one.name, {&one, 1});
  if (!scores.empty()) line("mean", scores);
  return text;
}

}  // namespace signweave
