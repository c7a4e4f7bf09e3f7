#include "options.h"

#include <stdexcept>

namespace oneac::python {
namespace {

namespace py = pybind11;

/// As it stands in a YAML file.
std::string text_of(const std::string& key, const py::handle& value) {
  const std::string text = py::cast<std::string>(py::str(value));
  if (text == "True") return "true";
  if (text == "False") return "false";
  if (value.is_none()) throw std::invalid_argument("key '" + key + "' is None, give a value");
  return text;
}

}  // namespace

void set_parameters(const py::dict& values, const std::string& prefix, ParameterTable& table) {
  for (const auto& [name, value] : values) {
    const std::string key = prefix + py::cast<std::string>(py::str(name));
    if (py::isinstance<py::dict>(value)) {
      set_parameters(py::reinterpret_borrow<py::dict>(value), key + ".", table);
    } else {
      table.set(key, text_of(key, value));
    }
  }
}

}  // namespace oneac::python
