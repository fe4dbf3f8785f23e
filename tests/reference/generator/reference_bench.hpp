// ReferenceBench: the bench of the generator's tests, for joints at 1 ms with points as they come,
// in offsets from home.
#pragma once

#include "tests/reference/motion/motion_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus {

struct ReferenceBench : MotionBench<JointSpace, 64> {
  static constexpr double kPeriod_s = 1e-3;

  ReferenceBench() : MotionBench(kPeriod_s, OnlineMode::kForward, kVelocityField) {}

  using MotionBench::start;
  Status start(const JointVector& q) {
    JointSpace::Point measured;
    measured.q = q;
    return start(measured);
  }
  using MotionBench::add;
  /// Appends a waypoint at `offset` rad from home on every joint.
  void add(Trajectory<JointSpace>& trajectory, double time_s, double offset, double dq = 0.0) {
    JointSpace::Point point;
    point.q = home.q + JointVector::Constant(offset);
    point.dq = JointVector::Constant(dq);
    add(trajectory, time_s, point);
  }
  /// Sends one segment from the present reference to `offset` in `time_s`.
  std::uint32_t go(double offset, double time_s, Fields fields) {
    Trajectory<JointSpace>* motion = trajectory(fields);
    add(*motion, time_s, offset);
    return send(*motion);
  }
  /// Steps up to n cycles; stops at the first that is not kOk and returns its Status.
  Status run(int cycles) {
    for (int k = 0; k < cycles; ++k) TRY(step());
    return Status::kOk;
  }
  /// Takes every report there is and returns the final one of request `id`; its outcome is kStarted
  /// if there is none yet.
  Report final_of(std::uint32_t id) {
    Report found, report;
    found.outcome = Outcome::kStarted;
    while (client.poll(report)) {
      if (report.id == id && report.outcome != Outcome::kStarted) found = report;
    }
    return found;
  }
};

}  // namespace tactus
