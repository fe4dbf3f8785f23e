#include "gateway/ctl/client_tunnel.hpp"

#include <algorithm>
#include <string_view>

namespace tactus::ctl {
namespace {

constexpr std::string_view kProtocol = "tactus-1";
constexpr std::size_t kRecord = 4096;  // plain bytes of a record, at most
constexpr std::size_t kTag = crypto_secretstream_xchacha20poly1305_ABYTES;
constexpr std::size_t kHeader = crypto_secretstream_xchacha20poly1305_HEADERBYTES;

const std::uint8_t* bytes_of(std::string_view text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}

std::uint8_t* bytes_of(std::string& text) {
  return reinterpret_cast<std::uint8_t*>(text.data());
}

}  // namespace

ClientTunnel::~ClientTunnel() {
  sodium_memzero(own_.data(), own_.size());
  sodium_memzero(&to_server_, sizeof to_server_);
  sodium_memzero(&from_server_, sizeof from_server_);
}

std::string ClientTunnel::hello() {
  if (sodium_init() < 0) return {};
  randombytes_buf(own_.data(), own_.size());
  if (crypto_scalarmult_base(public_.data(), own_.data()) != 0) return {};
  return std::string(kProtocol) +
         std::string(reinterpret_cast<const char*>(public_.data()), public_.size());
}

std::string ClientTunnel::agree(const Key& key, const std::string& answer) {
  std::array<std::uint8_t, crypto_scalarmult_BYTES> secret;
  const std::uint8_t* const server = bytes_of(std::string_view(answer));
  if (answer.size() != kAnswerBytes || crypto_scalarmult(secret.data(), own_.data(), server) != 0)
    return {};
  std::array<std::uint8_t, 64> keys;
  crypto_generichash_state state;
  crypto_generichash_init(&state, key.data(), key.size(), keys.size());
  crypto_generichash_update(&state, bytes_of(kProtocol), kProtocol.size());
  for (const std::uint8_t* part : {static_cast<const std::uint8_t*>(secret.data()),
                                   static_cast<const std::uint8_t*>(public_.data()), server})
    crypto_generichash_update(&state, part, crypto_scalarmult_BYTES);
  crypto_generichash_final(&state, keys.data(), keys.size());
  std::string header(kHeader, '\0');
  crypto_secretstream_xchacha20poly1305_init_push(&to_server_, bytes_of(header), keys.data());
  crypto_secretstream_xchacha20poly1305_init_pull(&from_server_, server + crypto_scalarmult_BYTES,
                                                  keys.data() + keys.size() / 2);
  sodium_memzero(&state, sizeof state);
  sodium_memzero(keys.data(), keys.size());
  sodium_memzero(secret.data(), secret.size());
  return header;
}

std::string ClientTunnel::seal(const std::string& plain) {
  std::string records;
  for (std::size_t at = 0; at < plain.size(); at += kRecord) {
    const std::size_t count = std::min(kRecord, plain.size() - at), sealed = count + kTag;
    std::string record(2 + sealed, '\0');
    record[0] = static_cast<char>(sealed & 0xff);
    record[1] = static_cast<char>(sealed >> 8);
    crypto_secretstream_xchacha20poly1305_push(&to_server_, bytes_of(record) + 2, nullptr,
                                               bytes_of(std::string_view(plain)) + at, count,
                                               nullptr, 0, 0);
    records += record;
  }
  return records;
}

bool ClientTunnel::open(std::string& sealed, std::string& plain) {
  while (sealed.size() >= 2) {
    const std::uint8_t* const bytes = bytes_of(std::string_view(sealed));
    const std::size_t size = bytes[0] | static_cast<std::size_t>(bytes[1]) << 8;
    if (size < kTag || size > kRecord + kTag) return false;
    if (sealed.size() < 2 + size) return true;
    std::string record(size - kTag, '\0');
    if (crypto_secretstream_xchacha20poly1305_pull(&from_server_, bytes_of(record), nullptr,
                                                   nullptr, bytes + 2, size, nullptr, 0) != 0)
      return false;
    plain += record;
    sealed.erase(0, 2 + size);
  }
  return true;
}

}  // namespace tactus::ctl
