// Reads and runs netlists with mistakes of all kinds; see README.md.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "tests/fuzz/cases.hpp"
#include "tests/fuzz/scene_tree.hpp"
#include "tests/fuzz/trial.hpp"

using namespace rheonet::test;

namespace {

namespace fs = std::filesystem;

struct Options {
  long reads = 0, runs = 0, first = 0;
  std::uint64_t seed = 1;
  int jobs = 1;
  std::string show, failures;
  bool minimise = false;
  TrialLimits limits;
};

/// Counters shared by all processes of a fuzzing run.
struct Counts {
  std::atomic<long> reads, runs, faults, interrupted, status[3];
};

/// An object in shared memory.
template <class T>
T* shared() {
  void* const memory = ::mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : new (memory) T{};
}

/// A temporary folder, removed by the destructor.
struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("rheonet-fuzz-{}", ::getpid());
  Scratch() { fs::create_directory(path); }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

class Fuzzing {
 public:
  Fuzzing(const Options& options, Counts& counts)
      : options_(options), counts_(counts), netlists_(fs::path(RHEONET_SOURCE_DIR) / "netlists"), cases_(netlists_), at_(shared<std::atomic<long>>()) {}

  FuzzCase make(long number, bool mild) const { return cases_.make(options_.seed, number, mild); }

  void read(long number) {
    const FuzzCase c = make(number, false);
    if (const std::string fault = fault_of_read(c); !fault.empty()) tell("read", number, fault, c, [&](const std::string& text) {
      return fault_of_read({text, c.folder}) == fault;
    });
  }

  /// Reads the numbers first, first + step, ... below the end, in a process that is replaced by a new one after a crash.
  void read_all(long first, long step) {
    for (long next = first; next < options_.first + options_.reads;) {
      at_->store(next);
      std::fflush(nullptr);
      const pid_t process = ::fork();
      if (process == 0) {
        quiet();
        for (long k = next; k < options_.first + options_.reads; k += step) {
          at_->store(k);
          limit_time();
          read(k);
          ++counts_.reads;
        }
        std::fflush(nullptr);
        ::_exit(0);
      }
      int status = 0;
      while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
      }
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
      const long number = at_->load();
      const std::string fault = words_of(status);
      const FuzzCase c = make(number, false);
      tell("read", number, fault, c, [&](const std::string& text) { return crash_of_read({text, c.folder}) == fault; });
      next = number + step;
    }
  }

  void run(long number) {
    const FuzzCase c = make(number, is_mild(number));
    const Trial trial = try_run(number, c.text, c.folder);
    ++counts_.runs;
    if (trial.interrupted) ++counts_.interrupted;
    if (trial.fault.empty()) ++counts_.status[trial.status];
    if (!trial.fault.empty())
      tell("run", number, trial.fault, c, [&](const std::string& text) { return try_run(number, text, c.folder).fault == trial.fault; });
  }

  /// Three runs in four: most others are refused by the reader.
  static bool is_mild(long number) { return number % 4 > 0; }

  void run_all(long first, long step) {
    for (long k = first; k < options_.first + options_.runs; k += step) run(k);
  }

