#include "program/scan/scan.hpp"

#include <cstdio>

#include "hal/can/can_socket.hpp"
#include "hal/can/node_scan.hpp"
#include "hal/os/cycle_clock.hpp"
#include "kernel/core/nanoseconds.hpp"
#include "program/scan/node_text.hpp"

namespace tactus {
namespace {

/// Runs a scan to its end. False: the bus broke down; the reason was printed.
bool run_scan(const char* interface, can::CanSocket& socket, can::NodeScan& scan,
              const can::ScanTimes& times) {
  static std::array<can::CanFrame, can::CanSocket::kBatch> frames;
  scan.begin(times, monotonic_ns());
  while (scan.advance(monotonic_ns())) {
    can::CanFrame request;
    while (scan.take(request)) {
      const can::Sent sent = socket.send(&request, 1);
      if (sent == can::Sent::kAll) continue;
      std::fprintf(stderr, "bus %s: %s\n", interface,
                   sent == can::Sent::kLost
                       ? "the interface has gone"
                       : "no frame can be sent: check the bit rate and that another node is on");
      return false;
    }
    socket.wait(kMillisecond_ns);
    const int count = socket.receive(frames.data(), can::CanSocket::kBatch);
    const std::int64_t now_ns = monotonic_ns();
    for (int i = 0; i < count; ++i) scan.receive(frames[static_cast<std::size_t>(i)], now_ns);
    if (!socket.health().lost) continue;
    std::fprintf(stderr, "bus %s: the interface has gone\n", interface);
    return false;
  }
  return true;
}

/// Prints what the controller reported, if it is not in good health.
void print_health(const can::LinkHealth& health) {
  const char* state = health.bus_off         ? "bus-off"
                      : health.error_passive ? "error passive"
                      : health.warning       ? "error warning"
                                             : nullptr;
  if (state != nullptr) std::printf("  the controller is in state %s\n", state);
  if (health.foreign > 0)
    std::printf("  %u frames with 29-bit identifiers, which are not CANopen\n", health.foreign);
}

int scan_bus(const char* interface, const can::ScanTimes& times) {
  static can::CanSocket socket;
  static can::NodeScan scan;
  Message why;
  if (socket.open(interface, false, nullptr, 0, why) != Status::kOk) {
    std::fprintf(stderr, "tactus: %s\n", why.c_str());
    return kRefused;
  }
  const bool good = run_scan(interface, socket, scan, times);
  const int count = scan.count();
  std::printf("bus %s: %d %s\n", interface, count, count == 1 ? "node" : "nodes");
  print_health(socket.health());
  if (good && count == 0)
    std::printf("  no node answers: check power, cabling, terminators and bit rate\n");
  for (int node = 1; node <= can::kMaxNode; ++node)
    if (scan.report(node).present()) print_node(stdout, node, scan.report(node));
  socket.close();
  return good && count > 0 ? kSucceeded : kEndedOtherwise;
}

}  // namespace

int scan(const Options& options) {
  can::ScanTimes times;
  times.answer_ns = options.answer_ms * kMillisecond_ns;
  int exit_code = kSucceeded;
  for (int i = 0; i < options.bus_count; ++i) {
    const int code = scan_bus(options.buses[i], times);
    if (code > exit_code) exit_code = code;
  }
  return exit_code;
}

}  // namespace tactus
