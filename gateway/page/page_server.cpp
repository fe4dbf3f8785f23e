#include "gateway/page/page_server.hpp"

#include <cstring>

#include "gateway/page/json.hpp"
#include "gateway/page/page_files.hpp"
#include "hal/os/cycle_clock.hpp"

namespace tactus {
namespace {

constexpr const char* kPlain = "text/plain; charset=utf-8";
constexpr const char* kJson = "application/json";

struct Header {
  const char *name, *value;
};
// Only files of the page itself are loaded and run; no other page may show it in a frame, in which
// its buttons could be pressed unseen.
constexpr Header kHeaders[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Frame-Options", "DENY"},
    {"X-Content-Type-Options", "nosniff"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Referrer-Policy", "no-referrer"},
    {"Cache-Control", "no-store"},
};

std::string_view view(const char* text) {
  return text != nullptr ? std::string_view(text) : std::string_view("");
}

/// No path of ours has an escape; "%00" would cut it.
std::size_t leave_escaped(void*, MHD_Connection*, char* text) {
  return std::strlen(text);
}

}  // namespace

bool PageServer::start(int socket, std::string_view description, std::string_view token,
                       Message& why) {
  description_ = description;
  token_ = token;
  if (!http_.load(why)) return false;
  daemon_ = http_.start_daemon(
      MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, 0, nullptr, nullptr, handle, this,
      MHD_OPTION_LISTEN_SOCKET, socket, MHD_OPTION_CONNECTION_LIMIT,
      static_cast<unsigned>(kMostPageConnections), MHD_OPTION_CONNECTION_MEMORY_LIMIT,
      kConnectionBytes, MHD_OPTION_CONNECTION_TIMEOUT, kConnectionWait_s,
      MHD_OPTION_NOTIFY_COMPLETED, completed, this, MHD_OPTION_NOTIFY_CONNECTION,
      accepted_or_closed, this, MHD_OPTION_UNESCAPE_CALLBACK, leave_escaped, nullptr,
      MHD_OPTION_END);
  if (daemon_ == nullptr) why << "libmicrohttpd did not start";
  return daemon_ != nullptr;
}

void PageServer::run(int wait_ms) {
  for (Browser& browser : browsers_) {
    if (!browser.suspended || (browser.at == events_.end() && !ending_)) continue;
    browser.suspended = false;
    http_.resume(browser.connection);
  }
  open_.end_late(monotonic_ns());
  http_.run_wait(daemon_, wait_ms);
}

void PageServer::stop() {
  if (daemon_ == nullptr) return;
  ending_ = true;
  run(0);
  http_.stop_daemon(daemon_);
  daemon_ = nullptr;
}

int PageServer::browsers() const {
  int count = 0;
  for (const Browser& browser : browsers_) count += browser.connection != nullptr ? 1 : 0;
  return count;
}

/// Is called for the head of a request, for each piece of its body, and behind its end.
MHD_Result PageServer::handle(void* server, MHD_Connection* connection, const char* path,
                              const char* method, const char*, const char* upload,
                              std::size_t* upload_size, void** context) {
  PageServer& its = *static_cast<PageServer*>(server);
  if (*context != nullptr) {
    Command& command = *static_cast<Command*>(*context);
    if (*upload_size > 0) return its.take_body(command, upload, *upload_size);
    return its.execute(connection, command);
  }
  RequestHead head = {method, path};
  its.http_.for_each_header(connection, MHD_HEADER_KIND, take_one_header, &head);
  if (head.token.empty() && head.path == "/events")  // EventSource sends no headers
    head.token = view(its.http_.value(connection, MHD_GET_ARGUMENT_KIND, "token"));
  return its.begin(connection, head, context);
}

MHD_Result PageServer::take_one_header(void* head, MHD_ValueKind, const char* name,
                                       const char* value) {
  take_header(view(name), view(value), *static_cast<RequestHead*>(head));
  return MHD_YES;
}

MHD_Result PageServer::begin(MHD_Connection* connection, const RequestHead& head, void** context) {
  const RequestVerdict verdict = judge_request(head, token_);
  switch (verdict.path) {
    case PagePath::kNone: return send_text(connection, verdict.status, verdict.text, kPlain);
    case PagePath::kDescription: return send_text(connection, 200, description_, kJson);
    case PagePath::kEvents: return send_events(connection);
    case PagePath::kFile: {
      const PageFile& file = *page_file(head.path);
      return send_text(connection, 200, file.bytes, file.type);
    }
    case PagePath::kCommand: break;
  }
  for (Command& command : commands_) {
    if (command.used) continue;
    command = {true, {}, read_seen(head.seen)};
    static_cast<void>(command_of(head.path, command.what));
    *context = &command;
    return MHD_YES;
  }
  return MHD_NO;  // there are as many as connections
}

/// No answer may be sent before the end of the body. A body that is too long is counted and refused
/// at its end; one that is far too long ends the connection.
MHD_Result PageServer::take_body(Command& command, const char* upload, std::size_t& size) {
  if (command.size + size > kConnectionBytes) return MHD_NO;
  for (std::size_t i = 0; i < size; ++i)
    if (command.size + i < command.body.size()) command.body[command.size + i] = upload[i];
  command.size += size;
  size = 0;
  return MHD_YES;
}

MHD_Result PageServer::execute(MHD_Connection* connection, const Command& command) {
  if (command.size > command.body.size())
    return send_text(connection, 413, "the body is longer than 64 bytes", kPlain);
  double rate = 0.0;
  if (!read_body(command.what, {command.body.data(), command.size}, rate))
    return send_text(connection, 400, "a body has only /override: a number from 0 to 1", kPlain);
  const std::int64_t now_ns = monotonic_ns();
  const CommandVerdict verdict =
      gate_.judge(command.what, command.seen.sent_ms, now_ns / kMillisecond_ns);
  if (verdict.status != 200) return send_text(connection, verdict.status, verdict.text, kPlain);
  const std::uint32_t number = link_.send(command.what, rate, command.seen.stops, now_ns);
  if (number == 0)
    return send_text(connection, 503, "the server has no place for the page", kPlain);
  char bytes[64];
  Json json(bytes, sizeof bytes);
  json.open('{').integer(number, "number").close('}');
  return send_text(connection, 202, json.text(), kJson);
}

int PageServer::socket_of(MHD_Connection* connection) const {
  const MHD_ConnectionInfo* const info = http_.info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
  return info != nullptr ? info->connect_fd : -1;
}

void PageServer::accepted_or_closed(void* server, MHD_Connection* connection, void**,
                                    MHD_ConnectionNotificationCode what) {
  PageServer& its = *static_cast<PageServer*>(server);
  const int socket = its.socket_of(connection);
  if (socket < 0) return;
  if (what == MHD_CONNECTION_NOTIFY_STARTED)
    its.open_.add(socket, monotonic_ns());
  else
    its.open_.remove(socket);
}

void PageServer::completed(void*, MHD_Connection*, void** context, MHD_RequestTerminationCode) {
  if (*context != nullptr) *static_cast<Command*>(*context) = {};
  *context = nullptr;
}

MHD_Result PageServer::send_text(MHD_Connection* connection, int status, std::string_view text,
                                 const char* type) {
  const bool lasts = status == 200;  // files and the description
  // The library does not change the bytes, in spite of the non-const type.
  return queue(connection, status,
               http_.response_from_buffer(text.size(), const_cast<char*>(text.data()),
                                          lasts ? MHD_RESPMEM_PERSISTENT : MHD_RESPMEM_MUST_COPY),
               type);
}

MHD_Result PageServer::send_events(MHD_Connection* connection) {
  for (Browser& browser : browsers_) {
    if (browser.connection != nullptr) continue;
    browser = {this, connection, events_.end()};
    open_.keep(socket_of(connection));
    return queue(
        connection, 200,
        http_.response_from_callback(MHD_SIZE_UNKNOWN, 4096, read_news, &browser, free_browser),
        "text/event-stream");
  }
  return send_text(connection, 503, "eight browsers watch already; close one", kPlain);
}

/// Connections are not kept for a next request: they are few.
MHD_Result PageServer::queue(MHD_Connection* connection, int status, MHD_Response* response,
                             const char* type) {
  if (response == nullptr) return MHD_NO;
  for (const auto& [name, value] : kHeaders) http_.add_header(response, name, value);
  http_.add_header(response, "Content-Type", type);
  http_.add_header(response, "Connection", "close");
  if (status == 405) http_.add_header(response, "Allow", "GET, POST");
  const MHD_Result queued =
      http_.queue_response(connection, static_cast<unsigned>(status), response);
  http_.destroy_response(response);
  return queued;
}

/// The stream of a browser that has lost events, being too slow, ends; the browser reconnects.
ssize_t PageServer::read_news(void* browser, std::uint64_t, char* to, std::size_t size) {
  Browser& its = *static_cast<Browser*>(browser);
  const EventRing& events = its.server->events_;
  if (its.server->ending_ || !events.holds(its.at)) return MHD_CONTENT_READER_END_OF_STREAM;
  const std::size_t count = events.read(its.at, to, size);
  its.at += count;
  if (count > 0) return static_cast<ssize_t>(count);
  its.suspended = true;
  its.server->http_.suspend(its.connection);
  return 0;
}

void PageServer::free_browser(void* browser) {
  *static_cast<Browser*>(browser) = {};
}

}  // namespace tactus
