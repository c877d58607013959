#pragma once

namespace signweave::cli {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM are noted, so that what is under way can end in order; a second one ends
/// the program at once. They may be nested.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// True once there was one.
  static bool noted() noexcept;

 private:
  void (*int_)(int);
  void (*term_)(int);
};

}  // namespace signweave::cli
