// Trains the models that the transition methods learn from captured spans, and writes
// signweave/transition/transition_weights.inc. docs/evaluation.md describes the input files and the results with each
// of them left out.
//
//   train_transitions FILE.inc PATH...    databases, motion files, or folders of them
#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include "app/cli/command.h"
#include "signweave/calls/evaluation_input.h"
#include "signweave/evaluation/spans.h"
#include "signweave/evaluation/training.h"
#include "signweave/transition/learned.h"

namespace {

using namespace signweave;

std::string text_of(const TransitionModel& model) {
  std::string text = "// Made by tools/train_transitions.cpp from the files that docs/evaluation.md names.\n";
  text += fmt::format(".spans = {},\n.bends = {{{{\n", model.spans);
  const auto row = [&](const auto& values) {
    std::string line;
    for (const float value : values) line += fmt::format("{}{:.5f}f", line.empty() ? "" : ",", value + 0.0f);
    return line;
  };
  for (const Bends& bends : model.bends) text += fmt::format("{{{}}},\n", row(bends));
  text += "}},\n.damping = {{\n";
  for (const auto& knot : model.damping) {
    std::string line;
    for (const auto& group : knot) line += fmt::format("{{{}}},", row(group));
    text += fmt::format("{{{{{}}}}},\n", line);
  }
  return text + "}},\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: train_transitions FILE.inc PATH...\n";
    return 2;
  }
  try {
    cli::Io io{.out = std::cout, .err = std::cerr};
    const calls::EvaluationInput input =
        calls::read_evaluation_input({argv + 2, argv + argc}, {}, cli::listener_of(io));
    const SpanChoice choice = choose_spans(input.recordings);
    const auto model = train(input.recordings, choice.spans, folds_of(input.recordings)).model();
    std::ofstream out(argv[1]);
    out << text_of(*model);
    if (!out.flush()) throw Error(ErrorCode::io, fmt::format("{}: cannot be written", argv[1]));
    std::cout << fmt::format("{} spans of {} recordings\n", model->spans, input.recordings.size());
  } catch (const std::exception& error) {
    std::cerr << "train_transitions: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
