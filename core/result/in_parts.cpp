#include "core/result/in_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/network/network.hpp"
#include "core/result/csv.hpp"
#include "core/result/memory_file.hpp"
#include "core/result/row_store.hpp"

namespace rheonet {

namespace {

/// The lines of a text, without the first one.
std::vector<std::string> lines_after_header(std::string_view text) {
  std::vector<std::string> result;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    if (begin > 0) result.emplace_back(text.substr(begin, end - begin));
  }
  return result;
}

/// Results of a subscene, besides its rows.
struct Outcome {
  std::unique_ptr<MemoryFile> events;
  Summary summary;
  std::exception_ptr failure;
  double reached = 0;   ///< fraction of the run done; for the thread of this subscene alone
  double fraction = 0;  ///< last fraction included in done_
};

class SideBySide {
 public:
  SideBySide(const Scene& scene, const Partition& partition, const RunSettings& settings)
      : scene_(scene), partition_(partition), settings_(settings), outcomes_(partition.subscenes.size()), rows_(widths_of(partition), "the rows of independent parts") {}

  Summary go() {
    std::vector<std::string> notes;
    check_unasked(notes);
    if (outcomes_.size() == 1) {  // it has all records and claims, in their order
      Summary sum = run_whole(partition_.subscenes.front().scene, settings_);
      sum.notes.insert(sum.notes.begin(), notes.begin(), notes.end());
      return sum;
    }
    const std::size_t threads = std::min<std::size_t>(static_cast<std::size_t>(std::max(settings_.threads, 1)), outcomes_.size());
    std::vector<std::thread> others;
    for (std::size_t k = 1; k < threads; ++k) others.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : others) thread.join();
    const Outcome* const failed = first_failed();
    write_rows(rows_.rows(failed ? static_cast<std::size_t>(failed - outcomes_.data()) : 0));
    write_events(failed);
    if (failed) std::rethrow_exception(failed->failure);
    return summary(std::move(notes));
  }

 private:
  static std::vector<std::size_t> widths_of(const Partition& partition) {
    std::vector<std::size_t> widths;
    for (const Subscene& subscene : partition.subscenes) widths.push_back(subscene.records.size());
    return widths;
  }

  /// Checks structure and start of the parts that are not integrated.
  void check_unasked(std::vector<std::string>& notes) const {
    if (partition_.left_out.empty()) return;
    for (const Subscene& subscene : partition_.unasked) check(subscene.scene);
    if (!scene_.blocks.empty()) build_network(scene_);  // ignored blocks may form an algebraic loop
    notes.push_back(fmt::format("not integrated, since nothing asks for what happens there: {}{}", format_list(partition_.left_out),
                                settings_.account ? "; the energy account is without it" : ""));
  }

  void work() {
    for (std::size_t k = next_++; k < outcomes_.size(); k = next_++) integrate(k);
  }

  void integrate(std::size_t k) {
    Outcome& outcome = outcomes_[k];
    RunSettings settings = settings_;
    settings.csv = settings.events = nullptr;
    settings.state = {};
    settings.profile = false;
    settings.row = [this, k](double time, const std::vector<double>& values) { rows_.add(k, time, values); };
    settings.progress = [this, &outcome](double fraction) {
      outcome.reached = fraction;
      if (settings_.progress) {
        const std::lock_guard lock(told_);
        done_ += fraction - outcome.fraction;
        outcome.fraction = fraction;
        settings_.progress(done_ / static_cast<double>(outcomes_.size()));
      }
    };
    try {
      if (settings_.events) {
        outcome.events = std::make_unique<MemoryFile>();
        settings.events = outcome.events->file();
      }
      outcome.summary = run_whole(partition_.subscenes[k].scene, settings);
    } catch (...) {
      outcome.failure = std::current_exception();
    }
  }

  /// The failed subscene with the fewest rows.
  const Outcome* first_failed() const {
    const Outcome* first = nullptr;
    std::size_t fewest = 0;
    for (std::size_t k = 0; k < outcomes_.size(); ++k) {
      if (!outcomes_[k].failure || (first && rows_.rows(k) >= fewest)) continue;
      first = &outcomes_[k];
      fewest = rows_.rows(k);
    }
    return first;
  }

