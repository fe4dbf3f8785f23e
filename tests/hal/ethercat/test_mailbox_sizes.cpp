// Mailboxes of every length: of the shortest SDO message up to what a frame has room for, each
// slave with its own, in the start-up and in the cycle.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <random>

#include "tests/hal/ethercat/master_bench.hpp"
#include "tests/hal/ethercat/segment_bench.hpp"

namespace tactus::ethercat {
namespace {

using segment::SegmentBench;
using segment::SmPlaces;

// An SDO message has 16 bytes (ETG.1000.6). An Ethernet frame has 1514 bytes, of which 28 are not
// data of its only datagram (IEC 61158-4-12).
constexpr int kLeast = 16, kMost = 1486;

struct Sizes {
  int out, in;
};
bool fits(int bytes) {
  return bytes >= kLeast && bytes <= kMost;
}

/// To OP, armed, which asks every drive for its mode in the cycle, and told of an error.
void assert_works(MasterBench& bench) {
  ASSERT_OK(bench.load());
  std::size_t longest = 0;
  bench.hal.tamper = [&longest](const Frame& frame) { longest = std::max(longest, frame.size); };
  const Status status = bench.start();
  if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(status);
  ASSERT_OK(bench.cycles(100));
  const LineCounts counts = bench.hal.master.counts();
  assert_int_equal(counts.lost + counts.late + counts.counter + counts.strange, 0);
  bench.add(drives::FaultKind::kEmergency, 5, 0x4310);
  ASSERT_STATUS(bench.cycles(10), Status::kDriveFault);
  assert_non_null(std::strstr(bench.hal.trouble().c_str(), "4310h"));
  assert_int_equal(bench.hal.line.malformed(), 0);
  assert_true(longest <= 1514);
}

// Proves ECAT-17.
void mailboxes_of_every_length_work_from_the_start_up_to_a_fault(void**) {
  for (const Sizes& sizes : {Sizes{1024, 1024}, Sizes{kMost, kMost}, Sizes{kLeast, kMost},
                             Sizes{kMost, kLeast}, Sizes{513, 1311}}) {
    MasterBench& bench = fresh_bench();
    bench.plant.places.fill(SmPlaces::with_mailboxes(sizes.out, sizes.in));
    assert_works(bench);
  }
  MasterBench& mixed = fresh_bench();
  constexpr Sizes kMixed[] = {{128, 128},  {1024, 1024}, {kMost, kMost}, {16, 16},
                              {1024, 128}, {64, kMost},  {1400, 17}};
  for (std::size_t i = 0; i < kDof; ++i)
    mixed.plant.places[i] = SmPlaces::with_mailboxes(kMixed[i].out, kMixed[i].in);
  assert_works(mixed);
}

/// Of random lengths, most of which fit, the first of the line that does not is named, with the
/// word of the EEPROM, and nothing that could make it worse.
void a_mailbox_that_no_message_or_no_frame_fits_is_refused_with_its_limit(void**) {
  constexpr unsigned kSeed = 20261128;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> any(0, 2000), good(kLeast, kMost), odds(0, 15);
  int refused = 0;
  for (int n = 0; n < 60; ++n) {
    MasterBench& bench = fresh_bench();
    char expected[128] = "";
    for (std::size_t i = 0; i < kDof; ++i) {
      const Sizes sizes = {odds(random) == 0 ? any(random) : good(random),
                           odds(random) == 0 ? any(random) : good(random)};
      bench.plant.places[i] = SmPlaces::with_mailboxes(sizes.out, sizes.in);
      if (expected[0] != '\0' || (fits(sizes.out) && fits(sizes.in))) continue;
      const bool out = !fits(sizes.out);
      std::snprintf(expected, sizeof expected,
                    "joint %zu (slave %zu): its mailbox of %s has %d bytes by its EEPROM (word "
                    "%s), expected 16 to 1486: ",
                    i + 1, i + 1, out ? "requests" : "answers", out ? sizes.out : sizes.in,
                    out ? "0019h" : "001Bh");
    }
    ASSERT_OK(bench.load());
    const Status status = bench.hal.connect(CommandMode::kEffort);
    const Message said = bench.hal.trouble();
    const bool good_ones = expected[0] == '\0';
    const bool right = good_ones
                           ? status == Status::kOk
                           : status == Status::kRefusedByRobot &&
                                 std::strncmp(said.c_str(), expected, std::strlen(expected)) == 0;
    if (!right) print_error("run %d: expected '%s', is '%s'\n", n, expected, said.c_str());
    assert_true(right);
    assert_null(std::strstr(said.c_str(), "write its EEPROM"));
    refused += good_ones ? 0 : 1;
  }
  assert_true(refused > 10 && refused < 50);
}

/// A client, a port and one slave; datagrams and their answers are lost at random.
struct LossyBench {
  SegmentBench wire;
  CoeClient client;
  MailboxPort port{client};
  std::mt19937 random{20261128};
  std::uint32_t loses = 0;  ///< of 1000 datagrams

