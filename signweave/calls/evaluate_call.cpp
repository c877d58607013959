#include "signweave/calls/evaluate_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "signweave/calls/aim_report.h"
#include "signweave/calls/collection_report.h"
#include "signweave/core/text.h"
#include "signweave/evaluation/collection_table.h"
#include "signweave/evaluation/folds.h"

namespace signweave::calls {
namespace {

std::vector<const GapMethod*> methods_of(const EvaluateCall& call) {
  std::vector<const GapMethod*> methods;
  for (const GapMethod& method : gap_methods()) {
    // The reference of the ratios is always included.
    if (call.methods.empty() || method.name == "slerp" ||
        std::ranges::find(call.methods, method.name) != call.methods.end()) {
      methods.push_back(&method);
    }
  }
  return methods;
}

EvaluatedTask given_task(const EvaluationInput& input, const SpanChoice& choice,
                         const std::vector<const GapMethod*>& methods, const Listener& listener) {
  EvaluatedTask task{.name = "duration given",
                     .key = "given",
                     .spans = choice.spans,
                     .groups = choice.groups,
                     .methods = {},
                     .summary = {Measure::wrist}};
  listener.begin("duration given");
  task.methods =
      evaluate_given(input.recordings, task.spans, methods, [&](double fraction) { listener.advance(fraction); });
  for (MethodScores& bound : evaluate_ceiling(input.recordings, task.spans)) task.methods.push_back(std::move(bound));
  return task;
}

/// Evaluates spans whose length is the movement's own: annotated, natural, or from a table.
EvaluatedTask predicted_task(const EvaluationInput& input, const SpanChoice& choice,
                             const std::vector<const GapMethod*>& methods, const Listener& listener) {
  EvaluatedTask task{.name = "duration predicted",
                     .key = "predicted",
                     .spans = {},
                     .groups = choice.groups,
                     .methods = {},
                     .summary = {Measure::duration, Measure::mean_duration, Measure::wrist}};
  for (const EvaluatedSpan& span : choice.spans) {
    if (!choice.is_fixed(span.group)) task.spans.push_back(span);
  }
  listener.begin("duration predicted");
  task.methods =
      evaluate_predicted(input.recordings, task.spans, methods, [&](double fraction) { listener.advance(fraction); });
  return task;
}

EvaluatedTask replaced_task(const EvaluationInput& input, const SpanChoice& choice,
                            const std::vector<const GapMethod*>& methods, const Listener& listener) {
  EvaluatedTask task{.name = "token replaced",
                     .key = "replaced",
                     .spans = {},
                     .groups = {"same gloss", "other sign"},
                     .methods = {},
                     .summary = {Measure::peak_speed_error}};
  const std::vector<ReplacedSpan> replaced = choose_replaced(input.recordings);
  for (const ReplacedSpan& one : replaced) {
    task.spans.push_back(one.span);
    task.spans.back().group = one.same_gloss ? 0 : 1;
  }
  listener.begin("token replaced");
  task.methods = evaluate_replaced(input.recordings, replaced, choice.spans, methods,
                                   [&](double fraction) { listener.advance(fraction); });
  return task;
}

std::vector<SpanAnswer> span_answers(const EvaluationInput& input, const SpanChoice& choice) {
  std::vector<SpanAnswer> spans;
  for (const EvaluatedSpan& span : choice.spans) {
    spans.push_back({.file = input.recordings[span.recording].name,
                     .first_frame = span.frames.begin,
                     .frames = span.frames.size(),
                     .group = choice.groups[span.group],
                     .moving_hand = span.moving == Side::left ? "left" : "right",
                     .speed_peaks = span.peaks});
  }
  return spans;
}

/// Sets the collection of each recording in a task.
void add_collections(const EvaluationInput& input, EvaluatedTask& task) {
  std::set<std::string> names;
  for (const EvaluatedMotion& one : input.recordings) names.insert(one.collection);
  task.collections.assign(names.begin(), names.end());
  for (const EvaluatedMotion& one : input.recordings) {
    const auto place = std::ranges::find(task.collections, one.collection) - task.collections.begin();
    task.collection_of.push_back(static_cast<std::size_t>(place));
  }
}

/// The measures that best distinguish the methods, for each task.
constexpr Measure kDrawn[] = {Measure::wrist,      Measure::fingertips,    Measure::peak_speed_error,
                              Measure::jerk_error, Measure::velocity_jump, Measure::depth};

}  // namespace

std::string plot_of(const std::vector<EvaluatedTask>& tasks, Bootstrap& bootstrap) {
  std::vector<ErrorPanel> panels;
  for (const EvaluatedTask& task : tasks) {
    for (ErrorPanel& panel : panels_of(task, kDrawn, bootstrap)) panels.push_back(std::move(panel));
  }
  return error_plot(panels);
}

std::string check_method(const std::string& name) {
  if (find_gap_method(name) != nullptr) return {};
  std::vector<std::string> known;
  for (const GapMethod& method : gap_methods()) known.emplace_back(method.name);
  return fmt::format("no method '{}'{}", printable(name), did_you_mean(name, known));
}

Evaluated evaluate(EvaluationInput input, SpanChoice choice, const EvaluateCall& call, const Listener& listener) {
  const std::vector<const GapMethod*> methods = methods_of(call);
  Evaluated made{.input = std::move(input), .choice = std::move(choice), .tasks = {}, .left_out_by = {}};
  made.left_out_by = folds_of(made.input.recordings).by;
  made.tasks.push_back(given_task(made.input, made.choice, methods, listener));
  made.tasks.push_back(predicted_task(made.input, made.choice, methods, listener));
  made.tasks.push_back(replaced_task(made.input, made.choice, methods, listener));
  for (EvaluatedTask& task : made.tasks) add_collections(made.input, task);
  return made;
}

Evaluated evaluate_aimed(EvaluationInput input, const Listener& listener) {
  Evaluated made{.input = std::move(input), .choice = {}, .tasks = {}, .left_out_by = "locus"};
  listener.begin("aim");
  made.aim = evaluate_aim(made.input.recordings, [&](double fraction) { listener.advance(fraction); });
  return made;
}

Evaluated run(const Database& database, const EvaluateCall& call, const Listener& listener) {
  EvaluationInput input = read_evaluation_input(database, listener);
  require_recordings(input, "the database");
  if (call.task == "aim") return evaluate_aimed(std::move(input), listener);
  if (!call.collections.empty()) {
    TextReader table("collections", call.collections);
    read_collections(table, input.recordings, input.left_out);
  }
  SpanChoice choice = choose_spans(input.recordings);
  return evaluate(std::move(input), std::move(choice), call, listener);
}

void require_recordings(const EvaluationInput& input, const std::string& where) {
  if (!input.recordings.empty()) return;
  throw Error(ErrorCode::not_found, fmt::format("{}: no recording that can be evaluated on; there must be motion "
                                                "with a wrist and at least {} frames",
                                                where, kLeastFrames));
}

EvaluationAnswer answer_of(const Evaluated& evaluated, const EvaluateCall& call, Bootstrap& bootstrap) {
  EvaluationAnswer answer{.recordings = evaluated.input.recordings.size(),
                          .recordings_left_out = evaluated.input.left_out.size(),
                          .left_out_by = evaluated.left_out_by,
                          .judged = {},
                          .spans_left_out = evaluated.choice.left_out,
                          .seed = call.seed,
                          .confidence = kConfidence,
                          .tasks = {},
                          .spans = span_answers(evaluated.input, evaluated.choice)};
  if (evaluated.aim) {
    answer.aim = aim_answer(*evaluated.aim);
    return answer;
  }
  // In this order: the bootstrap draws from one sequence of random numbers.
  for (const EvaluatedTask& task : evaluated.tasks) answer.tasks.push_back(answer_of(task, bootstrap));
  answer.judged = judged_answers(evaluated.tasks.front(), bootstrap);
  return answer;
}

}  // namespace signweave::calls
