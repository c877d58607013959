#pragma once

namespace signweave::cli {

/// While an instance exists, Ctrl-C (SIGINT) and SIGTERM are only noted, so that running work can end in good order; a
/// second one ends the program immediately. Instances may be nested.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// True once a signal was received.
  static bool noted() noexcept;

 private:
  void (*int_)(int);
  void (*term_)(int);
};

}  // namespace signweave::cli
