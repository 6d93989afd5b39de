#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "core/netlist/read.hpp"
#include "tools/rheonet/arguments.hpp"
#include "tools/rheonet/design.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/sweep_table.hpp"

namespace rheonet::tool {

/// Makes the rows of each run.
class Sweep {
 public:
  Sweep(const Arguments& arguments, Design design, SweepTable table)
      : arguments_(arguments), options_(options_of(arguments)), design_(std::move(design)), table_(std::move(table)) {
    options_.claims = false;  // they are about the scene as it stands
    options_.cache = &cache_;
    options_.measures = table_.record_measures();
  }

  const Design& design() const { return design_; }
  std::string header() const { return table_.header(some_points()); }
  tables::Layout layout() const;
  std::string key(long run) const { return SweepTable::key(run + 1, design_.point(run)); }

  /// Reads the first run, with a report if that or every other is refused. False: nothing can be simulated. Then the columns of
  /// rows without measures are known.
  bool begin();

  /// On any thread.
  std::optional<std::string> make(long run, const std::atomic<bool>& stop);

  const Sources& sources() const { return first_.sources; }
  const SweepTable& table() const { return table_; }
  /// The title of the scene.
  const std::string& title() const { return title_; }
  long failed() const { return failed_; }
  double simulating() const { return simulating_; }

 private:
  std::vector<std::vector<std::string>> some_points() const { return {design_.point(0), design_.point(design_.runs() - 1)}; }
  ReadResult read(const std::vector<std::string>& values);
  /// Whether what is wrong with a run is wrong with every run: the path of a value, or the scene itself.
  bool is_wrong_for_all(const ReadResult& refused);

  const Arguments& arguments_;
  FileCache cache_;
  ReadOptions options_;  ///< of every run
  Design design_;
  SweepTable table_;
  std::string title_;
  ReadResult first_;
  std::atomic<long> failed_ = 0;
  std::atomic<double> simulating_ = 0;  ///< CPU time of the simulations [s]
};

}  // namespace rheonet::tool
