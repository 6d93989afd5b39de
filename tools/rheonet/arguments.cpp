#include "tools/rheonet/arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

#include "core/netlist/characters.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/network/reductions.hpp"
#include "tools/rheonet/footers.hpp"
#include "tools/rheonet/repeated_options.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

std::vector<std::string> long_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// Names of the same commands in other programs.
constexpr std::pair<std::string_view, std::string_view> foreign_commands[] = {
    {"simulate", "run"}, {"sim", "run"},       {"solve", "run"},  {"validate", "check"}, {"verify", "check"}, {"lint", "check"},
    {"graph", "plot"},   {"schematic", "draw"}, {"diff", "compare"}, {"playground", "serve"}, {"elements", "components"}};

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string name = nearest(word, known);
  return name.empty() ? "" : fmt::format("did you mean `{}`?", name);
}

/// Whether `word` follows a value of --set on the command line: `--set k1.stiffness=40 N/m` without quotes.
bool follows_override(const std::string& word, const std::vector<std::string>& words) {
  for (std::size_t i = 2; i < words.size(); ++i)
    if (words[i] == word && (words[i - 1].starts_with("--set=") || (words[i - 2] == "--set" && words[i - 1].find('=') != std::string::npos))) return true;
  return false;
}

// Throws WrongCommandLine for the first word that is neither an option nor an argument. `words` is the command line.
void refuse_extra_words(const CLI::App& app, const std::vector<std::string>& words) {
  const auto is_option = [](const std::string& word) { return word.size() > 1 && word[0] == '-'; };
  const CLI::App* command = app.get_subcommands().empty() ? nullptr : app.get_subcommands().front();
  for (const CLI::App* level : {&app, command}) {
    if (level == nullptr) continue;
    for (const std::string& word : level->remaining()) {
      if (word == "--") continue;  // Marks the end of the options.
      if (is_option(word)) {
        const std::string name = word.substr(0, word.find('='));
        throw WrongCommandLine{fmt::format("unknown option `{}`", name), did_you_mean(name, long_options(*level))};
      }
      if (level == &app && command == nullptr) {
        std::vector<std::string> commands;
        for (const CLI::App* known : app.get_subcommands({})) commands.push_back(known->get_name());
        const auto* const foreign = std::find_if(std::begin(foreign_commands), std::end(foreign_commands),
                                                 [&](const auto& names) { return names.first == word; });
        std::string hint = foreign != std::end(foreign_commands) ? fmt::format("did you mean `{}`?", foreign->second) : did_you_mean(word, commands);
        if (hint.empty() && word.ends_with(".toml")) hint = fmt::format("to simulate a scene: `rheonet run {}`", word);
        throw WrongCommandLine{fmt::format("unknown command `{}`", word), hint};
      }
      throw WrongCommandLine{fmt::format("unexpected argument `{}`", word),
                             follows_override(word, words) ? "write a value that has a space in quotes: --set 'PATH=VALUE UNIT'" : ""};
    }
  }
}

// Rewords CLI11's message on an option with too few or too many values.
std::string parse_error_in_words(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string option = text.substr(0, text.find(':'));
  if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::ArgumentMismatch) || !option.starts_with('-')) {
    return text;
  }
  if (text.ends_with(" missing")) return fmt::format("`{}` needs a value", option);
  return fmt::format("`{}` is given more than once", option);
}

/// Distinct values in descending order.
std::vector<double> read_accuracies(const std::vector<std::string>& texts) {
  const char* const option = "--accuracies";
  std::vector<double> values;
  for (const std::string& text : texts) {
    values.push_back(read_number(option, text));
    if (!(values.back() >= 1e-12 && values.back() <= 0.1))
      throw WrongCommandLine{fmt::format("`{}` takes numbers from 1e-12 to 0.1, not `{}`", option, text), ""};
  }
  std::sort(values.begin(), values.end(), std::greater<>());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

void check_reductions(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const ReductionWords& words : reductions()) known.push_back(words.name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string hint = did_you_mean(name, known);
    throw WrongCommandLine{fmt::format("`--keep`: there is no reduction `{}`", name),
                           hint.empty() ? fmt::format("the reductions are: {}", fmt::join(known, ", ")) : hint};
  }
}

