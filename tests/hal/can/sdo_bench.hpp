// An SdoClient whose frames a test writes and reads as text, one byte after the other.
#pragma once

#include <cstdio>
#include <string_view>

#include "hal/can/sdo_client.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {

struct SdoBench {
  static constexpr std::int64_t kMs_ns = 1'000'000;

  SdoClient client;
  std::int64_t now_ns = 0;

  /// Asserts that the next frame is `expected`, such as "601 40 00 10 00 00 00 00 00".
  void expect(std::string_view expected) {
    CanFrame frame;
    char text[64] = "no frame";
    if (client.take(frame)) {
      int at = std::snprintf(text, sizeof text, "%03X", frame.id);
      for (std::size_t i = 0; i < frame.size && i < 8; ++i)
        at += std::snprintf(text + at, sizeof text - static_cast<std::size_t>(at), " %02X",
                            frame.data[i]);
    }
    if (expected != text) print_error("%s, expected %s\n", text, expected.data());
    assert_true(expected == text);
  }
  void expect_silence() {
    CanFrame frame;
    assert_false(client.take(frame));
  }
  /// The node answers with such a frame.
  void answer(const char* text) {
    client.receive(frame_of(text), now_ns);
    client.advance(now_ns);
  }
  /// Begins to read the name of node 2.
  void ask_name() {
    client.upload(2, 0x1008, 0, 0);
    expect("602 40 08 10 00 00 00 00 00");
  }
  /// Node 2 sends so many whole segments of its name.
  void take_segments(int count) {
    for (int i = 0; i < count; ++i) {
      expect(i % 2 == 0 ? "602 60 00 00 00 00 00 00 00" : "602 70 00 00 00 00 00 00 00");
      answer(i % 2 == 0 ? "582 00 31 32 33 34 35 36 37" : "582 10 31 32 33 34 35 36 37");
    }
  }
  /// Begins to read the device type of node 1.
  void ask_type() {
    client.upload(1, 0x1000, 0, 0);
    expect("601 40 00 10 00 00 00 00 00");
  }
  /// Begins to write mode 10 to node 1.
  void write_mode() {
    client.download(1, 0x6060, 0, 10, 1, 0);
    expect("601 2F 60 60 00 0A 00 00 00");
  }
  /// Writes two whole segments to node 4; the answer to the second is missing.
  void write_fourteen_bytes() {
    const char* const text = "0123456789ABCD";
    client.download_bytes(4, 0x2000, 1, reinterpret_cast<const std::uint8_t*>(text), 14, 0);
    expect("604 21 00 20 01 0E 00 00 00");
    answer("584 60 00 20 01 00 00 00 00");
    expect("604 00 30 31 32 33 34 35 36");
    answer("584 20 00 00 00 00 00 00 00");
    expect("604 11 37 38 39 41 42 43 44");
  }
  static CanFrame frame_of(const char* text) {
    CanFrame frame;
    unsigned id = 0, b[8] = {};
    const int count = std::sscanf(text, "%x %x %x %x %x %x %x %x %x", &id, &b[0], &b[1], &b[2],
                                  &b[3], &b[4], &b[5], &b[6], &b[7]);
    frame.id = static_cast<std::uint16_t>(id);
    frame.size = static_cast<std::uint8_t>(count - 1);
    for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(b[i]);
    return frame;
  }
  void assert_progress(Progress progress) const {
    assert_int_equal(static_cast<int>(client.progress()), static_cast<int>(progress));
  }
  void assert_aborted(SdoAbort abort, std::string_view description) const {
    assert_progress(Progress::kAborted);
    assert_int_equal(static_cast<std::uint32_t>(client.abort()), static_cast<std::uint32_t>(abort));
    const Message said = client.describe();
    if (description != said) print_error("%s\n", said.c_str());
    assert_true(description == said);
  }
};

}  // namespace tactus::can
