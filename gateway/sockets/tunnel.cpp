#include "gateway/sockets/tunnel.hpp"

#include <algorithm>

namespace tactus {
namespace {

constexpr std::string_view kProtocol = "tactus-1";
constexpr std::size_t kPublic = crypto_scalarmult_BYTES;
constexpr std::size_t kHeader = crypto_secretstream_xchacha20poly1305_HEADERBYTES;

/// The keys of both directions, derived from the secret of the two ends.
struct Keys {
  std::array<std::uint8_t, 64> both;

  Keys(const Key& key, const std::uint8_t* secret, const std::uint8_t* client,
       const std::uint8_t* server) {
    crypto_generichash_state state;
    crypto_generichash_init(&state, key.data(), key.size(), both.size());
    crypto_generichash_update(&state, reinterpret_cast<const std::uint8_t*>(kProtocol.data()),
                              kProtocol.size());
    for (const std::uint8_t* part : {secret, client, server})
      crypto_generichash_update(&state, part, kPublic);
    crypto_generichash_final(&state, both.data(), both.size());
    sodium_memzero(&state, sizeof state);
  }
  ~Keys() { sodium_memzero(both.data(), both.size()); }
  const std::uint8_t* from_client() const { return both.data(); }
  const std::uint8_t* to_client() const { return both.data() + both.size() / 2; }
};

}  // namespace

void Tunnel::begin(const Key& key) {
  end();
  key_ = key;
  state_ = State::kHello;
}

void Tunnel::end() {
  sodium_memzero(key_.data(), key_.size());
  sodium_memzero(from_client_key_.data(), from_client_key_.size());
  sodium_memzero(&to_client_, sizeof to_client_);
  sodium_memzero(&from_client_, sizeof from_client_);
  sodium_memzero(plain_.data(), plain_.size());
  in_size_ = out_first_ = out_size_ = plain_first_ = plain_size_ = 0;
  known_ = false;
  state_ = State::kBroken;
}

void Tunnel::drop(std::size_t count) {
  in_size_ -= count;
  std::memmove(in_.data(), in_.data() + count, in_size_);
}

bool Tunnel::open() {
  if (state_ == State::kHello && in_size_ >= kProtocol.size() + kPublic && !shake_hands())
    state_ = State::kBroken;
  if (state_ == State::kHeader && in_size_ >= kHeader) {
    crypto_secretstream_xchacha20poly1305_init_pull(&from_client_, in_.data(),
                                                    from_client_key_.data());
    drop(kHeader);
    state_ = State::kOpen;
  }
  if (state_ == State::kOpen && plain_size_ == 0 && !open_record()) state_ = State::kBroken;
  return state_ != State::kBroken;
}

/// Answers the client's key with one of its own.
bool Tunnel::shake_hands() {
  const std::uint8_t* const client = in_.data() + kProtocol.size();
  std::array<std::uint8_t, crypto_scalarmult_SCALARBYTES> own;
  std::array<std::uint8_t, kPublic> secret;
  randombytes_buf(own.data(), own.size());
  const bool good = std::equal(kProtocol.begin(), kProtocol.end(), in_.begin()) &&
                    crypto_scalarmult_base(out_.data(), own.data()) == 0 &&
                    crypto_scalarmult(secret.data(), own.data(), client) == 0;
  if (good) {
    const Keys keys(key_, secret.data(), client, out_.data());
    std::copy_n(keys.from_client(), from_client_key_.size(), from_client_key_.data());
    crypto_secretstream_xchacha20poly1305_init_push(&to_client_, out_.data() + kPublic,
                                                    keys.to_client());
    out_first_ = 0;
    out_size_ = kPublic + kHeader;
    drop(kProtocol.size() + kPublic);
    state_ = State::kHeader;
  }
  sodium_memzero(own.data(), own.size());
  sodium_memzero(secret.data(), secret.size());
  return good;
}

/// False: a record does not open.
bool Tunnel::open_record() {
  if (in_size_ < kLength) return true;
  const std::size_t sealed = in_[0] | static_cast<std::size_t>(in_[1]) << 8;
  if (sealed < crypto_secretstream_xchacha20poly1305_ABYTES || sealed > kSealed) return false;
  if (in_size_ < kLength + sealed) return true;
  unsigned long long size = 0;
  unsigned char tag = 0;
  if (crypto_secretstream_xchacha20poly1305_pull(&from_client_, plain_.data(), &size, &tag,
                                                 in_.data() + kLength, sealed, nullptr, 0) != 0)
    return false;
  drop(kLength + sealed);
  plain_first_ = 0;
  plain_size_ = static_cast<std::size_t>(size);
  known_ = true;
  return true;
}

/// Sends nothing to a client before it has proved that it has the key.
std::size_t Tunnel::seal(const Bytes& plain) {
  if (state_ != State::kOpen || !known_ || out_size_ > 0 || plain.size == 0) return 0;
  const std::size_t count = std::min(plain.size, kRecordBytes);
  unsigned long long sealed = 0;
  crypto_secretstream_xchacha20poly1305_push(&to_client_, out_.data() + kLength, &sealed,
                                             plain.data, count, nullptr, 0, 0);
  out_[0] = static_cast<std::uint8_t>(sealed);
  out_[1] = static_cast<std::uint8_t>(sealed >> 8);
  out_first_ = 0;
  out_size_ = kLength + static_cast<std::size_t>(sealed);
  return count;
}

}  // namespace tactus
