#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/delivery.h"
#include "signweave/calls/synthesis_call.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/notation/score_json.h"

namespace signweave::cli {
namespace {

/// Options whose values a score has already decided. (Passed to CLI11, its help would list them all.)
constexpr const char* kDecided[] = {"--transition", "--duration", "--tempo",   "--align",       "--handedness",
                                    "--junction",   "--rate",     "--missing", "--explain",     "--mouthing",
                                    "--language",   "--blinks",   "--strict",  "--expressions", "--non-manuals",
                                    "--role",       "--roles"};

/// "bvh" of "out.bvh", and what is written alongside.
std::vector<std::string> extensions_of(const Delivery& delivery) {
  std::vector<std::string> extensions;
  for (const std::string& file : delivery.outputs) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (!extension.empty()) extensions.push_back(fold_case(extension.substr(1)));
  }
  return extensions;
}

}  // namespace

Run sign(CLI::App& verb) {
  struct SignArguments {
    std::string folder;
    calls::SignCall call;
    std::string from;
    std::string frames;
    std::string expressions;
    std::string roles;
    Delivery delivery;
  };
  auto options = std::make_shared<SignArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call, [&verb, options](std::string_view next) {
    if (next == "transition") add_outputs(verb, options->delivery.outputs);
  });
  CLI::Option* const utterance = verb.get_option("UTTERANCE")->required(false);
  verb.add_option("--from", options->from,
                  "render a score written by --score instead of an utterance: nothing is chosen again")
      ->excludes(utterance);
  verb.add_option("--expressions", options->expressions,
                  "a CSV file of expressions of your own (name,what,value), beside the built-in ones")
      ->check(CLI::ExistingFile);
  verb.add_option("--roles", options->roles,
                  "a CSV file of the roles of glosses in space (gloss,role), as --role gives them")
      ->check(CLI::ExistingFile);
  const calls::Field frames = calls::frames_field();
  verb.add_option("--frames", options->frames, frames.help)->needs("--from")->check(frames.check);
  add_reports(verb, options->delivery);
  return [options, utterance, &verb](Io& io) {
    if (options->from.empty() && utterance->empty()) throw CLI::RequiredError("UTTERANCE or --from");
    for (const char* decided : kDecided) {
      if (!options->from.empty() && verb.count(decided) > 0) throw CLI::ExcludesError("--from", decided);
    }
    if (!options->expressions.empty()) options->call.expressions = read_expressions(options->expressions);
    if (!options->roles.empty()) options->call.roles = read_space_roles(options->roles);
    std::optional<Score> score;
    if (!options->from.empty()) score = score_from_json(read_file(options->from, kLargestScore), options->from);
    const Database database(options->folder, kv::Access::read_only);
    const std::string title = score ? options->from : title_of(database, options->call);
    report_damage(database, io);
    check_signing_space(options->call.how.signing_space, options->delivery.outputs);
    const calls::SharedCharacter character = character_of(options->call.how.character);
    Synthesized made = score
                           ? calls::run(database, *score, {.frames = options->frames}, extensions_of(options->delivery))
                           : calls::run(database, options->call);
    if (character) show_on(made, stance_of(database, signer_of(made)), *character);
    deliver(made, options->call.how, options->delivery, title, character, io);
  };
}

}  // namespace signweave::cli
