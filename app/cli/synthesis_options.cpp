#include "app/cli/synthesis_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "app/cli/output.h"
#include "app/cli/selection_report.h"
#include "app/cli/table.h"
#include "signweave/core/text.h"

namespace signweave::cli {
namespace {

std::optional<Milliseconds> parse_duration(const std::string& text) {
  int ms = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, ms);
  if (error != std::errc{} || parsed != end || ms < 0 || ms > 60'000) return std::nullopt;
  return Milliseconds(ms);
}

double ms_of(Seconds seconds) {
  return seconds.count() * 1000.0;
}

/// What a part of the body keeps of retraction and preparation.
std::string part_of(const TransitionCut& cut) {
  return fmt::format("{}+{}{}", cut.retraction_frames, cut.preparation_frames, cut.waits ? " waits" : "");
}

/// How the transitions were timed, where the corpus tells it.
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

/// What the method had to go by, where it asks for it.
std::string captured_of(const Synthesized& made) {
  if (!made.captured_transitions) return {};
  return fmt::format("made after {}\n", counted(*made.captured_transitions, "captured transition"));
}

void print_junctions(const Synthesized& made, Io& io) {
  std::vector<std::vector<std::string>> rows = {
      {"junction", "from", "to", "method", "ms", "m_i", "m_j", "p", "body", "left", "right"}};
  const FrameClock clock{made.result.motion.rate().frame_time(), Seconds(0)};
  for (std::size_t i = 0; i < made.result.junctions.size(); ++i) {
    const Junction& junction = made.result.junctions[i];
    rows.push_back({std::to_string(i + 1), junction.from, junction.to, junction.method,
                    std::to_string(span_of(junction.frames, clock).duration().count()),
                    std::to_string(junction.cut.retraction_frames), std::to_string(junction.cut.preparation_frames),
                    std::to_string(junction.cut.blend_frames), part_of(junction.cuts[0]), part_of(junction.cuts[1]),
                    part_of(junction.cuts[2])});
  }
  if (rows.size() == 1) return;
  io.out << '\n' << format_table(rows) << timing_of(made.durations) << captured_of(made);
}

nlohmann::json timings_of(const Timings& timings) {
  return {{"semantic_query_ms", ms_of(timings.semantic_query)},
          {"selection_ms", ms_of(timings.selection)},
          {"retrieval_ms", ms_of(timings.retrieval)},
          {"concatenation_ms", ms_of(timings.concatenation)},
          {"total_ms", ms_of(timings.total)}};
}

}  // namespace

void add_synthesis_options(CLI::App& verb, SynthesisWords& words) {
  std::string methods = "how transitions are made:";
  std::vector<std::string> names;
  for (const TransitionMethod& method : transition_methods()) {
    names.emplace_back(method.name);
    methods += fmt::format("\n  {}: {}", method.name, method.description);
  }
  words.method = names.front();
  verb.add_option("-o,--output", words.outputs, "file to write: " + writable_endings() + "; may be given several times")
      ->required()
      ->allow_extra_args(false)
      ->check([](const std::string& path) { return check_output(path); });
  verb.add_option("--transition", words.method, methods)->check(CLI::IsMember(names))->capture_default_str();
  verb.add_option("--duration", words.duration,
                  "of each transition: fitted (told from what the hands have to do, where that beats the mean), corpus "
                  "(its mean), or milliseconds")
      ->check([](const std::string& text) {
        return text == "corpus" || text == "fitted" || parse_duration(text)
                   ? std::string()
                   : "'" + printable(text) + "' is neither corpus, nor fitted, nor 0 to 60000 ms";
      })
      ->capture_default_str();
  verb.add_option("--tempo", words.tempo, "0.25 to 4; above 1 is faster")
      ->check(CLI::Range(0.25, 4.0))
      ->capture_default_str();
  verb.add_option("--rate", words.rate, "frames a second of the result; the highest of its sources where not given")
      ->check([](const std::string& text) {
        const auto rate = parse_frame_rate(text);
        return rate && rate->hertz() >= 1 && rate->hertz() <= 2000
                   ? std::string()
                   : "'" + printable(text) + "' is no rate of 1 to 2000 frames a second";
      });
  verb.add_option(
          "--align", words.align,
          "bring signers to one place: auto (other recordings than the first or the edited one), ground (all), none")
      ->check(CLI::IsMember({"auto", "ground", "none"}))
      ->capture_default_str();
  verb.add_flag("--signing-space", words.signing_space, kSigningSpaceHelp);
  verb.add_flag("--explain", words.explain, "show candidates, costs and junctions");
  verb.add_flag("--timings", words.timings, "show how long each step took");
}

SynthesisOptions synthesis_options(const SynthesisWords& words) {
  check_signing_space(words.signing_space, words.outputs);
  SynthesisOptions options;
  options.method = find_transition_method(words.method);
  options.duration = {.fixed = parse_duration(words.duration), .fitted = words.duration == "fitted"};
  options.tempo = words.tempo;
  options.explain = words.explain;
  if (!words.rate.empty()) options.rate = parse_frame_rate(words.rate);
  options.alignment = words.align == "ground" ? Alignment::ground
                      : words.align == "none" ? Alignment::none
                                              : Alignment::automatic;
  return options;
}

void deliver(const Synthesized& made, const SynthesisWords& words, const std::string& title, Io& io) {
  std::optional<bvh::Layout> layout;
  RigNames rig;
  if (const RecordingInfo* source = made.contents->find(made.layout_from)) {
    layout = source->layout;
    rig = source->rig;
  }
  if (layout) {  // of the source's file its axes, unit and orders, but not its oddities
    layout->root_columns = bvh::RootColumns::declared;
    layout->root_unit = layout->unit;
    layout->frame_time.clear();
  }
  write_synthesis(words.outputs, made, layout, {.title = title, .signing_space = words.signing_space, .rig = rig});
  print_notices(io, made.result.notices);
  for (const auto& [name, value] : made.result.declarations) io.err << "signweave: " << value << '\n';
  const Synthesis& result = made.result;
  if (io.json) {
    nlohmann::json report = describe(result);
    report["files"] = words.outputs;
    report["timings"] = timings_of(made.timings);
    if (words.explain) {
      report["places"] = places_of(made);
      report["weights"] = json_of(made.selection.weights);
      if (made.captured_transitions) report["captured_transitions"] = *made.captured_transitions;
    }
    io.out << report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    return;
  }
  if (words.explain) {
    print_selection(made, io);
    print_junctions(made, io);
  }
  io.out << fmt::format("{}, {}, {:.2f} s at {} frames a second\n", counted(result.signs.size(), "sign"),
                        counted(result.junctions.size(), "junction"), result.motion.duration().count(),
                        to_string(result.motion.rate()));
  if (words.timings) {
    const Timings& t = made.timings;
    io.out << format_table(
        {{"semantic query ms", "selection ms", "retrieval ms", "concatenation ms", "total ms", "frames"},
         {fmt::format("{:.3f}", ms_of(t.semantic_query)), fmt::format("{:.3f}", ms_of(t.selection)),
          fmt::format("{:.3f}", ms_of(t.retrieval)), fmt::format("{:.3f}", ms_of(t.concatenation)),
          fmt::format("{:.3f}", ms_of(t.total)), std::to_string(result.motion.frame_count())}});
  }
}

}  // namespace signweave::cli
