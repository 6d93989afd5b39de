#include "tools/rheonet/program.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include "core/result/csv.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {

int run_program(int count, char** words, const std::function<ExitStatus(const Arguments&)>& command) {
  fail_writes_with_errors();
  try {
    const std::variant<Arguments, ExitStatus> read = read_arguments({words + 1, words + count});
    if (const ExitStatus* status = std::get_if<ExitStatus>(&read)) return *status;
    const Arguments& arguments = std::get<Arguments>(read);
    if (!arguments.serve.worker) answer_signals();  // A worker writes no file, and its server reports why it ended.
    const ExitStatus status = command(arguments);
    if (std::fflush(stdout) != 0) {
      say("error: cannot write to standard output\n");
      return not_simulated;
    }
    return status;
  } catch (const std::system_error& error) {
    say("error: {}\n", error.what());
  } catch (const WriteError& error) {
    say("error: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    say("error: out of memory\n");
  } catch (const std::exception& error) {
    say("error: a mistake in rheonet itself: {}\n", error.what());
  }
  return not_simulated;
}

}  // namespace rheonet::tool