  void write_rows(std::size_t count) {
    if (count == 0) return;
    std::vector<std::string> names;
    for (const Record& record : scene_.records) names.push_back(record.path);
    CsvWriter csv(settings_.csv, "the results");
    csv.header(names);
    std::vector<RowStore::Reader> readers;
    for (std::size_t k = 0; k < outcomes_.size(); ++k) readers.push_back(rows_.read(k));
    std::vector<double> values(scene_.records.size());
    for (std::size_t row = 0; row < count; ++row) {
      std::fill(values.begin(), values.end(), 0.0);
      double time = 0;
      for (std::size_t k = 0; k < outcomes_.size(); ++k) {
        const std::vector<std::size_t>& records = partition_.subscenes[k].records;
        const double* const part = readers[k].next();
        if (k == 0) time = part[0];
        for (std::size_t r = 0; r < records.size(); ++r) values[records[r]] += part[1 + r];
      }
      csv.row(time, values);
      if (settings_.row) settings_.row(time, values);
    }
    csv.flush();
  }

  /// Writes the events sorted by time, up to the first failure. An event that several subscenes report is written once.
  void write_events(const Outcome* failed) const {
    if (!settings_.events) return;
    std::vector<std::pair<double, std::string>> lines;
    std::set<std::string> told;
    double last = scene_.stop;
    if (failed) last = scene_.start + failed->reached * (scene_.stop - scene_.start) * (1 + time_rounding);
    for (const Outcome& outcome : outcomes_) {
      if (!outcome.events) continue;
      for (std::string& line : lines_after_header(outcome.events->text())) {
        const double time = std::strtod(line.c_str(), nullptr);
        if ((!failed || &outcome == failed || time <= last) && told.insert(line).second) lines.emplace_back(time, std::move(line));
      }
    }
    std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text = "time,element,event,direction\n";
    for (const auto& [time, line] : lines) text += line + '\n';
    if (std::fwrite(text.data(), 1, text.size(), settings_.events) != text.size() || std::fflush(settings_.events) != 0)
      throw WriteError("the events cannot be written");
  }

  Summary summary(std::vector<std::string> notes) {
    Summary sum;
    sum.parts = static_cast<int>(outcomes_.size());
    sum.findings.resize(scene_.claims.size());
    std::map<std::string, long> switched;
    for (std::size_t k = 0; k < outcomes_.size(); ++k) {
      const Summary& s = outcomes_[k].summary;
      sum.unknowns += s.unknowns;
      sum.sparse = sum.sparse || s.sparse;
      sum.steps += s.steps;
      sum.arc_steps += s.arc_steps;
      sum.rejected_steps += s.rejected_steps;
      sum.finest_steps += s.finest_steps;
      sum.residual_evaluations += s.residual_evaluations;
      sum.jacobian_evaluations += s.jacobian_evaluations;
      sum.restarts += s.restarts;
      // A motion that several subscenes share switches in each of them.
      for (const Summary::Switched& one : s.switched) switched[one.element] = std::max(switched[one.element], one.times);
      sum.supplied += s.supplied;
      sum.stored += s.stored;
      sum.dissipated += s.dissipated;
      sum.missing += s.missing;
      sum.largest += s.largest;
      sum.cpu_seconds += s.cpu_seconds;
      for (std::size_t c = 0; c < s.findings.size(); ++c) sum.findings[partition_.subscenes[k].claims[c]] = s.findings[c];
      for (const std::string& note : s.notes) {
        if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
      }
    }
    for (const SceneElement& element : scene_.elements) {
      const auto found = switched.find(element.name);
      if (found == switched.end()) continue;
      sum.switched.push_back({element.name, found->second});
      sum.events += found->second;
    }
    std::stable_sort(sum.switched.begin(), sum.switched.end(), [](const auto& p, const auto& q) { return p.times > q.times; });
    sum.notes = std::move(notes);
    return sum;
  }

  const Scene& scene_;
  const Partition& partition_;
  const RunSettings& settings_;
  std::vector<Outcome> outcomes_;
  RowStore rows_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex told_;
  double done_ = 0;  ///< sum of the reported fractions
};

}  // namespace

Summary run_in_parts(const Scene& scene, const Partition& partition, const RunSettings& settings) {
  return SideBySide(scene, partition, settings).go();
}

}  // namespace rheonet
