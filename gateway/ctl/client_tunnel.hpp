// ClientTunnel: the client's end of an encrypted connection; gateway/sockets/tunnel.hpp has the
// protocol.
#pragma once

#include <sodium.h>

#include <string>

#include "gateway/sockets/key_file.hpp"

namespace tactus::ctl {

class ClientTunnel {
 public:
  static constexpr std::size_t kHelloBytes = 8 + crypto_scalarmult_BYTES;
  static constexpr std::size_t kAnswerBytes =
      crypto_scalarmult_BYTES + crypto_secretstream_xchacha20poly1305_HEADERBYTES;

  ClientTunnel() = default;
  ClientTunnel(const ClientTunnel&) = delete;
  ClientTunnel& operator=(const ClientTunnel&) = delete;
  ~ClientTunnel();

  /// Returns the first bytes for the server; empty: libsodium cannot be used.
  std::string hello();
  /// Takes the server's answer and returns the bytes that follow; empty: it is none.
  std::string agree(const Key& key, const std::string& answer);
  /// Returns the records with these plain bytes.
  std::string seal(const std::string& plain);
  /// Takes whole records off `sealed` and appends what they contain. False: one does not open.
  bool open(std::string& sealed, std::string& plain);

 private:
  std::array<std::uint8_t, crypto_scalarmult_SCALARBYTES> own_{};
  std::array<std::uint8_t, crypto_scalarmult_BYTES> public_{};
  crypto_secretstream_xchacha20poly1305_state to_server_{}, from_server_{};
};

}  // namespace tactus::ctl
