#include "commands.h"
#include "terminal/help_text.h"
#include "terminal/key_flags.h"
#include "terminal/quiet_libraries.h"
#include "terminal/usage.h"

#include "oneac/base/error.h"
#include "oneac/base/version.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>

int main(int argc, char** argv) {
  oneac::app::quiet_libraries();
  CLI::App program{"Where is the car going? Egomotion from one camera and a rawlog."};
  program.formatter(std::make_shared<oneac::app::HelpText>());  // of the verbs, too
  program.set_version_flag("--version", oneac::version());
  program.require_subcommand(1);
  oneac::app::add_info(program);
  oneac::app::add_run(program);
  oneac::app::add_calibrate(program);
  oneac::app::add_compare(program);
  oneac::app::add_features(program);
  oneac::app::add_import(program);
  oneac::app::add_simulate(program);
  oneac::app::add_eval(program);
  oneac::app::add_synth(program);
  oneac::app::check_values(program);
  try {
    program.parse(argc, argv);
    if (std::cout.flush()) return 0;
    throw std::runtime_error("standard output cannot be written");
  } catch (const CLI::ParseError& error) {
    return oneac::app::answer_to(error, program, {argv + 1, argv + argc});
  } catch (const oneac::InputError& error) {
    return oneac::app::end_with(error.what(), 2);
  } catch (const std::invalid_argument& error) {  // misuse that a flag led to
    return oneac::app::end_with(error.what(), 2);
  } catch (const std::exception& error) {
    return oneac::app::end_with(error.what(), 1);
  }
}
