// ClockSetup: sets the distributed clocks of a segment (IEC 61158-4-12). The clock of the first
// slave is the reference; the others get their offset to it and the delay of the line, and then
// follow it. Then SYNC0 is started in every slave if the file requests it. Single datagrams; frames
// in, frames out, time passed in.
#pragma once

#include "hal/ethercat/ethercat_settings.hpp"
#include "hal/ethercat/slave.hpp"

namespace tactus::ethercat {

class ClockSetup {
 public:
  ClockSetup(SlaveLine& line, Message& why) : line_(line), why_(why) {}

  /// Forgets what is known of the slaves. [init]
  void reset(const EthercatSettings& ethercat, int period_us);
  /// Judges the features of the slave at a place of the line. kRefusedByRobot: SYNC0 needs a clock
  /// that it does not have. [init]
  Status judge(int place);
  /// True if all slaves judged so far have a clock. [any]
  bool all_have_clocks() const { return all_have_clocks_; }

  /// Begins, after all slaves were judged. [init]
  void begin(std::int64_t now_ns) { enter(Stage::kLatch, now_ns); }
  Request request() const;
  /// Takes the answer to request(). kArming: there is more to do. kBusTimeout, kRefusedByRobot:
  /// `why` has the slave and the reason. [init]
  Status take(const Answer& answer, std::int64_t now_ns);

  /// With SYNC0: a reference time from which frames are to be sent whole periods apart, ns. [any]
  std::int64_t phase_ns() const { return phase_ns_; }
  /// Reference time of the first SYNC0 of the slave that was started last, ns. [init]
  std::int64_t sync0_ns() const { return start_ns_; }
  /// With SYNC0: the largest distance of a clock to that of the first slave after they have been
  /// steered, ns. [any]
  std::int64_t apart_ns() const { return apart_ns_; }

 private:
  enum class Stage : std::uint8_t { kLatch, kTimes, kOffsets, kFilter, kSteer, kSync0, kDone };

  void enter(Stage stage, std::int64_t now_ns);
  void next_slave(Stage then, std::int64_t now_ns);
  Status take_times(const Answer& answer, std::int64_t now_ns);
  void set_delays();
  Request sync0_request() const;
  Status take_sync0(const Answer& answer, std::int64_t now_ns);
  Status judge_difference(std::uint32_t shown, std::int64_t now_ns);
  Status judge_start(std::int64_t reference_ns, std::int64_t now_ns);
  void plan_start(std::int64_t reference_ns);
  Status refuse(Status status, std::string_view what);
  const Slave& at() const { return line_.at(place_); }

  SlaveLine& line_;
  Message& why_;
  const EthercatSettings* ethercat_ = nullptr;
  int period_us_ = 1;
  bool all_have_clocks_ = true;
  Stage stage_ = Stage::kDone;
  int place_ = 0, step_ = 0, attempts_ = 0;
  std::int64_t since_ns_ = 0;  // in this stage, with this slave
  std::int64_t phase_ns_ = 0, apart_ns_ = 0;
  std::int64_t start_ns_ = 0;  // of SYNC0 of the present slave
};

}  // namespace tactus::ethercat
