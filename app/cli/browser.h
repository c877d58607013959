#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace signweave::cli {

/// The program of a browser that can draw without a screen: `wanted` where it is given, else $CHROMIUM, else the first
/// of chromium, chromium-browser, google-chrome in the PATH. Throws Error{not_found} where there is none.
std::filesystem::path find_browser(const std::string& wanted);

/// A headless Chromium on one page, with a profile of its own; ended with this object, and all that it began. Belongs
/// to one thread.
class Browser {
 public:
  /// `folder`: for its profile and what it says; must exist. Throws Error{io} where it cannot be started.
  Browser(const std::filesystem::path& program, const std::string& url, const std::filesystem::path& folder);
  Browser(const Browser&) = delete;
  ~Browser();

  /// False once it has ended by itself.
  bool running();
  /// The last line of what it said, for a fault.
  std::string last_words() const;

 private:
  std::filesystem::path said_;
  pid_t process_ = -1;
};

}  // namespace signweave::cli
