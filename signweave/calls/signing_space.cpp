#include "signweave/calls/signing_space.h"

#include <algorithm>

#include "signweave/core/error.h"
#include "signweave/formats/write_file.h"

namespace signweave::calls {

void check_signing_space(bool wanted, const std::vector<std::string>& paths) {
  const auto is_sheet = [](const std::string& path) { return extension_of(path) == ".svg"; };
  if (!wanted || std::ranges::any_of(paths, is_sheet)) return;
  throw Error(ErrorCode::bad_input, "'signing_space' is drawn on contact sheets only: request an .svg file");
}

}  // namespace signweave::calls
