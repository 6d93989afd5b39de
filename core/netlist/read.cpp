#include "core/netlist/read.hpp"

#include <algorithm>
#include <system_error>

#include "core/netlist/analytic_solutions.hpp"
#include "core/netlist/checks.hpp"
#include "core/netlist/domains.hpp"
#include "core/netlist/loose_nodes.hpp"
#include "core/netlist/effects_table.hpp"
#include "core/netlist/expand.hpp"
#include "core/netlist/expect_table.hpp"
#include "core/netlist/file_offer.hpp"
#include "core/netlist/group_names.hpp"
#include "core/netlist/include.hpp"
#include "core/netlist/laws.hpp"
#include "core/netlist/measures.hpp"
#include "core/netlist/models.hpp"
#include "core/netlist/read_presentation.hpp"
#include "core/netlist/records.hpp"
#include "core/netlist/simulate_table.hpp"
#include "core/netlist/stop_condition.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/unused_parameters.hpp"

namespace rheonet {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> top_level{"title", "domain", "parameters", "check",    "elements",
                                         "nodes", "models", "include",    "simulate", "expect",
                                         "exact", "plot",   "demo",     "effects", "laws"};

bool is_top_level(const std::string& name) {
  return std::find(top_level.begin(), top_level.end(), name) != top_level.end();
}

/// Reads one scene from its text.
class Reader {
 public:
  Reader(ReadResult& result, Declarations declarations, const ReadOptions& options, std::vector<const FileOffer*> offers = {})
      : result_(result),
        options_(options),
        diagnostics_(result.sources),
        files_(result.sources, options.model_folders, options.cache, std::move(offers)),
        context_{declarations, Domain::translation, files_, diagnostics_} {}

  void read(const fs::path& file) {
    std::string why;
    std::error_code failed;
    if (auto text = files_.text_of(file, why))
      read(file, std::move(*text), file.parent_path(), files_.canonical(file, failed));
    else
      refuse(file, why);
  }

  void read(fs::path name, std::string text, fs::path folder, const fs::path& canonical) {
    const int file = files_.add(std::move(name), std::move(text), std::move(folder));
    try {
      overrides_ = read_overrides(options_.overrides, options_.origins, result_.sources, diagnostics_);
      if (auto document = files_.document(file, diagnostics_)) {
        document_ = std::move(*document);
        read_document(file, canonical);
      }
    } catch (const TooManyDiagnostics&) {  // finish() lists them
    }
    finish();
  }

 private:
  void refuse(const fs::path& name, const std::string& why) {
    const int file = files_.add(name, "", {});
    diagnostics_.error({file, 0, 0}, "cannot be read: " + why);
    finish();
  }

  void finish() {
    result_.diagnostics = diagnostics_.sorted();
    if (diagnostics_.errors() > 0) return;
    result_.scene = std::move(scene_);
    result_.presentation = std::move(presentation_);
  }

  void read_document(int file, const fs::path& canonical) {
    override_tables();
    TableReader reader(document_.value(), "the scene");
    for (const std::string& key : top_level) reader.find(key);
    const Spot begin{file, 1, 1};
    const TomlEntry* elements =
        reader.require("elements", begin,
                     "[elements] with a line for each: k1 = { type = \"spring\", between = [\"a\", \"ground\"], ... }");
    const TomlEntry* simulate = reader.require("simulate", begin, "[simulate] says when the run ends: stop = \"1 s\"");
    reader.finish(diagnostics_);
    read_title_and_domain();

    const Environment& environment = parameters_of(document_.value());
    if (const TomlEntry* checks = document_.value().find("check")) evaluate_checks(checks->value, environment, diagnostics_);
    std::set<std::string> doubtful = read_network(elements, environment, canonical);
    read_start_and_effects(environment, doubtful);
    read_questions(simulate, environment, doubtful);
    if (diagnostics_.errors() > 0) return;
    warn_of_unused_parameters(document_.value(), [&] { return identifiers_on_command_line(); }, diagnostics_);
  }

  std::set<std::string> identifiers_on_command_line() const {
    std::set<std::string> names;
    for (const Override& override : overrides_) names.merge(identifiers_below(override.value));
    for (const std::string& measure : options_.measures) {
      const std::vector<std::string> found = identifiers_of(measure);
      names.insert(found.begin(), found.end());
    }
    return names;
  }