  void exchange(Mailboxes& boxes, std::size_t room) {
    const Request request = port.next(boxes, room);
    assert_true(request.size <= room);
    std::array<std::uint8_t, 1500> bytes{};
    std::memcpy(bytes.data(), request.data.data(), request.kept());
    const auto fate = static_cast<std::uint32_t>(random() % 1000);
    Answer answer;
    if (fate >= loses) {
      answer.counter = wire.send(request.command, request.address, bytes.data(), request.size);
      if (fate >= 2 * loses) answer.data = wire.data.data();
    }
    can::Emergency emergency;
    (void)port.take(boxes, answer, emergency, wire.now_ns);
    client.advance(wire.now_ns);
  }
  /// Reads an object, again and again until an answer comes; whatever else comes must be none.
  void read(Mailboxes& boxes, std::size_t room, std::uint16_t index, std::uint8_t sub) {
    for (int attempt = 0; attempt < 100; ++attempt) {
      client.upload(boxes.out_bytes, index, sub, wire.now_ns);
      while (client.progress() == CoeClient::Progress::kBusy) exchange(boxes, room);
      if (client.progress() == CoeClient::Progress::kDone) return;
      assert_true(client.abort() == can::SdoAbort::kTimeout ||
                  client.abort() == can::SdoAbort::kToggle ||
                  client.abort() == can::SdoAbort::kCommand);
    }
    assert_true(false);  // no answer to any attempt
  }
};

/// However a mailbox is divided among datagrams, and whichever of them are lost: a transfer ends
/// with the whole object or with an error, never with bytes of another one.
void a_mailbox_that_shares_frames_is_accessed_in_several_of_them(void**) {
  constexpr const char* kName = "Tactus emulated servo drive";
  for (const std::uint32_t loses : {0U, 20U, 100U}) {
    static LossyBench* bench = nullptr;
    delete bench;
    bench = new LossyBench;
    bench->loses = loses;
    bench->client.set_time(5'000'000);
    std::uniform_int_distribution<int> any(kLeast, kMost);
    std::uniform_int_distribution<std::size_t> rooms(144, kMost);
    for (int n = 0; n < 40; ++n) {
      SegmentBench& wire = bench->wire;
      const SmPlaces places = SmPlaces::with_mailboxes(any(bench->random), any(bench->random));
      wire.settings.slaves = 1;
      wire.settings.places.fill(places);
      wire.load();
      wire.to_preop();
      bench->port.reset();
      Mailboxes boxes = {0x1001, places.mailbox_out, places.mailbox_out_bytes, places.mailbox_in,
                         places.mailbox_in_bytes};
      const std::size_t room = rooms(bench->random);
      for (int i = 0; i < 3; ++i) {
        bench->read(boxes, room, 0x1008, 0);
        assert_int_equal(bench->client.size(), 27);
        assert_memory_equal(bench->client.data(), kName, 27);
        bench->read(boxes, room, 0x1018, 4);
        assert_int_equal(bench->client.value(), 1001);
      }
    }
  }
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(mailboxes_of_every_length_work_from_the_start_up_to_a_fault),
      cmocka_unit_test(a_mailbox_that_no_message_or_no_frame_fits_is_refused_with_its_limit),
      cmocka_unit_test(a_mailbox_that_shares_frames_is_accessed_in_several_of_them),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
