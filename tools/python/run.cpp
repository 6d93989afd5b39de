#include "tools/python/run.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "tools/rheonet/claims.hpp"

namespace rheonet::python {
namespace {

/// Takes the part of `text` before `separator` off its beginning.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
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

}  // namespace

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

}  // namespace rheonet::python
