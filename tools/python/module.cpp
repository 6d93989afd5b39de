// `_rheonet`: the compiled part of the Python package. rheonet/__init__.py makes the public classes from it.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "core/netlist/read.hpp"
#include "core/network/advice.hpp"
#include "core/network/component.hpp"
#include "core/result/certify.hpp"
#include "core/result/explain.hpp"
#include "core/result/memory_file.hpp"
#include "core/result/run.hpp"
#include "tools/draw/schematic.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/rheonet/claims.hpp"
#include "tools/rheonet/explanation.hpp"

namespace py = pybind11;

namespace rheonet {
namespace {

/// Time between two looks for signals (Ctrl-C), which is also the time between two calls of `progress`: short for a person.
constexpr auto polling_interval = std::chrono::milliseconds(20);

/// A diagnostic as the keywords of `rheonet.Diagnostic`.
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

/// The same for a scene that cannot be simulated; without a place in the netlist if the error has none.
py::dict as_dict(const SimulationError& error, const Sources& sources) {
  py::dict result = as_dict({.severity = Severity::error, .spot = error.spot.value_or(Spot{}), .message = error.what(), .hint = {}}, sources);
  if (!error.spot) result["text"] = std::string("error: ") + error.what();
  return result;
}

/// Takes the part of `text` before `separator` off its beginning.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

/// The rows, the events and the summary of a run. Each record has a column of its own, which NumPy views without a copy.
struct Run {
  std::vector<double> times;
  std::vector<std::vector<double>> columns;  ///< one for each record of the scene
  std::string events;                        ///< as `rheonet run --events` writes them: CSV with a header
  Summary summary;
  std::optional<Certificate> certificate;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Sources> sources;
  std::optional<SimulationError> failure;  ///< why the run ended early; the rows before are there
};

/// A read-only view of a column, which keeps its owner alive.
py::array_t<double> view(const std::vector<double>& column, const py::handle& owner) {
  py::array_t<double> array({column.size()}, {sizeof(double)}, column.data(), owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::list events_of(const Run& run) {
  py::list result;
  std::string_view rest = run.events;
  take(rest, '\n');  // the header
  while (!rest.empty()) {
    std::string_view line = take(rest, '\n');
    double time = 0;
    const std::string_view written = take(line, ',');
    std::from_chars(written.data(), written.data() + written.size(), time);
    const std::string_view element = take(line, ','), what = take(line, ',');
    int direction = 0;
    std::from_chars(line.data(), line.data() + line.size(), direction);
    result.append(py::make_tuple(time, element, what, direction));
  }
  return result;
}

py::list claims_of(const Run& run) {
  py::list result;
  for (std::size_t k = 0; k < run.summary.findings.size(); ++k) {
    const Claim& claim = run.scene->claims[k];
    const Finding& finding = run.summary.findings[k];
    const tool::ClaimInWords words = tool::in_words(*run.scene, claim, finding);
    py::dict entry;
    entry["name"] = words.name;
    entry["found"] = finding.found;
    entry["unit"] = tool::unit_of_claim(claim, *run.scene);
    entry["claimed"] = words.claimed;
    entry["holds"] = finding.holds;
    result.append(entry);
  }
  return result;
}

py::dict summary_of(const Run& run) {
  const Summary& s = run.summary;
  py::dict result, switched;
  for (const Summary::Switched& element : s.switched) switched[py::str(element.element)] = element.times;
  result["rows"] = run.times.size();
  result["unknowns"] = s.unknowns;
  result["parts"] = s.parts;
  result["steps"] = s.steps;
  result["arc_steps"] = s.arc_steps;
  result["rejected_steps"] = s.rejected_steps;
  result["residual_evaluations"] = s.residual_evaluations;
  result["jacobian_evaluations"] = s.jacobian_evaluations;
  result["restarts"] = s.restarts;
  result["events"] = s.events;
  result["switched"] = switched;
  result["energy_supplied"] = s.supplied;
  result["energy_stored"] = s.stored;
  result["energy_dissipated"] = s.dissipated;
  result["energy_missing"] = s.missing;
  result["ended"] = s.ended;
  result["wall_seconds"] = s.wall_seconds;
  result["cpu_seconds"] = s.cpu_seconds;
  result["notes"] = s.notes;
  result["claims"] = claims_of(run);
  return result;
}

py::object certificate_of(const Run& run) {
  if (!run.certificate) return py::none();
  const Certificate& c = *run.certificate;
  py::dict result, errors;
  for (std::size_t k = 0; k < c.errors.size() && k < run.scene->records.size(); ++k) {
    py::dict error;
    error["largest"] = c.errors[k].largest;
    error["time"] = c.errors[k].time;
    error["relative"] = c.errors[k].relative();
    errors[py::str(run.scene->records[k].path)] = error;
  }
  result["holds"] = c.holds;
  result["errors"] = errors;
  result["obstacle"] = c.obstacle;
  result["runs"] = c.runs;
  result["cpu_seconds"] = c.cpu_seconds;
  return result;
}

/// Looks for signals and calls `progress` during a run, at intervals. An exception (KeyboardInterrupt) ends the run.
class Watch {
 public:
  /// `progress` is called with the fraction of the run completed, unless it is None.
  explicit Watch(const py::object& progress) : progress_(progress) {}

  const std::atomic<bool>* interrupt() const { return &interrupt_; }

  /// For RunSettings::progress. The engine may call it in any thread, but Python delivers signals to its main thread only: so the
  /// thread that made the Watch is the one that looks.
  void advance(double fraction) {
    fraction_ = fraction;
    if (std::this_thread::get_id() == caller_ && std::chrono::steady_clock::now() - last_ > polling_interval) look();
  }

  /// Calls `work` without the interpreter lock. If the engine has `threads`, this thread only watches. Throws what ended the run.
  void call(const std::function<void()>& work, int threads) {
    {
      const py::gil_scoped_release unlocked;
      if (threads > 1) {
        std::future<void> done = std::async(std::launch::async, work);
        while (done.wait_for(polling_interval) == std::future_status::timeout) look();
        done.get();
      } else {
        work();
      }
    }
    if (stopped_) std::rethrow_exception(stopped_);
  }

 private:
  void look() {
    if (stopped_) return;
    last_ = std::chrono::steady_clock::now();
    const py::gil_scoped_acquire locked;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_.is_none()) progress_(fraction_.load());
    } catch (...) {
      stopped_ = std::current_exception();
      interrupt_ = true;
    }
  }

  const py::object& progress_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::atomic<bool> interrupt_ = false;
  std::atomic<double> fraction_ = 0;
  std::exception_ptr stopped_;
};

/// A netlist that has been read: the scene, or the mistakes in it.
class Reading {
 public:
  explicit Reading(ReadResult result)
      : sources_(std::make_shared<const Sources>(std::move(result.sources))), diagnostics_(std::move(result.diagnostics)) {
    if (!result.scene) return;
    scene_ = std::make_shared<const Scene>(std::move(*result.scene));
    const std::vector<Diagnostic> advice = advice_on(*scene_);
    diagnostics_.insert(diagnostics_.end(), advice.begin(), advice.end());
  }

