#include "tools/serve/api.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "tools/report/messages.hpp"
#include "tools/serve/requests.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::serve {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr std::size_t longest_body = 1u << 20;  // Largest body of a request [bytes].

/// Answers with these bytes as they are. `set_content` would compress them again for each request, which takes seconds for a script of 1 MB.
/// `owner` keeps the bytes until they are sent, unless they last as long as the program.
void send(httplib::Response& response, std::string_view bytes, const char* type, std::shared_ptr<const std::string> owner = nullptr) {
  if (bytes.empty()) return response.set_content("", type);
  response.set_content_provider(bytes.size(), type, [bytes, owner = std::move(owner)](std::size_t from, std::size_t length, httplib::DataSink& sink) {
    return sink.write(bytes.data() + from, length);
  });
}

void send_text(httplib::Response& response, std::string text, const char* type) {
  const auto kept = std::make_shared<const std::string>(std::move(text));
  send(response, *kept, type, kept);
}

void send(httplib::Response& response, const httplib::Request& request, const web::Asset& asset) {
  const bool compressed = !asset.gzipped.empty() && request.get_header_value("Accept-Encoding").find("gzip") != std::string::npos;
  if (compressed) response.set_header("Content-Encoding", "gzip");
  if (!asset.gzipped.empty()) response.set_header("Vary", "Accept-Encoding");
  send(response, compressed ? asset.gzipped : asset.text, asset.type);
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  send_text(response, report::to_line({{"error", why}}), "application/json");
  response.set_header("Connection", "close");
  Server::end_connection();
}

/// Explains how to get access, as a page or as JSON.
void ask_for_token(const httplib::Request& request, httplib::Response& response) {
  if (request.path.starts_with("/api/"))
    return refuse(response, 401, "the token of the address that `rheonet serve` has printed is missing, or of another start: open "
                                 "that address again");
  response.status = 401;
  send(response, request, web::token_page());
  response.set_header("Connection", "close");
  Server::end_connection();
}

/// The body as JSON; absent, after an answer with the reason, if it is not JSON or too large.
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

/// `framed_by`: the origin whose pages may embed the page in a frame; "": none.
void add_headers(httplib::Server& server, const std::string& framed_by) {
  server.set_default_headers({
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src data:; "
       "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors " + (framed_by.empty() ? "'none'" : framed_by)},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"},
  });
}

}  // namespace

void Api::attach(Server& server, const std::string& host, const std::string& shared, const std::string& framed_by) {
  shared_ = shared;
  add_headers(server, framed_by);
  server.set_pre_routing_handler([this, host](const Request& request, Response& response) {
    using Handled = httplib::Server::HandlerResponse;
    if (const std::string why = refusal(request, host); !why.empty())
      return refuse(response, 403, why), Handled::Handled;
    if (!is_this_machine(host) && keys_.lead_in(request, response)) return Handled::Handled;
    if (!keys_.admit(request, response)) return ask_for_token(request, response), Handled::Handled;
    return Handled::Unhandled;
  });
  const auto page = [&server](const char* path, const web::Asset& asset) {
    server.Get(path, [asset](const Request& request, Response& response) { send(response, request, asset); });
  };
  page("/", web::playground_page());
  page("/playground.css", web::playground_style());
  page("/playground.js", web::playground_script());
  page("/licences.txt", web::notice());
  server.Get("/api/folder", [this](const Request& request, Response& response) { list(request, response); });
  server.Get("/api/scene", [this](const Request& request, Response& response) { open(request, response); });
  server.Post("/api/save", [this](const Request& request, Response& response, const Reader& body) { save(request, response, body); });
  server.Post("/api/task", [this](const Request&, Response& response, const Reader& body) { start(response, body); });
  server.set_exception_handler([](const Request&, Response& response, std::exception_ptr) {
    refuse(response, 500, "the request could not be answered");
  });
}

void Api::list(const Request& request, Response& response) const {
  json listing = listing_of(folder_);
  if (!keys_.is_owner(request)) listing["may_be_written"] = false;
  // Whoever sees the page by an address of the network shares that one: the machine may have several networks.
  const std::string host = request.get_header_value("Host");
  const std::string address = is_this_machine(without_port(host)) ? shared_ : "http://" + host + "/";
  if (!address.empty()) listing["link"] = address + keys_.guest_query();
  listing["seconds"] = pool_.limits().seconds;
  send_text(response, report::to_line(listing), "application/json");
}

void Api::open(const Request& request, Response& response) const {
  const std::optional<Folder::Netlist> netlist = folder_.read(request.get_param_value("file"));
  if (!netlist) return refuse(response, 404, "there is no such netlist in the folder");
  response.set_header("ETag", '"' + netlist->version + '"');
  send_text(response, netlist->text, "text/plain; charset=utf-8");
}

void Api::save(const Request& asked, Response& response, const Reader& body) {
  if (!keys_.is_owner(asked)) return refuse(response, 403, "this page was opened by a link for others, which saves nothing in the folder: download the netlist");
  const std::optional<json> request = read(response, body);
  if (!request) return;
  if (!request->contains("text") || !(*request)["text"].is_string()) return refuse(response, 400, "there is no text to save");
  if (!request->contains("file") || !(*request)["file"].is_string()) return refuse(response, 400, "there is no name to save it by");
  const Folder::Written written = folder_.write((*request)["file"].get_ref<const std::string&>(),
                                                (*request)["text"].get_ref<const std::string&>(), word(*request, "version"));
  response.status = status_of(written.outcome);
  json answer{{"version", written.version}};
  if (!written.why.empty()) answer["error"] = written.why;
  send_text(response, report::to_line(answer), "application/json");
}

std::shared_ptr<Job> Api::begin(const std::string& session, double turn, std::string task) {
  const std::lock_guard lock(mutex_);
  std::erase_if(sessions_, [](const auto& each) { return each.second.job.expired(); });
  if (!session.empty())
    if (const auto other = sessions_.find(session); other != sessions_.end()) {
      if (other->second.turn > turn) return nullptr;
      if (const std::shared_ptr<Job> job = other->second.job.lock()) job->cancel();
    }
  auto job = std::make_shared<Job>(pool_, std::move(task));
  if (!session.empty()) sessions_[session] = {job, turn};
  return job;
}

void Api::start(Response& response, const Reader& body) {
  const std::optional<json> request = read(response, body);
  if (!request) return;
  const std::optional<json> task = task_of(*request);
  if (!task) return refuse(response, 400, "the request asks for nothing that is known here");
  const json turn = request->value("turn", json());
  const std::shared_ptr<Job> job = begin(word(*request, "session"), turn.is_number() ? turn.get<double>() : 0, report::to_line(*task));
  if (!job) return refuse(response, 409, "a newer task of this session has come before this one");
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
