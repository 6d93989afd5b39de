#include "tools/serve/api.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/report/messages.hpp"
#include "tools/serve/netlist_name.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::serve {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr std::size_t longest_body = 1u << 20;  // of a body
constexpr std::size_t most_compared = 4, most_curves = 200, longest_name = 1000;

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(report::to_line({{"error", why}}), "application/json");
  response.set_header("Connection", "close");
  Server::end_connection();
}

/// Says how one gets in: in words that a person reads, or a program.
void ask_for_token(const httplib::Request& request, httplib::Response& response) {
  if (request.path.starts_with("/api/"))
    return refuse(response, 401, "the token of the address that `rheonet serve` has printed is missing, or of another start: open "
                                 "that address again");
  response.status = 401;
  response.set_content(web::token_page().text.data(), web::token_page().text.size(), web::token_page().type);
  response.set_header("Connection", "close");
  Server::end_connection();
}

/// The body as JSON; absent if it is none or too large, which has then been said.
std::optional<json> read(httplib::Response& response, const httplib::ContentReader& body) {
  std::string text;
  bool too_large = false;
  const bool whole = body([&](const char* data, std::size_t size) {
    too_large = text.size() + size > longest_body;
    if (!too_large) text.append(data, size);
    return !too_large;
  });
  if (too_large) return refuse(response, 413, "a request may have 1 MB"), std::nullopt;
  if (!whole) return refuse(response, 400, "the request is not complete"), std::nullopt;
  json value = json::parse(text, nullptr, false);
  if (!value.is_object()) return refuse(response, 400, "the request is no JSON object in UTF-8"), std::nullopt;
  return value;
}

/// A string of a request, "" if there is none; a long one is no name.
std::string word(const json& value, const char* key) {
  const auto found = value.find(key);
  if (found == value.end() || !found->is_string()) return "";
  const auto& text = found->get_ref<const std::string&>();
  return text.size() <= longest_name ? text : "";
}

/// A netlist as a worker gets it; absent if it is not one.
std::optional<json> scene_of(const json& value) {
  if (!value.is_object() || !value.contains("text") || !value["text"].is_string()) return {};
  const std::string file = word(value, "file");
  const std::string folder = fault_of_name(file).empty() ? std::filesystem::path(file).parent_path().string() : "";
  return json{{"text", value["text"]}, {"file", file.empty() ? "scene.toml" : file}, {"folder", folder}};
}

/// The task that a request asks for, with nothing in it but what is known; absent if it asks for none.
std::optional<json> task_of(const json& request) {
  const std::string kind = word(request, "task");
  if (kind == "show" || kind == "explain" || kind == "csv") {
    std::optional<json> task = scene_of(request);
    if (!task) return {};
    (*task)["task"] = kind;
    (*task)["draw"] = request.value("draw", json()) == true;
    return task;
  }
  if ((kind != "report" && kind != "figure") || !request.contains("scenes") || !request["scenes"].is_array()) return {};
  json task{{"task", kind}, {"scenes", json::array()}, {"curves", json::array()}};
  if (request["scenes"].empty() || request["scenes"].size() > most_compared) return {};
  for (const json& scene : request["scenes"]) {
    std::optional<json> one = scene_of(scene);
    if (!one) return {};
    task["scenes"].push_back(std::move(*one));
  }
  if (kind == "report") return task;
  if (!request.contains("curves") || !request["curves"].is_array() || request["curves"].size() > most_curves) return {};
  for (const json& curve : request["curves"]) {
    if (!curve.is_array() || curve.size() != 2 || !curve[0].is_string() || !curve[1].is_string()) return {};
    task["curves"].push_back(curve);
  }
  return task;
}

int status_of(Folder::Written::Outcome outcome) {
  using Outcome = Folder::Written::Outcome;
  switch (outcome) {
    case Outcome::done:
      return 200;
    case Outcome::no_name:
      return 400;
    case Outcome::not_here:
      return 403;
    case Outcome::other_there:
      return 409;
    case Outcome::failed:
      break;
  }
  return 500;
}

void add_headers(httplib::Server& server) {
  server.set_default_headers({
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src data:; "
       "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"},
  });
}

}  // namespace

