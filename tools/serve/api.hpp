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

/// The HTTP requests of the playground: see tools/web/README.md.
class Api {
 public:
  Api(Folder& folder, Pool& pool, Keys& keys) : folder_(folder), pool_(pool), keys_(keys) {}

  /// Adds the routes. `host` is the address that the server listens at; `framed_by` is the origin whose pages may embed the page in a frame,
  /// "": none.
  void attach(Server& server, const std::string& host, const std::string& framed_by);

 private:
  using Reader = httplib::ContentReader;
  using Request = httplib::Request;
  using Response = httplib::Response;

  void list(Response& response) const;
  void open(const Request& request, Response& response) const;
  void save(Response& response, const Reader& body);
  void start(Response& response, const Reader& body);
  /// Starts a task, and cancels the earlier task of the same session.
  std::shared_ptr<Job> begin(const std::string& session, std::string task);

  Folder& folder_;
  Pool& pool_;
  Keys& keys_;
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<Job>> sessions_;
};

}  // namespace rheonet::serve
