#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/cli/evaluation_input.h"
#include "app/cli/evaluation_report.h"
#include "app/cli/motion_options.h"
#include "app/cli/progress.h"
#include "app/cli/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/transition/method.h"

namespace signweave::cli {
namespace {

struct Options {
  std::vector<std::string> paths;
  std::vector<std::string> methods;
  std::vector<std::string> measures;
  std::string spans;
  std::string plot;
  std::uint64_t seed = 1;
  bool full = false;
  MotionOptions reading;
};

std::vector<const GapMethod*> methods_of(const Options& options) {
  std::vector<const GapMethod*> methods;
  for (const GapMethod& method : gap_methods()) {
    // What others are told over is always there.
    if (options.methods.empty() || method.name == "slerp" ||
        std::ranges::find(options.methods, method.name) != options.methods.end()) {
      methods.push_back(&method);
    }
  }
  return methods;
}

std::string check_method(const std::string& name) {
  if (find_gap_method(name) != nullptr) return {};
  std::vector<std::string> known;
  for (const GapMethod& method : gap_methods()) known.emplace_back(method.name);
  return fmt::format("no method '{}'{}", printable(name), did_you_mean(name, known));
}

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const MeasureInfo& info : measures()) names.emplace_back(info.name);
  return names;
}

std::string check_measure(const std::string& name) {
  const std::vector<std::string> known = measure_names();
  if (std::ranges::find(known, name) != known.end()) return {};
  return fmt::format("no measure '{}'{}", printable(name), did_you_mean(name, known));
}

/// Those that were asked for, in the order of asking; none: each task's own.
std::vector<Measure> measures_of(const Options& options) {
  std::vector<Measure> chosen;
  for (const std::string& name : options.measures) {
    for (const MeasureInfo& info : measures()) {
      if (info.name == name) chosen.push_back(info.measure);
    }
  }
  return chosen;
}

EvaluatedTask given_task(const EvaluationInput& input, const SpanChoice& choice,
                         const std::vector<const GapMethod*>& methods, Io& io) {
  EvaluatedTask task{.name = "duration given",
                     .key = "given",
                     .spans = choice.spans,
                     .groups = choice.groups,
                     .methods = {},
                     .summary = {Measure::wrist}};
  Progress progress(io, "duration given");
  task.methods =
      evaluate_given(input.recordings, task.spans, methods, [&](double fraction) { progress.show(fraction); });
  for (MethodScores& bound : evaluate_ceiling(input.recordings, task.spans)) task.methods.push_back(std::move(bound));
  return task;
}

/// Of spans whose length is the movement's own: annotated, natural, or from a table.
EvaluatedTask predicted_task(const EvaluationInput& input, const SpanChoice& choice,
                             const std::vector<const GapMethod*>& methods, Io& io) {
  EvaluatedTask task{.name = "duration predicted",
                     .key = "predicted",
                     .spans = {},
                     .groups = choice.groups,
                     .methods = {},
                     .summary = {Measure::duration, Measure::mean_duration, Measure::wrist}};
  for (const EvaluatedSpan& span : choice.spans) {
    if (!choice.is_fixed(span.group)) task.spans.push_back(span);
  }
  Progress progress(io, "duration predicted");
  task.methods =
      evaluate_predicted(input.recordings, task.spans, methods, [&](double fraction) { progress.show(fraction); });
  return task;
}

EvaluatedTask replaced_task(const EvaluationInput& input, const SpanChoice& choice,
                            const std::vector<const GapMethod*>& methods, Io& io) {
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
  Progress progress(io, "token replaced");
  task.methods = evaluate_replaced(input.recordings, replaced, choice.spans, methods,
                                   [&](double fraction) { progress.show(fraction); });
  return task;
}

nlohmann::ordered_json json_of_spans(const EvaluationInput& input, const SpanChoice& choice) {
  nlohmann::ordered_json spans = nlohmann::ordered_json::array();
  for (const EvaluatedSpan& span : choice.spans) {
    spans.push_back({{"file", input.recordings[span.recording].name},
                     {"first_frame", span.frames.begin},
                     {"frames", span.frames.size()},
                     {"group", choice.groups[span.group]},
                     {"moving_hand", span.moving == Side::left ? "left" : "right"},
                     {"speed_peaks", span.peaks}});
  }
  return spans;
}

