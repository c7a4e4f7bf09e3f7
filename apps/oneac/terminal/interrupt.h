#pragma once

namespace oneac::app {

/// From here on SIGINT and SIGTERM only set a flag, so that what was computed can be written; a
/// second signal ends the program as usual.
void catch_interrupts();

/// A signal has come.
[[nodiscard]] bool interrupted();

}  // namespace oneac::app