ExitStatus report_mistake(const WrongCommandLine& mistake, const CLI::App& app) {
  const std::vector<const CLI::App*> commands = app.get_subcommands([](const CLI::App* c) { return c->parsed(); });
  say("error: {}\n", printable(mistake.message));
  if (!mistake.hint.empty()) say("  {}\n", printable(mistake.hint));
  say("  `rheonet {}--help` lists the commands and options\n", commands.empty() ? "" : commands.front()->get_name() + " ");
  return wrong_input;
}

/// Refuses "", which an unset variable of the shell leaves.
void refuse_files_without_a_name(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      const std::vector<std::string>& given = option->results();
      if (option->get_type_name() == "FILE" && std::find(given.begin(), given.end(), "") != given.end())
        throw WrongCommandLine{fmt::format("`{}` needs the name of a file", option->get_name()), ""};
    }
  }
}

void add_figure(CLI::App* command, Arguments& arguments) {
  Arguments::Plot& plot = arguments.plot;
  command->add_option("FILES", arguments.scenes, "scenes (.toml) and CSV files; their curves are overlaid")
      ->required()
      ->option_text("FILE [FILE ...]");
  command->add_option("-o,--output", arguments.output, "the figure: an .svg or a .png; `-` is an SVG on standard output")
      ->required()
      ->type_name("FILE");
  command->add_option("-x", plot.x, "column for the horizontal axis (default `time`)")->type_name("COLUMN");
  add_list(command, "-y", plot.y, "columns to draw", "COLUMN,...");
  add_list(command, "--loop", plot.loops, "force over displacement", "ELEMENT,...");
  add_list(command, "--flow", plot.flows, "force over velocity", "ELEMENT,...");
  add_list(command, "--phase", plot.phases, "velocity over position", "NODE,...");
  add_list(command, "--decay", plot.decays, "force over time, logarithmic", "ELEMENT,...");
  command->add_option("--log", plot.log, "logarithmic axes")->type_name("x|y|xy");
  command->add_flag("--abs", plot.magnitudes, "draw magnitudes, for logarithmic axes");
  command->add_flag("--marks", plot.marks, "mark each point");
  add_list(command, "--unit", plot.units, "units for the axes that have their dimension", "UNIT,...");
  command->add_option("--domain", arguments.domain, "domain of CSV files, for their SI units")
      ->check(CLI::IsMember({"translation", "rotation"}))
      ->type_name("translation|rotation");
  command->add_option("--x-range", plot.x_range, "part of the horizontal axis, in its unit")->type_name("LOW:HIGH");
  command->add_option("--y-range", plot.y_range, "part of the vertical axis, in its unit")->type_name("LOW:HIGH");
  command->add_option("--title", plot.title, "title of the figure")->type_name("TEXT");
  command->add_option("--x-label", plot.x_label, "label of the horizontal axis")->type_name("TEXT");
  command->add_option("--y-label", plot.y_label, "label of the vertical axis")->type_name("TEXT");
  add_list(command, "--name", plot.names, "name of a curve, in their order; may be repeated", "TEXT", false);
  command->add_option("--size", plot.size, "size of the figure in px (96 per inch)")->type_name("WxH");
}

/// The commands and options, declared for CLI11, and the variables that it writes to.
struct CommandLine {
  Arguments arguments;
  std::optional<std::string> accuracy, within, order, runs;
  SweepTexts sweep_texts;
  std::vector<std::string> accuracies, only;
  CLI::App app{"Simulates one-dimensional mechanical networks: springs, dashpots, friction, masses, drives.\n",
               "rheonet"};