void Api::attach(Server& server, const std::string& host) {
  add_headers(server);
  server.set_pre_routing_handler([this, host](const Request& request, Response& response) {
    using Handled = httplib::Server::HandlerResponse;
    if (const std::string why = refusal(request, host); !why.empty())
      return refuse(response, 403, why), Handled::Handled;
    if (!keys_.admit(request, response)) return ask_for_token(request, response), Handled::Handled;
    return Handled::Unhandled;
  });
  const auto page = [&server](const char* path, const web::Asset& asset) {
    server.Get(path, [asset](const Request&, Response& response) {
      response.set_content(asset.text.data(), asset.text.size(), asset.type);
    });
  };
  page("/", web::playground_page());
  page("/playground.css", web::playground_style());
  page("/playground.js", web::playground_script());
  page("/licences.txt", web::notice());
  server.Get("/api/folder", [this](const Request&, Response& response) { list(response); });
  server.Get("/api/scene", [this](const Request& request, Response& response) { open(request, response); });
  server.Post("/api/save", [this](const Request&, Response& response, const Reader& body) { save(response, body); });
  server.Post("/api/task", [this](const Request&, Response& response, const Reader& body) { start(response, body); });
  server.set_exception_handler([](const Request&, Response& response, std::exception_ptr) {
    refuse(response, 500, "the request could not be answered");
  });
}

void Api::list(Response& response) const {
  json scenes = json::array();
  const Folder::Listing listing = folder_.scenes();
  for (const Folder::Entry& each : listing.scenes) {
    scenes.push_back({{"file", each.file}, {"title", each.title}, {"about", each.about}});
    if (each.place) scenes.back()["place"] = *each.place;
  }
  response.set_content(report::to_line({{"name", folder_.path().filename().string()},
                                        {"may_be_written", folder_.may_be_written()},
                                        {"seconds", pool_.limits().seconds},
                                        {"left_out", listing.left_out},
                                        {"all_visited", listing.all_visited},
                                        {"scenes", scenes}}),
                       "application/json");
}

void Api::open(const Request& request, Response& response) const {
  const std::optional<Folder::Netlist> netlist = folder_.read(request.get_param_value("file"));
  if (!netlist) return refuse(response, 404, "there is no such netlist in the folder");
  response.set_header("ETag", '"' + netlist->version + '"');
  response.set_content(netlist->text, "text/plain; charset=utf-8");
}

void Api::save(Response& response, const Reader& body) {
  const std::optional<json> request = read(response, body);
  if (!request) return;
  if (!request->contains("text") || !(*request)["text"].is_string()) return refuse(response, 400, "there is no text to save");
  if (!request->contains("file") || !(*request)["file"].is_string()) return refuse(response, 400, "there is no name to save it by");
  const Folder::Written written = folder_.write((*request)["file"].get_ref<const std::string&>(),
                                                (*request)["text"].get_ref<const std::string&>(), word(*request, "version"));
  response.status = status_of(written.outcome);
  json answer{{"version", written.version}};
  if (!written.why.empty()) answer["error"] = written.why;
  response.set_content(report::to_line(answer), "application/json");
}

std::shared_ptr<Job> Api::begin(const std::string& session, std::string task) {
  const std::lock_guard lock(mutex_);
  std::erase_if(sessions_, [](const auto& each) { return each.second.expired(); });
  if (!session.empty())
    if (const auto older = sessions_.find(session); older != sessions_.end())
      if (const std::shared_ptr<Job> job = older->second.lock()) job->cancel();
  auto job = std::make_shared<Job>(pool_, std::move(task));
  if (!session.empty()) sessions_[session] = job;
  return job;
}

void Api::start(Response& response, const Reader& body) {
  const std::optional<json> request = read(response, body);
  if (!request) return;
  const std::optional<json> task = task_of(*request);
  if (!task) return refuse(response, 400, "the request asks for nothing that is known here");
  const std::shared_ptr<Job> job = begin(word(*request, "session"), report::to_line(*task));
  response.set_chunked_content_provider("application/x-ndjson", [job](std::size_t, httplib::DataSink& sink) {
    constexpr auto tick = 50ms;
    bool finished = false;
    const std::string text = job->take(tick, finished);
    if (!sink.is_writable() || (!text.empty() && !sink.write(text.data(), text.size()))) {
      job->cancel();
      return false;
    }
    if (finished) sink.done();
    return true;
  });
}

}  // namespace rheonet::serve
