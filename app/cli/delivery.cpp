#include "app/cli/delivery.h"
#include "app/wire/text.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/progress.h"
#include "app/cli/selection_report.h"
#include "signweave/calls/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/file_format.h"
#include "signweave/formats/write_file.h"
#include "signweave/notation/score_json.h"

namespace signweave::cli {
namespace {

double ms_of(Seconds seconds) {
  return seconds.count() * 1000.0;
}

/// The frames of retraction and preparation that a part of the body keeps.
std::string part_of(const TransitionCut& cut) {
  return fmt::format("{}+{}{}", cut.retraction_frames, cut.preparation_frames, cut.waits ? " waits" : "");
}

/// How the durations of transitions were determined, if the corpus has any.
std::string timing_of(const DurationFit& fit) {
  const auto ms = [](Seconds time) { return std::llround(ms_of(time)); };
  if (fit.count == 0) return {};
  if (fit.fitted_error == Seconds(0)) {
    return fmt::format("timed by the {} of {} transitions, {} ms\n", fit.median ? "median" : "mean", fit.count,
                       ms(fit.mean));
  }
  return fmt::format("timed {} {} transitions: cross-validated, it errs by {} ms and {} by {} ms\n",
                     fit.weights.empty() ? "by the mean of" : "by what the hands have to do, fitted on", fit.count,
                     ms(fit.weights.empty() ? fit.mean_error : fit.fitted_error),
                     fit.weights.empty() ? "a fit" : "the mean",
                     ms(fit.weights.empty() ? fit.fitted_error : fit.mean_error));
}

/// The number of captured transitions available to the method, if it uses them.
std::string captured_of(const Synthesized& made) {
  if (!made.captured_transitions) return {};
  return fmt::format("made after {}\n", counted(*made.captured_transitions, "captured transition"));
}

void print_junctions(const Synthesized& made, Io& io) {
  std::vector<std::vector<std::string>> rows = {
      {"junction", "from", "to", "method", "ms", "m_i", "m_j", "p", "body", "left", "right"}};
  const bool any_chosen =
      std::ranges::any_of(made.result.junctions, [](const Junction& one) { return !one.chosen.empty(); });
  if (any_chosen) rows.front().emplace_back("chosen");
  const FrameClock clock{made.result.motion.rate().frame_time(), Seconds(0)};
  for (const Junction& junction : made.result.junctions) {
    rows.push_back({std::to_string(junction.number), junction.from, junction.to, junction.method,
                    std::to_string(span_of(junction.frames, clock).duration().count()),
                    std::to_string(junction.cut.retraction_frames), std::to_string(junction.cut.preparation_frames),
                    std::to_string(junction.cut.blend_frames), part_of(junction.cuts[0]), part_of(junction.cuts[1]),
                    part_of(junction.cuts[2])});
    if (any_chosen) rows.back().push_back(junction.chosen.empty() ? "-" : to_string(junction.chosen));
  }
  if (rows.size() == 1) return;
  io.out << '\n' << format_table(rows) << timing_of(made.durations) << captured_of(made);
}

/// To be called before anything is written: announces the size of large files, and refuses if the disk has no room.
void announce(const std::vector<std::string>& outputs, const FileContent& content, Io& io) {
  constexpr std::uint64_t kLarge = std::uint64_t{100} << 20;
  for (const std::string& path : outputs) {
    const std::uint64_t bytes = estimated_bytes(path, content);
    require_room(path, bytes);
    if (bytes >= kLarge) {
      io.err << fmt::format("signweave: {}: about {} will be written\n", one_line(path), size_text(bytes));
    }
  }
}

}  // namespace

void add_outputs(CLI::App& verb, std::vector<std::string>& outputs) {
  verb.add_option("-o,--output", outputs,
                  fmt::format("file to write: {}; may be given several times", fmt::join(writable_extensions(), " ")))
      ->required()
      ->allow_extra_args(false)
      ->check([](const std::string& path) { return check_extension(path, writable_extensions()); });
}

void deliver(const calls::Exported& made, const std::vector<std::string>& outputs, Io& io) {
  print_notices(io, made.notices);
  {
    Progress progress(io, "writing", "stopped; the file being written was discarded");
    FileContent written = made.content();
    written.progress = [&](double fraction) { progress.show(fraction); };
    announce(outputs, written, io);
    for (const std::string& path : outputs) write_file(path, written);
  }
  for (const auto& [name, value] : made.info.declarations) io.err << "signweave: " << value << '\n';
  if (!io.json) return;
  auto report = answer_json<nlohmann::json>(made);
  report["files"] = outputs;
  io.out << text_of(report);
}

calls::SharedCharacter character_of(const std::string& file) {
  return file.empty() ? nullptr : calls::read_character_file(file);
}

void add_reports(CLI::App& verb, Delivery& delivery) {
  verb.add_option("--score", delivery.score,
                  "also write the score (.json): the captured frames and transitions of the result, and their times; "
                  "'sign DB --from' renders it again")
      ->check([](const std::string& path) { return check_extension(path, {".json"}); });
  verb.add_flag("--timings", delivery.timings, "show how long each step took");
}

void deliver(const Synthesized& made, const calls::SynthesisChoices& choices, const Delivery& delivery,
             const std::string& title, calls::SharedCharacter character, Io& io) {
  {
    Progress progress(io, "writing", "stopped; the file being written was discarded");
    FileContent content = content_of(made, choices, title, character);
    content.progress = [&](double fraction) { progress.show(fraction); };
    announce(delivery.outputs, content, io);
    write_files(delivery.outputs, content);
    if (!delivery.score.empty()) {
      AtomicFile file(delivery.score);
      file.write(json_of(made.result.score));
      file.commit();
    }
  }
  print_notices(io, made.result.notices);
  for (const auto& [name, value] : made.result.declarations) io.err << "signweave: " << value << '\n';
  const Synthesis& result = made.result;
  if (io.json && result.clips.empty()) {  // a part of a score
    io.out << text_of(nlohmann::json{{"files", delivery.outputs},
                                     {"frames", result.motion.frame_count()},
                                     {"frames_per_second", result.motion.rate().hertz()},
                                     {"score_frames", result.score.frames}});
    return;
  }
  if (io.json) {
    auto report = answer_json<nlohmann::json>(calls::report_of(made, choices));
    report["files"] = delivery.outputs;
    if (!delivery.score.empty()) report["score"] = delivery.score;
    io.out << text_of(report);
    return;
  }
  if (choices.explain) {
    print_selection(made, io);
    print_junctions(made, io);
  }
  if (result.clips.empty()) {  // a part
    io.out << fmt::format("{} of {} at {} frames a second\n", counted(result.motion.frame_count(), "frame"),
                          result.score.frames, to_string(result.motion.rate()));
    return;
  }
  io.out << fmt::format("{}, {}, {:.2f} s at {} frames a second\n", counted(result.signs.size(), "sign"),
                        counted(result.junctions.size(), "junction"), result.motion.duration().count(),
                        to_string(result.motion.rate()));
  if (delivery.timings) {
    const Timings& t = made.timings;
    io.out << format_table(
        {{"semantic query ms", "selection ms", "retrieval ms", "concatenation ms", "total ms", "frames"},
         {fmt::format("{:.3f}", ms_of(t.semantic_query)), fmt::format("{:.3f}", ms_of(t.selection)),
          fmt::format("{:.3f}", ms_of(t.retrieval)), fmt::format("{:.3f}", ms_of(t.concatenation)),
          fmt::format("{:.3f}", ms_of(t.total)), std::to_string(result.motion.frame_count())}});
  }
}

}  // namespace signweave::cli
