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
