// Tests the collision check against FCL on poses by KDL: a pair within the margin is reported, a
// distant pair is not, and the prediction covers every motion the joints can make until they rest.
#include "tests/guard/collision_bench.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// A bench for one test.
CollisionBench& fresh() {
  static std::array<CollisionBench, 4> benches;
  static std::size_t used = 0;
  return benches.at(used++);
}

bool reported(const CollisionBench& bench, const Nearest& nearest) {
  const Collision::Telemetry& told = bench.collision.telemetry();
  return bench.body(told.first) == nearest.first && bench.body(told.second) == nearest.second;
}

// Proves COL-1, COL-2.

/// FCL's distance of a box is good to 0.1 mm.
void at_rest_a_contact_is_what_is_nearer_than_the_margin(void**) {
  CollisionBench& bench = fresh();
  bench.start();
  RandomStates states;
  int near = 0, far = 0, open = 0, named = 0;
  for (int i = 0; i < 2000; ++i) {
    states.next();
    const Nearest nearest = bench.nearest(states.q);
    const Status status = bench.check(states.q, JointVector::Zero());
    const Collision::Telemetry& told = bench.collision.telemetry();
    const bool contact = status == Status::kCollision && !told.predicted;
    if (nearest.distance <= bench.section.margin) {
      assert_true(contact);
      ++near;
      named += reported(bench, nearest);
    } else if (nearest.distance > bench.section.margin + 1e-4) {
      assert_false(contact);
      ++far;
    } else {
      ++open;
    }
  }
  print_message("%d near, of which the nearest pair is named %d times; %d far, %d open\n", near,
                named, far, open);
  assert_true(near > 200 && far > 200 && open < 10 && named > near / 3);
}

/// Moves `near` and `far` together, to either side of the state whose nearest pair is `distance`
/// apart.
void close_in(const CollisionBench& bench, double distance, JointVector& near, JointVector& far) {
  for (int k = 0; k < 24; ++k) {
    const JointVector middle = 0.5 * (near + far);
    (bench.nearest(middle).distance > distance ? far : near) = middle;
  }
}

void the_border_of_the_margin_is_sharp(void**) {
  CollisionBench& bench = fresh();
  bench.start();
  RandomStates states;
  const double margin = bench.section.margin, clear = margin + 1e-4;
  int borders = 0;
  for (int i = 0; i < 400 && borders < 60; ++i) {
    states.next();
    JointVector near = states.q, hit = near;
    states.next();
    JointVector far = states.q, out = far;
    if (bench.nearest(near).distance > margin || bench.nearest(far).distance <= clear) continue;
    ++borders;
    close_in(bench, margin, near, far);
    ASSERT_STATUS(bench.check(near, JointVector::Zero()), Status::kCollision);
    assert_false(bench.collision.telemetry().predicted);
    close_in(bench, clear, hit, out);
    const Status status = bench.check(out, JointVector::Zero());
    assert_true(status == Status::kOk || bench.collision.telemetry().predicted);
  }
  assert_true(borders > 20);
}

// Proves COL-3.

/// One of the motions that the guarantee covers. Until braking begins, any acceleration within
/// limits, new in every step or held; then every joint at a speed between its own ramp and the
/// common one.
struct Stop {
  const CollisionBench& bench;
  std::mt19937_64& random;
  JointVector q, dq;
  double reaction_s, step_s;

  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  void react() {
    const bool held = unit() > 0.0;
    JointVector ddq = JointVector::Zero();
    for (int k = 0; k < std::lround(reaction_s / step_s); ++k) {
      for (int i = 0; i < kDof && (k == 0 || !held); ++i)
        ddq[i] = bench.limits.ddq_max[i] * (held ? std::copysign(1.0, unit()) : unit());
      q += step_s * dq + 0.5 * step_s * step_s * ddq;
      dq += step_s * ddq;
    }
  }
  /// Beyond the mechanical stops, where pairs meet that never can.
  static bool impossible(const JointVector& q) {
    for (int i = 0; i < kDof; ++i) {
      const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(i)];
      if (q[i] < limit.q_min - 0.05 || q[i] > limit.q_max + 0.05) return true;
    }
    return false;
  }
  /// The nearest distance until rest, or until a mechanical stop, at `samples` instants.
  double nearest_until_rest(int samples) {
    const JointVector own_s = dq.cwiseAbs().cwiseQuotient(bench.section.braking);
    const double all_s = own_s.maxCoeff();
    JointVector share;  // the common ramp's share of the speed
    for (int i = 0; i < kDof; ++i) share[i] = std::clamp(2.0 * unit(), 0.0, 1.0);
    double least = 1e9;
    for (int k = 0; k <= samples; ++k) {
      const double s = all_s * k / samples;
      JointVector now = q;
      for (int i = 0; i < kDof && all_s > 0.0; ++i) {
        const double own = std::min(s, own_s[i]);
        now[i] +=
            share[i] * dq[i] * (s - s * s / (2.0 * all_s)) +
            (1.0 - share[i]) *
                (dq[i] * own - 0.5 * own * own * std::copysign(bench.section.braking[i], dq[i]));
      }
      if (impossible(now)) break;
      least = std::min(least, bench.nearest(now).distance);
    }
    return least;
  }
};

void a_contact_on_the_way_to_rest_was_said_before(void**) {
  CollisionBench& bench = fresh();
  bench.section.delay_s = 0.003;
  bench.start();
  RandomStates states;
  const double reaction_s = 4 * CollisionBench::kPeriod_s + 0.003, margin = bench.section.margin;
  int contacts = 0, predicted = 0;
  for (int i = 0; i < 4000; ++i) {
    states.next();
    const double speed = 0.3 + 0.7 * (i % 8) / 7.0;
    const Status status = bench.check(states.q, speed * states.dq);
    if (status == Status::kCollision && !bench.collision.telemetry().predicted) continue;
    predicted += status == Status::kCollision;
    Stop stop{bench, states.random, states.q, speed * states.dq, reaction_s, 0.001};
    stop.react();
    if (stop.nearest_until_rest(8) > margin) continue;
    ++contacts;
    ASSERT_STATUS(status, Status::kCollision);
  }
  print_message("%d contacts on the way, %d predicted\n", contacts, predicted);
  assert_true(contacts > 25);
}

/// A contact is reported too early by no more than the thickening of the pair, on both sides.
void what_is_predicted_is_near_the_way(void**) {
  CollisionBench& bench = fresh();
  bench.start();
  RandomStates states;
  int predicted = 0;
  for (int i = 0; i < 600; ++i) {
    states.next();
    const Status status = bench.check(states.q, 0.6 * states.dq);
    const Collision::Telemetry told = bench.collision.telemetry();
    if (status == Status::kOk || !told.predicted) continue;
    ++predicted;
    Stop stop{bench, states.random, states.q, 0.6 * states.dq, 0.004, 0.001};
    stop.q += 0.004 * stop.dq;
    const double on_the_way =
        std::min(bench.nearest(states.q).distance, stop.nearest_until_rest(12));
    assert_true(on_the_way <= bench.section.margin + 2.0 * told.sweep_m);
  }
  print_message("%d predicted\n", predicted);
  assert_true(predicted > 20);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(at_rest_a_contact_is_what_is_nearer_than_the_margin),
      cmocka_unit_test(the_border_of_the_margin_is_sharp),
      cmocka_unit_test(a_contact_on_the_way_to_rest_was_said_before),
      cmocka_unit_test(what_is_predicted_is_near_the_way),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
