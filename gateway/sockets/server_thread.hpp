// ServerThread: a thread without priority that carries bytes between the sockets of clients and a
// Server, beside the cycles.
#pragma once

#include <pthread.h>

#include <atomic>

#include "gateway/server/server.hpp"
#include "gateway/sockets/listener.hpp"

namespace tactus {

class ServerThread {
 public:
  ServerThread(Server& server, Listener& listener) : server_(server), listener_(listener) {}
  ~ServerThread() { end(); }
  ServerThread(const ServerThread&) = delete;
  ServerThread& operator=(const ServerThread&) = delete;

  /// Starts the thread. Call it before the calling thread is bound to a CPU. Returns 0 or an errno.
  /// [init]
  int start();
  /// Ends the thread and closes the connections. [any]
  void end();

 private:
  static void* run(void* thread);
  void work();
  void turn(int timeout_ms);
  void welcome();
  void take_datagrams();
  void receive(int slot);
  void send(int slot);
  void close(int slot);

  Server& server_;
  Listener& listener_;
  std::array<int, kMostClients> sockets_;  // of the slots of the server; -1: none
  std::array<std::uint8_t, kLongestMessage> datagram_;
  std::atomic<bool> ended_{false};
  pthread_t thread_{};
  bool started_ = false;
};

}  // namespace tactus
