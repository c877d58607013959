#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/calls/field.h"
#include "app/calls/json.h"
#include "app/calls/listener.h"
#include "signweave/backup/backup.h"

namespace signweave::calls {

/// Adds the state of a database to a backup.
struct BackupCall {
  std::optional<std::int64_t> keep;
};

template <class Visit>
void fields(Visit& visit, BackupCall& call) {
  visit(Field{.name = "keep",
              .help = "how many states stay in the backup, the newest; all where not given",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000}},
              .type_name = "N"},
        call.keep);
}

/// Reports faults to the listener, and throws as signweave::backup does.
BackupReport run(const Database& database, const std::filesystem::path& folder, const BackupCall& call,
                 const Listener& listener);
nlohmann::json json_of(const BackupReport& report);

/// Makes a database of a state of a backup.
struct RestoreCall {
  std::optional<std::int64_t> state;
  std::string engine;
  bool skip_damaged = false;
};

template <class Visit>
void fields(Visit& visit, RestoreCall& call) {
  visit(Field{.name = "state",
              .help = "which state, as 'signweave info BACKUP' numbers them; the newest where not given",
              .range = Range{std::int64_t{1}, std::int64_t{999'999'999}},
              .type_name = "N"},
        call.state);
  visit(Field{.name = "engine", .help = "key-value engine; as it was where not given", .one_of = kv::engines()},
        call.engine);
  visit(Field{.name = "skip_damaged", .help = "leave out recordings whose files are damaged, instead of refusing"},
        call.skip_damaged);
}

/// Reports what is left out to the listener, and throws as signweave::restore does.
RestoreReport run(const std::filesystem::path& folder, const std::filesystem::path& database, const RestoreCall& call,
                  const Listener& listener);
nlohmann::json json_of(const RestoreReport& report);

nlohmann::json json_of(const std::vector<BackupState>& states);

}  // namespace signweave::calls
