// Links: the sockets that scripts open to the control computer. The emulator lists those it wants;
// the owner of the network connects them and passes bytes.
#pragma once

#include <array>
#include <string_view>

#include "hal/ur/protocol.hpp"
#include "kernel/core/text.hpp"
#include "sim_plant/ur/wire/outbox.hpp"

namespace tactus::ur {

class Link {
 public:
  enum class State : std::uint8_t { kClosed, kWanted, kConnecting, kOpen, kFailed };

  State state() const { return state_; }
  bool open() const { return state_ == State::kOpen; }

  // ---- the script's side ----
  void want(std::string_view name, std::string_view host, int port);
  void close() { state_ = State::kClosed; }
  std::string_view name() const { return name_; }
  /// Reads `count` big-endian integers. False: fewer have come.
  bool read_ints(std::int32_t* values, std::size_t count);
  /// All bytes that have come.
  std::string_view received() const {
    return {reinterpret_cast<const char*>(in_.data()), in_size_};
  }
  void send_int(std::int32_t value);
  void send_text(std::string_view text) { out_.put(text); }

  // ---- the network's side ----
  const char* host() const { return host_.c_str(); }
  int port() const { return port_; }
  void connecting() { state_ = State::kConnecting; }
  void connected() { state_ = State::kOpen; }
  void failed() { state_ = State::kFailed; }
  void lost() { lost_ = true; }
  /// Free bytes of the input buffer.
  std::size_t room() const { return in_.size() - in_size_; }
  void receive(const std::uint8_t* data, std::size_t size);
  Outbox& outbox() { return out_; }
  /// True if the peer has closed and fewer than `ints` integers are left to read.
  bool at_end(std::size_t ints) const { return lost_ && in_size_ < 4 * ints; }

 private:
  State state_ = State::kClosed;
  bool lost_ = false;
  Text<63> name_, host_;
  int port_ = 0;
  std::array<std::uint8_t, 96 * 1024> in_;
  std::size_t in_size_ = 0;
  Outbox out_;
};

class Links {
 public:
  static constexpr std::size_t kCount = 6;

  /// Returns the link of this name, or else a closed one; null: all are in use.
  Link* find(std::string_view name);
  void close_all() {
    for (Link& link : links_) link.close();
  }
  std::array<Link, kCount>& all() { return links_; }

 private:
  std::array<Link, kCount> links_;
};

}  // namespace tactus::ur
