#pragma once

namespace mimicry::cli {

/// While one of these lives, Ctrl-C and a request to end (SIGINT, SIGTERM) are only noted, so that
/// long work can stop between two steps and leave nothing behind. What the signals did before comes
/// back at the end.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  bool interrupted() const;

 private:
  void (*before_interrupt_)(int);
  void (*before_terminate_)(int);
};

}  // namespace mimicry::cli
