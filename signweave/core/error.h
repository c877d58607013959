#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace signweave {

/// What kind of fault an `Error` is. The command line turns it into an exit status, a server into an HTTP status.
enum class ErrorCode {
  bad_input,       ///< a file, text or option from outside is wrong
  not_found,       ///< what was named does not exist
  already_exists,  ///< what was to be made is there already
  conflict,        ///< somebody else is changing it now
  corrupt,         ///< stored bytes are damaged
  unsupported,     ///< understood, but this version cannot do it
  io,              ///< the operating system refused (disk full, no permission)
  cancelled,       ///< stopped on request, or by a deadline
};

/// A parameter of the call that would fix what an `Error` or a `Notice` reports. The library names it as the call's
/// fields do; each front end spells it its own way: `--root-order rotation_first`, a property of JSON, a button.
struct Remedy {
  std::string parameter;  ///< "root_order"
  std::string value;      ///< what to set it to, "true" for a flag; empty: the user has to choose
  friend bool operator==(const Remedy&, const Remedy&) = default;
};
/// Those with a value are set together; of those without one any may do.
using Remedies = std::vector<Remedy>;

/// A fault in input, files or stored bytes: never in our own logic (that is an assert).
/// The text is one line: "FILE:LINE: what is wrong, and what would mend it". Parts that do not apply are left out.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& text, Remedies remedies = {})
      : std::runtime_error(text), code_(code), remedies_(std::move(remedies)) {}
  ErrorCode code() const noexcept { return code_; }
  const Remedies& remedies() const noexcept { return remedies_; }

 private:
  ErrorCode code_;
  Remedies remedies_;
};

/// Something that the user should know of and that stopped nothing: a guess, a repair, an oddity of a file.
struct Notice {
  std::string where;  ///< "FILE" or "FILE:LINE" or a recording's name
  std::string text;   ///< one line, without a full stop
  Remedies remedies = {};
  friend bool operator==(const Notice&, const Notice&) = default;
};

}  // namespace signweave