  bool complete() const { return scene_ != nullptr; }
  const Scene& scene() const { return *scene_; }

  py::list diagnostics() const {
    py::list result;
    for (const Diagnostic& diagnostic : diagnostics_) result.append(as_dict(diagnostic, *sources_));
    return result;
  }

  py::dict units() const {
    py::dict result;
    for (const Record& record : scene_->records) result[py::str(record.path)] = unit_text(*scene_, record);
    return result;
  }

  std::unique_ptr<Run> run(std::optional<double> accuracy, bool certified, int threads, const py::object& progress) const {
    auto run = std::make_unique<Run>();
    run->scene = with_accuracy(accuracy);
    run->sources = sources_;
    run->columns.resize(scene_->records.size());
    const auto rows = static_cast<std::size_t>(scene_->output_intervals) + 1;
    run->times.reserve(rows);
    for (std::vector<double>& column : run->columns) column.reserve(rows);

    MemoryFile events;
    Watch watch(progress);
    const RunSettings settings{.events = events.file(),
                               .row = [&run](double time, const std::vector<double>& values) {
                                 run->times.push_back(time);
                                 // As in the CSV, -0 becomes 0.
                                 for (std::size_t k = 0; k < values.size(); ++k) run->columns[k].push_back(values[k] + 0.0);
                               },
                               .interrupt = watch.interrupt(),
                               .progress = [&watch](double fraction) { watch.advance(fraction); },
                               .threads = threads};
    const auto work = [&] {
      try {
        if (certified) {
          run->certificate = certify(*run->scene, settings);
          run->summary = run->certificate->summary;
        } else {
          run->summary = rheonet::run(*run->scene, settings);
        }
      } catch (const SimulationError& error) {
        run->failure = error;
      }
    };
    watch.call(work, threads);
    run->events = events.text();
    return run;
  }

