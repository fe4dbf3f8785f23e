// approach_speed: points and chunks that begin anew, of a leader that may be far from the arm. And
// whose points they are. Every cycle is judged by the oracle of motions as well.
#include "tests/reference/motion/checked_motion.hpp"
#include "tests/streams/chunk_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

constexpr double kSpeed = 0.2, kPeriod_s = 0.01;

double fastest(const JointSpace::Point& point) {
  return point.dq.cwiseAbs().maxCoeff();
}
double fastest(const TaskSpace::Point& point) {
  return std::max(point.v.head<3>().norm(), point.v.tail<3>().norm());
}

/// A leader that begins far away and is slower than the approach for `slow_s`, then faster.
struct Leader {
  double distance, slow_s;
  double x(double t) const {
    const double late = std::max(t - slow_s, 0.0);
    return distance + 0.05 * (1.0 - std::cos(1.5 * t)) + 0.1 * (1.0 - std::cos(5.0 * late));
  }
};

template <class Space>
struct Follower : CheckedMotion<Space> {
  Chunk<Space>& chunk = storage();

  Follower() {
    this->params.bounds.approach_speed = kSpeed;
    ASSERT_OK(this->start(this->home));
    chunk = {};
  }
  static Chunk<Space>& storage() {
    static Chunk<Space> chunk;
    return chunk;
  }
  /// Sends where the leader is, or, every tenth time, where it will be.
  void send_of(const Leader& leader, bool chunks, int k) {
    const double now_s = k * kPeriod_s;
    if (!chunks) {
      assert_int_not_equal(this->send(moved_by(this->home, leader.x(now_s))), 0);
    } else if (k % 10 == 0) {
      chunk.count = 0;
      ++chunk.sequence;
      for (int i = 1; i <= 10; ++i)
        chunk.add(this->generator.time_s() + 0.03 * i,
                  moved_by(this->home, leader.x(now_s + 0.03 * i)));
      std::uint32_t id = 0;
      ASSERT_OK(this->client.send(chunk, id).status);
    }
  }
  /// Largest velocity while following the leader from one time to another.
  double follow(const Leader& leader, bool chunks, double from_s, double to_s) {
    double most = 0.0;
    for (int k = static_cast<int>(from_s / kPeriod_s); k < static_cast<int>(to_s / kPeriod_s);
         ++k) {
      send_of(leader, chunks, k);
      for (int i = this->cycles(kPeriod_s); i > 0; --i) {
        this->cycle();
        most = std::max(most, fastest(this->out()));
      }
      this->report_of(0);
    }
    return most;
  }
};

template <class Space>
void is_joined_slowly_and_then_followed(const Leader& leader, bool chunks) {
  Follower<Space> arm;
  const double near_s = 0.5 * leader.distance / kSpeed, joined_s = leader.slow_s - 0.2;
  const double on_the_way = arm.follow(leader, chunks, 0.0, near_s);
  assert_true(on_the_way <= kSpeed * (1.0 + 1e-9) && on_the_way >= 0.99 * kSpeed);
  arm.follow(leader, chunks, near_s, joined_s);
  const double behind = leader.x(joined_s) - way(arm.out(), arm.home);
  assert_true(std::abs(behind) <= 0.01);
  assert_true(arm.follow(leader, chunks, joined_s, leader.slow_s + 2.0) >= 2.0 * kSpeed);

  arm.run(0.5);  // of silence
  const auto far = moved_by(arm.home, -0.2);
  assert_int_not_equal(arm.send(far), 0);
  const double rests_s = 0.3 + (way(arm.out(), arm.home) + 0.2) / kSpeed + 1.0;
  double most = 0.0;
  for (int k = arm.cycles(rests_s); k > 0; --k) {
    arm.cycle();
    most = std::max(most, fastest(arm.out()));
  }
  assert_true(most <= kSpeed * (1.0 + 1e-9));
  ASSERT_NEAR(Space::difference(arm.out(), far).x.norm(), 0.0, 1e-9);
}

