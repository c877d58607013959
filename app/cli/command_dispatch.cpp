#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <ostream>
#include <sstream>

#include "app/cli/command.h"
#include "app/cli/help_format.h"
#include "app/cli/interrupts.h"
#include "app/wire/fault.h"
#include "app/wire/text.h"
#include "signweave/calls/listener.h"
#include "signweave/core/syntax_error.h"
#include "signweave/core/text.h"
#include "signweave/core/version.h"
#include "signweave/database/database.h"

namespace signweave::cli {
namespace {

constexpr int kInterrupted = 130;  // as in shells: 128 and the number of SIGINT

constexpr Command kCommands[] = {
    {"create", "create an empty database", "signweave create corpus.db --access-mode by_frame:64", create},
    {"import", "store recordings: motion files and their annotation",
     "signweave import corpus.db recordings/ --sign-tier 'Gloss RH:right'", import},
    {"remove", "remove a recording", "signweave remove corpus.db meteo", remove},
    {"info", "show what a database or a file contains", "signweave info meteo.bvh", info},
    {"check", "verify every stored byte", "signweave check corpus.db", check},
    {"relayout", "store motions in another access mode",
     "signweave relayout corpus.db --access-mode by_joint_and_frame", relayout},
    {"backup", "copy a database while it is written to; later runs copy what changed",
     "signweave backup corpus.db corpus.backup", backup},
    {"restore", "create a database from a backup", "signweave restore corpus.backup corpus.db", restore},
    {"compact-file", "return the free space in a database's file to the disk", "signweave compact-file corpus.db",
     compact_file},
    {"query", "find signs, phases and annotations", "signweave query corpus.db 'gloss = \"VANNES\" & phase = stroke'",
     query},
    {"xpath", "query the annotation documents themselves, in XPath 1.0",
     "signweave xpath corpus.db '//TIER[@TIER_ID=\"Gloss\"]//ANNOTATION_VALUE'", xpath},
    {"sign", "generate new signing from glosses", "signweave sign corpus.db 'VANNES MATIN PLUIE' -o out.bvh -o out.eaf",
     sign},
    {"edit", "replace or swap signs of a recording",
     "signweave edit corpus.db meteo --replace BRETAGNE=VANNES -o out.bvh", edit},
    {"export", "write a recording, or a part of it",
     "signweave export corpus.db meteo -o part.bvh --from 1000 --to 4000", export_recording},
    {"convert", "write files of one format as another, without a database",
     "signweave convert walk.bvh -o walk.glb -o walk.csv", convert},
    {"segment", "propose phases of both hands, from motion alone", "signweave segment meteo.bvh -o meteo.phases.eaf",
     segment},
    {"stats", "durations of the recorded transitions", "signweave stats corpus.db --recording meteo", stats},
    {"evaluate", "cut out captured movements, regenerate them by each method, compare",
     "signweave evaluate recordings/ --plot errors.svg", evaluate},
    {"serve", "answer over HTTP, and stream signing live", "signweave serve corpus.db --listen 127.0.0.1:8080", serve},
    {"render", "draw signing as a film or pictures",
     "signweave render corpus.db 'VANNES MATIN PLUIE' -o film.webm --studio site", render},
    {"formats", "list the file formats, and what each can hold", "signweave formats", formats},
};

/// Extra words are mostly an unquoted utterance or query.
std::string one_word_too_many(const CLI::App& verb) {
  const std::string extra = verb.remaining().at(0);
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_positional() && !option->results().empty() &&
        (option->get_name() == "UTTERANCE" || option->get_name() == "TEXT")) {
      const std::string all = fmt::format("{} {}", option->results().front(), fmt::join(verb.remaining(), " "));
      return fmt::format("'{}' is one word too many; put quotation marks around all of them: '{}'", printable(extra),
                         printable(all));
    }
  }
  return fmt::format("'{}' is one word too many", printable(extra));
}

/// Rewrites "Could not convert: --rate = abc".
std::string not_a_number(const CLI::App& verb, const std::string& text) {
  const std::size_t begin = text.find(": ");
  const std::size_t equal = text.find(" = ");
  if (begin == text.npos || equal == text.npos || equal < begin) return text;
  const std::string name = text.substr(begin + 2, equal - begin - 2);
  const CLI::Option* option = verb.get_option_no_throw(name);
  const bool whole = option != nullptr && option->get_type_name().starts_with("FLOAT") == false;
  return fmt::format("{}: '{}' is not a {}", name, printable(text.substr(equal + 3)),
                     whole ? "whole number" : "number");
}

/// One line for wrong usage, with near matches for an unknown verb or option.
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const CLI::App* verb = &app;
  for (const CLI::App* used : app.get_subcommands()) verb = used;
  std::vector<std::string> known;
  std::string unknown;
  if (verb == &app) {
    for (const Command& command : kCommands) known.emplace_back(command.name);
    if (words.empty()) return "no verb given; see signweave --help";
    unknown = words[0];
    if (unknown.starts_with('-')) {
      return fmt::format("'{}' comes before the verb; options come after it; see signweave --help", printable(unknown));
    }
    return fmt::format("no verb '{}'{}; see signweave --help", printable(unknown), did_you_mean(unknown, known));
  }
  std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    for (const CLI::Option* option : verb->get_options()) {
      if (option->get_group() == HelpFormat::kHidden) continue;  // a former name
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    for (const std::string& left : verb->remaining()) {
      if (left.starts_with('-')) {
        unknown = left;
        break;
      }
    }
    if (unknown.empty() && verb->remaining().empty()) {  // the remaining option came before the verb
      return fmt::format("'{}' comes before the verb; options come after it; see signweave --help",
                         printable(words.at(0)));
    }
    text = unknown.empty() ? one_word_too_many(*verb)
                           : fmt::format("no option '{}'{}", printable(unknown), did_you_mean(unknown, known));
  } else if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
    text = not_a_number(*verb, text);
  }
  return fmt::format("{}: {}; see signweave {} --help", verb->get_name(), text, verb->get_name());
}

