#include "core/netlist/table_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/netlist/csv_fields.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/units.hpp"

namespace rheonet {

namespace {

/// Reads the rows of a file, and reports the first mistakes in them.
class TableFileReader {
 public:
  TableFileReader(int file, const std::vector<TomlValue>& columns, const TableAbscissa& abscissa, Context& context)
      : file_(file), named_(columns), abscissa_(abscissa), context_(context) {}

  /// The table; absent if there are mistakes.
  std::optional<TableFile> read() {
    std::string_view rest = context_.files.text(file_);
    bool first = true;
    for (line_ = 1; !rest.empty(); ++line_) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (is_csv_remark(line)) continue;
      const std::vector<CsvField> fields = csv_fields(line);
      if (first && !named_.empty() && !find_columns(fields)) return {};
      if (!first || named_.empty()) row(fields, first);
      first = false;
    }
    if (diagnostics_ > most_told)
      context_.diagnostics.error({file_, first_untold_, 1},
                              "and " + std::to_string(diagnostics_ - most_told) + " more mistakes in this table");
    if (diagnostics_ > 0) return {};
    return std::move(table_);
  }

 private:
  static constexpr int most_told = 10;  // a file of the wrong kind has a mistake in every row

  void refuse(int column, std::string message, std::string hint = {}) {
    if (++diagnostics_ <= most_told)
      context_.diagnostics.error({file_, line_, column}, std::move(message), std::move(hint));
    else if (diagnostics_ == most_told + 1)
      first_untold_ = line_;
  }

  void row(const std::vector<CsvField>& fields, bool may_be_header) {
    if (fields.size() != width_) {
      refuse(1, named_.empty() ? fmt::format("a table of {} has two columns, {} and value; this row has {}", abscissa_.of, abscissa_.name, fields.size())
                               : fmt::format("the header has {} columns, this row has {}", width_, fields.size()),
             may_be_header ? how_to_choose(fields) : "");
      return;
    }
    const CsvField &time_field = fields[time_column_], &value_field = fields[value_column_];
    const auto time = csv_number(time_field);
    const auto value = csv_number(value_field);
    if (may_be_header && !time && !value) {
      header(time_field, value_field);
      return;
    }
    bool good = true;
    for (const auto& [parsed, field] : {std::pair(time, time_field), std::pair(value, value_field)}) {
      if (parsed && std::isfinite(*parsed)) continue;
      refuse(field.column, "expected a finite number, found `" + std::string(field.text) + "`");
      good = false;
    }
    if (!good) return;
    auto& points = table_.points;
    if (!points.empty() && multiplied(*time, unit_) < points.back().first)
      refuse(time_field.column, fmt::format("the {}s of a table must not decrease", abscissa_.name));
    else
      points.emplace_back(multiplied(*time, unit_), *value);
  }

  /// The hint for a first row with more than two fields.
  static std::string how_to_choose(const std::vector<CsvField>& fields) {
    if (fields.size() < 3) return "";
    if (csv_number(fields[0]) || csv_number(fields[1]))
      return "give the file a first row with names of its columns, and say which two are meant: columns = [\"time\", \"force\"]";
    return fmt::format("say which two are meant: columns = [\"{}\", \"{}\"]", csv_heading(fields[0].text).name, csv_heading(fields[1].text).name);
  }

  /// Finds the columns that the signal names in the header. False, with a mistake, unless both are there.
  bool find_columns(const std::vector<CsvField>& fields) {
    std::vector<std::string> names;
    for (const CsvField& field : fields) names.emplace_back(csv_heading(field.text).name);
    for (const auto& [wanted, column] : {std::pair(&named_[0], &time_column_), std::pair(&named_[1], &value_column_)}) {
      const auto found = std::find(names.begin(), names.end(), wanted->text);
      if (found == names.end()) {
        context_.diagnostics.error(wanted->spot, "the table has no column `" + wanted->text + "`",
                                did_you_mean(wanted->text, names, "its columns are " + list_names(names, "and")));
        return false;
      }
      *column = static_cast<std::size_t>(found - names.begin());
    }
    width_ = fields.size();
    header(fields[time_column_], fields[value_column_]);
    return true;
  }

