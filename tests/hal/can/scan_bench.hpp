// A NodeScan on a bus with nodes that answer out of lists.
#pragma once

#include <memory>

#include "hal/can/node_scan.hpp"
#include "tests/hal/can/fake_node.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {

inline constexpr std::int64_t kMs_ns = 1'000'000;

/// A bus on which every half millisecond something can happen.
struct Bus {
  NodeScan scan;
  std::vector<FakeNode> nodes;
  std::vector<CanFrame> sent, heartbeats;  ///< heartbeats come every 100 ms
  std::vector<std::int64_t> sent_ns;
  std::int64_t now_ns = 0;
  std::int64_t delay_ns = 0;  ///< of every answer
  std::int64_t deaf_ns = 0;   ///< no node answers before this time
  CanFrame late;
  std::int64_t late_ns = -1;  ///< when it comes; -1: none is on its way

  /// Runs the scan to its end, or fails after two minutes.
  void run() {
    scan.begin(ScanTimes(), now_ns);
    const std::int64_t end_ns = now_ns + 120'000 * kMs_ns;
    while (scan.advance(now_ns)) {
      assert_true(now_ns < end_ns);
      CanFrame request, reply;
      while (scan.take(request)) {
        sent.push_back(request);
        sent_ns.push_back(now_ns);
        for (FakeNode& node : nodes)
          if (now_ns >= deaf_ns && node.answer(request, reply)) give(reply);
      }
      if (late_ns >= 0 && now_ns >= late_ns) {
        late_ns = -1;
        scan.receive(late, now_ns);
      }
      now_ns += kMs_ns / 2;
      if (now_ns % (100 * kMs_ns) != 0) continue;
      for (const CanFrame& frame : heartbeats) scan.receive(frame, now_ns);
    }
  }
  void give(const CanFrame& reply) {
    late = reply;
    late_ns = now_ns + delay_ns;
    // While all nodes are asked, answers overlap.
    if (delay_ns == 0 || (nodes.size() > 1 && sent.size() <= 127)) scan.receive(reply, now_ns);
  }
  int requests(int node, std::uint16_t index) const {
    int count = 0;
    for (const CanFrame& frame : sent)
      count += frame.id == 0x600 + node && frame.data[0] == 0x40 &&
               (frame.data[1] | frame.data[2] << 8) == index;
    return count;
  }
};
// A failed assertion is a longjmp, so the bus is not on the stack.
inline std::unique_ptr<Bus> g_bus;

inline Bus& fresh() {
  g_bus = std::make_unique<Bus>();
  return *g_bus;
}
inline CanFrame heartbeat(int node, std::uint8_t state) {
  return heartbeat_frame(static_cast<std::uint8_t>(node), static_cast<NmtState>(state));
}
/// A drive with a part of the objects that a scan reads.
inline FakeNode drive(int number) {
  FakeNode node;
  node.node = number;
  node.objects = {{0x1000, 0, 0x00020192}, {0x1001, 0, 0x21},       {0x1003, 0, 2},
                  {0x1003, 1, 0x00008611}, {0x1003, 2, 0x12348130}, {0x1008, 0, 0, "Servo drive"},
                  {0x100A, 0, 0, "v1"},    {0x1017, 0, 50},         {0x1018, 1, 0xAABB},
                  {0x1018, 4, 77},         {0x6041, 0, 0x0637},     {0x6061, 0, 10},
                  {0x6502, 0, 0x380},      {0x608F, 1, 16777216},   {0x1400, 1, 0x201},
                  {0x1400, 2, 1},          {0x1600, 0, 2},          {0x1600, 1, 0x60400010},
                  {0x1600, 2, 0x60710010}, {0x1401, 1, 0x80000301}, {0x1401, 2, 1},
                  {0x1801, 1, 0x40000281}, {0x1801, 2, 255},        {0x1A01, 0, 1},
                  {0x1A01, 1, 0x60640020}};
  return node;
}

// Proves CAN-16.
}  // namespace tactus::can
