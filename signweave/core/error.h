#pragma once

#include <stdexcept>
#include <string>

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

/// A fault in input, files or stored bytes: never in our own logic (that is an assert).
/// The text is one line: "FILE:LINE: what is wrong, and what would mend it". Parts that do not apply are left out.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

/// Something that the user should know of and that stopped nothing: a guess, a repair, an oddity of a file.
struct Notice {
  std::string where;  ///< "FILE" or "FILE:LINE" or a recording's name
  std::string text;   ///< one line, without a full stop
  friend bool operator==(const Notice&, const Notice&) = default;
};

}  // namespace signweave
