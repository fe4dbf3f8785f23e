// An emulated segment and a sender of single datagrams, which knows of states and mailboxes only
// what the test says.
#pragma once

#include <cstring>

#include "hal/ethercat/protocol_coe.hpp"
#include "hal/ethercat/protocol_esc.hpp"
#include "sim_plant/ethercat/segment.hpp"
#include "tests/hal/ethercat/hex_frame.hpp"
#include "tests/support/testing.hpp"

namespace tactus::segment {

using namespace ethercat;

struct SegmentBench {
  static constexpr std::int64_t kMs_ns = 1'000'000;
  static constexpr int kNoFrame = -1;
  static constexpr std::uint16_t kFirst = 0x1001;

  SegmentSettings settings;
  Segment line;
  std::int64_t now_ns = 0;
  std::array<std::uint8_t, 1500> data{};  ///< of the last answer
  std::uint16_t position = 0;             ///< of its header

  void load() { ASSERT_OK(line.load(settings, now_ns)); }

  /// Sends a datagram and returns its working counter; kNoFrame: it did not come back.
  int send(Command command, std::uint32_t address, const void* bytes, std::size_t size) {
    Frame frame;
    FrameWriter writer(frame, kSender);
    std::uint8_t* const at = writer.add(command, 1, address, size);
    if (bytes != nullptr) std::memcpy(at, bytes, size);
    line.receive(frame, now_ns += 10'000);
    line.advance(now_ns);
    if (!line.take(frame)) return kNoFrame;
    FrameReader reader(frame);
    Datagram datagram;
    if (!reader.next(datagram)) return kNoFrame;
    std::memcpy(data.data(), datagram.data, size);
    position = datagram.position();
    return datagram.counter();
  }
  int read(int slave, std::uint16_t reg, std::size_t size) {
    return send(Command::kFprd, address_of(station(slave), reg), nullptr, size);
  }
  template <class Number>
  int write(int slave, std::uint16_t reg, Number number) {
    std::uint8_t bytes[sizeof number];
    put(bytes, number);
    return send(Command::kFpwr, address_of(station(slave), reg), bytes, sizeof bytes);
  }
  const SmPlaces& places(int slave) const {
    return settings.places[static_cast<std::size_t>(slave)];
  }
  static std::uint16_t station(int slave) { return static_cast<std::uint16_t>(kFirst + slave); }
  std::uint16_t word() const { return get<std::uint16_t>(data.data()); }
  std::uint32_t dword() const { return get<std::uint32_t>(data.data()); }

  void give_stations() {
    for (int i = 0; i < line.slaves(); ++i) {
      const std::uint16_t number = station(i);
      assert_int_equal(send(Command::kApwr, address_of(position_field(i), kStationReg), &number, 2),
                       1);
    }
  }
  void write_sm(int slave, int sm, std::uint16_t start, std::uint16_t length,
                std::uint8_t control) {
    std::uint8_t bytes[kSmBytes] = {};
    put(bytes, start);
    put(bytes + 2, length);
    bytes[4] = control;
    bytes[6] = length > 0 ? kSmEnabled : 0;
    const auto reg = static_cast<std::uint16_t>(kSmReg + sm * int{kSmBytes});
    assert_int_equal(send(Command::kFpwr, address_of(station(slave), reg), bytes, kSmBytes), 1);
  }
  void write_fmmu(int slave, int fmmu, std::uint32_t logical, std::uint16_t length,
                  std::uint16_t physical, std::uint8_t type, std::uint8_t first_bit = 0,
                  std::uint8_t last_bit = 7) {
    std::uint8_t bytes[kFmmuBytes] = {};
    put(bytes, logical);
    put(bytes + 4, length);
    bytes[6] = first_bit;
    bytes[7] = last_bit;
    put(bytes + 8, physical);
    bytes[11] = type;
    bytes[12] = 1;
    const auto reg = static_cast<std::uint16_t>(kFmmuReg + fmmu * int{kFmmuBytes});
    assert_int_equal(send(Command::kFpwr, address_of(station(slave), reg), bytes, kFmmuBytes), 1);
  }
  /// Asks for a state, and asserts what status and code become.
  void request(int slave, unsigned control, unsigned status, unsigned code = 0) {
    assert_int_equal(
        write<std::uint16_t>(slave, kAlControlReg, static_cast<std::uint16_t>(control)), 1);
    assert_int_equal(read(slave, kAlStatusReg, 6), 1);
    assert_int_equal(word(), status);
    assert_int_equal(get<std::uint16_t>(data.data() + 4), code);
  }
  void set_mailboxes(int slave) {
    const SmPlaces& at = places(slave);
    write_sm(slave, 0, at.mailbox_out, at.mailbox_out_bytes, kMailboxOutControl);
    write_sm(slave, 1, at.mailbox_in, at.mailbox_in_bytes, kMailboxInControl);
  }
  void set_process_data(int slave, std::uint16_t out = 8, std::uint16_t in = 16) {
    write_sm(slave, 2, places(slave).outputs, out, kOutputsControl);
    write_sm(slave, 3, places(slave).inputs, in, kInputsControl);
  }
  /// Sends CoE bytes, from the service on, and returns the number of bytes that come back;
  /// kNoFrame: no answer.
  int mailbox(int slave, const std::uint8_t* body, std::size_t size) {
    std::array<std::uint8_t, kMostMailbox> message{};
    put(message.data(), static_cast<std::uint16_t>(size));
    message[5] = kMailboxCoe;  // without a counter
    std::memcpy(message.data() + kMailboxBytes, body, size);
    const SmPlaces& at = places(slave);
    if (send(Command::kFpwr, address_of(station(slave), at.mailbox_out), message.data(),
             at.mailbox_out_bytes) != 1)
      return kNoFrame;
    return answer(slave);
  }
  int answer(int slave) {
    if (read(slave, places(slave).mailbox_in, places(slave).mailbox_in_bytes) != 1) return kNoFrame;
    return get<std::uint16_t>(data.data());
  }
  /// SDO requests of 8 bytes; returns the command byte of the answer.
  int sdo(int slave, unsigned command, unsigned index, unsigned sub, std::uint32_t value = 0) {
    std::uint8_t body[10] = {0, kCoeSdoRequest << 4, static_cast<std::uint8_t>(command)};
    put(body + 3, static_cast<std::uint16_t>(index));
    body[5] = static_cast<std::uint8_t>(sub);
    put(body + 6, value);
    return mailbox(slave, body, sizeof body) < 0 ? kNoFrame : data[8];
  }
  std::uint32_t sdo_value() const { return get<std::uint32_t>(data.data() + 12); }
  void to_preop() {
    give_stations();
    for (int i = 0; i < line.slaves(); ++i) {
      set_mailboxes(i);
      request(i, 2, 2);
    }
  }
};

/// A bench with this many slaves; there is one at a time.
inline SegmentBench& fresh_segment(int slaves = kDof) {
  static SegmentBench bench;
  bench.settings = {};
  bench.settings.slaves = slaves;
  bench.now_ns = 0;
  bench.load();
  return bench;
}

}  // namespace tactus::segment
