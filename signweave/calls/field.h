#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Calls: what signweave can be asked for, free of how it is asked. Of each call one struct of parameters, one
/// description of its fields, one function that answers it and one that puts the answer into JSON. The command line
/// and the server share them all.
namespace signweave::calls {

using Bound = std::variant<std::int64_t, std::size_t, double>;

/// Both ends belong to it.
struct Range {
  Bound least;
  Bound most;
};

/// One field of a call's parameters, described once. From it come the option of the command line, what a JSON body or a
/// URL may hold, and the schema of the OpenAPI document. A call's `fields` visits each field with its description and
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
      {};  ///< on the command line: a positional argument (capitals), or an option's name if it is another
  bool required = false;
  bool shows_default = false;  ///< in `--help`
  bool or_number = false;      ///< of a string: JSON may give a number, too
  bool several_words = false;  ///< of a list: on the command line several values may follow the option
  bool is_file = false;        ///< names a file: on the command line by its path, else one of the same upload
  std::optional<Range> range{};
  std::vector<std::string> one_of{};
  std::string (*check)(const std::string&) = nullptr;  ///< what is wrong with a value, in one line; empty: nothing
  std::string_view type_name = {};                     ///< in `--help`
};

}  // namespace signweave::calls
