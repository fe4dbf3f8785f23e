// The bench of the generator's tests: a reference generator with its client and stores, and a
// record of its output.
#pragma once

#include <array>

#include "gateway/reference_client.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/streams/generator_streams.hpp"
#include "tests/support/middle_of_range.hpp"
#include "tests/support/random.hpp"

namespace tactus {

struct ReferenceBench {
  static constexpr int kWaypoints = 64;
  static constexpr double kPeriod_s = 1e-3;

  ChannelMemory<JointSpace> channel;
  std::array<std::array<Waypoint<JointSpace>, kWaypoints>, kStores> waypoints;
  ReferenceClient<JointSpace> client{channel};
  ReferenceGenerator<JointSpace> generator;
  ReferenceGenerator<JointSpace>::Params params;
  JointVector home = middle_of_range();

  ReferenceBench() {
    channel.settings.period_s = kPeriod_s;
    params.measured = kVelocityField;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = kWaypoints;
    }
    static_cast<void>(start(home));
  }
  Status start(const JointVector& q) {
    JointSpace::Point measured;
    measured.q = q;
    return generator.start(channel, params, measured);
  }
  /// Steps one cycle of a robot that is where the reference was, or where the test says it is.
  Status step(double dt_s = kPeriod_s) { return generator.step(dt_s, out()); }
  Status step_measured(const JointSpace::Point& measured) {
    return generator.step(kPeriod_s, measured);
  }
  const JointSpace::Point& out() const { return generator.reference(); }

  /// Returns an empty trajectory that gives `fields` at each waypoint; null if no store is free.
  Trajectory<JointSpace>* trajectory(Fields fields) {
    Trajectory<JointSpace>* empty = client.acquire();
    if (empty == nullptr) return nullptr;
    empty->count = 0;
    empty->fields = fields;
    empty->interpolation = Interpolation::kByFields;
    empty->header = {};
    empty->start_s = kStartAtOnce;
    return empty;
  }
  /// Appends a waypoint at `offset` rad from home on every joint.
  void add(Trajectory<JointSpace>& trajectory, double time_s, double offset, double dq = 0.0) {
    Waypoint<JointSpace>& waypoint = trajectory.waypoints[trajectory.count++];
    waypoint = {};
    waypoint.time_s = time_s;
    waypoint.point.q = home + JointVector::Constant(offset);
    waypoint.point.dq = JointVector::Constant(dq);
  }
  /// Sends one segment from the present reference to `offset` in `time_s`.
  std::uint32_t go(double offset, double time_s, Fields fields) {
    Trajectory<JointSpace>* motion = trajectory(fields);
    add(*motion, time_s, offset);
    std::uint32_t id = 0;
    return client.send(*motion, id).ok() ? id : 0;
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
