// ServerThread: a thread without priority that carries bytes between the sockets of clients and a
// Server, beside the cycles.
#pragma once

#include <pthread.h>

#include <atomic>

#include "gateway/server/server.hpp"
#include "gateway/sockets/listener.hpp"
#include "gateway/sockets/tunnel.hpp"

namespace tactus {

class ServerThread {
 public:
  /// With a key all connections are encrypted; null: none.
  ServerThread(Server& server, Listener& listener, const Key* key)
      : server_(server), listener_(listener), key_(key) {}
  ~ServerThread() { end(); }
  ServerThread(const ServerThread&) = delete;
  ServerThread& operator=(const ServerThread&) = delete;

  /// Starts the thread. Call it before the calling thread is bound to a CPU. Returns 0 or an errno.
  /// [init]
  int start();
  /// Ends the thread and closes the connections. [any]
  void end();
  /// Takes over the socket of a client in this program, which needs no key. Closes it if there is
  /// no place for one more client. False, without effect: another one is being taken over. [any]
  bool join(int socket);

 private:
  static void* run(void* thread);
  void work();
  void turn(int timeout_ms);
  void welcome(int socket, bool inside);
  void refuse_connection(int socket);
  void take_datagrams();
  void receive(int slot);
  bool take_plain(int slot);
  void send(int slot);
  ByteSpace space(int slot);
  Bytes waiting(int slot);
  void sent(int slot, std::size_t count);
  void close(int slot);
  Tunnel& tunnel(int slot) { return tunnels_[static_cast<std::size_t>(slot)]; }
  bool keyed(int slot) const { return key_ != nullptr && !inside_[static_cast<std::size_t>(slot)]; }

  Server& server_;
  Listener& listener_;
  const Key* key_;
  std::array<Tunnel, kMostClients> tunnels_;
  std::array<int, kMostClients> sockets_;    // of the slots of the server; -1: none
  std::array<bool, kMostClients> inside_{};  // clients in this program
  std::array<std::uint8_t, kLongestMessage> datagram_;
  std::atomic<int> joining_{-1};
  std::atomic<bool> ended_{false};
  pthread_t thread_{};
  bool started_ = false;
};

}  // namespace tactus
