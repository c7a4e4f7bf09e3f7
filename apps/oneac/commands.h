#pragma once

namespace CLI {
class App;
}

namespace oneac::app {

// Each adds one verb to the program. Its callback throws InputError (exit 2), OutputError or any
// other std::exception (exit 1); it prints results on stdout, progress and warnings on stderr.
void add_calibrate(CLI::App& program);
void add_compare(CLI::App& program);
void add_eval(CLI::App& program);
void add_features(CLI::App& program);
void add_import(CLI::App& program);
void add_info(CLI::App& program);
void add_run(CLI::App& program);
void add_simulate(CLI::App& program);
void add_synth(CLI::App& program);

}  // namespace oneac::app
