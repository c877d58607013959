#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/delivery.h"
#include "app/cli/progress.h"
#include "signweave/calls/convert_call.h"
#include "signweave/formats/file_format.h"

namespace signweave::cli {

Run convert(CLI::App& verb) {
  struct ConvertArguments {
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
    calls::ConvertCall call;
  };
  auto options = std::make_shared<ConvertArguments>();
  verb.add_option("FILE", options->inputs,
                  "a motion file " + readable_extensions(FileKind::motion) +
                      ", its face capture (.face.csv), or an annotation file " +
                      readable_extensions(FileKind::annotation))
      ->required();
  add_outputs(verb, options->outputs);
  bind(verb, options->call);
  return [options](Io& io) {
    check_signing_space(options->call.signing_space, options->outputs);
    const calls::SharedCharacter character = character_of(options->call.character);
    const std::vector<std::filesystem::path> inputs(options->inputs.begin(), options->inputs.end());
    Progress progress(io, "reading");
    calls::Exported made =
        calls::run(inputs, options->call, options->outputs, [&](double fraction) { progress.show(fraction); });
    progress.hide();
    if (character && made.motion) show_on(made, calls::stance_of(*made.motion, made.info.rig), character);
    deliver(made, options->outputs, io);
  };
}

}  // namespace signweave::cli
