#pragma once

#include <atomic>
#include <string>

#include "core/netlist/read.hpp"
#include "tools/rheonet/arguments.hpp"
#include "tools/rheonet/design.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/spool.hpp"
#include "tools/rheonet/sweep_table.hpp"

namespace rheonet::tool {

/// Simulates the runs of a sweep and produces their rows.
class Sweep {
 public:
  Sweep(const Arguments& arguments, Design design, SweepTable table)
      : arguments_(arguments), options_(options_of(arguments)), design_(std::move(design)), table_(std::move(table)) {
    options_.claims = false;  // Claims hold for the unmodified scene.
    options_.cache = &cache_;
    options_.measures = table_.record_measures();
  }

  const Design& design() const { return design_; }
  std::string header() const { return table_.header(some_points()); }
  tables::Layout layout() const;
  std::string key(long run) const { return SweepTable::key(run + 1, design_.point(run)); }

  /// Reads a run, which determines the columns of rows without measures: the first run that is not refused. Returns false, after
  /// messages, if the sweep cannot begin.
  bool begin();

  /// Simulates the runs first .. end - 1 and appends their rows to an empty text. Returns false if it was stopped. May be called on any thread.
  /// Throws WriteError if a temporary file cannot be written: that is no fault of the runs.
  bool make(long first, long end, Spool& rows, const std::atomic<bool>& stop);
  /// How many runs to make at once: several where each run is one row. Their scenes are read one after the other, before the first run. The
  /// processor's caches then still hold the code of the reader, and a scene takes two thirds of the time.
  long most_at_once() const { return table_.measures() ? 16 : 1; }

  const Sources& sources() const { return first_.sources; }
  const SweepTable& table() const { return table_; }
  /// The title of the scene.
  const std::string& title() const { return title_; }
  long failed() const { return failed_; }
  double simulating() const { return simulating_; }

 private:
  std::vector<std::vector<std::string>> some_points() const { return {design_.point(0), design_.point(design_.runs() - 1)}; }
  ReadResult read(const std::vector<std::string>& values);
  bool make(const ReadResult& read, const std::string& key, Spool& rows, const std::atomic<bool>& stop);
  /// Whether a mistake of one run is a mistake of every run: in the path of a value, or in the scene itself.
  bool is_wrong_for_all(const ReadResult& refused);

  const Arguments& arguments_;
  FileCache cache_;
  ReadOptions options_;  ///< For every run.
  Design design_;
  SweepTable table_;
  std::string title_;
  ReadResult first_;
  std::atomic<long> failed_ = 0;
  std::atomic<double> simulating_ = 0;  ///< CPU time of the simulations [s].
};

}  // namespace rheonet::tool