  void header(const CsvField& time, const CsvField& value) {
    const auto time_unit = unit_of_column(time);
    const auto value_unit = unit_of_column(value);
    if (!time_unit || !value_unit) return;
    table_.unit = *value_unit;
    table_.argument = *time_unit;
    if (!abscissa_.quantity) {
      unit_ = time_unit->value;
      return;
    }
    const auto factor = as_quantity(*time_unit, *abscissa_.quantity, context_.domain);
    if (const auto* wrong = std::get_if<TextError>(&factor))
      refuse(time.column, fmt::format("the unit of the {}s: {}", abscissa_.name, wrong->message));
    else
      unit_ = std::get<double>(factor);
  }

  /// The unit at the end of a header's field: plain if there is none, absent if it has a mistake. Text in round brackets
  /// may also be a remark.
  std::optional<Number> unit_of_column(const CsvField& field) {
    const CsvHeading heading = csv_heading(field.text);
    Number one{.value = 1, .dimension = {}};
    if (heading.unit.empty() && !heading.square) return one;
    const auto parsed = parse_unit(heading.unit);
    if (const auto* unit = std::get_if<Unit>(&parsed))
      return number_in(1, *unit);
    if (heading.square) {
      const TextError& wrong = std::get<TextError>(parsed);
      refuse(field.column, "`" + std::string(heading.unit) + "` is no unit: " + wrong.message, wrong.hint);
      return {};
    }
    context_.diagnostics.warning({file_, line_, field.column},
                              "`" + std::string(heading.unit) + "` is no unit: this column is taken in SI");
    return one;
  }

  int file_;
  const std::vector<TomlValue>& named_;  ///< the columns that are named; empty if none are
  const TableAbscissa& abscissa_;
  Context& context_;
  std::size_t width_ = 2, time_column_ = 0, value_column_ = 1;
  TableFile table_{{}, {.value = 1, .dimension = {}}, {.value = 1, .dimension = {}}};
  double unit_ = 1;  ///< of the first column
  int line_ = 0;
  int diagnostics_ = 0;
  int first_untold_ = 0;  ///< line of the first mistake that is not listed
};

}  // namespace

std::optional<TableFile> read_table_file(const TomlValue& name, const std::vector<TomlValue>& columns, const TableAbscissa& abscissa,
                                         Context& context) {
  const auto found = context.files.find(name, name.spot.file, context.diagnostics);
  if (!found) return {};
  const auto file = context.files.read(*found, Sources::Role::table, name.spot, context.diagnostics);
  if (!file) return {};
  if (is_netcdf(context.files.text(*file))) {
    context.diagnostics.error(name.spot, "`" + name.text + "` is a NetCDF or HDF5 file, but tables are read from CSV and MAT files", netcdf_hint);
    return {};
  }
  auto table = TableFileReader(*file, columns, abscissa, context).read();
  if (table && table->points.empty()) {
    context.diagnostics.error(name.spot, "the table `" + name.text + "` has no rows");
    return {};
  }
  return table;
}

std::vector<TomlValue> read_column_names(const TomlEntry& columns, bool from_file, const std::string& abscissa, const std::string& example, DiagnosticList& diagnostics) {
  const std::string shown = "columns = [" + example + "]";
  if (!from_file) {
    diagnostics.error(columns.spot, "`columns` names columns of a CSV file, but `table` names none", "table = \"measured.csv\", " + shown);
    return {};
  }
  if (!expect_array(columns.value, "`columns`", diagnostics, shown)) return {};
  if (columns.value.items.size() != 2) {
    diagnostics.error(columns.value.spot, fmt::format("`columns` names two columns, of the {}s and of the values", abscissa), shown);
    return {};
  }
  for (const TomlValue& name : columns.value.items)
    if (!expect_string(name, "a column", diagnostics, shown)) return {};
  return columns.value.items;
}

}  // namespace rheonet
