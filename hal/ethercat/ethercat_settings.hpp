// EthercatSettings: the [ethercat] section of a pipeline file, the segment and the slaves of the
// drives.
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/load_error.hpp"
#include "kernel/core/types.hpp"

namespace tactus::ethercat {

struct EthercatSettings {
  static constexpr const char* kSection = "ethercat";  ///< of the pipeline file

  Value interface;                                      ///< must be given
  JointVector slave = JointVector::LinSpaced(1, kDof);  ///< place in the line of each joint's drive
  int connect_ms = 30000;                               ///< longest time of the whole start-up
  int state_ms = 5000;      ///< longest time until a slave is in a state
  int sdo_ms = 1000;        ///< longest time for an answer to an SDO request
  int clock_frames = 4000;  ///< that the clocks are steered by before the first cycle
  /// After which a drive without frames leaves operation; 0: ten periods.
  int watchdog_ms = 0;
  /// Longest time that a cycle waits for its frame, beyond its beginning; 0: it does not. With it
  /// the cycles are a period apart by their stamps, however long they take: for an emulated
  /// segment.
  int frame_wait_ms = 0;
  /// Delay of SYNC0 after the moment at which frames are sent; -1: there is none, and the
  /// drives are synchronized by the frame.
  int sync0_us = -1;
  double vendor = 0, product = 0;  ///< 1018h:1 and :2 of every drive; 0: any

  /// Time-out of the process data, ms. [init]
  int timeout_ms(int period_us) const {
    return watchdog_ms > 0 ? watchdog_ms : (10 * period_us + 999) / 1000;
  }

  bool has_sync0() const { return sync0_us >= 0; }

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.text("interface", interface, "the network interface, as `ip link` shows it");
    visit.param("slave", slave, Range{1.0, double{kDof}}, "1");
    visit.param("connect_ms", connect_ms, Range{10.0, 120000.0}, "ms");
    visit.param("state_ms", state_ms, Range{10.0, 60000.0}, "ms");
    visit.param("sdo_ms", sdo_ms, Range{1.0, 10000.0}, "ms");
    visit.param("clock_frames", clock_frames, Range{0.0, 100000.0}, "1");
    visit.param("watchdog_ms", watchdog_ms, Range{0.0, 6000.0}, "ms");
    visit.param("frame_wait_ms", frame_wait_ms, Range{0.0, 1000.0}, "ms");
    visit.param("sync0_us", sync0_us, Range{-1.0, 1000000.0}, "us");
    visit.param("vendor", vendor, Range{0.0, 4294967295.0}, "1");
    visit.param("product", product, Range{0.0, 4294967295.0}, "1");
  }
};

}  // namespace tactus::ethercat
