#include "cli/interrupt.h"

#include <csignal>

namespace mimicry::cli {
namespace {

volatile std::sig_atomic_t noted = 0;

void note(int) {
  noted = 1;
}

}  // namespace

InterruptWatch::InterruptWatch()
    : before_interrupt_(std::signal(SIGINT, note)), before_terminate_(std::signal(SIGTERM, note)) {}

InterruptWatch::~InterruptWatch() {
  std::signal(SIGINT, before_interrupt_);
  std::signal(SIGTERM, before_terminate_);
}

bool InterruptWatch::interrupted() const {
  return noted != 0;
}

}  // namespace mimicry::cli
