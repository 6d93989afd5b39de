#include "tools/rheonet/precision_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/summary.hpp"
#include "tools/rheonet/table.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

using Rows = std::vector<std::vector<std::string>>;

// An error is known only if it exceeds this multiple of the difference between the reference and its check.
constexpr double told = 2;
// A closed form is doubtful if the tightest run has a larger relative difference from it.
constexpr double doubtful_form = 1e-6;

std::string error_number(double value) { return value == 0 ? "0" : fmt::format("{:.1e}", value); }

/// The smallest error that can be determined for the worst record of a price.
double least_known(const PriceList& list, const Price& price) {
  return price.errors.empty() ? 0 : told * list.doubt[price.worst].relative();
}

std::string error_text(const PriceList& list, const Price& price) {
  const double least = least_known(list, price);
  return price.error() > least || price.error() == 0 ? error_number(price.error()) : "< " + error_number(least);
}

double median(const Price& price) { return price.cpu_quantile(0.5); }
double steps(const Price& price) { return static_cast<double>(price.summary.steps); }

std::string spread(const Price& price) {
  const double half = (price.cpu_quantile(0.75) - price.cpu_quantile(0.25)) / 2;
  return fmt::format("+-{:.0f} %", 100 * half / median(price));
}

/// The cost of one more digit, relative to the cost of this price.
std::string next_digit(const Price& price, const Price* next, double (*cost)(const Price&)) {
  if (!next || !next->failure.empty() || !(cost(price) > 0)) return "-";
  const double digits = std::log10(price.setting.tolerance / next->setting.tolerance);
  return fmt::format("x {:.2f}", std::pow(cost(*next) / cost(price), 1 / digits));
}

/// The prices of each method, in the order of the list.
std::vector<std::vector<const Price*>> by_method(const PriceList& list) {
  std::vector<std::vector<const Price*>> result;
  for (const Price& p : list.prices) {
    if (result.empty() || result.back().front()->setting.method != p.setting.method) result.emplace_back();
    result.back().push_back(&p);
  }
  return result;
}

std::string table_of(const Scene& scene, const PriceList& list, const std::vector<const Price*>& prices) {
  Rows rows{{"accuracy", "error", "of", "CPU time", "spread", "steps", "rejected", "residuals", "Jacobians", "starts",
             "next digit: CPU", "steps"}};
  std::string failures;
  for (std::size_t i = 0; i < prices.size(); ++i) {
    const Price& p = *prices[i];
    const std::string accuracy = fmt::format("{:g}", p.setting.tolerance);
    if (!p.failure.empty()) {
      rows.push_back({accuracy, "fails"});
      failures += fmt::format("  {} fails: {}\n", accuracy, wrapped(p.failure, 4));
      continue;
    }
    const Price* next = i + 1 < prices.size() ? prices[i + 1] : nullptr;
    const Summary& s = p.summary;
    rows.push_back({accuracy, error_text(list, p), p.error() > 0 ? scene.records[p.worst].path : "-",
                    in_time_units(median(p)), spread(p), fmt::format("{}", s.steps), fmt::format("{}", s.rejected_steps),
                    fmt::format("{}", s.residual_evaluations), fmt::format("{}", s.jacobian_evaluations),
                    fmt::format("{}", s.restarts), next_digit(p, next, median), next_digit(p, next, steps)});
  }
  return aligned(rows) + failures;
}

/// The reference for the errors and its own accuracy, as text.
std::string yardstick_words(const Scene& scene, const PriceList& list) {
  std::string text;
  if (scene.exact.size() < scene.records.size()) {
    text += fmt::format("  errors are measured by a run to {:g} of order up to {}; one of order up to {} is {} from it",
                        list.reference.tolerance, list.reference.order, list.check.order, error_number(list.largest_doubt()));
    text += list.largest_doubt() > 0 ? fmt::format(" (`{}`)\n", scene.records[worst_of(list.doubt)].path) : "\n";
  }
  if (scene.exact.empty()) return text;
  const std::size_t worst = worst_of(list.off);
  const RecordError& off = list.off[worst];
  text += fmt::format("  errors of {} are measured by closed forms, from which a run to {:g} is off by up to {} (`{}`)\n",
                      scene.exact.size() == scene.records.size() ? "all records"
                      : scene.exact.size() == 1                  ? "one record"
                                                                 : fmt::format("{} records", scene.exact.size()),
                      list.reference.tolerance, error_number(off.relative()),
                      scene.records[static_cast<std::size_t>(scene.exact[worst].record)].path);
  if (off.relative() > doubtful_form)
    text += fmt::format("  note: that is too much for rounding, first at {:g} s: either the form or the scene is not as it is meant\n",
                        off.beyond);
  return text;
}