  /// The JSON of `rheonet explain --json`, or "" and why the scene cannot start.
  py::tuple explanation() const {
    std::string json;
    std::optional<SimulationError> failure;
    {
      const py::gil_scoped_release unlocked;
      try {
        json = tool::to_json(*scene_, explain(*scene_));
      } catch (const SimulationError& error) {
        failure = error;
      }
    }
    return py::make_tuple(json, failure ? py::object(as_dict(*failure, *sources_)) : py::none());
  }

  /// The SVG of the network; absent if it is too large to be drawn.
  std::optional<std::string> schematic() const {
    try {
      return draw::svg(draw::schematic(*scene_, {.title = scene_->title, .sources = sources_.get()}), *scene_);
    } catch (const plot::Mistake&) {
      return std::nullopt;
    }
  }

 private:
  std::shared_ptr<const Scene> with_accuracy(std::optional<double> accuracy) const {
    if (!accuracy || *accuracy == scene_->accuracy) return scene_;
    auto changed = std::make_shared<Scene>(*scene_);
    changed->accuracy = *accuracy;
    return changed;
  }

  std::shared_ptr<const Sources> sources_;
  std::shared_ptr<const Scene> scene_;  ///< nullptr if there is any mistake
  std::vector<Diagnostic> diagnostics_;
};

/// A netlist before it is read: a file, or a text, for which `file` then stands in messages. Its files are read from disk once, so
/// that every reading sees the same.
class Source {
 public:
  Source(std::string file, std::optional<std::string> text, std::string folder)
      : file_(std::move(file)), text_(std::move(text)), folder_(std::move(folder)) {}

  const std::string& file() const { return file_; }
  py::tuple arguments() const { return py::make_tuple(file_, text_, folder_); }

  /// `measures` take the place of the file's claims, which are about the scene without changes. `library`: folders that `include`
  /// falls back on.
  Reading read(std::vector<std::string> overrides, const std::optional<std::vector<std::string>>& measures,
               const std::vector<std::string>& library) {
    const ReadOptions options{.overrides = std::move(overrides),
                              .claims = !measures,
                              .measures = measures.value_or(std::vector<std::string>{}),
                              .model_folders = {library.begin(), library.end()},
                              .cache = &cache_};
    return Reading(text_ ? read_scene_text(*text_, file_, folder_, declarations(), options) : read_scene(file_, declarations(), options));
  }

 private:
  std::string file_;
  std::optional<std::string> text_;
  std::string folder_;  ///< of files that a text includes
  FileCache cache_;
};

}  // namespace

PYBIND11_MODULE(_rheonet, module) {
  module.attr("__version__") = RHEONET_VERSION;

  py::class_<Run>(module, "Run")
      .def_property_readonly("time", [](const py::object& self) { return view(self.cast<const Run&>().times, self); })
      .def("column", [](const py::object& self, std::size_t k) { return view(self.cast<const Run&>().columns.at(k), self); })
      .def_property_readonly("events", &events_of)
      .def_property_readonly("summary", &summary_of)
      .def_property_readonly("certificate", &certificate_of)
      .def_property_readonly("failure", [](const Run& run) -> py::object {
        if (!run.failure) return py::none();
        return as_dict(*run.failure, *run.sources);
      });

  py::class_<Reading>(module, "Reading")
      .def_property_readonly("complete", &Reading::complete)
      .def_property_readonly("diagnostics", &Reading::diagnostics)
      .def_property_readonly("title", [](const Reading& r) { return r.scene().title; })
      .def_property_readonly("start", [](const Reading& r) { return r.scene().start; })
      .def_property_readonly("stop", [](const Reading& r) { return r.scene().stop; })
      .def_property_readonly("accuracy", [](const Reading& r) { return r.scene().accuracy; })
      .def_property_readonly("units", &Reading::units)
      .def("run", &Reading::run, py::arg("accuracy"), py::arg("certify"), py::arg("threads"), py::arg("progress"))
      .def("explain", &Reading::explanation)
      .def("schematic", &Reading::schematic, py::call_guard<py::gil_scoped_release>());

  py::class_<Source>(module, "Source")
      .def(py::init<std::string, std::optional<std::string>, std::string>(), py::arg("file"), py::arg("text"), py::arg("folder"))
      .def_property_readonly("file", &Source::file)
      .def_property_readonly("arguments", &Source::arguments)
      .def("__reduce__", [](const py::object& self) { return py::make_tuple(py::type::of(self), self.attr("arguments")); })
      .def("read", &Source::read, py::arg("overrides"), py::arg("measures"), py::arg("library"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace rheonet
