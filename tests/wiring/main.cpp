// The whole wiring test, or a part of it. A part is in rheonet_tests too; see README.md.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "tests/wiring/catalogue.hpp"
#include "tests/wiring/identities.hpp"
#include "tests/wiring/judge.hpp"
#include "tests/wiring/tally.hpp"

using namespace rheonet::test;

namespace {

struct Options {
  int jobs = 1;
  std::string part, name, log;
  std::vector<int> numbers;
  bool toml = false, identities = false, reductions = false, closer = false;
};

std::vector<int> chosen(const Options& options) {
  int i = 1, n = 1;
  if (!options.part.empty() && (std::sscanf(options.part.c_str(), "%d/%d", &i, &n) != 2 || i < 1 || n < i)) {
    throw CLI::ValidationError("--part", "is written 3/10: the third of ten");
  }
  const int count = static_cast<int>(catalogue().size());
  std::vector<int> numbers = options.numbers.empty() ? part(i - 1, n) : options.numbers;
  std::erase_if(numbers, [&](int number) {
    if (number < 0 || number >= count) throw CLI::ValidationError("--number", fmt::format("0 to {}", count - 1));
    return catalogue()[static_cast<std::size_t>(number)].name.find(options.name) == std::string::npos;
  });
  return numbers;
}

int go(const Options& options) {
  const std::vector<int> numbers = chosen(options);
  if (options.toml) {
    for (const int number : numbers) fmt::print("{}\n", netlist_of(catalogue()[static_cast<std::size_t>(number)]));
    return 0;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> log(
      options.log.empty() ? nullptr : std::fopen(options.log.c_str(), "w"), [](std::FILE* f) { return f ? std::fclose(f) : 0; });
  const auto how = [&](const Wiring& wiring) {
    if (options.reductions) return check_reductions(wiring);
    return options.identities ? check_identities(wiring) : judge(wiring, options.closer);
  };
  const Tally tally = judge_all(numbers, options.jobs, how, log.get());
  for (const std::string& line : tally.undecided) fmt::print("{}\n", line);
  for (const std::string& line : tally.wrong) fmt::print("{}\n", line);
  fmt::print("{} scenes: {} agree, {} refused as expected, {} open, {} undecided, {} wrong; {:.0f} s of a core\n", numbers.size(),
             tally.of(Verdict::agrees), tally.of(Verdict::refused), tally.of(Verdict::open), tally.of(Verdict::undecided),
             tally.of(Verdict::wrong), tally.cpu_seconds);
  return tally.of(Verdict::wrong) > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  // Code shared with the tests uses doctest's assertions, which need a context.
  doctest::Context context;
  context.setAsDefaultForAssertsOutOfTestCases();
  Options options;
  CLI::App app("Every wiring of springs, dashpots and friction elements against an independent integrator");
  app.add_option("--jobs", options.jobs, "processes at a time")->check(CLI::PositiveNumber);
  app.add_option("--part", options.part, "i/n: the i-th of n parts");
  app.add_option("--name", options.name, "those whose name contains this");
  app.add_option("--number", options.numbers, "these alone");
  app.add_flag("--toml", options.toml, "print their netlists instead");
  app.add_flag("--identities", options.identities, "the identities of mechanics instead of the reference");
  app.add_flag("--reductions", options.reductions, "each reduction on against off instead of the reference");
  app.add_flag("--closer", options.closer, "with a smaller step and a tighter accuracy: who is nearer to the truth");
  app.add_option("--log", options.log, "a line for each scene goes to this file");
  try {
    app.parse(argc, argv);
    return go(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
}
