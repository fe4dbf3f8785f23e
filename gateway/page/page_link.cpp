#include "gateway/page/page_link.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "gateway/page/limits.hpp"

namespace tactus {

void PageLink::open(int socket, std::int64_t now_ns) {
  close();
  socket_ = socket;
  ping_ns_ = now_ns;
  in_.clear();
  asked_ = tactus_ToServer_init_zero;
  asked_.which_request = tactus_ToServer_hello_tag;
  asked_.request.hello.version = tactus_Version_VERSION_PRESENT;
  set_text(asked_.request.hello.client, "page");
  put();
  asked_ = tactus_ToServer_init_zero;
  asked_.which_request = tactus_ToServer_subscribe_tag;
  asked_.request.subscribe = {kStatePeriod_ms, 0, true};
  put();
  static_cast<void>(flush());
}

void PageLink::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
  out_size_ = 0;
}

/// Appends asked_ with its length, under the next number.
void PageLink::put() {
  asked_.number = ++number_;
  const std::size_t size = encode(
      asked_, {out_.data() + out_size_ + kLengthBytes, out_.size() - out_size_ - kLengthBytes});
  for (std::size_t i = 0; i < kLengthBytes; ++i)
    out_[out_size_ + i] = static_cast<std::uint8_t>(size >> (8 * i));
  out_size_ += kLengthBytes + size;
}

/// These messages are few and short: if the socket has no space for them, the server has died.
bool PageLink::flush() {
  const ssize_t sent = ::send(socket_, out_.data(), out_size_, MSG_NOSIGNAL | MSG_DONTWAIT);
  const bool good = sent == static_cast<ssize_t>(out_size_);
  out_size_ = 0;
  if (!good) close();
  return good;
}

void PageLink::put_lease(tactus_Lease_Wish wish) {
  asked_ = tactus_ToServer_init_zero;
  asked_.which_request = tactus_ToServer_lease_tag;
  asked_.request.lease = {static_cast<std::uint32_t>(wish), 0, 0};
  put();
}

/// Between two Stops with nothing of the page between them, so close that the server may read them
/// in one turn, no message of another client has an order.
bool PageLink::stop_goes_on(std::int64_t now_ns) const {
  return stop_ == number_ && (!stop_answered_ || now_ns - stop_ns_ < kStopPeriod_ns);
}

std::uint32_t PageLink::send(PageCommand command, double rate, std::uint32_t stops,
                             std::int64_t now_ns) {
  if (!there()) return 0;
  const bool is_stop = command == PageCommand::kStop;
  if (is_stop && stop_goes_on(now_ns)) return stop_;
  if (may_need_lease(command)) put_lease(tactus_Lease_Wish_TAKE);
  asked_ = tactus_ToServer_init_zero;
  write_request(command, rate, stops, asked_);
  put();
  const std::uint32_t number = number_;
  if (is_stop) {
    stop_ = number;
    stop_ns_ = now_ns;
    stop_answered_ = false;
  }
  if (may_need_lease(command)) put_lease(tactus_Lease_Wish_RELEASE);
  return flush() ? number : 0;
}

void PageLink::ping(std::int64_t now_ns) {
  if (!there() || now_ns - ping_ns_ < kPing_ns) return;
  ping_ns_ = now_ns;
  asked_ = tactus_ToServer_init_zero;
  asked_.which_request = tactus_ToServer_ping_tag;
  put();
  static_cast<void>(flush());
}

/// Receives once. False: nothing has arrived, or the server has closed the connection.
bool PageLink::receive() {
  if (!there()) return false;
  const ByteSpace to = in_.space();
  const ssize_t size = ::recv(socket_, to.data, to.size, MSG_DONTWAIT);
  if (size > 0) {
    in_.added(static_cast<std::size_t>(size));
    return true;
  }
  if (size == 0 || (errno != EAGAIN && errno != EINTR)) close();
  return false;
}

/// Reads the next message into message_; one that is malformed ends the connection.
bool PageLink::next() {
  Bytes bytes;
  if (!in_.next(bytes)) return false;
  if (!decode(bytes, message_)) {
    close();
    return false;
  }
  if (message_.which_message == tactus_ToClient_answer_tag &&
      message_.message.answer.number == stop_)
    stop_answered_ = true;
  return true;
}

}  // namespace tactus
