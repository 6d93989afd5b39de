#include "tools/python/diagnostics.hpp"

#include <string>

namespace py = pybind11;

namespace rheonet::python {

py::dict as_dict(const Diagnostic& diagnostic, const Sources& sources) {
  py::dict result;
  const Spot& spot = diagnostic.spot;
  const bool in_file = !spot.on_command_line() && static_cast<std::size_t>(spot.file) < sources.files.size();
  result["severity"] = diagnostic.severity == Severity::error ? "error" : "warning";
  result["file"] = in_file ? py::cast(sources.files[static_cast<std::size_t>(spot.file)].path.string()) : py::none();
  result["line"] = in_file ? py::cast(spot.line) : py::none();
  result["column"] = in_file ? py::cast(spot.column) : py::none();
  result["message"] = diagnostic.message;
  result["hint"] = diagnostic.hint;
  result["text"] = format(diagnostic, sources);
  return result;
}

py::dict as_dict(const SimulationError& error, const Sources& sources) {
  py::dict result = as_dict({.severity = Severity::error, .spot = error.spot.value_or(Spot{}), .message = error.what(), .hint = {}}, sources);
  if (!error.spot) result["text"] = std::string("error: ") + error.what();
  return result;
}

void raise(const SimulationError& error, const Sources& sources) {
  const py::module_ package = py::module_::import("rheonet");
  py::list diagnostics;
  diagnostics.append(package.attr("Diagnostic")(**as_dict(error, sources)));
  const py::object type = package.attr("SimulationError");
  PyErr_SetObject(type.ptr(), type(diagnostics, py::none()).ptr());
  throw py::error_already_set();
}

}  // namespace rheonet::python
