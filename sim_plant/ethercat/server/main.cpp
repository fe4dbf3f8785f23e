// fer_segment: emulated CiA 402 drives of a Franka FER, with the arm that they move, on an EtherCAT
// segment behind a network interface.
#include <sched.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "hal/ethercat/packet_socket.hpp"
#include "hal/os/cycle_clock.hpp"
#include "sim_plant/drives/server/fault_text.hpp"
#include "sim_plant/ethercat/segment.hpp"
#include "sim_plant/ethercat/server/options.hpp"

namespace tactus::segment {
namespace {

constexpr int kRefused = 2;
constexpr std::int64_t kWait_ns = 1'000'000;  // the resolution of the timers

volatile std::sig_atomic_t g_interrupted = 0;

void interrupt(int) {
  g_interrupted = 1;
}

int refuse(const char* what, const char* why) {
  std::fprintf(stderr, "fer_segment: %s%s\n", what, why);
  return kRefused;
}

SegmentSettings settings_of(const SegmentOptions& options) {
  SegmentSettings settings;
  settings.slaves = options.slaves;
  options.apply(settings);
  settings.drift_ppb = static_cast<std::int64_t>(options.drift_ppm * 1e3);
  settings.seed = options.seed;
  if (options.no_lrw > 0) settings.no_lrw[static_cast<std::size_t>(options.no_lrw - 1)] = true;
  if (options.sync0 > 0) settings.sync0[static_cast<std::size_t>(options.sync0 - 1)] = true;
  settings.places.fill(SmPlaces::with_mailboxes(options.mailbox_out, options.mailbox_in));
  return settings;
}

/// Adds a fault, of the line or of a drive. Returns what is wrong with it, or null.
const char* add_fault(const char* text, Segment& segment) {
  drives::Fault fault;
  std::size_t kind = 0;
  const char* const wrong =
      drives::parse_fault(text, {kLineFaultNames.data(), kLineFaultNames.size()}, kind, fault);
  if (wrong == nullptr) {
    const LineFault line = {static_cast<LineFaultKind>(kind),
                            fault.node,
                            fault.at,
                            fault.until,
                            fault.probability,
                            static_cast<std::uint16_t>(fault.value)};
    return segment.add(line) ? nullptr : "the line has too many faults";
  }
  if (const char* why = drives::parse_fault(text, fault)) return why;
  return segment.add(fault) ? nullptr : "a drive has too many faults";
}

void run(Segment& segment, ethercat::PacketSocket& socket, double duration_s) {
  const std::int64_t end_ns = monotonic_ns() + static_cast<std::int64_t>(duration_s * 1e9);
  static ethercat::Frame frame;
  while (g_interrupted == 0 && (duration_s == 0.0 || monotonic_ns() < end_ns)) {
    (void)socket.wait(kWait_ns);
    while (socket.receive(frame)) {
      segment.receive(frame, monotonic_ns());
      while (segment.take(frame)) (void)socket.send(frame);
    }
    if (socket.lost()) return;
    segment.advance(monotonic_ns());
  }
}

}  // namespace
}  // namespace tactus::segment

int main(int argc, char** argv) {
  using namespace tactus::segment;
  SegmentOptions options;
  int exit_code = 0;
  if (!parse_segment_options(argc, argv, options, exit_code)) return exit_code;
  static Segment segment;
  if (segment.load(settings_of(options), tactus::monotonic_ns()) != tactus::Status::kOk)
    return refuse("the arm could not be built", "");
  for (int i = 0; i < options.fault_count; ++i)
    if (const char* wrong = add_fault(options.faults[i], segment))
      return refuse("--fault: ", wrong);
  static tactus::ethercat::PacketSocket socket;
  tactus::Message why("--descriptor is not an open socket");
  const bool open = options.interface[0] != '\0'
                        ? socket.open(options.interface, why) == tactus::Status::kOk
                        : socket.adopt(options.descriptor);
  if (!open) return refuse(why.c_str(), "");
  const sched_param priority = {options.priority};
  if (options.priority > 0 && sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    return refuse("--priority: ", std::strerror(errno));
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  std::printf("FER drives on EtherCAT, %d slaves: ready\n", options.slaves);
  std::fflush(stdout);
  run(segment, socket, options.duration_s);
  return 0;
}