  struct Command {
    const char* name;
    Arguments::Command command;
    const char* description;
    const char* footer;
    void (CommandLine::*add_options)(CLI::App*);
  };
  static const std::array<Command, 14>& commands() {
    using Name = Arguments::Command;
    using Line = CommandLine;
    static const std::array<Command, 14> all{{
        {"run", Name::run, "simulate a scene and write its records as CSV", footer_of_run, &Line::add_run},
        {"check", Name::check, "read and check a scene without simulating it", footer_of_check, &Line::add_check},
        {"explain", Name::explain, "explain what will be simulated, and why", footer_of_explain, &Line::add_explain},
        {"effects", Name::effects, "measure what each physical effect of a scene contributes and costs", footer_of_effects, &Line::add_effects},
        {"compare", Name::compare, "simulate scenes and measure how far they are from the first", footer_of_compare, &Line::add_compare},
        {"precision", Name::precision, "measure error and cost of a scene at many accuracies", footer_of_precision, &Line::add_precision},
        {"sweep", Name::sweep, "simulate a scene for many parameter values, on all processors or many machines, into one table", footer_of_sweep, &Line::add_sweep},
        {"plot", Name::plot, "draw curves of scenes and of CSV files", footer_of_plot, &Line::add_plot},
        {"draw", Name::draw, "draw the schematic of a scene", footer_of_draw, &Line::add_draw},
        {"report", Name::report, "write an HTML page of scenes and their results", footer_of_report, &Line::add_report},
        {"serve", Name::serve, "open a playground for netlists in the browser", footer_of_serve, &Line::add_serve},
        {"components", Name::components, "describe the element types", "", &Line::add_components},
        {"expressions", Name::expressions, "list the functions and units of values", "", &Line::add_expressions},
        {"schema", Name::schema, "print the JSON Schema of a scene, for editors", "", &Line::add_schema},
    }};
    return all;
  }

  explicit CommandLine(const std::vector<std::string>& words) {
    app.set_help_flag("-h,--help", "print this help");
    app.set_version_flag("--version", "rheonet " RHEONET_VERSION, "print the version");
    app.footer(footer_of_rheonet);
    // Extra words are accepted here and refused by refuse_extra_words, which suggests the nearest valid word.
    app.allow_extras()->require_subcommand(0, 1);
    for (const Command& command : commands()) {
      CLI::App* known = app.add_subcommand(command.name, command.description)->allow_extras();
      known->footer(command.footer);
      if (std::find(words.begin(), words.end(), command.name) != words.end()) (this->*command.add_options)(known);
    }
  }
  CommandLine(const CommandLine&) = delete;  // `app` holds addresses of the other members.

  void add_overrides(CLI::App* command) {
    add_list(command, "--set", arguments.overrides,
             "replace the value at this path; may be repeated", "PATH=VALUE", false);
    add_list(command, "--without", arguments.without, "leave out these effects: inertia, or elasticity:oil for one element",
             "EFFECT,...");
    add_list(command, "--only", only, "keep only these effects; `none` leaves out all", "EFFECT,...");
    add_list(command, "--keep", arguments.keep, "switch off these reductions of the equations (see the manual)", "NAME,...");
  }
  CLI::Option* add_scene(CLI::App* command) {
    CLI::Option* scene = command->add_option("SCENE", arguments.scene, "the netlist, a TOML file")->required()->type_name("");
    add_overrides(command);
    return scene;
  }
  void add_accuracy(CLI::App* command) {
    command->add_option("--accuracy", accuracy, "allowed error of each record, relative to its largest magnitude")
        ->type_name("E");
  }

