#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/run.hpp"
#include "tools/rheonet/variation.hpp"
#include "tools/tables/table_file.hpp"

namespace rheonet::tool {

/// A measure of a run as a whole: of its energy or of its cost.
struct SweepFigure {
  const char* name;
  double (*of)(const Summary&);
  const char* unit;
  bool of_energy = false;  ///< Needs the energy account of a run.
};

/// Whether a value, as `--set` takes it, is a number without reference to other values.
bool is_number(const std::string& value);

/// The columns of a sweep's table, and its rows as CSV. The first columns are the number of the run, from 1 on, and the varied values in SI,
/// or as text. Then come the measures (one row for each run), or time and records (many rows). The last column has the reason why a run
/// failed. Headings have units, as in `k1.force [N]`; the heading of a number has none.
class SweepTable {
 public:
  /// Returns a NoVariation if a measure is misspelt. A measure of the run as a whole has no brackets, a measure of a record has.
  static std::variant<SweepTable, NoVariation> make(const std::vector<std::string>& paths,
                                                    const std::vector<std::string>& measures);

  bool measures() const { return !measures_.empty(); }
  std::vector<std::string> measure_names() const;
  /// Known after `set_scene`; "1" for a number.
  std::vector<std::string> measure_units() const;
  /// The measures of records, for ReadOptions.
  std::vector<std::string> record_measures() const;
  /// Whether a measure needs the energy account of a run.
  bool needs_account() const;
  /// Takes the records and all units from the scene of any run that could be read.
  void set_scene(const Scene& scene);

  /// The columns of the header. `is_text`: for each varied value, whether it may be something other than a number.
  tables::Layout layout(const std::string& title, const std::vector<std::vector<std::string>>& points, const std::vector<bool>& is_text) const;
  /// `points`: the values of some runs, which determine the units of the columns of varied values.
  std::string header(const std::vector<std::vector<std::string>>& points) const;
  /// The cells that each row of a run begins with: "17,200,", and ends in a comma.
  static std::string key(long run, const std::vector<std::string>& values);
  /// The measures of a run in SI; not finite: no value.
  std::vector<double> values(const Summary& summary) const;
  /// The row of measures.
  std::string row(const std::string& key, const Summary& summary) const;
  /// Appends a row of a run's records.
  static void append(std::string& text, const std::string& key, double time, const std::vector<double>& values);
  /// Throws SimulationError if the records of a run, or the units of its columns, are not those of the first run.
  void check_columns(const Scene& scene) const;
  std::string failed(const std::string& key, const std::string& why) const;

 private:
  struct Measure {
    std::string text;
    const SweepFigure* figure = nullptr;  ///< nullptr: a measure of a record.
    std::string unit = "1";
  };
  struct RecordColumn {
    std::string path, unit;
  };

  struct Heading {
    std::string name, unit;
  };
  std::vector<Heading> headings(const std::vector<std::vector<std::string>>& points) const;

  std::vector<std::string> paths_;
  std::vector<Measure> measures_;
  std::vector<RecordColumn> records_;
};

}  // namespace rheonet::tool
