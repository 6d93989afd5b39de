// rheonet for a page without a server. The page puts the netlists that come with it into /netlists of the file system in
// memory, and asks as it would ask `rheonet serve`: see tools/web/README.md.
#include <emscripten.h>

#include <cstdlib>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/report/messages.hpp"
#include "tools/serve/below.hpp"
#include "tools/serve/folder.hpp"
#include "tools/serve/requests.hpp"
#include "tools/serve/tasks.hpp"

namespace {

using namespace rheonet;
using nlohmann::json;

constexpr const char* netlists = "/netlists";

// The worker's script defines this function (worker.js).
EM_JS(void, tell_page, (const char* message), { Module.tell(UTF8ToString(message)); });

void tell(const std::string& message) { tell_page(message.c_str()); }

void refuse(const char* why) { tell(report::to_line({{"error", why}})); }

const serve::Folder& folder() {
  static const serve::Folder opened(netlists, false);
  return opened;
}

void open_netlist(const json& request) {
  const auto netlist = folder().read(serve::word(request, "file"));
  if (!netlist) return refuse("there is no such netlist in the folder");
  tell(report::to_line({{"text", netlist->text}, {"version", netlist->version}}));
}

void do_task(const json& request) {
  static const serve::OfferedFolder offer{std::filesystem::path(netlists)};
  const std::optional<json> task = serve::task_of(request);
  if (!task) return refuse("the request asks for nothing that is known here");
  // An include looks in the folder of the scene first, then in the whole collection.
  serve::carry_out(*task, {&offer, &offer}, tell);
}

}  // namespace

/// Answers a request, whose body is a JSON object, by messages to the page, a JSON object each.
extern "C" EMSCRIPTEN_KEEPALIVE void answer(const char* path, const char* body) {
  try {
    const std::string_view asked(path);
    const json request = json::parse(body);
    if (asked == "/api/folder")
      tell(report::to_line(serve::listing_of(folder())));
    else if (asked == "/api/scene")
      open_netlist(request);
    else if (asked == "/api/task")
      do_task(request);
    else
      refuse("nothing is known by this name");
  } catch (const std::bad_alloc&) {
    tell(report::to_line({{"kind", "failed"}, {"message", "the run needs more memory than the browser gives to a page"}}));
  } catch (const std::exception& error) {
    tell(report::to_line({{"kind", "failed"}, {"message", error.what()}}));
  }
}
