#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/wire/text.h"
#include "signweave/calls/aim_report.h"
#include "signweave/calls/collection_report.h"
#include "signweave/calls/evaluate_call.h"
#include "signweave/calls/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/evaluation/collection_table.h"
#include "signweave/formats/file_format.h"
#include "signweave/formats/write_file.h"

namespace signweave::cli {
namespace {

struct EvaluateArguments {
  std::vector<std::string> paths;
  calls::EvaluateCall call;
  std::vector<std::string> measures;
  std::string spans;
  std::string plot;
  bool full = false;
  calls::MotionReading reading;
};

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

/// The requested measures, in the order of the request; if empty, each task's own.
std::vector<Measure> measures_of(const EvaluateArguments& options) {
  std::vector<Measure> chosen;
  for (const std::string& name : options.measures) {
    for (const MeasureInfo& info : measures()) {
      if (info.name == name) chosen.push_back(info.measure);
    }
  }
  return chosen;
}

void draw(const std::string& path, const std::vector<EvaluatedTask>& tasks, Bootstrap& bootstrap) {
  AtomicFile file(path);
  file.write(plot_of(tasks, bootstrap));
  file.commit();
}

void show_aim(const calls::Evaluated& made, const EvaluateArguments& options, Io& io) {
  if (io.json) {
    Bootstrap bootstrap(options.call.seed);
    io.out << text_of(answer_json(answer_of(made, options.call, bootstrap)));
    return;
  }
  io.out << fmt::format("{}, {} left out; {} of {}, {} left out\n", counted(made.input.recordings.size(), "recording"),
                        made.input.left_out.size(), counted(made.aim->tokens.size(), "token"),
                        fmt::format("{} gloss{}", made.aim->glosses.size(), made.aim->glosses.size() == 1 ? "" : "es"),
                        made.aim->left_out);
  io.out << "nothing is learned from the locus that is judged, except in 'seen'; signer and session are the same\n";
  io.out << calls::aim_text(calls::aim_answer(*made.aim));
}

void run_evaluate(const EvaluateArguments& options, Io& io) {
  std::unique_ptr<Progress> progress;
  calls::Listener listener = listener_of(io);
  listener.stage = [&](std::string_view what) { progress = std::make_unique<Progress>(io, std::string(what)); };
  listener.progress = [&](double fraction) { progress->show(fraction); };
  calls::EvaluationInput input = calls::read_evaluation_input(options.paths, options.reading, listener);
  progress.reset();
  calls::require_recordings(input, fmt::format("{}", fmt::join(options.paths, ", ")));
  if (options.call.task == "aim") {
    const calls::Evaluated made = calls::evaluate_aimed(std::move(input), listener);
    progress.reset();
    show_aim(made, options, io);
    return;
  }
  if (!options.call.collections.empty()) {
    TextReader table{std::filesystem::path(options.call.collections)};
    read_collections(table, input.recordings, input.left_out);
  }
  SpanChoice choice =
      options.spans.empty() ? choose_spans(input.recordings) : read_spans(options.spans, input.recordings);
  const calls::Evaluated made = calls::evaluate(std::move(input), std::move(choice), options.call, listener);
  progress.reset();
  Bootstrap bootstrap(options.call.seed);
  if (io.json) {
    io.out << text_of(answer_json(answer_of(made, options.call, bootstrap)));
    if (!options.plot.empty()) draw(options.plot, made.tasks, bootstrap);
    return;
  }
  io.out << fmt::format("{}, {} left out; {}, {} left out for defects of the capture\n",
                        counted(made.input.recordings.size(), "recording"), made.input.left_out.size(),
                        counted(made.choice.spans.size(), "span"), made.choice.left_out);
  io.out << fmt::format("nothing is learned from the {} that is judged\n", made.left_out_by);
  const std::vector<Measure> chosen = measures_of(options);
  for (const EvaluatedTask& task : made.tasks) {
    io.out << '\n' << summary_text(task, chosen.empty() ? task.summary : chosen, bootstrap);
    if (chosen.empty()) io.out << default_text(task, bootstrap);
    if (task.key == "given" && chosen.empty()) io.out << calls::judged_text(task, bootstrap);
  }
  if (options.full) {
    for (const EvaluatedTask& task : made.tasks) io.out << full_text(task, bootstrap);
  }
  // After the results are printed: if a plot cannot be written, nothing else is lost.
  if (!options.plot.empty()) draw(options.plot, made.tasks, bootstrap);
}

}  // namespace

Run evaluate(CLI::App& verb) {
  auto options = std::make_shared<EvaluateArguments>();
  verb.add_option("PATH", options->paths,
                  "databases, motion files " + readable_extensions(FileKind::motion) + ", or folders of them")
      ->required();
  bind(verb, options->call, [&verb, options](std::string_view next) {
    if (next != "seed") return;
    verb.add_option("--measure", options->measures,
                    "a table of this measure, given by its name in JSON; may be repeated")
        ->check(check_measure);
    verb.add_option("--spans", options->spans,
                    "a table of spans: CSV with file, first frame, frames, optionally a group")
        ->type_name("FILE.csv");
    verb.add_flag("--full", options->full, "every measure of every group and hand, with intervals");
    verb.add_option("--plot", options->plot, "draw the summary with intervals (.svg)")
        ->check([](const std::string& path) { return check_extension(path, {".svg"}); });
  });
  bind(verb, options->reading);
  return [options](Io& io) { run_evaluate(*options, io); };
}

}  // namespace signweave::cli
