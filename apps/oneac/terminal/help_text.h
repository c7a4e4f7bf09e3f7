#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace oneac::app {

/// What --help prints, the same with every version of CLI11: manual pages and completion are made
/// from it, and the documentation quotes it.
class HelpText : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace oneac::app
