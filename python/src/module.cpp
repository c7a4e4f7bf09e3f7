// The extension module oneac._oneac. Python sees it through oneac/__init__.py.
#include "bindings.h"

#include "oneac/base/error.h"
#include "oneac/base/version.h"

namespace oneac::python {

void bind_errors(pybind11::module_& m) {
  auto& error = pybind11::register_exception<InputError>(m, "InputError", PyExc_ValueError);
  error.doc() = "Input that cannot be used: one line with where, fault and cure. A ValueError.";
  error.attr("__module__") = "oneac";
  m.def("version", &version, "Release and commit, as oneac --version prints them.");
}

}  // namespace oneac::python

PYBIND11_MODULE(_oneac, m) {
  m.doc() = "oneac's C++ library for Python; import oneac instead.";
  oneac::python::bind_errors(m);
  oneac::python::bind_geometry(m);
  oneac::python::bind_solvers(m);
  oneac::python::bind_focal(m);
  oneac::python::bind_robust(m);
  oneac::python::bind_files(m);
  oneac::python::bind_rawlog(m);
  oneac::python::bind_front_end(m);
}
