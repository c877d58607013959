#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "app/cli/help_format.h"
#include "app/cli/validators.h"
#include "app/wire/read.h"
#include "signweave/calls/field.h"

namespace signweave::cli {

/// Adds an option to the command line for each field of a call. A former name becomes an option that `--help` does not
/// list; its description is the notice to print when it is used.
class Binder {
 public:
  /// `before` is called with the name of each field before its option is added, so that options that the call does not
  /// have can be inserted, such as the output file.
  Binder(CLI::App& verb, std::function<void(std::string_view)> before) : verb_(verb), before_(std::move(before)) {}

  template <class Member>
  void operator()(const calls::Field& field, Member& member) {
    if (before_) before_(field.name);
    add(words_of(field), field, member);
    if (field.former.empty()) return;
    const std::string current = words_of(field);
    calls::Field former = field;
    former.words = {};
    former.name = field.former;
    former.required = false;
    former.help = wire::renamed(field).text;
    add(words_of(former), former, member)->group(std::string(HelpFormat::kHidden))->excludes(verb_.get_option(current));
  }

  /// "--offset-ms"; for a positional argument its words.
  static std::string words_of(const calls::Field& field) {
    const bool positional = !field.words.empty() && std::isupper(static_cast<unsigned char>(field.words[0])) != 0;
    if (positional) return std::string(field.words);
    std::string words = fmt::format("--{}", field.words.empty() ? field.name : field.words);
    std::replace(words.begin(), words.end(), '_', '-');
    return words;
  }

 private:
  template <class Member>
  CLI::Option* add(const std::string& words, const calls::Field& field, Member& member) {
    if constexpr (std::is_same_v<Member, bool>) {
      return verb_.add_flag(words, member, field.help);
    } else {
      CLI::Option* option = verb_.add_option(words, member, field.help);
      option->required(field.required);
      if constexpr (std::is_same_v<Member, std::vector<std::string>>) {
        if (words.starts_with('-') && !field.several_words) option->allow_extra_args(false);
      }
      if (field.range) option->check(within(*field.range));
      if (!field.one_of.empty()) option->check(one_of(field.one_of));
      if (field.check != nullptr) {
        option->check([check = field.check](const std::string& text) { return check(text); });
      }
      if (!field.type_name.empty()) option->type_name(std::string(field.type_name));
      if (field.shows_default) option->capture_default_str();
      return option;
    }
  }

  CLI::App& verb_;
  std::function<void(std::string_view)> before_;
};

/// Adds every field of a call as an option of a verb; both must live until the command line has been parsed.
template <class Call>
void bind(CLI::App& verb, Call& call, std::function<void(std::string_view)> before = {}) {
  Binder binder(verb, std::move(before));
  fields(binder, call);
}

/// Adds the option -o that `sign`, `edit` and `export` share.
void add_outputs(CLI::App& verb, std::vector<std::string>& outputs);

}  // namespace signweave::cli
