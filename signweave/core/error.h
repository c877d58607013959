#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace signweave {

/// The kind of an `Error`. The command line maps it to an exit status, the server to an HTTP status.
enum class ErrorCode {
  bad_input,       ///< invalid input: a file, a text or an option
  not_found,       ///< the named item does not exist
  already_exists,  ///< the item to be created already exists
  conflict,        ///< another process or thread is using it
  corrupt,         ///< stored data is damaged
  unsupported,     ///< valid, but this version does not support it
  io,              ///< the operating system reported an error (disk full, no permission)
  cancelled,       ///< stopped on request or by a deadline
};

/// "not_found": the name of a kind of error in the answers of the command line, HTTP and streams.
constexpr std::string_view name_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::bad_input:
      return "bad_input";
    case ErrorCode::not_found:
      return "not_found";
    case ErrorCode::already_exists:
      return "already_exists";
    case ErrorCode::conflict:
      return "conflict";
    case ErrorCode::corrupt:
      return "corrupt";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::io:
      return "io";
    case ErrorCode::cancelled:
      return "cancelled";
  }
  return "io";
}

/// A parameter of the call that would fix what an `Error` or a `Notice` reports. The library names it as the call's
/// fields do; each front end spells it its own way: `--root-order rotation_first`, a property of JSON, a button.
struct Remedy {
  std::string parameter;  ///< "root_order"
  std::string value;      ///< what to set it to, "true" for a flag; empty: the user has to choose
  friend bool operator==(const Remedy&, const Remedy&) = default;
};
/// Those with a value are set together; of those without one any may do.
using Remedies = std::vector<Remedy>;

/// An error in input, files or stored data; errors in the program's own logic are asserts. The text is one line:
/// "FILE:LINE: what is wrong, and how to fix it". Parts that do not apply are left out.
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

/// Information for the user about something that stopped nothing: a guess, a repair, an oddity of a file.
struct Notice {
  std::string where;  ///< "FILE" or "FILE:LINE" or a recording's name
  std::string text;   ///< one line, without a full stop
  Remedies remedies = {};
  std::string code = {};  ///< for programs: what kind of notice it is; empty for most
  friend bool operator==(const Notice&, const Notice&) = default;
};

}  // namespace signweave
