// Generators with their clients, for the tests of feedback.
#pragma once

#include "gateway/reference_client.hpp"
#include "kernel/reference/blocks/joint_reference_generator.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr double kPeriod_s = 1e-3;

/// A generator's block with its client and the measured values.
template <class Space, class Generator>
struct Bench {
  ChannelMemory<Space> channel;
  ReferenceClient<Space> client{channel};
  std::array<std::array<Waypoint<Space>, 4>, kStores> waypoints;
  Generator block;
  typename Space::Point measured;
  std::uint32_t id = 0;

  explicit Bench(int divisor) {
    channel.settings.period_s = kPeriod_s;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = 4;
    }
    block.channel = &channel;
    block.params.generator.feedback_divisor = divisor;
    block.params.generator.stopped_velocity = 0.0;
    block.params.generator.online = OnlineMode::kForward;
  }
  void run(int cycles) {
    for (int k = 0; k < cycles; ++k) assert_true(block.step(kPeriod_s) == Status::kOk);
  }
  /// Returns the only message that waits.
  Feedback<Space> only() {
    Feedback<Space> message, second;
    assert_true(client.poll_feedback(message) && !client.poll_feedback(second));
    return message;
  }
  bool send(const typename Space::Point& goal, double time_s) {
    Trajectory<Space>& motion = *client.acquire();
    motion.count = 1;
    motion.fields = kVelocityField | kAccelerationField;
    motion.waypoints[0] = {time_s, goal};
    return client.send(motion, id).ok();
  }
};

struct JointBench : Bench<JointSpace, JointReferenceGenerator> {
  explicit JointBench(int divisor) : Bench(divisor) {
    const JointLimits limits;
    measured.q = 0.5 * (limits.q_min + limits.q_max);
    block.q.source = &measured.q;
  }
  JointSpace::Point out() const {
    return {block.q_d.value, block.dq_d.value, block.ddq_d.value, block.tau_d.value};
  }
};

}  // namespace tactus
