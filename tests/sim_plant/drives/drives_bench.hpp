// A master's side of the emulated drives in virtual time, with bytes typed here and not taken from
// the code under test.
#pragma once

#include <cstring>
#include <initializer_list>
#include <new>

#include "sim_plant/drives/drive_arm.hpp"
#include "tests/support/testing.hpp"

namespace tactus::drives {

inline can::CanFrame make_frame(unsigned id, std::initializer_list<unsigned> bytes) {
  can::CanFrame frame;
  frame.id = static_cast<std::uint16_t>(id);
  for (const unsigned byte : bytes) frame.data[frame.size++] = static_cast<std::uint8_t>(byte);
  return frame;
}

/// All seven drives on one bus.
inline DriveArmSettings one_bus() {
  DriveArmSettings settings;
  for (std::size_t i = 0; i < kDof; ++i) settings.joints[i] = {0, static_cast<int>(i) + 1};
  return settings;
}
/// Drives 1 to 3, 4 and 5, 6 and 7 on three buses.
inline DriveArmSettings three_buses() {
  DriveArmSettings settings = one_bus();
  for (std::size_t i = 3; i < kDof; ++i) settings.joints[i].bus = i < 5 ? 1 : 2;
  return settings;
}

/// What a drive said in its last TPDO of the layout that `configure` gives it.
struct Feedback {
  std::uint16_t status = 0;
  std::int32_t position = 0;
  std::int16_t torque = 0;
  std::int64_t count = 0;
};

class DrivesBench {
 public:
  DriveArm arm;
  std::int64_t now_ns = 1'000'000'000;
  std::array<Feedback, kDof> feedback{};
  std::array<std::uint16_t, kDof> controlword{};
  std::array<std::int16_t, kDof> torque{};
  std::uint64_t checksum = 14695981039346656037ULL;  // of all frames sent by the drives

  void load(const DriveArmSettings& settings) {
    settings_ = settings;
    ASSERT_OK(arm.load(settings, now_ns));
  }
  void boot() {
    run_ms(20);
    while (take()) {
    }
  }

  /// Makes the nodes of the first bus operational.
  void start() { send(0x000, {0x01, 0x00}); }
  /// Passes a millisecond with a SYNC on the first bus at its end.
  void sync_cycle() {
    now_ns += 1'000'000;
    send(0x080, {});
    arm.advance(now_ns);
  }

