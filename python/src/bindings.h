#pragma once

#include <pybind11/pybind11.h>

namespace oneac::python {

/// Each adds one part to the module `_oneac`, in this order: later ones use types of earlier ones.
void bind_errors(pybind11::module_& m);
void bind_geometry(pybind11::module_& m);
void bind_solvers(pybind11::module_& m);
void bind_focal(pybind11::module_& m);
void bind_robust(pybind11::module_& m);
void bind_files(pybind11::module_& m);
void bind_rawlog(pybind11::module_& m);
void bind_front_end(pybind11::module_& m);

}  // namespace oneac::python
