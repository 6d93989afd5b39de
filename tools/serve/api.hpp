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

  /// Adds the routes. `host` is the address that the server listens at; `shared` is the address of the page for other machines, "": none;
  /// `framed_by` is the origin whose pages may embed the page in a frame, "": none.
  void attach(Server& server, const std::string& host, const std::string& shared, const std::string& framed_by);

 private:
  using Reader = httplib::ContentReader;
  using Request = httplib::Request;
  using Response = httplib::Response;

  void list(const Request& request, Response& response) const;
  void open(const Request& request, Response& response) const;
  void save(const Request& request, Response& response, const Reader& body);
  void start(Response& response, const Reader& body);
  struct Newest {
    std::weak_ptr<Job> job;
    double turn = 0;  ///< The page counts its tasks.
  };
  /// Starts a task, and cancels the earlier task of the same session. Null if a later task of the session has come before it: requests
  /// travel on several connections, which overtake each other on a busy machine.
  std::shared_ptr<Job> begin(const std::string& session, double turn, std::string task);

  Folder& folder_;
  Pool& pool_;
  Keys& keys_;
  std::string shared_;
  std::mutex mutex_;
  std::map<std::string, Newest> sessions_;
};

}  // namespace rheonet::serve
