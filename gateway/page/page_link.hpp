// PageLink: the page's connection to the server, as that of any client.
#pragma once

#include "gateway/page/page_command.hpp"
#include "gateway/server/codec.hpp"

namespace tactus {

class PageLink {
 public:
  PageLink() = default;
  ~PageLink() { close(); }
  PageLink(const PageLink&) = delete;
  PageLink& operator=(const PageLink&) = delete;

  /// Takes over a connected socket, and sends Hello and Subscribe. [any]
  void open(int socket, std::int64_t now_ns);
  void close();
  bool there() const { return socket_ >= 0; }

  /// Receives what has arrived and calls take(message) for every message; pings. Ends the
  /// connection if the server has. Never waits. [any]
  template <class Take>
  void work(std::int64_t now_ns, const Take& take) {
    ping(now_ns);
    while (receive())
      while (next()) take(message_);
  }

  /// Sends a command; one that may need the lease takes it before, with the lowest priority, and
  /// gives it back behind. A Stop right behind a Stop that was sent a moment ago or has no answer
  /// yet is the same. `stops`: the latest stop that the sender had received. The answer has the
  /// number that is returned; 0: it could not be sent. [any]
  std::uint32_t send(PageCommand command, double rate, std::uint32_t stops, std::int64_t now_ns);

 private:
  bool receive();
  bool next();
  void ping(std::int64_t now_ns);
  void put();
  void put_lease(tactus_Lease_Wish wish);
  bool flush();
  bool stop_goes_on(std::int64_t now_ns) const;

  int socket_ = -1;
  std::uint32_t number_ = 0;  // continues in a later connection
  std::uint32_t stop_ = 0;    // number of the last Stop
  bool stop_answered_ = false;
  std::int64_t stop_ns_ = 0, ping_ns_ = 0;
  InputBytes in_;
  std::array<std::uint8_t, 512> out_{};  // messages that are sent at once
  std::size_t out_size_ = 0;
  tactus_ToServer asked_;
  tactus_ToClient message_;
};

}  // namespace tactus