  /// Reads the models and elements. Returns the names that have a mistake: further mistakes about them are not reported.
  std::set<std::string> read_network(const TomlEntry* elements, const Environment& environment, const fs::path& canonical) {
    Models models;
    if (elements) context_.several_domains = names_other_domain(elements->value, context_) || overrides_name_domain();
    read_models(environment, canonical, models);
    TemplateReader planner(context_, models);
    Scope scope;
    if (elements) planner.read_elements(elements->value, scope);
    stop_condition_.read(document_.value(), environment, scope, context_);
    if (elements && elements->value.is_table() && elements->value.entries.empty())
      diagnostics_.error(elements->spot, "the scene has no elements");
    const ActiveOverrides overrides = element_overrides(scope);
    Expander expander(context_, planner, scene_);
    Scene wired;
    DomainOfElement domains;
    if (context_.several_domains) {
      wired = wiring(models, scope, environment, overrides);
      domains = find_domains(wired, context_);
      expander.use(domains);
    }
    const std::size_t errors_before = diagnostics_.errors();
    expander.run(scope, environment, overrides);
    // A mistyped node may be in the other domain than the node that is meant: all units there are wrong then.
    if (context_.several_domains && diagnostics_.errors() > errors_before) {
      for (const Diagnostic& loose : loose_nodes(wired)) diagnostics_.warning(loose.spot, loose.message, loose.hint);
    }
    if (context_.several_domains) set_node_domains(scene_, context_.declarations);
    check_names(scope, diagnostics_);  // again: overrides may have added nodes

    std::set<std::string> doubtful = expander.failed();
    if (elements)
      for (const TomlEntry& entry : elements->value.entries)
        if (!scope.find(entry.key)) doubtful.insert(entry.key);
    if (!doubtful.empty())
      for (const Scope::Node& node : scope.nodes) doubtful.insert(node.name);
    stop_condition_.mark(scene_);
    connect(expander.loose_ends(), doubtful, context_, scene_);
    return doubtful;
  }

  /// The elements without values. Mistakes in them are reported when they get their values.
  Scene wiring(const Models& models, Scope& scope, const Environment& environment, const ActiveOverrides& overrides) {
    Scene result;
    DiagnosticList untold(result_.sources);
    Context context{context_.declarations, context_.domain, files_, untold, context_.several_domains, context_.models_missing};
    TemplateReader planner(context, models);
    Expander expander(context, planner, result);
    expander.leave_out_values();
    try {
      expander.run(scope, environment, overrides);
    } catch (const TooManyDiagnostics&) {  // reported when the elements get their values
    }
    return result;
  }

  bool overrides_name_domain() const {
    return std::any_of(overrides_.begin(), overrides_.end(), [&](const Override& override) {
      return override.path.size() > 1 && (override.path.back().name == "domain" || override.path.back().name == "type");
    });
  }

  /// Reads the models of the scene and of the files that it includes.
  void read_models(const Environment& environment, const fs::path& canonical, Models& models) {
    const std::size_t before = diagnostics_.errors();
    included_ = read_includes(document_.value(), canonical, context_);
    override_models(included_);
    const auto make_models = [&](Document& document) {
      if (document.value().find("laws")) laws_to_models(document.own(), diagnostics_);
    };
    make_models(document_);
    for (IncludedFile& other : included_) make_models(other.document);
    context_.models_missing = diagnostics_.errors() > before;
    for (const IncludedFile& other : included_) {
      const TomlEntry* table = other.document.value().find("models");
      context_.several_domains = context_.several_domains || (table && names_other_domain(table->value, context_));
    }
    if (const TomlEntry* table = document_.value().find("models")) {
      context_.several_domains = context_.several_domains || names_other_domain(table->value, context_);
    }
    for (IncludedFile& other : included_) declare(other.document.value(), parameters_of(other.document.value()), models);
    declare(document_.value(), environment, models);
    plan_models(context_, models);
  }

  void declare(const TomlValue& document, const Environment& environment, Models& models) {
    if (const TomlEntry* table = document.find("models")) declare_models(table->value, environment, context_, models);
    if (const TomlEntry* table = document.find("laws"); table && table->value.is_table()) declare_models(table->value, environment, context_, models, true);
  }

