#include "oneac/base/parameter_table.h"

#include "oneac/base/finite_number.h"
#include "oneac/base/nearest_name.h"
#include "oneac/base/number_text.h"
#include "oneac/base/printable.h"
#include "oneac/base/require.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace oneac {
namespace {

constexpr std::size_t kLongestValue = 60;  // [byte] in a message

template <class Number>
bool parse(const std::string& text, Number& value) {
  const std::string_view digits = without_plus(text);
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  return error == std::errc{} && stop == end;
}

bool parse(const std::string& text, bool& value) {
  value = text == "true";
  return value || text == "false";
}

bool parse(const std::string& text, std::string& value) {
  value = text;
  return true;
}

const char* type_name(const ParameterTable::Target& target) {
  static constexpr const char* kNames[] = {"a number", "a whole number",
                                           "a whole number of at least 0", "true or false", "text"};
  return kNames[target.index()];
}

/// Shortest text that reads back as the same number; a decimal point marks it as real.
std::string text_of(double value) {
  std::string text = exact_text(value);
  if (text.find_first_of(".einf") == std::string::npos) text += ".0";
  return text;
}
std::string text_of(int value) {
  return std::to_string(value);
}
std::string text_of(std::size_t value) {
  return std::to_string(value);
}
std::string text_of(bool value) {
  return value ? "true" : "false";
}
std::string text_of(const std::string& value) {
  std::string quoted = "\"";
  for (char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::vector<std::string> split(const std::string& key) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', start)) {
    parts.push_back(key.substr(start, dot - start));
    start = dot + 1;
  }
  parts.push_back(key.substr(start));
  return parts;
}

}  // namespace

void ParameterTable::set(const std::string& key, const std::string& text) {
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const Parameter& p) { return p.key == key; });
  if (found == parameters_.end()) {
    std::vector<std::string> keys;
    for (const Parameter& p : parameters_) keys.push_back(p.key);
    throw std::invalid_argument("unknown key '" + key + "', did you mean '" +
                                nearest_name(key, keys) + "'?");
  }
  const bool good = std::visit(
      [&](auto* field) {
        std::remove_pointer_t<decltype(field)> value{};
        if (!parse(text, value)) return false;
        *field = value;
        return true;
      },
      found->target);
  if (!good) {
    throw std::invalid_argument("key '" + key + "' must be " + type_name(found->target) +
                                ", not '" + text + "'");
  }
}

std::string ParameterTable::value_text(const Parameter& parameter) const {
  return std::visit([](const auto* field) { return text_of(*field); }, parameter.target);
}

std::string ParameterTable::to_yaml(bool comments) const {
  std::string yaml;
  std::vector<std::string> open;  // sections that the last line stood in
  for (const Parameter& parameter : parameters_) {
    std::vector<std::string> path = split(parameter.key);
    const std::string name = path.back();
    path.pop_back();
    const auto shared = static_cast<std::size_t>(
        std::mismatch(open.begin(), open.end(), path.begin(), path.end()).first - open.begin());
    for (std::size_t depth = shared; depth < path.size(); ++depth) {
      yaml += std::string(2 * depth, ' ') + path[depth] + ":\n";
    }
    open = path;
    std::string line = std::string(2 * path.size(), ' ') + name + ": " + value_text(parameter);
    if (comments) {
      line.append(line.size() < 40 ? 40 - line.size() : 1, ' ');
      const std::string bound = parameter.bound.text();
      line +=
          "# [" + parameter.unit + (bound.empty() ? "" : ", " + bound) + "] " + parameter.meaning;
    }
    yaml += line + "\n";
  }
  return yaml;
}

void ParameterTable::check_bounds() const {
  for (const Parameter& parameter : parameters_) {
    const bool met = std::visit(
        [&](auto* field) {
          using Field = std::decay_t<decltype(*field)>;
          if constexpr (std::is_same_v<Field, std::string>) {
            return parameter.bound.holds(std::string_view(*field));
          } else {
            return parameter.bound.holds(static_cast<double>(*field));
          }
        },
        parameter.target);
    require(met, parameter.key, shortened(printable(value_text(parameter)), kLongestValue),
            parameter.bound.text());
  }
}

std::string ParameterTable::full_key(const std::string& name) const {
  const std::string ending = "." + name;
  for (const Parameter& parameter : parameters_) {
    const std::string& key = parameter.key;
    const bool ends = key.size() >= ending.size() &&
                      key.compare(key.size() - ending.size(), ending.size(), ending) == 0;
    if (key == name || ends) return key;
  }
  return name;
}

}  // namespace oneac
