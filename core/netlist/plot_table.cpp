#include <algorithm>
#include <iterator>

#include "core/netlist/read_presentation.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/units.hpp"

namespace rheonet {

namespace {

/// One text, or several in an array.
std::vector<TomlValue> texts_of(const TomlEntry* entry, const std::string& example, DiagnosticList& diagnostics) {
  if (!entry) return {};
  const std::string what = "`" + entry->key + "`";
  std::vector<TomlValue> texts = entry->value.is_array() ? entry->value.items : std::vector{entry->value};
  std::erase_if(texts, [&](const TomlValue& text) { return !expect_string(text, what, diagnostics, example); });
  return texts;
}

TomlValue path(const TomlValue& subject, const std::string& channel) {
  TomlValue result = subject;
  result.text += channel;
  return result;
}

bool is_log(const std::string& text) { return text == "x" || text == "y" || text == "xy"; }

}  // namespace

std::vector<std::string> PlotTable::records() const {
  std::vector<std::string> paths;
  for (const Curve& curve : curves)
    for (const std::string& path : {curve.y, curve.x})
      if (path != "time" && std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
  return paths;
}

PlotTable read_plot_table(const TomlValue& plot, const std::set<std::string>& doubtful, Context& context,
                          Scene& scene) {
  DiagnosticList& diagnostics = context.diagnostics;
  PlotTable table;
  if (!expect_table(plot, "`plot`", diagnostics, "[plot] has keys such as y = [\"k1.force\"] and loop = \"c1\"")) return table;
  TableReader reader(plot, "[plot]");
  std::vector<TomlValue> xs, ys;
  const TomlEntry* x = reader.find("x");
  const bool known_x = x && expect_string(x->value, "`x`", diagnostics, "x = \"drum.position\"");
  TomlValue time;
  time.kind = TomlValue::Kind::string;
  time.text = "time";
  const TomlEntry* y = reader.find("y");
  for (const TomlValue& text : texts_of(y, "y = [\"k1.force\", \"c1.force\"]", diagnostics)) {
    xs.push_back(known_x ? x->value : time);
    ys.push_back(text);
  }
  if (x && !y) diagnostics.error(x->spot, "[plot] has `x` without `y`", "what is drawn against it: y = [\"k1.force\"]");
  const auto pairs = [&](const char* key, const char* over, const char* drawn, const char* example) {
    for (const TomlValue& text : texts_of(reader.find(key), example, diagnostics)) {
      xs.push_back(path(text, over));
      ys.push_back(path(text, drawn));
    }
  };
  pairs("loop", ".displacement", ".force", "loop = \"k1\": its force against its displacement");
  pairs("flow", ".velocity", ".force", "flow = \"c1\": its force against its velocity");
  pairs("phase", ".position", ".velocity", "phase = \"block\": the velocity of a node against its position");
  for (const TomlValue& text : texts_of(reader.find("unit"), "unit = [\"mm\", \"ms\"]", diagnostics)) {
    const auto unit = parse_unit(text.text);
    if (const auto* wrong = std::get_if<TextError>(&unit))
      diagnostics.error(diagnostics.inside(text, wrong->offset), "`unit`: " + wrong->message, wrong->hint);
    else
      table.units.push_back(text.text);
  }
  if (const TomlEntry* log = reader.find("log"); log && expect_string(log->value, "`log`", diagnostics, "log = \"y\"")) {
    if (is_log(log->value.text))
      table.log = log->value.text;
    else
      diagnostics.error(log->value.spot, "`log` must be `x`, `y` or `xy`, but is `" + log->value.text + "`");
  }
  reader.finish(diagnostics);

  std::vector<TomlValue> wanted = ys;
  std::copy_if(xs.begin(), xs.end(), std::back_inserter(wanted), [](const TomlValue& v) { return v.text != "time"; });
  const auto found = find_records(wanted, doubtful, context, scene);
  if (std::all_of(found.begin(), found.end(), [](const auto& record) { return record.has_value(); }))
    for (std::size_t i = 0; i < ys.size(); ++i) table.curves.push_back({xs[i].text, ys[i].text});
  return table;
}

}  // namespace rheonet
