#include "program/scan_segment/scan_segment.hpp"

#include <cstdio>

#include "hal/ethercat/packet_socket.hpp"
#include "hal/ethercat/slave_scan.hpp"
#include "hal/os/cycle_clock.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus {
namespace {

using namespace ethercat;

/// Carries the frames of a scan until it has something, or has failed.
SlaveScan::Progress carry(PacketSocket& socket, SlaveScan& scan) {
  static Frame frame;
  SlaveScan::Progress progress = SlaveScan::Progress::kBusy;
  while (progress == SlaveScan::Progress::kBusy && !socket.lost()) {
    if (scan.exchange().take(frame)) (void)socket.send(frame);
    (void)socket.wait(kMillisecond_ns);
    while (socket.receive(frame)) scan.exchange().receive(frame);
    progress = scan.advance(monotonic_ns());
  }
  return progress;
}

void print_pdos(const char* what, const std::array<SlaveReport::Pdo, SlaveReport::kMostPdos>& pdos,
                int count) {
  for (int i = 0; i < count; ++i) {
    const SlaveReport::Pdo& pdo = pdos[static_cast<std::size_t>(i)];
    std::printf("    %s %04Xh, %zu bytes:", what, pdo.index, pdo.layout.bytes());
    for (int k = 0; k < pdo.layout.count(); ++k) {
      const std::uint32_t entry = pdo.layout.entry(k);
      if (entry >> 16 == 0)
        std::printf(" padding/%u", entry & 0xFF);
      else
        std::printf(" %04Xh:%u/%u", entry >> 16, entry >> 8 & 0xFF, entry & 0xFF);
    }
    std::printf("%s\n", pdo.layout.count() < pdo.count ? " ..." : "");
  }
}

void print_slave(int position, const SlaveReport& report) {
  const auto state = static_cast<AlState>(report.al_status & kAlStateBits);
  std::printf("  slave %d: %s\n", position + 1,
              report.name.empty() ? "(no name)" : report.name.c_str());
  std::printf("    vendor %08Xh, product %u, revision %08Xh, serial %u%s\n", report.identity.vendor,
              report.identity.product, report.identity.revision, report.identity.serial,
              report.coe ? ", CoE" : "");
  std::printf("    station %04Xh, %s", report.station, name(state));
  if ((report.al_status & kAlErrorBit) != 0)
    std::printf(" with error: %s (%04Xh)", al_code_text(report.al_code), report.al_code);
  std::printf("\n");
  print_pdos("outputs", report.outputs, report.output_count);
  print_pdos("inputs ", report.inputs, report.input_count);
}

int scan_interface(const char* interface) {
  static PacketSocket socket;
  static SlaveScan scan;
  Message why;
  if (socket.open(interface, why) != Status::kOk) {
    std::fprintf(stderr, "tactus: %s\n", why.c_str());
    return kRefused;
  }
  scan.exchange().set_source(socket.address());
  scan.begin_count(monotonic_ns());
  const bool answered = carry(socket, scan) == SlaveScan::Progress::kDone;
  const int count = answered ? scan.count() : 0;
  std::printf("interface %s: %d %s\n", interface, count, count == 1 ? "slave" : "slaves");
  if (count == 0) std::printf("  no slave answers: check power and cabling\n");
  bool good = count > 0;
  for (int position = 0; position < count; ++position) {
    scan.begin(position, monotonic_ns());
    const SlaveScan::Progress progress = carry(socket, scan);
    if (progress == SlaveScan::Progress::kDone) {
      print_slave(position, scan.report());
      continue;
    }
    good = false;
    std::printf("  slave %d: %s\n", position + 1,
                progress == SlaveScan::Progress::kUnreadable ? "its EEPROM cannot be read"
                                                             : "does not answer any more");
  }
  socket.close();
  return good ? kSucceeded : kEndedOtherwise;
}

}  // namespace

int scan_segment(const Options& options) {
  int exit_code = kSucceeded;
  for (int i = 0; i < options.bus_count; ++i) {
    const int code = scan_interface(options.buses[i]);
    if (code > exit_code) exit_code = code;
  }
  return exit_code;
}

}  // namespace tactus
