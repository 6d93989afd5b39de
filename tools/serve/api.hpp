#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "tools/serve/folder.hpp"
#include "tools/serve/guard.hpp"
#include "tools/serve/job.hpp"
#include "tools/serve/server.hpp"

namespace rheonet::serve {

/// What the playground asks for: see tools/web/README.md.
class Api {
 public:
  Api(Folder& folder, Pool& pool, Keys& keys) : folder_(folder), pool_(pool), keys_(keys) {}

  /// Adds its routes. `host` is the address that is listened at; `framed_by` the origin whose pages may show the page in a frame, "": none.
  void attach(Server& server, const std::string& host, const std::string& framed_by);

 private:
  using Reader = httplib::ContentReader;
  using Request = httplib::Request;
  using Response = httplib::Response;

  void list(Response& response) const;
  void open(const Request& request, Response& response) const;
  void save(Response& response, const Reader& body);
  void start(Response& response, const Reader& body);
  /// Begins a task; an older one of the same session is not wanted any more.
  std::shared_ptr<Job> begin(const std::string& session, std::string task);

  Folder& folder_;
  Pool& pool_;
  Keys& keys_;
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<Job>> sessions_;
};

}  // namespace rheonet::serve