  void add_run(CLI::App* run) {
    add_scene(run);
    run->add_option("-o,--output", arguments.output, "file for the rows: .csv, .nc or .mat; `-`, the default, is CSV on standard output")
        ->type_name("FILE");
    run->add_option("--events", arguments.events, "file for the list of events: time, element, event, direction")
        ->type_name("FILE");
    run->add_option("--summary", arguments.summary, "JSON file for the summary: cost, energies, claims, certificate")
        ->type_name("FILE");
    run->add_option("--plot", arguments.figure, "draw the records (as [plot] says, else over time) into an .svg or a .png")
        ->type_name("FILE");
    add_accuracy(run);
    add_list(run, "--sensitivities", arguments.sensitivities,
             "add the derivatives of each record by the logarithms of these values: spring.stiffness, or a parameter", "PATH,...");
    run->add_flag("--certify", arguments.certify,
                  "estimate the error of each record from a tighter run, and tighten until it meets the accuracy");
    for (const char* other : {"--certify", "--plot"}) run->get_option("--sensitivities")->excludes(run->get_option(other));
    run->add_flag("--profile", arguments.profile, "list the elements and nodes that limit the time steps");
    run->add_option("--order", order, "highest order of the integration method, 1 to 5 (default 5)")->type_name("N");
    run->add_flag("-q,--quiet", arguments.quiet, "no progress bar and no summary");
  }
  void add_precision(CLI::App* precision) {
    add_scene(precision);
    add_accuracy(precision);
    add_list(precision, "--accuracies", accuracies, "accuracies to try (default: each power of ten from 1e-2 to 1e-11)",
             "E,...");
    precision->add_option("--runs", runs, "timed runs at each accuracy (default 5)")->type_name("N");
    precision->add_flag("--certified", arguments.certified, "add certified runs: their error, and the cost of the certificate");
    precision->add_flag("--variants", arguments.variants, "add other methods: lower order, events not located, no reductions, regularised sliders");
    add_list(precision, "--variant", arguments.variant_texts,
             "add another scene, or this one with other values separated by `;`; errors are relative to this scene",
             "SCENE.toml|PATH=VALUE", false);
    add_list(precision, "--pair", arguments.pairs, "a record of the scene and its counterpart in the variant", "RECORD=RECORD");
    precision->add_option("-o,--output", arguments.overlay, "CSV file for the list; `-` is standard output")
        ->type_name("FILE");
    precision->add_option("--plot", arguments.figure, "draw cost over error: an .svg or a .png")->type_name("FILE");
  }
  void add_sweep(CLI::App* sweep) {
    add_scene(sweep);
    add_sweep_options(sweep, arguments.sweep, sweep_texts);
    sweep->add_option("-o,--output", arguments.output, "file for the rows: .csv, .nc or .mat; `-`, the default, is CSV on standard output")
        ->type_name("FILE");
    add_accuracy(sweep);
    sweep->add_flag("-q,--quiet", arguments.quiet, "no progress bar and no summary");
  }
  void add_check(CLI::App* check) {
    add_scene(check);
    check->add_flag("-v,--verbose", arguments.verbose, "print the network with every value in SI");
  }
  void add_explain(CLI::App* explain) {
    CLI::Option* scene = add_scene(explain);
    add_accuracy(explain);
    explain->add_flag("--json", arguments.json, "print JSON");
    const auto without_scene = [this, scene] {
      arguments.numerics = true;
      scene->required(false);
    };
    explain->add_flag_callback("--numerics", without_scene,
                               "print every numerical parameter of the engine: value, unit, meaning, reason; takes no scene");
  }
  void add_effects(CLI::App* weigh) {
    add_scene(weigh);
    add_accuracy(weigh);
    weigh->add_option("--within", within, "acceptable difference, relative to a record's largest magnitude (default 0.01)")->type_name("E");
    weigh->add_option("--runs", runs, "timed runs of each model (default 5)")->type_name("N");
    weigh->add_option("-o,--output", arguments.overlay, "CSV file for all differences; `-` is standard output")->type_name("FILE");
  }
  void add_draw(CLI::App* draw) {
    add_scene(draw);
    draw->add_option("-o,--output", arguments.output, "the figure: an .svg or a .png; `-` is an SVG on standard output")
        ->required()
        ->type_name("FILE");
    draw->add_option("--title", arguments.title, "title of the figure, instead of that of the scene")->type_name("TEXT");
    draw->add_flag("--all", arguments.all, "draw all members of a repeat, also in a scene of more than 45 elements");
    draw->add_flag("--no-values", arguments.no_values, "draw names without values");
  }
  void add_compare(CLI::App* compare) {
    compare->add_option("SCENES", arguments.scenes, "two or more netlists; each is compared with the first")
        ->required()
        ->expected(2, 26)
        ->option_text("A B [C ...]");
    add_overrides(compare);
    add_accuracy(compare);
    add_list(compare, "--pair", arguments.pairs,
             "a record of the first scene and its counterpart in the others; may be repeated", "PATH=PATH", false);
    compare->add_option("--vary", arguments.vary, "vary this value in all scenes")
        ->type_name("PATH=RANGE");
    compare->add_option("--within", within, "allowed relative difference; sets the exit status")
        ->type_name("E");
    compare
        ->add_option("-o,--output", arguments.overlay,
                     "CSV file for the rows of all scenes, side by side; `-` is standard output")
        ->type_name("FILE");
  }
  void add_plot(CLI::App* plot) {
    add_figure(plot, arguments);
    add_overrides(plot);
    add_accuracy(plot);
  }
  void add_report(CLI::App* report) {
    add_report_options(*report, arguments.scenes, arguments.output, arguments.title, arguments.certify, arguments.report);
    add_overrides(report);
    add_accuracy(report);
  }
  void add_serve(CLI::App* serve) { add_serve_options(*serve, arguments.serve); }
  void add_components(CLI::App* components) {
    components->add_option("TYPE", arguments.type, "one element type (default: all)")->type_name("");
    components->add_flag("--markdown", arguments.markdown, "print the reference for components/README.md");
  }
  void add_expressions(CLI::App* expressions) {
    expressions->add_flag("--markdown", arguments.markdown, "print the reference for core/netlist/expressions.md");
  }
  void add_schema(CLI::App*) {}
};

}  // namespace

