#include "core/netlist/expect_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/netlist/claim_values.hpp"
#include "core/netlist/counting.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

using Figure = Claim::Figure;

const char* const claim_example = "\"k1.force\" = { at = \"0.2 s\", value = \"2 N\", within = 1e-6 }";

constexpr std::pair<const char*, Figure> claim_keys[] = {
    {"value", Figure::at},  {"final", Figure::final}, {"max", Figure::max},         {"min", Figure::min},
    {"mean", Figure::mean}, {"rms", Figure::rms},     {"crosses", Figure::crossing}};

/// One entry of `[expect]`: a path and its claims.
struct ClaimedSubject {
  TomlValue path;  ///< a string
  const TomlValue* claims;
};

bool holds_tables(const TomlValue& value) {
  return value.is_table() || (value.is_array() && !value.items.empty() && value.items.front().is_table());
}

/// Without quotes, TOML reads `k1.force = { ... }` as a table `k1` with a table `force`; it means the same here.
void gather_subjects(const TomlValue& table, const std::string& before, const Spot* begin, std::vector<ClaimedSubject>& subjects) {
  for (const TomlEntry& entry : table.entries) {
    const Spot& spot = begin ? *begin : entry.spot;
    const auto& inner = entry.value.entries;
    if (!inner.empty() &&
        std::all_of(inner.begin(), inner.end(), [](const auto& e) { return holds_tables(e.value); })) {
      gather_subjects(entry.value, before + entry.key + '.', &spot, subjects);
    } else {
      TomlValue path;
      path.kind = TomlValue::Kind::string;
      path.spot = spot;
      path.text = before + entry.key;
      subjects.push_back({std::move(path), &entry.value});
    }
  }
}

class ClaimReader {
 public:
  ClaimReader(const Environment& environment, Context& context, const Scene& scene)
      : environment_(environment), context_(context), diagnostics_(context.diagnostics), scene_(scene), values_(environment, context, scene) {}

  /// Reads a claim on `record`, divided by `other` if not nullptr. Absent if it has a mistake.
  std::optional<Claim> read(const TomlValue& source, const Record& record, const Record* other) {
    const std::size_t before = diagnostics_.errors();
    Claim claim;
    const std::string what = "a claim on `" + record.path + "`";
    TableReader reader(source, what);
    const TomlEntry* figure = nullptr;
    for (const auto& [key, meant] : claim_keys) {
      const TomlEntry* entry = reader.find(key);
      if (!entry) continue;
      if (figure) {
        refuse_both(*figure, *entry, what, diagnostics_,
                    "several claims on a record stand in brackets: [{ max = ... }, { min = ... }]");
        return {};
      }
      figure = entry;
      claim.figure = meant;
    }
    const TomlEntry* at = reader.find("at");
    const TomlEntry* from = reader.find("from");
    const TomlEntry* to = reader.find("to");
    const TomlEntry* within = reader.find("within");
    reader.find("per");
    reader.finish(diagnostics_);
    if (diagnostics_.errors() > before) return {};
    if (!figure) {
      diagnostics_.error(source.spot, what + " needs `value`, `final`, `max`, `min`, `mean`, `rms` or `crosses`", claim_example);
      return {};
    }
    claim.spot = figure->value.spot;
    const bool crossing = claim.figure == Figure::crossing;
    unit_ = one_of(unit_of(scene_, record));
    if (other) unit_ = product(unit_, raised(one_of(unit_of(scene_, *other)), -1));
    read_times(claim, *figure, at, from, to);
    if (crossing) {
      if (other) diagnostics_.error(claim.spot, "a ratio has no `crosses`", "leave out `per`");
      claim.level = value(figure->value, "`crosses`");
      unit_ = {.value = 1, .dimension = dimension_of(Quantity::time, context_.domain), .plain = false, .typed_time = 1};
    }
    const TomlEntry* claimed = crossing ? at : figure;
    if (claimed) read_claimed(claim, *claimed, within);
    if (other && diagnostics_.errors() == before) refuse_fraction_of_nothing(claim, *claimed, within);
    if (crossing && claimed) values_.check_in_run(claimed->value, "`" + claimed->key + "`", claim.least);
    if (diagnostics_.errors() > before) return {};
    return claim;
  }

 private:
  void read_times(Claim& claim, const TomlEntry& figure, const TomlEntry* at, const TomlEntry* from,
                  const TomlEntry* to) {
    const bool crossing = claim.figure == Figure::crossing;
    const bool instant = claim.figure == Figure::at || claim.figure == Figure::final;
    if (claim.figure == Figure::at || crossing) {
      if (!at) diagnostics_.error(figure.spot, "`" + figure.key + "` needs `at`, a time", claim_example);
    } else if (at) {
      diagnostics_.error(at->spot, "`at` goes with `value` or `crosses`, not with `" + figure.key + "`",
                      instant ? "`final` is the value at the end" : "`from` and `to` say where to look");
    }
    if (claim.figure == Figure::at && at) claim.time = time(at);
    claim.from = from ? time(from) : scene_.start;
    claim.to = to ? time(to) : scene_.stop;
    for (const TomlEntry* window : {from, to})
      if (window && instant)
        diagnostics_.error(window->spot, "`" + window->key + "` does not go with `" + figure.key + "`",
                        "it goes with `max`, `min`, `mean`, `rms` and `crosses`");
    if (claim.from >= claim.to && !instant)
      diagnostics_.error((to ? to : from)->value.spot, "`to` must be later than `from`, " + number_text(claim.from) +
                                                        " s, but is " + number_text(claim.to) + " s");
  }