// Proves RG-36.

void what_begins_anew_is_joined_slowly_and_then_followed(void**) {
  Random random{36};
  for (int trial = trials(10); trial > 0; --trial) {
    const double distance = random.uniform(0.2, 0.5);
    const Leader leader = {distance, distance / 0.1 + 2.0};
    for (const bool chunks : {false, true}) {
      is_joined_slowly_and_then_followed<JointSpace>(leader, chunks);
      is_joined_slowly_and_then_followed<TaskSpace>(leader, chunks);
    }
  }
}

/// A leader that is always faster is not joined: the reference stays slow, and reaches it where it
/// rests.
void a_leader_that_is_too_fast_is_joined_when_it_rests(void**) {
  Follower<JointSpace> arm;
  JointSpace::Point last;
  double most = 0.0;
  for (int k = 0; k < 300; ++k) {
    last = moved_by(arm.home, 0.6 + 0.3 * std::sin(6.0 * kPeriod_s * k));
    assert_int_not_equal(arm.send(last), 0);
    for (int i = arm.cycles(kPeriod_s); i > 0; --i) {
      arm.cycle();
      if (k < 100) most = std::max(most, fastest(arm.out()));
    }
    arm.report_of(0);
  }
  assert_true(most <= kSpeed * (1.0 + 1e-9));
  arm.run(4.0);
  ASSERT_NEAR(JointSpace::difference(arm.out(), last).x.norm(), 0.0, 1e-9);
}

/// A policy that begins almost where the arm is, and is fast, is not held back.
void who_begins_near_is_followed_at_once(void**) {
  for (const bool chunks : {false, true}) {
    Follower<JointSpace> joints;
    Follower<TaskSpace> tip;
    const Leader leader = {0.004, 0.0};
    assert_true(joints.follow(leader, chunks, 0.0, 0.5) >= 2.0 * kSpeed);
    assert_true(tip.follow(leader, chunks, 0.0, 0.5) >= 2.0 * kSpeed);
  }
}

template <class Space>
void send_from(CheckedMotion<Space>& bench, std::uint64_t sender, double x, double speed) {
  typename Space::Point point = moved_by(bench.home, x);
  Space::rates(point)[1] = speed;
  PointDetails details;
  details.sender = sender;
  std::uint32_t id = 0;
  ASSERT_OK(bench.client.send(point, id, {}, details).status);
}

/// A point of another sender moves the reference as one that follows a cancel does.
template <class Space>
void begins_anew_for_another_sender() {
  CheckedMotion<Space> taken, canceled;
  for (CheckedMotion<Space>* bench : {&taken, &canceled}) {
    ASSERT_OK(bench->start(bench->home));
    for (int k = 0; k < 20; ++k) {
      send_from(*bench, 1, 0.002 * k, 0.2);
      bench->run(kPeriod_s);
      bench->report_of(0);
    }
  }
  std::uint32_t id = 0;
  ASSERT_OK(canceled.client.cancel(id).status);
  send_from(canceled, 1, 0.1, -0.1);
  send_from(taken, 2, 0.1, -0.1);
  for (int k = 0; k < 600; ++k) {
    canceled.cycle();
    taken.cycle();
    ASSERT_NEAR(Space::difference(taken.out(), canceled.out()).x.norm(), 0.0, 1e-12);
  }
}

// Proves RG-37.

void a_point_of_another_sender_begins_anew(void**) {
  begins_anew_for_another_sender<JointSpace>();
  begins_anew_for_another_sender<TaskSpace>();
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_begins_anew_is_joined_slowly_and_then_followed),
      cmocka_unit_test(a_leader_that_is_too_fast_is_joined_when_it_rests),
      cmocka_unit_test(who_begins_near_is_followed_at_once),
      cmocka_unit_test(a_point_of_another_sender_begins_anew),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
