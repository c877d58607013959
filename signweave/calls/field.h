#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Calls: the operations of signweave, independent of the interface that requests them. Each call has a struct of
/// parameters, a description of its fields, a function that runs it, and a description of its answer. The command line
/// and the server share them.
namespace signweave::calls {

using Bound = std::variant<std::int64_t, std::size_t, double>;

/// Inclusive at both ends.
struct Range {
  Bound least;
  Bound most;
};

/// One field of a call's parameters, described once. The command-line option, the members of a JSON body or a URL, and
/// the schema of the OpenAPI document are derived from it. A call's `fields` visits each field with its description and
/// its member, in the order of `--help`:
///
///     template <class Visit>
///     void fields(Visit& visit, RemoveCall& call) {
///       visit({.name = "recording", .help = "name of the recording", .words = "RECORDING", .required = true},
///             call.recording);
///     }
///
/// Members are bool, std::string, numbers, optional numbers, and lists of strings.
struct Field {
  std::string_view name;         ///< of the property in JSON and in a URL
  std::string help;              ///< one line
  std::string_view former = {};  ///< its previous name, still accepted, with a notice
  std::string_view words =
      {};  ///< on the command line: a positional argument (capitals), or an option's name if it differs
  bool required = false;
  bool shows_default = false;  ///< in `--help`
  bool or_number = false;      ///< of a string: JSON may also give a number
  bool several_words = false;  ///< of a list: on the command line several values may follow the option
  bool is_file = false;        ///< names a file: by its path on the command line, else a file of the same upload
  std::optional<Range> range{};
  std::vector<std::string> one_of{};
  std::string (*check)(const std::string&) =
      nullptr;                      ///< returns what is wrong with a value, in one line; empty: nothing
  std::string_view type_name = {};  ///< in `--help`
};

}  // namespace signweave::calls
