#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/answer.h"

/// Lists of the values that parameters can have, for programs that offer a choice.
namespace signweave::calls {

/// A method that makes transitions: a value of `transition`.
struct MethodRow {
  std::string_view name;
  std::string_view description;  ///< one line
};
template <class Visit>
void fields(Visit& visit, const MethodRow& row) {
  visit.type("MethodRow");
  visit(AnswerField{.name = "name"}, row.name);
  visit(AnswerField{.name = "description", .help = "one line"}, row.description);
}
/// The default first.
std::vector<MethodRow> method_rows();

/// A kind of phase: a value of `phase` in queries and of phase labels.
struct PhaseRow {
  std::string_view name;
  std::string_view description;
};
template <class Visit>
void fields(Visit& visit, const PhaseRow& row) {
  visit.type("PhaseRow");
  visit(AnswerField{.name = "name"}, row.name);
  visit(AnswerField{.name = "description", .help = "one line"}, row.description);
}
/// In the order of a sign's phases.
std::vector<PhaseRow> phase_rows();

/// A unit of length: a value of `unit` and `root_unit`, which also accept metres per unit as a number.
struct UnitRow {
  std::string_view name;
  double metres = 0;
};
template <class Visit>
void fields(Visit& visit, const UnitRow& row) {
  visit.type("UnitRow");
  visit(AnswerField{.name = "name"}, row.name);
  visit(AnswerField{.name = "metres"}, row.metres);
}
const std::vector<UnitRow>& unit_rows();

}  // namespace signweave::calls
