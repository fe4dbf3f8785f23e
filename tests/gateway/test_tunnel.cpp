// Tests the encrypted connection against a client's end that is written here, and the key file.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "gateway/sockets/tunnel.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// The client's end, as the comment of tunnel.hpp describes it.
struct Client {
  Key key{};
  std::array<std::uint8_t, 32> own{}, open{};
  crypto_secretstream_xchacha20poly1305_state to{}, from{};
  std::array<std::uint8_t, 5000> bytes{};
  std::array<std::uint8_t, 40> greeting{};

  explicit Client(const Key& its) : key(its) {
    randombytes_buf(own.data(), own.size());
    crypto_scalarmult_base(open.data(), own.data());
    std::memcpy(greeting.data(), "tactus-1", 8);
    std::memcpy(greeting.data() + 8, open.data(), 32);
  }
  /// Takes the server's answer, 56 bytes; returns the header that the server then needs.
  std::array<std::uint8_t, 24> answer(const std::uint8_t* server) {
    std::array<std::uint8_t, 104> known{};
    std::memcpy(known.data(), greeting.data(), 8);
    assert_int_equal(crypto_scalarmult(known.data() + 8, own.data(), server), 0);
    std::memcpy(known.data() + 40, open.data(), 32);
    std::memcpy(known.data() + 72, server, 32);
    std::array<std::uint8_t, 64> keys{};
    crypto_generichash(keys.data(), 64, known.data(), known.size(), key.data(), key.size());
    std::array<std::uint8_t, 24> header{};
    crypto_secretstream_xchacha20poly1305_init_push(&to, header.data(), keys.data());
    crypto_secretstream_xchacha20poly1305_init_pull(&from, server + 32, keys.data() + 32);
    return header;
  }
  Bytes seal(std::string_view text) {
    unsigned long long size = 0;
    crypto_secretstream_xchacha20poly1305_push(&to, bytes.data() + 2, &size,
                                               reinterpret_cast<const std::uint8_t*>(text.data()),
                                               text.size(), nullptr, 0, 0);
    bytes[0] = static_cast<std::uint8_t>(size);
    bytes[1] = static_cast<std::uint8_t>(size >> 8);
    return {bytes.data(), static_cast<std::size_t>(size) + 2};
  }
};

/// Gives bytes to the tunnel; false: it is broken.
bool push(Tunnel& tunnel, const std::uint8_t* data, std::size_t size) {
  while (size > 0) {
    const ByteSpace space = tunnel.space();
    const std::size_t count = std::min(space.size, size);
    if (count == 0) return false;
    std::memcpy(space.data, data, count);
    tunnel.received(count);
    data += count;
    size -= count;
    if (!tunnel.open()) return false;
  }
  return true;
}

Key key_of(std::uint8_t byte) {
  Key key;
  key.fill(byte);
  return key;
}

/// A tunnel and a client that have shaken hands.
struct Pair {
  Tunnel tunnel;
  Client client;
  bool good = false;

  Pair(const Key& servers, const Key& clients) : client(clients) {
    tunnel.begin(servers);
    good = push(tunnel, client.greeting.data(), client.greeting.size());
    if (!good) return;
    assert_int_equal(tunnel.waiting().size, 56);
    const auto header = client.answer(tunnel.waiting().data);
    tunnel.sent(56);
    good = push(tunnel, header.data(), header.size());
  }
};

std::string_view text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data), bytes.size};
}

// Proves GW-11.

void both_ends_with_the_key_understand_each_other(void**) {
  Pair pair(key_of(7), key_of(7));
  assert_true(pair.good);
  for (const char* text : {"hello", "and more"}) {
    const Bytes sealed = pair.client.seal(text);
    assert_true(text_of(sealed).find(text) == std::string_view::npos);
    assert_true(push(pair.tunnel, sealed.data, sealed.size));
    assert_true(text_of(pair.tunnel.plain()) == text);
    pair.tunnel.taken(pair.tunnel.plain().size);
    const std::string_view reply = "welcome";
    const Bytes plain = {reinterpret_cast<const std::uint8_t*>(reply.data()), reply.size()};
    assert_int_equal(pair.tunnel.seal(plain), reply.size());
    const Bytes record = pair.tunnel.waiting();
    assert_true(text_of(record).find(reply) == std::string_view::npos);
    std::array<std::uint8_t, 64> opened{};
    unsigned long long size = 0;
    assert_int_equal(
        crypto_secretstream_xchacha20poly1305_pull(&pair.client.from, opened.data(), &size, nullptr,
                                                   record.data + 2, record.size - 2, nullptr, 0),
        0);
    assert_true(text_of({opened.data(), static_cast<std::size_t>(size)}) == reply);
    pair.tunnel.sent(record.size);
  }
}

void nobody_without_the_key_is_heard_or_told_anything(void**) {
  Pair pair(key_of(7), key_of(8));
  assert_true(pair.good);  // nothing shows yet
  const std::string_view secret = "a state";
  const Bytes plain = {reinterpret_cast<const std::uint8_t*>(secret.data()), secret.size()};
  assert_int_equal(pair.tunnel.seal(plain), 0);
  const Bytes sealed = pair.client.seal("hello");
  assert_false(push(pair.tunnel, sealed.data, sealed.size));
  assert_int_equal(pair.tunnel.plain().size, 0);
  assert_int_equal(pair.tunnel.seal(plain), 0);
  assert_false(pair.tunnel.open());
}

