#include "interrupt.h"

#include <csignal>

namespace oneac::app {
namespace {

// The one piece of global state that a signal handler may touch.
volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void on_signal(int number) {
  g_interrupted = 1;
  std::signal(number, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() {
  return g_interrupted != 0;
}

}  // namespace oneac::app
