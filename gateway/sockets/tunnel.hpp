// Tunnel: the server's end of an encrypted connection, by libsodium; the reasons for this protocol
// are in docs/decisions/0022-tunnel.md. Both ends have a key in common. Each connection has fresh
// X25519 keys, so that a key that is lost later opens no recording.
//
//   client   "tactus-1", its X25519 key (32 bytes)
//   server   its X25519 key (32), header of its stream (24)
//   client   header of its stream (24)
//   both     records: length (2, least significant first), so many bytes of ciphertext
//
// The streams are crypto_secretstream_xchacha20poly1305, whose order is part of what they protect:
// a record that is changed, left out, repeated or from another connection does not open. Their keys
// are the first (client to server) and the second half of the BLAKE2b hash of 64 bytes, keyed with
// the common key, of "tactus-1", the X25519 secret, the client's and the server's key. Only who has
// the common key can make a record that opens, which authenticates both ends.
#pragma once

#include <sodium.h>

#include "gateway/server/byte_queues.hpp"
#include "gateway/sockets/key_file.hpp"

namespace tactus {

inline constexpr std::size_t kRecordBytes = 4096;  ///< of plain bytes in a record, at most

class Tunnel {
 public:
  /// Prepares libsodium; false: it cannot be used. [init]
  static bool prepare() { return sodium_init() >= 0; }

  Tunnel() = default;
  Tunnel(const Tunnel&) = delete;
  Tunnel& operator=(const Tunnel&) = delete;
  ~Tunnel() { end(); }

  /// A client has connected.
  void begin(const Key& key);
  /// Forgets the keys of the connection.
  void end();

  /// Where bytes from the network go.
  ByteSpace space() { return {in_.data() + in_size_, in_.size() - in_size_}; }
  void received(std::size_t count) { in_size_ += count; }
  /// Opens the next record if the last one's bytes were all taken. False: the connection must end,
  /// because the other end does not have the key, or data was changed on the way.
  bool open();
  /// Plain bytes that have arrived.
  Bytes plain() const { return {plain_.data() + plain_first_, plain_size_}; }
  void taken(std::size_t count) {
    plain_first_ += count;
    plain_size_ -= count;
  }

  /// Seals plain bytes in a record if nothing waits; returns how many it has taken.
  std::size_t seal(const Bytes& plain);
  /// Bytes for the network.
  Bytes waiting() const { return {out_.data() + out_first_, out_size_}; }
  void sent(std::size_t count) {
    out_first_ += count;
    out_size_ -= count;
  }

 private:
  static constexpr std::size_t kLength = 2;
  static constexpr std::size_t kSealed =
      kRecordBytes + crypto_secretstream_xchacha20poly1305_ABYTES;
  enum class State : std::uint8_t { kHello, kHeader, kOpen, kBroken };

  bool shake_hands();
  bool open_record();
  void drop(std::size_t count);

  State state_ = State::kBroken;
  bool known_ = false;  // a record of the client has opened
  Key key_{};
  crypto_secretstream_xchacha20poly1305_state to_client_{}, from_client_{};
  Key from_client_key_{};
  std::array<std::uint8_t, kLength + kSealed> in_, out_;
  std::array<std::uint8_t, kRecordBytes> plain_;
  std::size_t in_size_ = 0, out_first_ = 0, out_size_ = 0, plain_first_ = 0, plain_size_ = 0;
};

}  // namespace tactus