 private:
  static void quiet() {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
#ifndef __SANITIZE_ADDRESS__
    const rlimit memory{4ul << 30, 4ul << 30};
    ::setrlimit(RLIMIT_AS, &memory);
#endif
  }
  /// Limits the CPU time of the next netlist.
  static void limit_time() {
    constexpr rlim_t seconds = 60;
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const rlim_t end = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + seconds;
    const rlimit limit{end, RLIM_INFINITY};
    ::setrlimit(RLIMIT_CPU, &limit);
  }
  static std::string words_of(int status) {
    return WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status)) : fmt::format("exit status {}", WEXITSTATUS(status));
  }

  std::string fault_of_read(const FuzzCase& c) const { return try_read(c.text, c.folder, netlists_); }

  std::string crash_of_read(const FuzzCase& c) const {
    std::fflush(nullptr);
    const pid_t process = ::fork();
    if (process == 0) {
      quiet();
      limit_time();
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      fault_of_read(c);
      ::_exit(0);
    }
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return words_of(status);
  }

  /// Runs the program. The number determines the command and its time limit: most are short, some longer.
  Trial try_run(long number, const std::string& text, const fs::path& folder) {
    static const std::vector<std::string> commands[] = {{"run"}, {"run"}, {"run"}, {"run"}, {"run"}, {"run", "--certify"}, {"check"}, {"explain"}, {"draw"}, {"effects", "--runs", "1"}};
    std::vector<std::string> words = commands[number % 10];
    words.push_back(copy_of(folder));
    TrialLimits limits = options_.limits;
    if (number / 10 % 10 == 0) limits.cpu_seconds *= 10;
    return try_program(words, text, limits);
  }

  /// The path of the fuzzed scene: in a copy of `folder`, where it finds its includes and tables.
  std::string copy_of(const fs::path& folder) {
    if (!fs::exists(scratch_.path / "netlists")) fs::copy(netlists_, scratch_.path / "netlists", fs::copy_options::recursive);
    return (scratch_.path / "netlists" / fs::relative(folder, netlists_) / "fuzzed.toml").string();
  }

  template <class Fails>
  void tell(const char* what, long number, const std::string& fault, const FuzzCase& c, const Fails& fails) {
    ++counts_.faults;
    const std::string text = options_.minimise ? minimise(c.text, fails) : c.text;
    if (!options_.failures.empty()) {
      fs::create_directories(options_.failures);
      const fs::path file = fs::path(options_.failures) / fmt::format("{}-{}-{}.toml", what, options_.seed, number);
      if (std::FILE* f = std::fopen(file.c_str(), "w")) {
        fmt::print(f, "# {}; beside {}\n{}", fault, c.folder.string(), text);
        std::fclose(f);
      }
    }
    fmt::print("{} {} of seed {}: {}\n", what, number, options_.seed, fault);
    std::fflush(stdout);
  }

  const Options& options_;
  Counts& counts_;
  const fs::path netlists_;
  FuzzCases cases_;
  std::atomic<long>* at_;  ///< The number being read.
  Scratch scratch_;
};

int go(const Options& options) {
  Counts* const counts = shared<Counts>();
  if (!options.show.empty()) {
    fmt::print("{}", Fuzzing(options, *counts).make(std::stol(options.show), options.runs > 0 && Fuzzing::is_mild(std::stol(options.show))).text);
    return 0;
  }
  const auto begin = std::chrono::steady_clock::now();
  for (int job = 0; job < options.jobs; ++job) {
    std::fflush(nullptr);
    if (::fork() != 0) continue;
    {
      Fuzzing fuzzing(options, *counts);
      fuzzing.read_all(options.first + job, options.jobs);
      fuzzing.run_all(options.first + job, options.jobs);
    }
    std::fflush(nullptr);
    ::_exit(0);
  }
  bool whole = true;
  for (int job = 0; job < options.jobs; ++job) {
    int status = 0;
    while (::wait(&status) < 0 && errno == EINTR) {
    }
    whole = whole && status == 0;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  fmt::print("seed {}: {} reads, {} runs ({} done, {} refused, {} wrong, of these {} interrupted), {} faults; {:.0f} s, {} s of a core\n", options.seed,
             counts->reads.load(), counts->runs.load(), counts->status[0].load(), counts->status[1].load(), counts->status[2].load(),
             counts->interrupted.load(), counts->faults.load(), seconds, used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  if (!whole) fmt::print("a process of the fuzzing itself has failed\n");
  return whole && counts->faults == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Reads and runs netlists that are wrong in all ways");
  app.add_option("--reads", options.reads, "netlists that are read");
  app.add_option("--runs", options.runs, "netlists that the program is run on");
  app.add_option("--first", options.first, "number of the first one");
  app.add_option("--seed", options.seed, "of them all");
  app.add_option("--jobs", options.jobs, "processes at a time")->check(CLI::PositiveNumber);
  app.add_option("--show", options.show, "print the netlist of this number instead: of a read, or with --runs 1 of a run");
  app.add_option("--failures", options.failures, "a folder for the netlists that fail");
  app.add_flag("--minimise", options.minimise, "make these as small as possible");
  app.add_option("--cpu", options.limits.cpu_seconds, "seconds of a processor after which a run is interrupted");
  CLI11_PARSE(app, argc, argv);
  return go(options);
}
