#include "tests/wiring/tally.hpp"

#include <fmt/format.h>

#include <ctime>
#include <sstream>

#include "tests/wiring/apart.hpp"

namespace rheonet::test {

namespace {

constexpr std::array<const char*, 5> verdict_names = {"agrees", "refused", "open", "undecided", "wrong"};

// As a process sends it: numbers, then the text.
std::string packed(const Judgement& j, double seconds) {
  return fmt::format("{} {:.17g} {:.17g} {} {:.3f} {}", static_cast<int>(j.verdict), j.deviation, j.judged,
                     j.reference_steps, seconds, j.text);
}

Judgement unpacked(const std::string& text, double& seconds) {
  Judgement j;
  int verdict = static_cast<int>(Verdict::wrong);
  std::istringstream in(text);
  std::string deviation;  // may be infinite, which a stream does not read
  in >> verdict >> deviation >> j.judged >> j.reference_steps >> seconds >> std::ws;
  j.deviation = std::strtod(deviation.c_str(), nullptr);
  j.verdict = static_cast<Verdict>(verdict);
  std::getline(in, j.text, '\0');
  return j;
}

}  // namespace

Tally judge_all(const std::vector<int>& numbers, int jobs, const Judge& judge, std::FILE* log) {
  Tally tally;
  const auto note = [&](int number, const Judgement& j, double seconds) {
    ++tally.count[static_cast<std::size_t>(j.verdict)];
    tally.cpu_seconds += seconds;
    const std::string& name = catalogue()[static_cast<std::size_t>(number)].name;
    const std::string line = fmt::format("{} {} [{}]: {}", verdict_names[static_cast<std::size_t>(j.verdict)], number, name, j.text);
    if (j.verdict == Verdict::wrong) tally.wrong.push_back(line);
    if (j.verdict == Verdict::undecided) tally.undecided.push_back(line);
    if (!log) return;
    fmt::print(log, "{} | deviation {:.2e}, judged {:.2f}, {} steps, {:.2f} s\n", line, j.deviation, j.judged,
               j.reference_steps, seconds);
    std::fflush(log);
  };
  Apart apart;
  apart.jobs = jobs;
  apart.work = [&](int number) {
    const Judgement j = judge(catalogue()[static_cast<std::size_t>(number)]);
    return packed(j, double(std::clock()) / CLOCKS_PER_SEC);
  };
  apart.done = [&](int number, const std::string& result) {
    double seconds = 0;
    const Judgement j = unpacked(result, seconds);
    note(number, j, seconds);
  };
  apart.lost = [&](int number, const std::string& why) { note(number, {.text = why}, 0); };
  catalogue();  // once, not in every process
  apart.run(numbers);
  return tally;
}

}  // namespace rheonet::test
