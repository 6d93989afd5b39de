#include "tools/python/run.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tools/rheonet/summary_json.hpp"

namespace rheonet::python {
namespace {

/// Takes the part of `text` before `separator` off its beginning.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

py::object as_python(const nlohmann::ordered_json& value) {
  if (value.is_object()) {
    py::dict result;
    for (const auto& [name, entry] : value.items()) result[py::str(name)] = as_python(entry);
    return result;
  }
  if (value.is_array()) {
    py::list result;
    for (const auto& entry : value) result.append(as_python(entry));
    return result;
  }
  if (value.is_string()) return py::str(value.get_ref<const std::string&>());
  if (value.is_boolean()) return py::bool_(value.get<bool>());
  if (value.is_number_integer()) return py::int_(value.get<long>());
  if (value.is_number()) return py::float_(value.get<double>());
  return py::none();
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

py::object summary_of(const Run& run) {
  return as_python(tool::summary_json(*run.scene, run.summary, static_cast<long>(run.times.size())));
}

py::object certificate_of(const Run& run) {
  return run.certificate ? as_python(tool::certificate_json(*run.scene, *run.certificate)) : py::none();
}

}  // namespace rheonet::python
