#pragma once

namespace mimicry {

/// Traps on invalid operation, division by zero and overflow, where the platform has them (glibc on
/// x86 and ARM); elsewhere nothing. Tests switch them on so that a NaN is found where it is born.
void enable_float_traps();

/// Masks the traps while it lives: put one around each call into third-party code that computes
/// with infinities or NaN on purpose. Restores what was set before.
class FloatTrapMask {
 public:
  FloatTrapMask();
  ~FloatTrapMask();
  FloatTrapMask(const FloatTrapMask&) = delete;
  FloatTrapMask& operator=(const FloatTrapMask&) = delete;

 private:
  int previous_;
};

}  // namespace mimicry