  void read_start_and_effects(const Environment& environment, const std::set<std::string>& doubtful) {
    if (const TomlEntry* nodes = document_.value().find("nodes"))
      read_initial_values(nodes->value, environment, doubtful, context_, scene_);
    scene_.keep = options_.keep;
    read_effects(document_.value().find("effects"), options_.without, options_.only, context_, result_.sources, scene_);
  }

  /// Reads the settings of the run, the records, the claims and the presentation.
  void read_questions(const TomlEntry* simulate, const Environment& environment, std::set<std::string>& doubtful) {
    scene_.stop = not_given;  // disables comparisons with the stop if [simulate] is missing or mistaken
    const TomlEntry* record = simulate ? read_simulate(*simulate, environment, context_, scene_) : nullptr;
    if (options_.accuracy) override_accuracy(*options_.accuracy, context_, result_.sources, scene_);
    // Do not make a million default records for a scene that is refused.
    if (record || diagnostics_.errors() == 0) resolve_records(record, environment, doubtful, context_, scene_);
    add_records(options_.records, doubtful, context_, result_.sources, scene_);
    if (const TomlEntry* expect = document_.value().find("expect"); expect && options_.claims)
      read_claims(expect->value, environment, doubtful, context_, scene_);
    read_measures(options_.measures, environment, doubtful, context_, result_.sources, scene_);
    if (const TomlEntry* exact = document_.value().find("exact"))
      read_analytic_solutions(exact->value, environment, doubtful, context_, scene_);
    if (const TomlEntry* plot = document_.value().find("plot")) {
      presentation_.plot = read_plot_table(plot->value, doubtful, context_, scene_);
      if (options_.plotted) add_records(presentation_.plot.records(), doubtful, context_, result_.sources, scene_);
    }
    if (const TomlEntry* demo = document_.value().find("demo"))
      presentation_.demo = read_demo(demo->value, environment, context_);
  }

  void read_title_and_domain() {
    if (const TomlEntry* title = document_.value().find("title"); title && expect_string(title->value, "`title`", diagnostics_))
      scene_.title = title->value.text;
    const TomlEntry* domain = document_.value().find("domain");
    if (!domain || !expect_string(domain->value, "`domain`", diagnostics_)) return;
    const std::string& text = domain->value.text;
    if (text == "rotation")
      context_.domain = scene_.domain = Domain::rotation;
    else if (text != "translation")
      diagnostics_.error(domain->value.spot, "`domain` must be `translation` or `rotation`, but is `" + text + "`",
                      did_you_mean(text, {"translation", "rotation"}));
  }

  const Environment& parameters_of(const TomlValue& document) {
    Environment& environment = environments_.emplace_back();
    const TomlEntry* table = document.find("parameters");
    if (!table || !expect_table(table->value, "`parameters`", diagnostics_)) return environment;
    const auto& formulas = formulas_.emplace_back(read_named_formulas(table->value, diagnostics_));
    return environment = evaluate_parameters(formulas, diagnostics_);
  }

  /// Applies the overrides of everything but elements and models.
  void override_tables() {
    for (Override& override : overrides_) {
      const std::string table = override.path.front().name;
      if (!is_top_level(table) || table == "elements" || table == "models" || table == "laws") continue;
      if (table == "nodes") join_node_path(override);
      const bool is_new_parameter = table == "parameters" && !has_parameter(override);
      apply({&override, 0}, document_.own(), diagnostics_);
      if (is_new_parameter) refuse_unless_used(override);
    }
  }

  /// In [nodes] the key of an inner node is its path: nodes.pivot.mid.position names the node pivot.mid.
  static void join_node_path(Override& override) {
    auto& path = override.path;
    const bool names_key = path.back().name == "position" || path.back().name == "velocity";
    const std::size_t end = path.size() - (names_key ? 1 : 0);
    for (std::size_t i = 2; i < end; ++i) path[1].name += '.' + path[i].name;
    if (end > 2) path.erase(path.begin() + 2, path.begin() + static_cast<std::ptrdiff_t>(end));
  }

  bool has_parameter(const Override& override) const {
    const TomlEntry* parameters = document_.value().find("parameters");
    return override.path.size() < 2 || (parameters && parameters->value.find(override.path[1].name));
  }