  /// Reads one value with a tolerance, or two bounds.
  void read_claimed(Claim& claim, const TomlEntry& entry, const TomlEntry* within) {
    const std::string name = "`" + entry.key + "`";
    if (!entry.value.is_array()) {
      claim.least = claim.most = value(entry.value, name);
      if (within) read_within(claim, *within);
      return;
    }
    if (entry.value.items.size() != 2) {
      diagnostics_.error(entry.value.spot, name + " must be one value, or two in brackets between which it lies",
                      entry.key + " = [\"1.9 N\", \"2.1 N\"]");
      return;
    }
    claim.least = value(entry.value.items[0], name);
    claim.most = value(entry.value.items[1], name);
    claim.within = 0;
    if (claim.least > claim.most) diagnostics_.error(entry.value.spot, name + " must name the lesser of two values first");
    if (within) diagnostics_.error(within->spot, "`within` does not go with two values, which say how far it may be");
  }

  /// A ratio has no magnitude in the run: its relative tolerance refers to the claimed ratio, which must not be 0.
  void refuse_fraction_of_nothing(const Claim& claim, const TomlEntry& claimed, const TomlEntry* within) {
    if (claimed.value.is_array() || claim.least != 0 || (within && !claim.fraction)) return;
    const std::string two = "two values say where it may lie: " + claimed.key + " = [-1e-6, 1e-6]";
    diagnostics_.error(within ? within->value.spot : claimed.value.spot,
                    (within ? "`within`" : "`" + claimed.key + "` without `within`") +
                        std::string(" allows a fraction of the claimed ratio, and that is 0"),
                    unit_.dimension.is_number()
                        ? two
                        : "an absolute `within` has a unit, that of " + describe(unit_) + "; or " + two);
  }

  void read_within(Claim& claim, const TomlEntry& within) {
    const Formula formula(within.value, "`within`", diagnostics_);
    if (!formula.given()) return;
    const auto number = formula.evaluate(environment_, diagnostics_);
    if (!number) return;
    claim.fraction = number->plain;
    claim.within = number->plain ? number->value : value(within.value, "`within`");
    if (claim.within < 0 || std::isinf(claim.within))
      diagnostics_.error(within.value.spot, "`within` must be at least 0 and finite, but is " + number_text(claim.within));
  }

  double time(const TomlEntry* entry) { return values_.time(entry->value, "`" + entry->key + "`"); }
  /// A value in SI, of the dimension of the claimed figure.
  double value(const TomlValue& source, const std::string& name) { return values_.level(source, name, unit_); }

  const Environment& environment_;
  Context& context_;
  DiagnosticList& diagnostics_;
  const Scene& scene_;
  ClaimValues values_;
  Number unit_;  ///< the number 1 in the unit of the claimed figure
};

}  // namespace

void read_claims(const TomlValue& expect, const Environment& environment, const std::set<std::string>& doubtful,
                 Context& context, Scene& scene) {
  DiagnosticList& diagnostics = context.diagnostics;
  if (!expect_table(expect, "`expect`", diagnostics, claim_example)) return;
  std::vector<ClaimedSubject> subjects;
  gather_subjects(expect, "", nullptr, subjects);

  // Resolve all paths together: this takes one pass over a scene with millions of elements.
  std::vector<TomlValue> paths;
  std::vector<std::pair<const TomlValue*, std::size_t>> claims;  // each with the index of its record's path
  for (const ClaimedSubject& subject : subjects) {
    paths.push_back(subject.path);
    const bool several = subject.claims->is_array();
    if (several && subject.claims->items.empty())
      diagnostics.error(subject.claims->spot, "there is no claim on `" + subject.path.text + "`", claim_example);
    for (std::size_t i = 0; i < (several ? subject.claims->items.size() : 1); ++i) {
      const TomlValue& claim = several ? subject.claims->items[i] : *subject.claims;
      if (expect_table(claim, "a claim on `" + subject.path.text + "`", diagnostics, claim_example))
        claims.emplace_back(&claim, paths.size() - 1);
    }
  }
  std::vector<std::size_t> divisors;
  for (const auto& [claim, record] : claims) {
    const TomlEntry* per = claim->find("per");
    divisors.push_back(per && expect_string(per->value, "`per`", diagnostics, "per = \"c1.force\"") ? paths.size() : 0);
    if (divisors.back()) paths.push_back(per->value);
  }

  const auto records = find_records(paths, doubtful, context, scene);
  ClaimReader reader(environment, context, scene);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const auto& record = records[claims[i].second];
    const auto& other = records[divisors[i]];
    if (!record || (divisors[i] && !other)) continue;
    auto claim = reader.read(*claims[i].first, *record, divisors[i] ? &*other : nullptr);
    if (!claim) continue;
    claim->record = claimed_index(*record, scene);
    if (divisors[i]) claim->per = claimed_index(*other, scene);
    scene.claims.push_back(*claim);
  }
}

}  // namespace rheonet
