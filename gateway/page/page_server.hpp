// PageServer: the page over HTTP, by libmicrohttpd, to a fixed number of browsers. Everything runs
// in the thread that calls run().
//
//   GET /, /page.css, /*.js    the page         GET /robot.json  robot, pipeline and token
//   GET /events?token=...      server-sent events: the EventRing
//   POST /stop, /override ...  commands, with the headers X-Tactus-Token and X-Tactus-Seen
#pragma once

#include <array>

#include "gateway/page/command_gate.hpp"
#include "gateway/page/event_ring.hpp"
#include "gateway/page/http_library.hpp"
#include "gateway/page/open_connections.hpp"
#include "gateway/page/page_link.hpp"
#include "gateway/page/request_check.hpp"

namespace tactus {

class PageServer {
 public:
  PageServer(PageLink& link, const EventRing& events) : link_(link), events_(events) {}
  ~PageServer() { stop(); }
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// Serves at a socket that listens, which it takes over. Both texts outlive it. False: `why` says
  /// what is missing. [init]
  bool start(int socket, std::string_view description, std::string_view token, Message& why);
  /// Does what there is to do; waits for it up to `wait_ms`. [any, one thread]
  void run(int wait_ms);
  /// Closes all connections. [any]
  void stop();
  /// Number of browsers that are receiving events.
  int browsers() const;

 private:
  struct Browser {
    PageServer* server = nullptr;
    MHD_Connection* connection = nullptr;  // null: free
    std::uint64_t at = 0;                  // position in the event ring
    bool suspended = false;                // until there are more
  };
  struct Command {  // a POST whose body is coming
    bool used = false;
    PageCommand what = PageCommand::kStop;
    SeenState seen;
    std::size_t size = 0;
    std::array<char, kLongestBody> body{};
  };

  static MHD_Result handle(void* server, MHD_Connection* connection, const char* path,
                           const char* method, const char* version, const char* upload,
                           std::size_t* upload_size, void** context);
  static void completed(void* server, MHD_Connection* connection, void** context,
                        MHD_RequestTerminationCode how);
  static void accepted_or_closed(void* server, MHD_Connection* connection, void** context,
                                 MHD_ConnectionNotificationCode what);
  static MHD_Result take_one_header(void* head, MHD_ValueKind kind, const char* name,
                                    const char* value);
  static ssize_t read_news(void* browser, std::uint64_t position, char* to, std::size_t size);
  static void free_browser(void* browser);

  int socket_of(MHD_Connection* connection) const;
  MHD_Result begin(MHD_Connection* connection, const RequestHead& head, void** context);
  MHD_Result take_body(Command& command, const char* upload, std::size_t& size);
  MHD_Result execute(MHD_Connection* connection, const Command& command);
  MHD_Result send_text(MHD_Connection* connection, int status, std::string_view text,
                       const char* type);
  MHD_Result send_events(MHD_Connection* connection);
  MHD_Result queue(MHD_Connection* connection, int status, MHD_Response* response,
                   const char* type);

  PageLink& link_;
  const EventRing& events_;
  HttpLibrary http_;
  MHD_Daemon* daemon_ = nullptr;
  std::string_view description_, token_;
  CommandGate gate_;
  OpenConnections open_;
  std::array<Browser, kMostBrowsers> browsers_{};
  std::array<Command, kMostPageConnections> commands_{};
  bool ending_ = false;
};

}  // namespace tactus