void a_record_that_is_changed_repeated_or_left_out_ends_the_connection(void**) {
  Random random{9};
  for (int trial = 0; trial < 200; ++trial) {
    Pair pair(key_of(7), key_of(7));
    Bytes sealed = pair.client.seal("the first message");
    std::array<std::uint8_t, 64> first{};
    std::memcpy(first.data(), sealed.data, sealed.size);
    const std::size_t size = sealed.size;
    if (trial % 3 == 0) {  // changed
      first[2 + static_cast<std::size_t>(random.below(static_cast<int>(size) - 2))] ^=
          static_cast<std::uint8_t>(1 << random.below(8));
      assert_false(push(pair.tunnel, first.data(), size));
      continue;
    }
    if (trial % 3 == 1) {  // repeated
      assert_true(push(pair.tunnel, first.data(), size));
      pair.tunnel.taken(pair.tunnel.plain().size);
      assert_false(push(pair.tunnel, first.data(), size));
      continue;
    }
    sealed = pair.client.seal("the second, without the first");
    assert_false(push(pair.tunnel, sealed.data, sealed.size));
  }
}

void a_recorded_connection_is_refused_when_it_is_played_again(void**) {
  Pair pair(key_of(7), key_of(7));
  const Bytes sealed = pair.client.seal("move");
  std::array<std::uint8_t, 64> recorded{};
  std::memcpy(recorded.data(), sealed.data, sealed.size);
  assert_true(push(pair.tunnel, recorded.data(), sealed.size));
  Tunnel again;
  again.begin(key_of(7));
  assert_true(push(again, pair.client.greeting.data(), 40));
  again.sent(again.waiting().size);
  std::array<std::uint8_t, 24> header{};
  assert_true(push(again, header.data(), header.size()));
  assert_false(push(again, recorded.data(), sealed.size));
}

void greetings_that_are_none_end_the_connection(void**) {
  std::array<std::uint8_t, 40> greeting{};
  std::memcpy(greeting.data(), "tactus-1", 8);
  Tunnel zero;  // the key of all zeros gives a secret of all zeros to everybody
  zero.begin(key_of(7));
  assert_false(push(zero, greeting.data(), greeting.size()));
  Client other(key_of(7));
  other.greeting[7] = '2';
  Tunnel tunnel;
  tunnel.begin(key_of(7));
  assert_false(push(tunnel, other.greeting.data(), 40));
  Pair pair(key_of(7), key_of(7));
  const std::uint8_t too_long[] = {0xff, 0xff}, too_short[] = {3, 0};
  assert_false(push(pair.tunnel, too_long, 2));
  Pair another(key_of(7), key_of(7));
  assert_false(push(another.tunnel, too_short, 2));
}

void a_key_file_holds_a_key_and_is_its_owners_alone(void**) {
  char path[] = "/tmp/tactus-key-XXXXXX";
  const int file = mkstemp(path);
  assert_true(file >= 0);
  Key key{};
  const auto judge = [&](std::string_view text, mode_t mode, const char* reason) {
    assert_int_equal(ftruncate(file, 0), 0);
    assert_int_equal(pwrite(file, text.data(), text.size(), 0), text.size());
    assert_int_equal(fchmod(file, mode), 0);
    Message why;
    const bool read = read_key(path, key, why);
    assert_int_equal(read, reason == nullptr);
    if (reason != nullptr) assert_non_null(std::strstr(why.c_str(), reason));
    assert_null(std::strstr(why.c_str(), "0a0a0a"));
  };
  const char* const kDigits = "0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a";
  judge(kDigits, 0600, nullptr);
  assert_true(key == key_of(10));
  judge(Text<80>(kDigits) << "\n", 0400, nullptr);
  for (const mode_t mode : {0640U, 0604U, 0666U}) judge(kDigits, mode, "chmod 600");
  judge(Text<80>(kDigits) << "0a", 0600, "64 hexadecimal digits");
  judge(std::string_view(kDigits).substr(2), 0600, "64 hexadecimal digits");
  judge("", 0600, "64 hexadecimal digits");
  judge("no key", 0600, "64 hexadecimal digits");
  close(file);
  unlink(path);
  Message why;
  assert_false(read_key(path, key, why));
  assert_non_null(std::strstr(why.c_str(), "No such file"));
  why = {};
  assert_false(read_key("/tmp", key, why));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  if (!Tunnel::prepare()) return 1;
  const CMUnitTest tests[] = {
      cmocka_unit_test(both_ends_with_the_key_understand_each_other),
      cmocka_unit_test(nobody_without_the_key_is_heard_or_told_anything),
      cmocka_unit_test(a_record_that_is_changed_repeated_or_left_out_ends_the_connection),
      cmocka_unit_test(a_recorded_connection_is_refused_when_it_is_played_again),
      cmocka_unit_test(greetings_that_are_none_end_the_connection),
      cmocka_unit_test(a_key_file_holds_a_key_and_is_its_owners_alone),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
