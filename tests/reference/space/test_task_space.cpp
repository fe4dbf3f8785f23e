// Segments of the tool tip: the values at their ends, exact derivatives, and no step or jump of the
// quaternion's sign between chained ones.
#include "kernel/reference/space/task_space.hpp"

#include "tests/reference/space/task_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kRate = 3.0;  ///< of the ends, in radians per duration about each axis

// Proves RG-2, RG-10.

void velocity_acceleration_and_wrench_rate_are_derivatives(void**) {
  over_task_ends(kRate, [](const TaskEnds& ends) {
    for (const Interpolation how : kJoins) {
      const TaskSegment segment = ends.join(how);
      const double fast = fastest(segment), margin = 0.2 / fast;
      for (const double share : {0.01, 0.2, 0.37, 0.5, 0.71, 0.99}) {
        const double t = margin + share * (ends.T - 2.0 * margin);
        assert_derivatives([&](double dt) { return segment.at(t + dt); }, fast);
      }
    }
  });
}

void both_ends_are_met_in_all_that_the_order_joins(void**) {
  over_task_ends(kRate, [](const TaskEnds& ends) {
    for (const Interpolation how : kJoins) {
      const TaskSegment segment = ends.join(how);
      for (const bool last : {false, true}) {
        const TaskPoint now = segment.at(last ? ends.T : 0.0);
        const TaskPoint& end = last ? ends.to : ends.from;
        assert_close(now.x.p, end.x.p, 1e-12);
        ASSERT_NEAR(angle_between(now.x.r, end.x.r), 0.0, 1e-12);
        ASSERT_NEAR((now.h - end.h).norm(), 0.0, 1e-12);
        if (how != Interpolation::kLinear) ASSERT_NEAR((now.v - end.v).norm() * ends.T, 0.0, 1e-10);
        if (how == Interpolation::kQuintic)
          ASSERT_NEAR((now.a - end.a).norm() * ends.T * ends.T, 0.0, 1e-9);
      }
    }
  });
}

void linear_is_a_straight_line_and_slerp(void**) {
  over_task_ends(kRate, [](const TaskEnds& ends) {
    const TaskSegment segment = ends.join(Interpolation::kLinear);
    const Vector3 way = ends.to.x.p - ends.from.x.p;
    const bool one_way = angle_between(ends.from.x.r, ends.to.x.r) < kPi - 1e-6;
    for (double share = 0.0; share <= 1.0; share += 0.125) {
      const TaskPoint now = segment.at(share * ends.T);
      assert_close(now.x.p, ends.from.x.p + share * way, 1e-14);
      assert_close(now.v.head<3>(), way / ends.T, 1e-14 / ends.T);
      assert_true(now.a.head<3>().isZero(0.0));
      if (one_way)  // for half a turn both directions are right
        ASSERT_NEAR(angle_between(now.x.r, ends.from.x.r.slerp(share, ends.to.x.r)), 0.0, 3e-15);
    }
  });
}

void the_fields_decide_unless_the_order_is_forced(void**) {
  RandomVectors random;
  const TaskEnds ends = task_ends(random, 7, kRate);
  const auto same = [&](Fields fields, Interpolation how) {
    const TaskSegment by_fields(ends.from, ends.to, ends.T, Interpolation::kByFields, fields);
    const TaskPoint a = by_fields.at(0.3 * ends.T), b = ends.join(how).at(0.3 * ends.T);
    return a.x.p == b.x.p && a.x.r.coeffs() == b.x.r.coeffs() && a.v == b.v && a.a == b.a;
  };
  assert_true(same(0, Interpolation::kLinear));
  assert_true(same(kEffortField, Interpolation::kLinear));
  assert_true(same(kVelocityField, Interpolation::kCubic));
  assert_true(same(kVelocityField | kAccelerationField, Interpolation::kQuintic));
}

void a_corner_leaves_out_what_steps_by_nature(void**) {
  RandomVectors random;
  const TaskEnds ends = task_ends(random, 7, kRate);
  const TaskPoint line = ends.join(Interpolation::kLinear).corner();
  assert_true(line.standing() && line.h == ends.from.h);
  const TaskPoint bend = ends.join(Interpolation::kCubic).corner();
  ASSERT_NEAR((bend.v - ends.from.v).norm() * ends.T, 0.0, 1e-12);
  assert_true(bend.a.isZero(0.0));
  const TaskPoint smooth = ends.join(Interpolation::kQuintic).corner();
  ASSERT_NEAR((smooth.a - ends.from.a).norm() * ends.T * ends.T, 0.0, 1e-11);
}

