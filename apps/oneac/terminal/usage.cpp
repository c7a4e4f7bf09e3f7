#include "usage.h"

#include "oneac/base/nearest_name.h"
#include "oneac/base/printable.h"

#include <algorithm>
#include <cstddef>
#include <iostream>

namespace oneac::app {
namespace {

constexpr std::size_t kLongest = 3000;  // [byte] of a line, as where, fault and cure have together
constexpr std::size_t kLongestWord = 60;

std::vector<std::string> verbs_of(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

/// Which verb is meant, where the first argument is none; "" when it is one, or a flag.
std::string about_verb(const CLI::App& program, const std::vector<std::string>& arguments) {
  const std::vector<std::string> verbs = verbs_of(program);
  if (verbs.empty()) return "";
  std::string all;
  for (const std::string& verb : verbs) all += (all.empty() ? "" : ", ") + verb;
  if (arguments.empty()) return "no verb given; choose from: " + all;
  const std::string& word = arguments.front();
  const bool known = std::find(verbs.begin(), verbs.end(), word) != verbs.end();
  if (known) {  // it may have verbs of its own
    return about_verb(*program.get_subcommand(word), {arguments.begin() + 1, arguments.end()});
  }
  if (!word.empty() && word.front() == '-') {
    return "'" + shortened(word, kLongestWord) +
           "' stands where a verb belongs, flags go behind it. "
           "There are: " +
           all;
  }
  return "'" + shortened(word, kLongestWord) + "' is no verb, did you mean '" +
         nearest_name(shortened(word, kLongestWord), verbs) + "'? There are: " + all;
}

/// Words as they were typed, none of them longer than a line.
std::string with_short_words(const std::string& text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    line += (at == 0 ? "" : " ") + shortened(text.substr(at, end - at), kLongestWord);
    at = end + 1;
  }
  return line;
}

}  // namespace

int answer_to(const CLI::ParseError& error, const CLI::App& program,
              const std::vector<std::string>& arguments) {
  if (error.get_exit_code() == 0) return program.exit(error);  // help, version
  const std::string verb = about_verb(program, arguments);
  if (!verb.empty()) return end_with(verb, 2);
  const std::string of = arguments.front().front() == '-' ? "" : arguments.front() + " ";
  return end_with(with_short_words(error.what()) + "; see oneac " + of + "--help", 2);
}

int end_with(const std::string& what, int code) {
  std::cerr << "oneac: " << shortened(printable(what), kLongest) << '\n';
  return code;
}

}  // namespace oneac::app