/// Options of the hidden group are former names, described by the notice about them (see Binder).
void print_former_names(const CLI::App& app, Io& io) {
  for (const CLI::App* verb : app.get_subcommands()) {
    for (const CLI::Option* option : verb->get_options()) {
      if (option->get_group() == HelpFormat::kHidden && option->count() > 0)
        print_notices(io, {{.where = "", .text = option->get_description()}});
    }
  }
}

/// With --json the error is the answer: {"error": {"code", "message", …}}.
void print_fault(const nlohmann::json& fault, Io& io) {
  if (io.json) io.out << wire::text_of(nlohmann::json{{"error", fault}});
}

int refuse_usage(const std::string& text, Io& io) {
  io.err << "signweave: " << text << '\n';
  print_fault({{"code", "usage"}, {"message", text}}, io);
  return 2;
}

}  // namespace

std::span<const Command> commands() noexcept {
  return kCommands;
}

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      line += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      line += c;
    }
  }
  return line;
}

std::string advice_of(const Remedies& remedies) {
  std::string chosen, set;
  for (const Remedy& remedy : remedies) {
    std::string option = "--" + remedy.parameter;
    std::ranges::replace(option, '_', '-');
    if (remedy.value.empty()) {
      chosen += (chosen.empty() ? "" : " or ") + option;
    } else {
      set += (set.empty() ? "" : " ") + option + (remedy.value == "true" ? "" : " " + remedy.value);
    }
  }
  if (remedies.empty()) return {};
  return "; use " + set + (set.empty() || chosen.empty() ? "" : ", or ") + chosen;
}

void print_notices(Io& io, const std::vector<Notice>& notices) {
  for (const Notice& notice : notices) {
    io.err << "signweave: " << one_line(notice.where) << (notice.where.empty() ? "" : ": ") << one_line(notice.text)
           << one_line(advice_of(notice.remedies)) << '\n';
  }
}

calls::Listener listener_of(Io& io) {
  return {.notice = [&io](const Notice& notice) { print_notices(io, {notice}); },
          .fault =
              [&io](const std::string& line, const Remedies& remedies) {
                io.err << "signweave: " << one_line(line) << one_line(advice_of(remedies)) << '\n';
                io.status = 1;
              },
          .stage = {},
          .progress = {}};
}

void report_damage(const Database& database, Io& io) {
  calls::report_damage(database, listener_of(io));
}

int dispatch(const std::vector<std::string>& words, Io& io) {
  CLI::App app("signweave: a database of captured signing: find signs by meaning and movement, make new signing",
               "signweave");
  app.set_version_flag("--version", std::string(version()));
  app.formatter(std::make_shared<HelpFormat>());  // before the verbs, which inherit it
  app.require_subcommand(1);
  Run chosen;
  for (const Command& command : kCommands) {
    CLI::App* verb = app.add_subcommand(std::string(command.name), std::string(command.summary));
    verb->add_flag("--json", io.json, "results as one JSON document");
    verb->footer("Example:\n  " + std::string(command.example));
    Run run = command.setup(*verb);
    verb->callback([&chosen, run = std::move(run)] { chosen = run; });
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success& help) {  // --help, --version
    std::ostringstream text;
    app.exit(help, text, text);
    io.out << text.str();
    return 0;
  } catch (const CLI::ParseError& error) {
    io.json = std::ranges::find(words, "--json") != words.end();
    return refuse_usage(usage_fault(app, error, words), io);
  }
  print_former_names(app, io);
  try {
    chosen(io);
    return io.status;
  } catch (const CLI::ParseError& error) {  // errors that only the command itself can detect
    return refuse_usage(usage_fault(app, error, words), io);
  } catch (const SyntaxError& error) {
    io.err << "signweave: " << error.what() << '\n' << error.caret << '\n';
    print_fault(wire::fault_json(error, name_of(error.code()), error.what()), io);
  } catch (const Error& error) {
    io.err << "signweave: " << one_line(error.what()) << one_line(advice_of(error.remedies())) << '\n';
    print_fault(wire::fault_json(error, name_of(error.code()), one_line(error.what())), io);
    if (Interrupts::noted()) return kInterrupted;
  } catch (const std::bad_alloc&) {
    io.err << "signweave: not enough memory\n";
    print_fault({{"code", "io"}, {"message", "not enough memory"}}, io);
  } catch (const std::exception& error) {
    io.err << "signweave: " << error.what() << '\n';
    print_fault({{"code", "io"}, {"message", one_line(error.what())}}, io);
  }
  return 1;
}

}  // namespace signweave::cli
