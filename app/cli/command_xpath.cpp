#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/wire/text.h"
#include "signweave/calls/table.h"
#include "signweave/calls/xpath_call.h"

namespace signweave::cli {

Run xpath(CLI::App& verb) {
  struct XPathArguments {
    std::string folder;
    calls::XPathCall call;
  };
  auto options = std::make_shared<XPathArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call);
  return [options](Io& io) {
    // Errors in the expression are reported before anything is opened.
    const xpath::Expression expression(options->call.expression);
    const Database database(options->folder, kv::Access::read_only);
    report_damage(database, io);
    const std::vector<XPathAnswer> answers = calls::run(database, options->call);
    if (io.json) {
      io.out << text_of(answer_json<nlohmann::json>(calls::node_answers(answers)));
      return;
    }
    io.out << format_table(calls::rows_of(answers)) << counted(answers.size(), "answer") << '\n';
  };
}

}  // namespace signweave::cli