  void send(unsigned id, std::initializer_list<unsigned> bytes, std::size_t bus = 0) {
    arm.receive(bus, make_frame(id, bytes), now_ns);
  }
  /// Lets time pass without SYNC.
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      now_ns += 1'000'000;
      arm.advance(now_ns);
    }
  }
  /// Takes the next frame of any bus into `frame`.
  bool take() {
    for (std::size_t bus = 0; bus < kBuses; ++bus) {
      if (!arm.take(bus, frame)) continue;
      mix(frame.id);
      mix(frame.size);
      for (std::size_t i = 0; i < frame.size; ++i) mix(frame.data[i]);
      return true;
    }
    return false;
  }
  /// The next frame with this identifier; others are dropped.
  bool take(unsigned id) {
    while (take())
      if (frame.id == id) return true;
    return false;
  }
  void expect(unsigned id, std::initializer_list<unsigned> bytes) {
    const bool came = take(id);
    if (!came) print_error("no frame %03X\n", id);
    assert_true(came);
    assert_int_equal(frame.size, bytes.size());
    std::size_t i = 0;
    for (const unsigned byte : bytes) {
      if (frame.data[i] != byte)
        print_error("%03X byte %zu is %02X, not %02X\n", id, i, frame.data[i], byte);
      assert_int_equal(frame.data[i++], byte);
    }
  }
  void expect_nothing(unsigned id) { assert_false(take(id)); }

  std::size_t bus_of(int node) const {
    for (const auto& place : settings_.joints)
      if (place.node == node) return static_cast<std::size_t>(place.bus);
    return 0;
  }
  /// Writes an object; returns the abort code, 0: done, ~0: no answer.
  std::uint32_t write(int node, unsigned index, unsigned sub, std::int64_t number, unsigned bytes) {
    const unsigned command = bytes == 1 ? 0x2F : bytes == 2 ? 0x2B : 0x23;
    const auto v = static_cast<std::uint32_t>(number);
    send(0x600U + static_cast<unsigned>(node),
         {command, index & 0xFF, index >> 8, sub, v & 0xFF, v >> 8 & 0xFF, v >> 16 & 0xFF, v >> 24},
         bus_of(node));
    return answer(node);
  }
  /// Reads an object of up to four bytes into `value`.
  std::uint32_t read(int node, unsigned index, unsigned sub) {
    send(0x600U + static_cast<unsigned>(node), {0x40, index & 0xFF, index >> 8, sub, 0, 0, 0, 0},
         bus_of(node));
    const std::uint32_t abort = answer(node);
    value = 0;
    const unsigned size = 4U - (frame.data[0] >> 2 & 3U);
    for (unsigned i = 0; i < size && abort == 0; ++i)
      value |= std::uint32_t{frame.data[4 + i]} << 8 * i;
    return abort;
  }
  void put(int node, unsigned index, unsigned sub, std::int64_t number, unsigned bytes) {
    const std::uint32_t abort = write(node, index, sub, number, bytes);
    if (abort != 0) print_error("%04X:%u of node %d: %08X\n", index, sub, node, abort);
    assert_int_equal(abort, 0);
  }
  std::uint32_t get(int node, unsigned index, unsigned sub) {
    const std::uint32_t abort = read(node, index, sub);
    if (abort != 0) print_error("%04X:%u of node %d: %08X\n", index, sub, node, abort);
    assert_int_equal(abort, 0);
    return value;
  }

  /// Maps `entries` to the PDO whose communication record is at `record`, and makes it valid.
  void map(int node, unsigned record, unsigned id, unsigned type,
           std::initializer_list<std::uint32_t> entries) {
    put(node, record, 1, 0x80000000LL | id, 4);
    put(node, record + 0x200, 0, 0, 1);
    unsigned sub = 0;
    for (const std::uint32_t entry : entries) put(node, record + 0x200, ++sub, entry, 4);
    put(node, record + 0x200, 0, sub, 1);
    put(node, record, 2, type, 1);
    put(node, record, 1, id, 4);
  }
  /// Every drive in `mode`, with the plain layout of classic CAN, and operational.
  void configure(int mode) {
    boot();
    for (int n = 1; n <= kDof; ++n) {
      put(n, 0x6060, 0, mode, 1);
      const auto id = static_cast<unsigned>(n);
      map(n, 0x1400, 0x200U + id, 1, {0x60400010, 0x60710010});
      map(n, 0x1800, 0x180U + id, 1, {0x60410010, 0x60640020, 0x60770010});
    }
    for (std::size_t bus = 0; bus < kBuses; ++bus) send(0x000, {0x01, 0x00}, bus);
  }
  void send_commands() {
    for (unsigned i = 0; i < kDof; ++i) {
      const unsigned t = static_cast<std::uint16_t>(torque[i]), word = controlword[i];
      send(0x201U + i, {word & 0xFF, word >> 8, t & 0xFF, t >> 8}, bus_of(static_cast<int>(i) + 1));
    }
  }
  void sync() {
    for (std::size_t bus = 0; bus < 3; ++bus) send(0x080, {}, bus);
  }
  /// One cycle of a master: commands, SYNC, feedback.
  void cycle() {
    send_commands();
    now_ns += 1'000'000;
    sync();
    arm.advance(now_ns);
    while (take()) note_feedback();
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  void command_all(unsigned word) { controlword.fill(static_cast<std::uint16_t>(word)); }
  /// All drives to operation enabled; the brakes are still closed.
  void enable() {
    for (const unsigned word : {0x0006U, 0x0007U, 0x000FU}) {
      command_all(word);
      cycle();
    }
  }

  /// Keeps the feedback in `frame`.
  void note_feedback() {
    if (frame.id < 0x181 || frame.id > 0x180 + kDof || frame.size < 8) return;
    Feedback& f = feedback[frame.id - 0x181U];
    f.status = can::load<std::uint16_t>(frame.data, 0);
    f.position = can::load<std::int32_t>(frame.data, 2);
    f.torque = can::load<std::int16_t>(frame.data, 6);
    ++f.count;
  }

  can::CanFrame frame;
  std::uint32_t value = 0;

 private:
  std::uint32_t answer(int node) {
    if (!take(0x580U + static_cast<unsigned>(node))) return 0xFFFFFFFF;
    return frame.data[0] == 0x80 ? can::load<std::uint32_t>(frame.data, 4) : 0;
  }
  void mix(unsigned byte) { checksum = (checksum ^ byte) * 1099511628211ULL; }

  DriveArmSettings settings_;
};

/// A new bench; there is one at a time.
inline DrivesBench& fresh(const DriveArmSettings& settings = one_bus()) {
  static DrivesBench bench;
  bench.~DrivesBench();
  new (&bench) DrivesBench;
  bench.load(settings);
  return bench;
}
/// The same, and the drives have booted.
inline DrivesBench& booted(const DriveArmSettings& settings = one_bus()) {
  DrivesBench& bench = fresh(settings);
  bench.boot();
  return bench;
}

}  // namespace tactus::drives
