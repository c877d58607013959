#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace signweave::cli {

/// The path of a browser that can draw without a display: `wanted` if given, else $CHROMIUM, else the first of
/// chromium, chromium-browser, google-chrome in the PATH. Throws Error{not_found} if there is none.
std::filesystem::path find_browser(const std::string& wanted);

/// A headless Chromium showing one page, with its own profile; the destructor ends it and its child processes. Belongs
/// to one thread.
class Browser {
 public:
  /// `folder`: for its profile and its output; must exist. Throws Error{io} if it cannot be started.
  Browser(const std::filesystem::path& program, const std::string& url, const std::filesystem::path& folder);
  Browser(const Browser&) = delete;
  ~Browser();

  /// False once it has ended by itself.
  bool running();
  /// The last line of its output, for an error message.
  std::string last_words() const;

 private:
  std::filesystem::path said_;
  pid_t process_ = -1;
};

}  // namespace signweave::cli
