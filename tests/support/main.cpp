#include <gtest/gtest.h>

#include "base/float_traps.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  mimicry::enable_float_traps();
  return RUN_ALL_TESTS();
}