std::variant<Arguments, ExitStatus> read_arguments(std::vector<std::string> words) {
  CommandLine line(words);
  auto& [arguments, accuracy, within, order, runs, sweep_texts, accuracies, only, app] = line;

  arguments.words = words;
  words = with_every_option(words);
  std::vector<std::string> reversed(words.rbegin(), words.rend());  // CLI11 takes a vector in reverse order.
  try {
    try {
      app.parse(reversed);
    } catch (const CLI::Success& help_or_version) {
      app.exit(help_or_version);
      return done;
    } catch (const CLI::ParseError& error) {
      refuse_extra_words(app, words);  // A misspelt word is often the reason for a missing one.
      throw WrongCommandLine{parse_error_in_words(error), ""};
    }
    refuse_extra_words(app, words);
    refuse_files_without_a_name(app);
    if (accuracy) arguments.accuracy = read_number("--accuracy", *accuracy);
    if (within) arguments.within = read_number("--within", *within);
    if (order) arguments.order = read_whole("--order", *order, 1, 5);
    if (runs) arguments.runs = read_whole("--runs", *runs, 1, 1000);
    arguments.accuracies = read_accuracies(accuracies);
    read_sweep_texts(sweep_texts, arguments.sweep);
    check_reductions(arguments.keep);
    if (!only.empty()) arguments.only = only == std::vector<std::string>{"none"} ? std::vector<std::string>{} : only;
    if (within && !(*arguments.within >= 0))
      throw WrongCommandLine{fmt::format("`--within` must be at least 0, but is {}", *within), ""};
    if (app.get_subcommands().empty())
      throw WrongCommandLine{"no command given", "to simulate a scene: `rheonet run SCENE`"};
  } catch (const WrongCommandLine& mistake) {
    return report_mistake(mistake, app);
  }

  const std::string called = app.get_subcommands().front()->get_name();
  const auto& commands = CommandLine::commands();
  arguments.command = std::find_if(commands.begin(), commands.end(), [&](const auto& c) { return called == c.name; })->command;
  return arguments;
}

}  // namespace rheonet::tool
