#include "tools/python/pictures.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <variant>

#include "tools/plot/compose.hpp"
#include "tools/plot/png.hpp"
#include "tools/python/diagnostics.hpp"
#include "tools/python/watch.hpp"
#include "tools/report/document.hpp"
#include "tools/rheonet/chart.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/scene_report.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::python {
namespace {

/// The rows of a run as something to draw.
class RunSource final : public tool::PlotSource {
 public:
  RunSource(const Run& run, std::string name, bool own) : run_(run) {
    file_ = std::move(name);
    title_ = run.scene->title;
    columns_ = tool::columns_of(*run.scene);
    if (!own) return;
    own_ = run.drawn;
    std::erase_if(own_.curves, [this](const PlotTable::Curve& curve) { return !has(curve.x) || !has(curve.y); });
  }

  std::vector<Drawn> read(const std::vector<plot::ColumnPair>& pairs) override {
    std::vector<Drawn> traces;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::vector<double>&x = column(pairs[k].first), &y = column(pairs[k].second);
      Drawn& drawn = traces.emplace_back(Drawn{k, "", {}});
      for (std::size_t row = 0; row < run_.times.size(); ++row) drawn.trace.add({x[row], y[row]});
    }
    return traces;
  }

 private:
  bool has(const std::string& name) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const plot::Column& column) { return column.name == name; });
  }
  const std::vector<double>& column(std::size_t k) const { return k == 0 ? run_.times : run_.columns[k - 1]; }

  const Run& run_;
};

}  // namespace

tool::Arguments::Plot plot_options(const py::kwargs& keywords) {
  tool::Arguments::Plot options;
  using Texts = std::vector<std::string>;
  const auto take = [&keywords](const char* name, auto& to) { to = keywords[name].cast<std::decay_t<decltype(to)>>(); };
  for (const auto& [name, to] : std::initializer_list<std::pair<const char*, Texts&>>{
           {"y", options.y}, {"loop", options.loops}, {"flow", options.flows}, {"phase", options.phases}, {"decay", options.decays},
           {"units", options.units}, {"names", options.names}})
    take(name, to);
  for (const auto& [name, to] : std::initializer_list<std::pair<const char*, std::string&>>{
           {"x", options.x}, {"log", options.log}, {"x_range", options.x_range}, {"y_range", options.y_range}, {"size", options.size},
           {"title", options.title}, {"x_label", options.x_label}, {"y_label", options.y_label}})
    take(name, to);
  take("magnitudes", options.magnitudes);
  take("marks", options.marks);
  return options;
}

Figure draw(const Run& run, const std::string& name, const tool::Arguments::Plot& options) {
  std::vector<std::unique_ptr<tool::PlotSource>> sources;
  sources.push_back(std::make_unique<RunSource>(run, name, tool::records_of(options).empty()));
  Figure figure;
  tool::Chart chart = tool::chart_of(sources, options, figure.notes);
  for (const plot::Measured& curve : chart.curves) figure.curves.push_back({curve.name, curve.x.name, curve.y.name});
  figure.logarithmic_x = chart.look.logarithmic_x;
  figure.logarithmic_y = chart.look.logarithmic_y;
  figure.magnitudes = chart.look.magnitudes;
  figure.svg = plot::svg(plot::compose(std::move(chart.curves), chart.look, figure.notes));
  return figure;
}

py::bytes png_of(const std::string& svg) {
  std::variant<plot::Png, plot::NoPng> made;
  {
    const Unlocked unlocked;
    made = plot::png(svg);
  }
  if (const auto* none = std::get_if<plot::NoPng>(&made)) {
    PyErr_SetString(PyExc_OSError, none->why.c_str());
    throw py::error_already_set();
  }
  return py::bytes(std::get<plot::Png>(made).bytes);
}

int write_file(const std::string& path, const std::string& content) {
  const Unlocked unlocked;
  try {
    tool::Output output(path, tool::Output::Writing::complete);
    std::fwrite(content.data(), 1, content.size(), output.file());
    return output.close();
  } catch (const std::system_error& error) {
    return error.code().value();
  }
}

py::tuple report(const std::vector<const Reading*>& readings, std::optional<double> accuracy, const std::string& title, bool certify, bool precision,
                 const py::object& progress) {
  if (!web::are_built()) throw std::runtime_error(std::string("a report cannot be made: ") + web::why_not_built());
  std::vector<std::vector<std::string>> scenes;
  std::vector<std::string> failures;
  std::string html;
  std::optional<SimulationError> failure;
  Watch watch(progress);
  watch.call(
      [&] {
        try {
          for (const Reading* reading : readings) {
            ReadResult read = reading->read_result(accuracy);
            tool::SceneReport made = tool::report_scene(read, reading->file(), {.certify = certify, .precision = precision, .interrupt = watch.interrupt()});
            for (const std::string& text : made.failures) failures.push_back(reading->file() + ": " + text);
            if (made.certificate && !made.certificate->holds) failures.push_back(reading->file() + ": the accuracy is not certified; the report says why");
            scenes.push_back(std::move(made.messages));
            watch.advance(static_cast<double>(scenes.size()) / static_cast<double>(readings.size()));
          }
          html = report::document(title, scenes);
        } catch (const SimulationError& error) {
          failure = error;
        }
      },
      true);
  if (failure) raise(*failure, readings[scenes.size()]->sources());
  return py::make_tuple(html, failures);
}

}  // namespace rheonet::python