const std::string& name_of_method(const PriceList& list, const Price& price) {
  return list.methods[static_cast<std::size_t>(price.setting.method)];
}

/// As in "accuracy = 1e-05, order up to 3".
std::string name_of_price(const PriceList& list, const Price& price) {
  return fmt::format("accuracy = {:g}", price.setting.tolerance) +
         (price.setting.method == 0 ? "" : ", " + printable(name_of_method(list, price)));
}

std::string recommendation(const Scene& scene, const PriceList& list) {
  const Price* const best = list.cheapest();
  const Price* const own = list.own(scene);
  if (!best) {
    return list.largest_doubt() > scene.accuracy
               ? fmt::format("nothing is recommended: by the two runs that should tell errors the {:g} asked for cannot be told\n",
                             scene.accuracy)
               : fmt::format("nothing of this meets the {:g} asked for\n", scene.accuracy);
  }
  std::string text = fmt::format("the cheapest that meets the {:g} asked for: {}, error {}, {} of CPU time", scene.accuracy,
                                 name_of_price(list, *best), error_text(list, *best), in_time_units(median(*best)));
  if (own && own != best) {
    text += fmt::format("; {} takes {:.2f} times that, for an error of {}", name_of_price(list, *own), median(*own) / median(*best),
                        error_text(list, *own));
  }
  return wrapped(text, 2) + '\n';
}

}  // namespace

std::string describe(const Scene& scene, const std::string& file, const PriceList& list) {
  std::string text = fmt::format("{}: {:g} s to {:g} s, asks for an accuracy of {:g}\n", printable(file), scene.start,
                                 scene.stop, scene.accuracy);
  text += yardstick_words(scene, list);
  for (const auto& prices : by_method(list)) {
    if (prices.front()->setting.method != 0) text += fmt::format("\n{}\n", printable(name_of_method(list, *prices.front())));
    text += table_of(scene, list, prices);
  }
  return text + '\n' + recommendation(scene, list);
}

std::string table(const Scene& scene, const PriceList& list) {
  std::string text =
      "order,accuracy,error,record,time,cpu_median,cpu_lower_quartile,cpu_upper_quartile,steps,rejected,residuals,"
      "jacobians,starts,manner";
  for (const Record& record : scene.records) text += ",error " + record.path;
  text += '\n';
  const auto put = [&text](const auto&... cells) { (fmt::format_to(std::back_inserter(text), ",{}", cells), ...); };
  for (const Price& p : list.prices) {
    if (!p.failure.empty()) continue;
    const Summary& s = p.summary;
    text += fmt::format("{}", p.setting.order);
    put(p.setting.tolerance, p.error(), p.errors.empty() ? "" : scene.records[p.worst].path,
        p.errors.empty() ? 0 : p.errors[p.worst].time, median(p), p.cpu_quantile(0.25), p.cpu_quantile(0.75), s.steps,
        s.rejected_steps, s.residual_evaluations, s.jacobian_evaluations, s.restarts, cell(name_of_method(list, p)));
    for (const RecordError& error : p.errors) put(error.relative());
    text += '\n';
  }
  return text;
}

std::vector<plot::Measured> curves(const PriceList& list) {
  // A logarithmic axis cannot show an error of 0; draw it at round-off level.
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  const plot::Column error{"error", plot::measure("largest error, of the magnitude of its record", "1")};
  const std::pair<plot::Column, double (*)(const Price&)> costs[] = {{{"CPU time", plot::measure("CPU time", "s")}, median},
                                                                     {{"steps", plot::measure("steps", "1")}, steps}};
  std::vector<plot::Measured> result;
  for (const auto& [column, cost] : costs) {
    for (const auto& prices : by_method(list)) {
      plot::Measured curve{name_of_method(list, *prices.front()), error, column, {}};
      for (const Price* p : prices) {
        if (p->failure.empty()) curve.trace.add({std::max({p->error(), least_known(list, *p), rounding}), cost(*p)});
      }
      result.push_back(std::move(curve));
    }
  }
  return result;
}

}  // namespace rheonet::tool
