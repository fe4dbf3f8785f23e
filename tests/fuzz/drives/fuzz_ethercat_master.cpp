// Fuzzes the master of the segment while it follows: whatever frames come, it commands torques and
// enables drives only while they are armed, and its numbers are finite.
#include <memory>

#include "hal/ethercat/ethercat_master.hpp"
#include "sim_plant/ethercat/segment.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::ethercat;

constexpr std::int64_t kPeriod_ns = 1'000'000;

struct Bench {
  EthercatSettings ethercat;
  cia402::Cia402Settings drive;
  EthercatMaster master;
  segment::Segment line;
  RobotState state;
  RobotCommand command;
  std::int64_t now_ns = 0;
  Frame sent;

  bool connect() {
    ethercat.interface = Value("eth0");
    ethercat.clock_frames = 2;
    drive.rated_torque << 3.0, 3.0, 3.0, 3.0, 0.5, 0.5, 0.5;
    drive.brake_ms = 20;
    drive.hold_tolerance = 1.0;  // these brakes open before the torque has risen
    segment::SegmentSettings settings;
    settings.brake_release_s = 0.005;
    if (master.configure(ethercat, drive, Tool{}, CommandMode::kEffort, 1000, 10000) !=
            Status::kOk ||
        line.load(settings, 0) != Status::kOk)
      return false;
    const std::uint8_t source[6] = {0x02, 0, 0, 0, 0, 1};
    master.connect(source, 0);
    Status status = Status::kArming;
    for (int i = 0; i < 20000 && status == Status::kArming; ++i) {
      status = master.connecting(now_ns += 100'000);
      carry();
    }
    return status == Status::kOk;
  }
  void carry() {
    Frame frame;
    while (master.take(frame)) {
      sent = frame;
      line.receive(frame, now_ns);
    }
    line.advance(now_ns);
    while (line.take(frame)) master.receive(frame);
  }
  void cycle(DriveRequest request) {
    command.request = request;
    now_ns += kPeriod_ns;
    MUST(master.read({now_ns}, state) == Status::kOk);
    master.write(command);
  }
  void check() const {
    const cia402::ArmingPhase phase = master.phase();
    const bool up =
        phase >= cia402::ArmingPhase::kSwitchingOn && phase <= cia402::ArmingPhase::kArmed;
    MUST(state.q.allFinite() && state.dq.allFinite() && state.tau.allFinite());
    for (std::size_t j = 0; j < kDof; ++j) {
      const std::uint8_t* const at = sent.bytes.data() + kFirstDatagram + kDatagramBytes + 4 * j;
      const bool enables = (get<std::uint16_t>(at) & 0x0008) != 0;
      MUST(up || (!enables && get<std::int16_t>(at + 2) == 0));
    }
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bench = std::make_unique<Bench>();
  MUST(bench->connect());
  for (int i = 0; i < 60 + bench->drive.held_ms(); ++i) {
    bench->cycle(DriveRequest::kArm);
    bench->carry();
  }
  MUST(bench->master.phase() == cia402::ArmingPhase::kArmed);
  // Each record: a kind; one changes a byte of the frame that comes back, one sends bytes of its
  // own.
  for (std::size_t at = 0; at + 1 < size;) {
    const std::uint8_t kind = data[at++];
    bench->cycle(kind < 0xF0 ? DriveRequest::kFollow : static_cast<DriveRequest>(kind % 3));
    Frame frame;
    MUST(bench->master.take(frame));
    bench->sent = frame;
    bench->check();
    bench->line.receive(frame, bench->now_ns);
    bench->line.advance(bench->now_ns);
    while (bench->line.take(frame)) {
      for (int n = kind & 3; n > 0 && at + 2 < size; --n, at += 3)
        frame.bytes[(data[at] << 8 | data[at + 1]) % frame.size] = data[at + 2];
      bench->master.receive(frame);
    }
    if ((kind & 4) == 0 || at == size) continue;
    Frame own;
    own.size = data[at++] % 128U;
    for (std::size_t i = 0; i < own.size && at < size; ++i) own.bytes[i] = data[at++];
    bench->master.receive(own);
  }
  return 0;
}
