// GeneratorSettings: the settings that the reference generators of all spaces have in common.
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/streams/generator_streams.hpp"

namespace tactus {

struct GeneratorSettings {
  OnlineMode online = OnlineMode::kLimit;
  OnlyWithStreams<PointBounds> bounds{};
  double timeout_ms = 0.0;  ///< longest silence of a stream of online points; 0: no limit
  double stopped_velocity =
      0.01;                   ///< at the goal: rad/s of each joint, m/s of the tip; 0: not checked
  double dwell_ms = 0.0;      ///< time for which the goal must be kept
  double goal_time_s = 10.0;  ///< time after the last waypoint in which it must be reached
  int latency_cycles = 0;     ///< of the measured motion; 0: measured in the next cycle
  int feedback_divisor = 10;  ///< cycles between two messages of feedback; 0: none

  template <class Visitor>
  void describe(Visitor& visit, const char* unit, const char* velocity_unit) {
    visit.choice("online", online);
    describe_bounds(visit, bounds, unit, velocity_unit);
    visit.param("timeout_ms", timeout_ms, kNonNegative, "ms");
    visit.param("stopped_velocity", stopped_velocity, kNonNegative, velocity_unit);
    visit.param("dwell_ms", dwell_ms, kNonNegative, "ms");
    visit.param("goal_time_s", goal_time_s, kNonNegative, "s");
    visit.param("latency_cycles", latency_cycles, Range{0.0, kMaxLatencyCycles}, "cycles");
    visit.param("feedback_divisor", feedback_divisor, Range{0.0, 100000.0}, "cycles");
  }

  template <class Visitor, class Bounds>
  static void describe_bounds(Visitor& visit, Bounds& bounds, const char* unit,
                              const char* velocity_unit) {
    if constexpr (kStreams) {
      visit.param("max_step", bounds.max_step, kNonNegative, unit);
      visit.param("approach_speed", bounds.approach_speed, kNonNegative, velocity_unit);
    }
  }

  /// Returns the generator's parameters; the block sets the tolerances of its space. [init]
  template <class Space>
  typename ReferenceGenerator<Space>::Params params() const {
    typename ReferenceGenerator<Space>::Params params;
    params.online = online;
    params.bounds = bounds;
    params.timeout_s = timeout_ms * 1e-3;
    params.latency_cycles = latency_cycles;
    params.feedback_divisor = feedback_divisor;
    params.tolerances.stopped_velocity = stopped_velocity;
    params.tolerances.dwell_s = dwell_ms * 1e-3;
    params.tolerances.goal_time_s = goal_time_s;
    return params;
  }
};

}  // namespace tactus