/// What tells methods apart best, of each task.
constexpr Measure kDrawn[] = {Measure::wrist,      Measure::fingertips,    Measure::peak_speed_error,
                              Measure::jerk_error, Measure::velocity_jump, Measure::depth};

void draw(const std::string& path, const std::vector<EvaluatedTask>& tasks, Bootstrap& bootstrap) {
  std::vector<ErrorPanel> panels;
  for (const EvaluatedTask& task : tasks) {
    for (ErrorPanel& panel : panels_of(task, kDrawn, bootstrap)) panels.push_back(std::move(panel));
  }
  AtomicFile file(path);
  file.write(error_plot(panels));
  file.commit();
}

void run_evaluate(const Options& options, Io& io) {
  const EvaluationInput input = read_evaluation_input(options.paths, options.reading, io);
  if (input.recordings.empty()) {
    throw Error(ErrorCode::not_found, fmt::format("{}: no recording that can be evaluated on; there must be motion "
                                                  "with a wrist and at least {} frames",
                                                  fmt::join(options.paths, ", "), kLeastFrames));
  }
  const SpanChoice choice =
      options.spans.empty() ? choose_spans(input.recordings) : read_spans(options.spans, input.recordings);
  const std::vector<const GapMethod*> methods = methods_of(options);
  std::vector<EvaluatedTask> tasks = {given_task(input, choice, methods, io),
                                      predicted_task(input, choice, methods, io),
                                      replaced_task(input, choice, methods, io)};
  Bootstrap bootstrap(options.seed);
  if (io.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const EvaluatedTask& task : tasks) list.push_back(json_of(task, bootstrap));
    io.out << nlohmann::ordered_json{{"recordings", input.recordings.size()},
                                     {"recordings_left_out", input.left_out},
                                     {"spans_left_out", choice.left_out},
                                     {"seed", options.seed},
                                     {"confidence", kConfidence},
                                     {"tasks", std::move(list)},
                                     {"spans", json_of_spans(input, choice)}}
                  .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
           << '\n';
    if (!options.plot.empty()) draw(options.plot, tasks, bootstrap);
    return;
  }
  io.out << fmt::format("{}, {} left out; {}, {} left out for defects of the capture\n",
                        counted(input.recordings.size(), "recording"), input.left_out,
                        counted(choice.spans.size(), "span"), choice.left_out);
  const std::vector<Measure> chosen = measures_of(options);
  for (const EvaluatedTask& task : tasks) {
    io.out << '\n' << summary_text(task, chosen.empty() ? task.summary : chosen, bootstrap);
    if (chosen.empty()) io.out << default_text(task, bootstrap);
  }
  if (options.full) {
    for (const EvaluatedTask& task : tasks) io.out << full_text(task, bootstrap);
  }
  // After what was computed is told: a plot that cannot be written loses nothing else.
  if (!options.plot.empty()) draw(options.plot, tasks, bootstrap);
}

}  // namespace

Run evaluate(CLI::App& verb) {
  auto options = std::make_shared<Options>();
  verb.add_option("PATH", options->paths, "databases, motion files (.bvh), or folders of them")->required();
  verb.add_option("--method", options->methods, "this method alone, beside slerp; may be given again")
      ->check(check_method);
  verb.add_option("--measure", options->measures, "a table of this measure, by its name in JSON; may be given again")
      ->check(check_measure);
  verb.add_option("--spans", options->spans, "a table of spans: CSV with file, first frame, frames, perhaps a group")
      ->type_name("FILE.csv");
  verb.add_flag("--full", options->full, "every measure of every group and hand, with intervals");
  verb.add_option("--plot", options->plot, "draw the summary with intervals (.svg)")
      ->check([](const std::string& path) {
        return fold_case(path).ends_with(".svg") ? std::string()
                                                 : fmt::format("{}: a plot is written as .svg", printable(path));
      });
  verb.add_option("--seed", options->seed, "of the resampling that intervals come from")
      ->check([](const std::string& text) { return text.starts_with('-') ? "a seed is not negative" : std::string(); })
      ->capture_default_str();
  add_motion_options(verb, options->reading);
  return [options](Io& io) { run_evaluate(*options, io); };
}

}  // namespace signweave::cli
