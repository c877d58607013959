#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/core/answer.h"

/// The answer of `evaluate`.
namespace signweave::calls {

/// A value with its confidence interval.
struct EstimateAnswer {
  OrNull<double> value;
  OrNull<double> low;
  OrNull<double> high;
  std::size_t spans = 0;
  std::size_t recordings = 0;
  std::size_t collections = 0;
};
template <class Visit>
void estimate_fields(Visit& visit, const EstimateAnswer& estimate) {
  visit(AnswerField{.name = "value", .help = "null: nothing was measured"}, estimate.value);
  visit(AnswerField{.name = "low", .help = "of its interval; null: too few recordings"}, estimate.low);
  visit(AnswerField{.name = "high"}, estimate.high);
  visit(AnswerField{.name = "spans", .help = "how many it is from"}, estimate.spans);
  visit(AnswerField{.name = "recordings"}, estimate.recordings);
  visit(AnswerField{.name = "collections"}, estimate.collections);
}
template <class Visit>
void fields(Visit& visit, const EstimateAnswer& estimate) {
  visit.type("Estimate");
  estimate_fields(visit, estimate);
}

/// A measure of a method in a group.
struct MeasureAnswer {
  EstimateAnswer estimate;
  std::optional<std::string> unit;
  std::map<std::string, EstimateAnswer> over;  ///< [method]: the ratio to that method's value
};
template <class Visit>
void fields(Visit& visit, const MeasureAnswer& measure) {
  const auto over = [&](const char* method) {
    const auto found = measure.over.find(method);
    return found == measure.over.end() ? std::nullopt : std::optional(found->second);
  };
  visit.type("MeasureEstimate");
  estimate_fields(visit, measure.estimate);
  visit(AnswerField{.name = "unit"}, measure.unit);
  visit(AnswerField{.name = "over_slerp", .help = "the ratio to slerp's figure"}, over("slerp"));
  visit(AnswerField{.name = "over_hermite", .help = "the ratio to hermite's figure"}, over("hermite"));
}

using FiguresAnswer = std::vector<std::pair<std::string, MeasureAnswer>>;  ///< by measure

/// A group of spans of a task.
struct GroupAnswer {
  std::string group;
  std::size_t spans = 0;
  std::size_t recordings = 0;
  std::size_t collections = 0;
  std::vector<std::pair<std::string, std::vector<std::pair<std::string, FiguresAnswer>>>> hands;  ///< [hand][method]
};
template <class Visit>
void fields(Visit& visit, const GroupAnswer& group) {
  visit.type("EvaluationGroup");
  visit(AnswerField{.name = "group"}, group.group);
  visit(AnswerField{.name = "spans"}, group.spans);
  visit(AnswerField{.name = "recordings"}, group.recordings);
  visit(AnswerField{.name = "collections"}, group.collections);
  visit(AnswerField{.name = "hands", .help = "by hand (moving, left, right), method and measure"}, group.hands);
}

struct TaskAnswer {
  std::string task;
  std::vector<GroupAnswer> groups;
};
template <class Visit>
void fields(Visit& visit, const TaskAnswer& task) {
  visit.type("EvaluationTask");
  visit(AnswerField{.name = "task"}, task.task);
  visit(AnswerField{.name = "groups"}, task.groups);
}

struct CollectionEstimate {
  std::string collection;
  EstimateAnswer estimate;
};
template <class Visit>
void fields(Visit& visit, const CollectionEstimate& one) {
  visit.type("CollectionEstimate");
  visit(AnswerField{.name = "collection"}, one.collection);
  estimate_fields(visit, one.estimate);
}

/// The ratio of a method's wrist error to that of the reference method.
struct JudgedAnswer {
  std::string method;
  std::string over;
  EstimateAnswer all;
  std::vector<CollectionEstimate> collections;
  bool may_be_default = false;
};
template <class Visit>
void fields(Visit& visit, const JudgedAnswer& judged) {
  visit.type("JudgedMethod");
  visit(AnswerField{.name = "method"}, judged.method);
  visit(AnswerField{.name = "over"}, judged.over);
  visit(AnswerField{.name = "all"}, judged.all);
  visit(AnswerField{.name = "collections"}, judged.collections);
  visit(AnswerField{.name = "may_be_default"}, judged.may_be_default);
}

/// A captured movement that was cut out.
struct SpanAnswer {
  std::string file;
  std::int64_t first_frame = 0;
  std::int64_t frames = 0;
  std::string group;
  std::string_view moving_hand;
  std::size_t speed_peaks = 0;
};
template <class Visit>
void fields(Visit& visit, const SpanAnswer& span) {
  visit.type("EvaluatedSpan");
  visit(AnswerField{.name = "file"}, span.file);
  visit(AnswerField{.name = "first_frame"}, span.first_frame);
  visit(AnswerField{.name = "frames"}, span.frames);
  visit(AnswerField{.name = "group"}, span.group);
  visit(AnswerField{.name = "moving_hand", .one_of = {"left", "right"}}, span.moving_hand);
  visit(AnswerField{.name = "speed_peaks"}, span.speed_peaks);
}

/// Mean errors of the predictions by one method.
struct AimRowAnswer {
  std::string_view method;
  bool near = true;
  std::size_t predictions = 0;
  std::size_t unreached = 0;
  double end_mm = 0;
  double path_mm = 0;
  OrNull<double> path_over_floor;
  OrNull<double> path_over_noise;
  double aim_degrees = 0;
  double turn_degrees = 0;
  double shape_mm = 0;
  OrNull<double> expected_mm;
};
template <class Visit>
void fields(Visit& visit, const AimRowAnswer& row) {
  visit.type("AimRow");
  visit(AnswerField{.name = "method", .one_of = {"seen", "learned", "cubic", "nearest", "citation", "ends", "floor"}},
        row.method);
  visit(AnswerField{.name = "near", .help = "the learned model vouches for these loci"}, row.near);
  visit(AnswerField{.name = "predictions", .help = "how many it is from"}, row.predictions);
  visit(AnswerField{.name = "unreached", .help = "of these, how many the arms cannot make wholly"}, row.unreached);
  visit(AnswerField{.name = "end_mm", .help = "between the palms at the stroke's end"}, row.end_mm);
  visit(AnswerField{.name = "path_mm", .help = "between the palms over the stroke"}, row.path_mm);
  visit(AnswerField{.name = "path_over_floor", .help = "over that of repetitions; null: there are none"},
        row.path_over_floor);
  visit(AnswerField{.name = "path_over_noise", .help = "over how far repetitions are from their mean"},
        row.path_over_noise);
  visit(AnswerField{.name = "aim_degrees",
                    .help = "between the directions of the movements; of a pointing sign, between finger and locus"},
        row.aim_degrees);
  visit(AnswerField{.name = "turn_degrees", .help = "between the orientations of the hands"}, row.turn_degrees);
  visit(AnswerField{.name = "shape_mm", .help = "between the paths after the best shift, turn and scale"},
        row.shape_mm);
  visit(AnswerField{.name = "expected_mm", .help = "the path error that the model expects"}, row.expected_mm);
}

struct AimGlossAnswer {
  std::string gloss;
  std::string_view role;
  std::size_t tokens = 0;
  std::size_t with_loci = 0;
  std::optional<std::string> why_not_learned;
  std::vector<AimRowAnswer> rows;
};
template <class Visit>
void fields(Visit& visit, const AimGlossAnswer& gloss) {
  visit.type("AimGloss");
  visit(AnswerField{.name = "gloss"}, gloss.gloss);
  visit(AnswerField{.name = "role", .help = "as guessed", .one_of = {"none", "forward", "backward", "aim", "both"}},
        gloss.role);
  visit(AnswerField{.name = "tokens"}, gloss.tokens);
  visit(AnswerField{.name = "with_loci"}, gloss.with_loci);
  visit(AnswerField{.name = "why_not_learned"}, gloss.why_not_learned);
  visit(AnswerField{.name = "rows"}, gloss.rows);
}

/// How strokes are predicted at loci that are left out.
struct AimAnswer {
  std::vector<AimRowAnswer> all;
  std::vector<AimGlossAnswer> glosses;
  std::size_t tokens_left_out = 0;
};
template <class Visit>
void fields(Visit& visit, const AimAnswer& answer) {
  visit.type("AimEvaluation");
  visit(AnswerField{.name = "all"}, answer.all);
  visit(AnswerField{.name = "glosses"}, answer.glosses);
  visit(AnswerField{.name = "tokens_left_out"}, answer.tokens_left_out);
}

struct EvaluationAnswer {
  std::size_t recordings = 0;
  std::size_t recordings_left_out = 0;
  std::string_view left_out_by;
  std::vector<JudgedAnswer> judged;
  std::size_t spans_left_out = 0;
  std::uint64_t seed = 0;
  double confidence = 0;
  std::vector<TaskAnswer> tasks;
  std::vector<SpanAnswer> spans;
  std::optional<AimAnswer> aim = {};
};
template <class Visit>
void evaluation_fields(Visit& visit, const EvaluationAnswer& answer) {
  visit(AnswerField{.name = "recordings"}, answer.recordings);
  visit(AnswerField{.name = "recordings_left_out"}, answer.recordings_left_out);
  visit(AnswerField{.name = "left_out_by",
                    .help = "nothing is learned from the one that is judged",
                    .one_of = {"collection", "signer", "recording", "locus"}},
        answer.left_out_by);
  visit(AnswerField{.name = "judged", .help = "the other methods against kriging, by the wrist's error"},
        answer.judged);
  visit(AnswerField{.name = "spans_left_out"}, answer.spans_left_out);
  visit(AnswerField{.name = "seed"}, answer.seed);
  visit(AnswerField{.name = "confidence"}, answer.confidence);
  visit(AnswerField{.name = "tasks"}, answer.tasks);
  visit(AnswerField{.name = "spans"}, answer.spans);
  visit(AnswerField{.name = "aim", .help = "of the task aim, which has no tasks and spans"}, answer.aim);
}
template <class Visit>
void fields(Visit& visit, const EvaluationAnswer& answer) {
  visit.type("Evaluation");
  evaluation_fields(visit, answer);
}

}  // namespace signweave::calls
