#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/evaluation_answer.h"
#include "signweave/calls/evaluation_input.h"
#include "signweave/calls/evaluation_report.h"
#include "signweave/calls/field.h"
#include "signweave/calls/listener.h"
#include "signweave/evaluation/evaluate_aim.h"
#include "signweave/transition/method.h"

namespace signweave::calls {

/// Cuts out captured movements, regenerates them by each method, and compares; or predicts strokes at loci from others.
struct EvaluateCall {
  std::string task = "transitions";
  std::vector<std::string> methods;  ///< empty: all; slerp, the reference of the ratios, is always included
  std::uint64_t seed = 1;
  std::string collections;  ///< a table (see read_collections) as text; on the command line, the name of its file
};

/// Returns that there is no such method, with near matches; empty if there is.
std::string check_method(const std::string& name);

template <class Visit>
void fields(Visit& visit, EvaluateCall& call) {
  visit(Field{.name = "task",
              .help = "transitions between signs, or strokes that are aimed at loci (aim)",
              .shows_default = true,
              .one_of = {"transitions", "aim"}},
        call.task);
  visit(Field{.name = "method",
              .help = "this method alone, in addition to slerp; may be given several times",
              .several_words = true,
              .check = check_method},
        call.methods);
  visit(Field{.name = "seed",
              .help = "of the resampling that intervals come from",
              .shows_default = true,
              .check =
                  [](const std::string& text) {
                    return text.starts_with('-') ? std::string("a seed is not negative") : std::string();
                  }},
        call.seed);
  visit(Field{.name = "collections",
              .help = "a table of which collection and signer recordings belong to: CSV with recording, collection, "
                      "perhaps signer",
              .type_name = "FILE.csv"},
        call.collections);
}

/// The result of an evaluation.
struct Evaluated {
  EvaluationInput input;
  SpanChoice choice;
  std::vector<EvaluatedTask> tasks;
  std::string_view left_out_by;           ///< see Folds; "locus" for the task "aim"
  std::optional<AimEvaluation> aim = {};  ///< of the task "aim", which has no spans and no other tasks
};

/// Throws Error{not_found} if there is nothing to evaluate on, and what `listener.progress` throws.
Evaluated run(const Database& database, const EvaluateCall& call, const Listener& listener);
/// Evaluates on any input and spans.
Evaluated evaluate(EvaluationInput input, SpanChoice choice, const EvaluateCall& call, const Listener& listener);
/// The task "aim".
Evaluated evaluate_aimed(EvaluationInput input, const Listener& listener);
/// Throws Error{not_found} if there is none.
void require_recordings(const EvaluationInput& input, const std::string& where);

EvaluationAnswer answer_of(const Evaluated& evaluated, const EvaluateCall& call, Bootstrap& bootstrap);
/// The summary with intervals as an SVG document.
std::string plot_of(const std::vector<EvaluatedTask>& tasks, Bootstrap& bootstrap);

}  // namespace signweave::calls
