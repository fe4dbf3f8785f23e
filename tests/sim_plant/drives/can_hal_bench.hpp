// The FER on CAN with its sockets and without a clock: executive, pipeline and CanHal at one end of
// a packet socket pair for every bus, the emulated drives at the other, in lock step. Only while
// the Hal connects, which waits for answers, the drives run in a thread and in real time.
#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <optional>
#include <thread>

#include "hal/can/can_hal.hpp"
#include "hal/net/deadline.hpp"
#include "sim_plant/drives/drive_arm.hpp"
#include "sim_plant/drives/server/bus_socket.hpp"
#include "tests/hal/cia402/loop_bench.hpp"

namespace tactus::can {

struct CanHalBench : cia402::LoopRig {
  static constexpr std::int64_t kPeriod_ns = 1'000'000;

  CanSettings can;
  cia402::Cia402Settings drive;
  drives::DriveArm arm;
  std::array<std::optional<drives::BusSocket>, kMaxBuses> ends;  ///< of the drives
  std::array<int, kMaxBuses> descriptors{-1, -1, -1, -1};        ///< of the Hal
  CanHal hal;
  Executive executive{hal, pipeline};
  std::int64_t now_ns = -kPeriod_ns, drives_ns = 0;
  std::vector<CanFrame> sent;  ///< by the Hal in the last cycle, of all buses
  std::vector<CanFrame> log;   ///< by the Hal since the test emptied it
  std::array<int, kMaxBuses> syncs{};
  bool (*passes)(CanFrame& answer) = nullptr;  ///< what the wire does to a frame of a drive

  CanHalBench(const CanHalBench&) = delete;
  CanHalBench& operator=(const CanHalBench&) = delete;
  /// One bus: CAN FD with packed commands; three: classic frames with plain ones.
  explicit CanHalBench(int buses) {
    can.frames = buses == 1 ? Frames::kFd : Frames::kClassic;
    can.commands = buses == 1 ? Commands::kPacked : Commands::kPlain;
    if (buses == 3) can.bus << 1, 1, 1, 2, 2, 3, 3;
    drive.rated_torque << 3.0, 3.0, 3.0, 3.0, 0.5, 0.5, 0.5;
    for (int bus = 0; bus < buses; ++bus) open(static_cast<std::size_t>(bus));
  }

  Status load() {
    TRY(LoopRig::load(cia402::kHoldingPipeline, hal.capabilities()));
    TRY(hal.configure(can, drive, Tool{}, pipeline.robot.mode(), pipeline.robot.period_us,
                      pipeline.executive.arming_ms));
    drives::DriveArmSettings plant;
    plant.plant.rotor_inertia.setConstant(0.1);
    plant.fd = can.frames == Frames::kFd;
    for (int j = 0; j < kDof; ++j)
      plant.joints[static_cast<std::size_t>(j)] = {static_cast<int>(can.bus[j]) - 1,
                                                   static_cast<int>(can.node[j])};
    return arm.load(plant, 0);
  }
  /// Connects while the drives answer.
  Status start() {
    Status status = Status::kOk;
    while_drives_answer([&] { status = executive.start(); });
    return status;
  }
  /// Runs what waits for the drives, which answer in a thread of their own by the wall clock.
  template <class Waits>
  void while_drives_answer(Waits waits) {
    std::atomic<bool> over{false};
    const std::int64_t began_ns = drives_ns;
    std::thread drives([&] {
      constexpr int kLongest_ms = 60'000;
      const Deadline clock(kLongest_ms);
      while (!over && clock.left_ns() > 0) {
        drives_ns = began_ns + std::int64_t{1'000'000} * kLongest_ms - clock.left_ns();
        exchange();
        usleep(100);
      }
    });
    waits();
    over = true;
    drives.join();
  }
  /// The drives take what has been sent to them and answer it.
  void exchange() {
    sent.clear();
    for (std::size_t bus = 0; bus < ends.size(); ++bus) {
      CanFrame frame;
      while (ends[bus] && ends[bus]->descriptor() >= 0 && ends[bus]->receive(frame)) {
        sent.push_back(frame);
        log.push_back(frame);
        syncs[bus] += frame.id == kSyncId ? 1 : 0;
        arm.receive(bus, frame, drives_ns);
      }
    }
    arm.advance(drives_ns);
    for (std::size_t bus = 0; bus < ends.size(); ++bus) {
      CanFrame frame;
      while (arm.take(bus, frame))
        if ((passes == nullptr || passes(frame)) && ends[bus] && ends[bus]->descriptor() >= 0)
          ends[bus]->send(frame);
    }
  }
  Status cycle() {
    drives_ns += kPeriod_ns;
    exchange();
    return executive.cycle({now_ns += kPeriod_ns});
  }
  /// Takes the drives over.
  Status arm_drives() {
    Status status = executive.arm();
    while (status == Status::kArming) {
      status = cycle();
      if (status == Status::kArming) status = executive.arm();
    }
    return status;
  }

 private:
  void open(std::size_t bus) {
    int pair[2] = {-1, -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, pair) != 0) return;
    descriptors[bus] = pair[0];
    ends[bus].emplace().adopt(pair[1]);
    Value names = can.interfaces;
    names << (names.empty() ? "fd:" : " fd:") << pair[0];
    can.interfaces = names;
  }
};

}  // namespace tactus::can
