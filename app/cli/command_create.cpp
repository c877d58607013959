#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/validators.h"
#include "app/wire/text.h"
#include "signweave/calls/change_calls.h"
#include "signweave/database/database.h"

namespace signweave::cli {

Run create(CLI::App& verb) {
  struct CreateArguments {
    std::string folder;
    std::string engine = "lmdb";
    std::string mode = "by_frame";
    std::optional<double> compact;  ///< millimetres
    std::string documents = "document";
  };
  auto options = std::make_shared<CreateArguments>();
  verb.add_option("DB", options->folder, "folder to create; must not exist or be empty")->required();
  verb.add_option("--engine", options->engine, "key-value engine")->check(one_of(kv::engines()))->capture_default_str();
  Binder binder(verb, {});
  calls::Field access_mode = calls::access_mode_field();
  access_mode.shows_default = true;
  binder(access_mode, options->mode);
  binder(calls::compact_field(), options->compact);
  calls::Field documents = calls::documents_field();
  documents.shows_default = true;
  binder(documents, options->documents);
  return [options](Io& io) {
    const AccessMode mode = *parse_access_mode(options->mode);
    Database::create(options->folder, {.engine = options->engine,
                                       .access_mode = mode,
                                       .tolerance = static_cast<float>(options->compact.value_or(0) / 1e3),
                                       .documents = *parse_document_storage(options->documents)});
    if (io.json) {
      io.out << text_of(nlohmann::json{{"database", options->folder},
                                       {"engine", options->engine},
                                       {"access_mode", to_string(mode)},
                                       {"compact_mm", options->compact.value_or(0)},
                                       {"documents", options->documents}});
    }
  };
}

}  // namespace signweave::cli
