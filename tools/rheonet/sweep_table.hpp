#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/run.hpp"
#include "tools/rheonet/variation.hpp"
#include "tools/tables/table_file.hpp"

namespace rheonet::tool {

/// A figure of a run that is no record's: of the energy, or of the work that it took.
struct SweepFigure {
  const char* name;
  double (*of)(const Summary&);
  const char* unit;
  bool of_energy = false;  ///< takes the energy account of a run
};

/// Whether a value, as `--set` takes it, is a number by itself.
bool is_number(const std::string& value);

/// The columns of a sweep's table, and its rows as CSV: the number of the run, from 1 on, its values in SI (as text where
/// that is no number), then for each run one row with its measures, or all of its rows; at last why a run failed. Headings
/// have units, as in `k1.force [N]`; a number has none.
class SweepTable {
 public:
  /// What is wrong with a measure of the run as a whole is told from one of a record by its having no brackets.
  static std::variant<SweepTable, NoVariation> make(const std::vector<std::string>& paths,
                                                    const std::vector<std::string>& measures);

  bool measures() const { return !measures_.empty(); }
  std::vector<std::string> measure_names() const;
  /// Known after `set_scene`; "1" for a number.
  std::vector<std::string> measure_units() const;
  /// Those that are a record's, for ReadOptions.
  std::vector<std::string> record_measures() const;
  /// One of them takes the energy account of a run.
  bool needs_account() const;
  /// The scene of a run that could be read says which records the rows have, and the units of measures and records.
  void set_scene(const Scene& scene);

  /// The columns of the header; `is_text`: of each value that is varied, whether it may be something other than a number.
  tables::Layout layout(const std::string& title, const std::vector<std::vector<std::string>>& points, const std::vector<bool>& is_text) const;
  /// `points`: the values of some runs, which say the units of the columns that hold values.
  std::string header(const std::vector<std::vector<std::string>>& points) const;
  /// The cells that each row of a run begins with: "17,200,", and ends in a comma.
  static std::string key(long run, const std::vector<std::string>& values);
  /// The measures of a run, in SI; not finite where there is none.
  std::vector<double> values(const Summary& summary) const;
  /// The row of measures.
  std::string row(const std::string& key, const Summary& summary) const;
  /// A row of a run's records. Throws SimulationError if they are not those of the columns.
  static void append(std::string& text, const std::string& key, double time, const std::vector<double>& values);
  void check_records(const std::vector<Record>& records) const;
  std::string failed(const std::string& key, const std::string& why) const;

 private:
  struct Measure {
    std::string text;
    const SweepFigure* figure = nullptr;  ///< nullptr: of a record
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