  /// An override may add a parameter that the file uses but does not define; any other new name is mistyped.
  void refuse_unless_used(const Override& override) {
    const Override::Part& part = override.path[1];
    if (identifiers_below(document_.value()).contains(part.name)) return;
    std::vector<std::string> names;
    for (const TomlEntry& entry : document_.value().find("parameters")->value.entries)
      if (entry.key != part.name) names.push_back(entry.key);
    diagnostics_.error(part.spot, "there is no parameter `" + part.name + "`, and nothing uses one",
                    did_you_mean(part.name, names));
  }

  void override_models(std::deque<IncludedFile>& included) {
    for (const Override& override : overrides_) {
      const std::string table = override.path.front().name;
      if (table != "models" && table != "laws") continue;
      std::vector<Document*> documents{&document_};
      for (IncludedFile& other : included) documents.push_back(&other.document);
      std::vector<std::string> names;
      bool found = false;
      for (Document* document : documents) {
        const TomlEntry* models = document->value().find(table);
        if (!models || !models->value.is_table()) continue;
        for (const TomlEntry& model : models->value.entries) names.push_back(model.key);
        if (found || override.path.size() < 2 || !models->value.find(override.path[1].name)) continue;
        found = true;
        apply({&override, 1}, document->own().find(table)->value, diagnostics_);
      }
      if (!found) {
        const Override::Part& part = override.path[override.path.size() < 2 ? 0 : 1];
        diagnostics_.error(
            part.spot, "there is no " + table.substr(0, table.size() - 1) + " `" + part.name + "`",
            did_you_mean(part.name, names, names.empty() ? "" : "the " + table + " are " + list_names(names, "and")));
      }
    }
  }

  ActiveOverrides element_overrides(const Scope& scope) {
    ActiveOverrides active;
    for (const Override& override : overrides_) {
      const bool from_table = override.path.front().name == "elements";
      if (!from_table && is_top_level(override.path.front().name)) continue;
      const ActiveOverride first{&override, from_table ? std::size_t{1} : std::size_t{0}};
      const Override::Part& part = first.at_end() ? override.path.front() : first.next();
      if (!first.at_end() && scope.find(part.name)) {
        active.push_back(first);
        continue;
      }
      std::vector<std::string> names;
      for (const ElementTemplate& plan : scope.entries) names.push_back(plan.name);
      if (!from_table) names.insert(names.end(), top_level.begin(), top_level.end());
      const TomlEntry* parameters = document_.value().find("parameters");
      const bool parameter = !from_table && parameters && parameters->value.find(part.name);
      diagnostics_.error(
          part.spot, parameter ? "no element is called `" + part.name + "`" : "nothing is called `" + part.name + "`",
          parameter ? "the path of the parameter is `parameters." + part.name + "`"
                    : did_you_mean(part.name, names, "a path begins with an element (k1.stiffness) or a table (simulate.stop)"));
    }
    return active;
  }

  ReadResult& result_;
  const ReadOptions& options_;
  DiagnosticList diagnostics_;
  Files files_;
  Context context_;
  Scene scene_;
  Presentation presentation_;
  Document document_;
  std::deque<Override> overrides_;
  std::deque<IncludedFile> included_;
  StopCondition stop_condition_;
  std::deque<Environment> environments_;
  std::deque<std::vector<NamedFormula>> formulas_;
};

}  // namespace

ReadResult read_scene(const fs::path& file, Declarations declarations, const ReadOptions& options) {
  ReadResult result;
  Reader reader(result, declarations, options);
  reader.read(file);
  return result;
}

ReadResult read_scene_text(std::string text, const std::string& name, const fs::path& folder, Declarations declarations,
                           const ReadOptions& options) {
  ReadResult result;
  Reader reader(result, declarations, options);
  reader.read(name, std::move(text), folder, {});
  return result;
}

ReadResult read_offered_text(std::string text, const std::string& name, const fs::path& folder, Declarations declarations,
                             const ReadOptions& options, std::vector<const FileOffer*> offers) {
  ReadResult result;
  Reader reader(result, declarations, options, std::move(offers));
  reader.read(name, std::move(text), folder, {});
  return result;
}

}  // namespace rheonet
