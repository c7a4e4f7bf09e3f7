#include "help_text.h"

#include <cstddef>
#include <utility>

namespace oneac::app {
namespace {

constexpr std::size_t kColumn = 30;  // where the words about a flag begin

/// "  head      text"; a head that is too long has a line of its own.
std::string entry(const std::string& head, const std::string& text) {
  std::string line = "  " + head;
  if (text.empty()) return line + "\n";
  if (line.size() >= kColumn) {
    line += "\n" + std::string(kColumn, ' ');
  } else {
    line.resize(kColumn, ' ');
  }
  return line + text + "\n";
}

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

/// "TEXT=default ... REQUIRED", with a blank before it.
std::string value_of(const CLI::Option& option) {
  std::string text;
  if (option.get_type_size() != 0) {
    if (!option.get_type_name().empty()) text += " " + option.get_type_name();
    if (!option.get_default_str().empty()) text += "=" + option.get_default_str();
    if (takes_many(option)) text += " ...";
    if (option.get_required()) text += " REQUIRED";
  }
  if (!option.get_excludes().empty()) text += " Excludes:";
  for (const CLI::Option* other : option.get_excludes()) text += " " + other->get_name();
  return text;
}

std::string in_usage(const CLI::Option& positional) {
  const std::string name = positional.get_name(true) + (takes_many(positional) ? "..." : "");
  return positional.get_required() ? name : "[" + name + "]";
}

/// A title and what stands below it; "" where that is nothing.
std::string section(const std::string& title, const std::string& entries) {
  return entries.empty() ? "" : "\n" + title + ":\n" + entries;
}

}  // namespace

std::string HelpText::make_help(const CLI::App* app, std::string name,
                                CLI::AppFormatMode /*mode*/) const {
  std::string usage = "Usage: " + std::move(name) + " [OPTIONS]", positionals, options, verbs;
  for (const CLI::Option* option : app->get_options({})) {
    if (option->get_positional()) {
      usage += " " + in_usage(*option);
      positionals += entry(option->get_name(true) + value_of(*option), option->get_description());
    } else {
      options +=
          entry(option->get_name(false, true) + value_of(*option), option->get_description());
    }
  }
  for (const CLI::App* verb : app->get_subcommands({})) {
    verbs += entry(verb->get_name(), verb->get_description());
  }
  if (!verbs.empty()) usage += " SUBCOMMAND";
  return app->get_description() + "\n" + usage + "\n" + section("Positionals", positionals) +
         section("Options", options) + section("Subcommands", verbs) + "\n";
}

}  // namespace oneac::app
