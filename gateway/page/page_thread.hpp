// PageThread: a thread without priority that serves the page. It is a client of the server, in this
// program; of the cycle it meets the box of port values alone.
#pragma once

#include <pthread.h>

#include <atomic>

#include "gateway/page/description.hpp"
#include "gateway/page/page_events.hpp"
#include "gateway/page/page_server.hpp"
#include "gateway/sockets/address.hpp"
#include "gateway/sockets/listener.hpp"
#include "gateway/sockets/server_thread.hpp"

namespace tactus {

/// Reads "127.0.0.1:PORT". False: `why` names what is wrong with it; an address that other
/// computers reach is refused. [init]
bool parse_page_address(std::string_view text, Address& address, Message& why);

class PageThread {
 public:
  PageThread(const PageSubject& subject, ServerThread& server, PortMailbox& ports)
      : subject_(subject), server_(server), ports_(ports) {}
  ~PageThread() { end(); }
  PageThread(const PageThread&) = delete;
  PageThread& operator=(const PageThread&) = delete;

  /// Listens, and starts the thread. Call it before the calling thread is bound to a CPU. False:
  /// `why` names what the computer lacks. [init]
  bool start(const Address& address, Message& why);
  /// Ends the thread and closes the connections. [any]
  void end();
  /// The port at which it listens.
  int port() const { return port_; }
  bool started() const { return started_; }

 private:
  static void* run(void* thread);
  void work();
  void connect();
  void tell_news();
  bool prepare(Message& why);

  PageSubject subject_;
  ServerThread& server_;
  PortMailbox& ports_;
  EventRing events_;
  PageLink link_;
  PageServer page_{link_, events_};
  PortValues values_;
  std::array<char, kDescriptionBytes> description_bytes_;
  std::string_view description_;
  Text<32> token_;
  std::int64_t begin_ns_ = 0, tried_ns_ = 0;
  int port_ = 0;
  std::atomic<bool> ended_{false};
  pthread_t thread_{};
  bool started_ = false;
};

}  // namespace tactus
