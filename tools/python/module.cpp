// `_rheonet`: the compiled part of the Python package. rheonet/__init__.py makes the public classes from it.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "tools/plot/mistake.hpp"
#include "tools/python/diagnostics.hpp"
#include "tools/python/pictures.hpp"
#include "tools/python/reading.hpp"
#include "tools/python/run.hpp"
#include "tools/python/studies.hpp"
#include "tools/python/unlocked.hpp"
#include "tools/rheonet/chart.hpp"

namespace py = pybind11;

namespace rheonet::python {
namespace {

void add_runs(py::module_& module) {
  py::class_<Run>(module, "Run")
      .def_property_readonly("time", [](const py::object& self) { return view(self.cast<const Run&>().times, self); })
      .def("column", [](const py::object& self, std::size_t k) { return view(self.cast<const Run&>().columns.at(k), self); })
      .def_property_readonly("events", &events_of)
      .def_property_readonly("summary", &summary_of)
      .def_property_readonly("certificate", &certificate_of)
      .def_property_readonly("failure",
                             [](const Run& run) -> py::object {
                               if (!run.failure) return py::none();
                               return as_dict(*run.failure, *run.sources);
                             })
      .def("plot", [](const Run& run, const std::string& name, const py::kwargs& options) { return draw(run, name, plot_options(options)); });
  py::class_<Figure>(module, "Figure")
      .def_readonly("svg", &Figure::svg)
      .def_readonly("logarithmic_x", &Figure::logarithmic_x)
      .def_readonly("logarithmic_y", &Figure::logarithmic_y)
      .def_readonly("magnitudes", &Figure::magnitudes)
      .def_readonly("notes", &Figure::notes)
      .def_property_readonly("curves", [](const Figure& figure) {
        py::list curves;
        for (const Figure::Curve& curve : figure.curves) curves.append(py::make_tuple(curve.name, curve.x, curve.y));
        return curves;
      });
  module.def("png", &png_of, py::arg("svg"));
  module.def("write_file", [](const py::bytes& path, const py::bytes& content) { return write_file(path, content); }, py::arg("path"), py::arg("content"));
  module.def("records_to_plot", [](const py::kwargs& options) { return tool::records_of(plot_options(options)); });
}

void add_readings(py::module_& module) {
  py::class_<Reading>(module, "Reading")
      .def_property_readonly("complete", &Reading::complete)
      .def_property_readonly("diagnostics", &Reading::diagnostics)
      .def_property_readonly("mistakes_in_changes", &Reading::mistakes_in_changes)
      .def("run_with", &Reading::run_with, py::arg("times"), py::arg("columns"))
      .def_property_readonly("title", [](const Reading& r) { return r.scene().title; })
      .def_property_readonly("start", [](const Reading& r) { return r.scene().start; })
      .def_property_readonly("stop", [](const Reading& r) { return r.scene().stop; })
      .def_property_readonly("accuracy", [](const Reading& r) { return r.scene().accuracy; })
      .def_property_readonly("units", &Reading::units)
      .def(
          "run",
          [](const Reading& r, std::optional<double> accuracy, bool certified, int threads, bool both_sides, const py::object& progress) {
            return r.run({accuracy, certified, threads, both_sides}, progress);
          },
          py::arg("accuracy"), py::arg("certify"), py::arg("threads"), py::arg("both_sides"), py::arg("progress"))
      .def("explain", &Reading::explanation)
      .def("schematic", &Reading::schematic, py::call_guard<Unlocked>());

  py::class_<Source>(module, "Source")
      .def(py::init<std::string, std::optional<std::string>, std::string, const Source::Files&, const Source::Files&>(), py::arg("file"), py::arg("text"),
           py::arg("folder"), py::arg("texts") = Source::Files{}, py::arg("canonical") = Source::Files{})
      .def_property_readonly("file", &Source::file)
      .def("__reduce__", [](const py::object& self) { return py::make_tuple(py::type::of(self), self.cast<Source&>().state()); })
      .def(
          "read",
          [](Source& source, std::vector<std::string> overrides, std::optional<std::vector<std::string>> measures, std::vector<std::string> library,
             std::vector<std::string> records, bool plotted) {
            return source.read({std::move(overrides), std::move(measures), std::move(library), std::move(records), plotted});
          },
          py::arg("overrides"), py::arg("measures"), py::arg("library"), py::arg("records"), py::arg("plotted"),
          py::call_guard<Unlocked>());
}

void add_studies(py::module_& module) {
  py::class_<Comparison>(module, "Comparison")
      .def(py::init<const std::vector<const Reading*>&, std::vector<tool::Pairing>, const py::object&>(), py::arg("readings"),
           py::arg("pairings"), py::arg("progress"))
      .def_property_readonly("pairings", &Comparison::pairings)
      .def_property_readonly("units", &Comparison::units)
      .def_property_readonly("differences", &Comparison::differences)
      .def_property_readonly("dissipated", &Comparison::dissipated)
      .def_property_readonly("time", &Comparison::time)
      .def("rows", &Comparison::rows)
      .def_property_readonly("text", &Comparison::text);

  py::class_<Effects>(module, "Effects")
      .def(py::init<const Reading&, int, const py::object&>(), py::arg("reading"), py::arg("runs"), py::arg("progress"))
      .def_property_readonly("effects", &Effects::effects)
      .def_property_readonly("full", &Effects::full)
      .def_property_readonly("each", &Effects::each)
      .def_property_readonly("steps", &Effects::steps)
      .def("barest", &Effects::barest)
      .def("text", &Effects::text);

  py::class_<Precision>(module, "Precision")
      .def(py::init([](const Reading& reading, std::vector<double> accuracies, int runs, bool variants, bool certified,
                       std::vector<std::pair<std::string, const Reading*>> models, std::vector<std::vector<std::string>> records,
                       const py::object& progress) {
             return Precision(reading, {std::move(accuracies), runs, variants, certified, std::move(models), std::move(records)}, progress);
           }),
           py::arg("reading"), py::arg("accuracies"), py::arg("runs"), py::arg("variants"), py::arg("certified"), py::arg("models"),
           py::arg("records"), py::arg("progress"))
      .def_property_readonly("prices", &Precision::prices)
      .def_property_readonly("cheapest", &Precision::cheapest)
      .def_property_readonly("own", &Precision::own)
      .def_property_readonly("doubt", &Precision::doubt)
      .def_property_readonly("text", &Precision::text);

  py::class_<Sensitivities>(module, "Sensitivities")
      .def(py::init([](Source& source, std::vector<std::string> overrides, std::vector<std::string> library, std::vector<std::string> paths,
                       std::optional<double> accuracy, const py::object& progress) {
             Source::Wanted wanted{.overrides = std::move(overrides), .measures = std::vector<std::string>{}, .model_folders = std::move(library), .records = {}};
             return Sensitivities(source, wanted, std::move(paths), accuracy, progress);
           }),
           py::arg("source"), py::arg("overrides"), py::arg("library"), py::arg("paths"), py::arg("accuracy"), py::arg("progress"))
      .def_property_readonly("time", &Sensitivities::time)
      .def("rows", &Sensitivities::rows)
      .def_property_readonly("largest", &Sensitivities::largest)
      .def_property_readonly("text", &Sensitivities::text);

  module.def("evaluated", &evaluated, py::arg("text"));
  py::class_<tool::Design>(module, "DrawnPoints")
      .def(py::init(&drawn_points), py::arg("vary"), py::arg("kind"), py::arg("count"), py::arg("seed"), py::arg("correlate"))
      .def("__len__", &tool::Design::runs)
      .def("__getitem__",
           [](const tool::Design& points, long run) {
             if (run < 0 || run >= points.runs()) throw py::index_error();
             return points.point(run);
           })
      .def("__getitem__", [](const tool::Design& points, const py::slice& slice) {
        std::size_t first = 0, end = 0, step = 0, size = 0;
        if (!slice.compute(static_cast<std::size_t>(points.runs()), &first, &end, &step, &size)) throw py::error_already_set();
        std::vector<std::vector<std::string>> chosen;
        for (; chosen.size() < size; first += step) chosen.push_back(points.point(static_cast<long>(first)));
        return chosen;
      });
  module.def("report", &report, py::arg("readings"), py::arg("accuracy"), py::arg("title"), py::arg("certify"), py::arg("precision"), py::arg("progress"));
}

}  // namespace
}  // namespace rheonet::python

PYBIND11_MODULE(_rheonet, module) {
  module.attr("__version__") = RHEONET_VERSION;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const rheonet::plot::Mistake& mistake) {
      const std::string text = mistake.hint.empty() ? mistake.what() : std::string(mistake.what()) + "\n  " + mistake.hint;
      PyErr_SetString(PyExc_ValueError, text.c_str());
    }
  });
  rheonet::python::wait_at_exit();
  rheonet::python::add_runs(module);
  rheonet::python::add_readings(module);
  rheonet::python::add_studies(module);
}