/// Walks along 20 waypoints whose quaternions have random signs. With `follow` each segment begins
/// where the previous one ended; else it begins at the waypoint, and unit_beside() keeps the sign.
void walk(Interpolation how, bool follow) {
  RandomVectors random;
  TaskPoint from = task_ends(random, 7, kRate).from;
  Eigen::Quaterniond last = from.x.r;
  TaskPoint end = from;
  for (int i = 0; i < 20; ++i) {
    TaskPoint to = task_ends(random, 7, kRate).to;
    if (random.unit() > 0.0) to.x.r = negative(to.x.r);
    const TaskSegment segment(from, to, 1.0, how, 0);
    const TaskPoint begin = segment.at(0.0);
    assert_close(begin.x.p, end.x.p, 1e-12);
    if (how != Interpolation::kLinear && i > 0) ASSERT_NEAR((begin.v - end.v).norm(), 0.0, 1e-9);
    if (how == Interpolation::kQuintic && i > 0) ASSERT_NEAR((begin.a - end.a).norm(), 0.0, 1e-8);
    for (int k = 0; k <= 400; ++k) {
      const Eigen::Quaterniond raw = segment.at(k / 400.0).x.r;
      const Eigen::Quaterniond r = follow ? raw : unit_beside(raw, last);
      ASSERT_NEAR(r.norm(), 1.0, 3e-15);
      assert_true(r.dot(last) > 0.9);
      last = r;
    }
    end = segment.at(1.0);
    from = to;
    if (follow) from.x.r = end.x.r;
  }
}

void chained_segments_neither_step_nor_jump_their_sign(void**) {
  for (const Interpolation how : kJoins) {
    walk(how, true);
    walk(how, false);
  }
}

void a_quaternion_nearly_unit_is_used_as_a_unit_one(void**) {
  over_task_ends(kRate, [](const TaskEnds& ends) {
    TaskEnds off = ends;
    off.from.x.r.coeffs() *= 1.0 + 1e-3;
    off.to.x.r.coeffs() *= 1.0 - 1e-3;
    ASSERT_NEAR(off.from.at_rest().x.r.norm(), 1.0, 1e-15);
    const TaskPoint a = ends.join(Interpolation::kQuintic).at(0.4 * ends.T);
    const TaskPoint b = off.join(Interpolation::kQuintic).at(0.4 * ends.T);
    if (angle_between(ends.from.x.r, ends.to.x.r) < kPi - 1e-3) {
      ASSERT_NEAR(distance(a.x.r, b.x.r), 0.0, 1e-12);
      ASSERT_NEAR((a.a - b.a).norm() * ends.T * ends.T, 0.0, 1e-9);
    }
    const TaskPoint sum = TaskSpace::sum(off.from, TaskSpace::difference(off.to, off.from));
    ASSERT_NEAR(sum.x.r.norm(), 1.0, 1e-14);
    ASSERT_NEAR((sum.v - ends.to.v).norm() * ends.T, 0.0, 1e-11);
  });
}

void a_unit_quaternion_keeps_its_bits_beside_the_last(void**) {
  RandomVectors random;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond r = exp_so3(kPi * random.vector()), last(r * exp_so3(random.vector()));
    assert_true(unit_beside(r, last).coeffs() == r.coeffs());
    assert_true(unit_beside(negative(r), last).coeffs() == r.coeffs());
  }
  assert_true(std::isnan(unit_beside({NAN, 0.0, 0.0, 0.0}, kIdentity).w()));
}

// Proves RG-11.

void at_a_rate_the_motion_is_that_of_the_path_at_its_time(void**) {
  over_task_ends(kRate, [](const TaskEnds& ends) {
    const TaskSegment segment = ends.join(Interpolation::kQuintic);
    const double fast = fastest(segment);
    for (const double rate : {0.0, 0.3, 1.0}) {
      for (const double slope : {-0.4, 0.0, 0.7}) {
        const double dr = slope * fast, middle = 0.5 * ends.T;
        assert_derivatives(
            [&](double dt) {
              const double s = middle + dt * (rate + 0.5 * dt * dr);
              return segment.at(s).at_rate(rate + dt * dr, dr);
            },
            2.0 * fast);
      }
    }
  });
}

void at_rest_and_stopped_stand_and_only_stopped_keeps_the_wrench(void**) {
  RandomVectors random;
  const TaskPoint point = task_ends(random, 7, kRate).from;
  const TaskPoint rest = point.at_rest(), stopped = point.stopped();
  assert_true(rest.standing() && rest.idle() && stopped.standing() && !stopped.idle());
  assert_true(stopped.h == point.h && rest.x.p == point.x.p && !point.standing());
  ASSERT_NEAR(distance(rest.x.r, point.x.r), 0.0, 1e-15);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(velocity_acceleration_and_wrench_rate_are_derivatives),
      cmocka_unit_test(both_ends_are_met_in_all_that_the_order_joins),
      cmocka_unit_test(linear_is_a_straight_line_and_slerp),
      cmocka_unit_test(the_fields_decide_unless_the_order_is_forced),
      cmocka_unit_test(a_corner_leaves_out_what_steps_by_nature),
      cmocka_unit_test(chained_segments_neither_step_nor_jump_their_sign),
      cmocka_unit_test(a_quaternion_nearly_unit_is_used_as_a_unit_one),
      cmocka_unit_test(a_unit_quaternion_keeps_its_bits_beside_the_last),
      cmocka_unit_test(at_a_rate_the_motion_is_that_of_the_path_at_its_time),
      cmocka_unit_test(at_rest_and_stopped_stand_and_only_stopped_keeps_the_wrench),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
