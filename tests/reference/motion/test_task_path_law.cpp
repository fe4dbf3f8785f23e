// PathLaw on a path of the tip: keeps the limits of velocity and acceleration, of translation and
// rotation, for any requested rate. The test differentiates the output numerically.

#include "kernel/math/so3.hpp"
#include "kernel/reference/motion/admission_room.hpp"
#include "kernel/reference/motion/path_law.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3, kShare = 0.98;
constexpr int kPieces = 12;

constexpr int kPaths = tries(60, 20);

Vector3 any(Random& random) {
  const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0);
  return {x, y, random.uniform(-1.0, 1.0)};
}

/// The largest lengths of velocity and acceleration put out, as shares of the limits.
struct Shares {
  double v = 0.0, a = 0.0;

  void take(const TaskSpace::Point& out, const TaskLimits& limits) {
    v = std::fmax(v, out.v.head<3>().norm() / limits.v_max);
    v = std::fmax(v, out.v.tail<3>().norm() / limits.w_max);
    a = std::fmax(a, out.a.head<3>().norm() / limits.a_max);
    a = std::fmax(a, out.a.tail<3>().norm() / limits.alpha_max);
  }
};

struct Runner {
  std::array<Waypoint<TaskSpace>, kPieces + 1> waypoints;
  Trajectory<TaskSpace> trajectory;
  TaskLimits limits;
  AdmissionSettings<TaskSpace> settings;
  Path<TaskSpace> path;
  PathLaw<TaskSpace> law;
  Shares shares;
  double mean = 0.0, jerk = 0.0, derivative = 0.0;  // mean acceleration of a period
  TaskSpace::Point last;

  Runner(Fields fields, Random& random) {
    limits.p_min.setConstant(-100.0);
    limits.p_max.setConstant(100.0);
    trajectory.waypoints = waypoints.data();
    trajectory.capacity = trajectory.count = kPieces + 1;
    trajectory.fields = fields;
    TaskSpace::Point point;
    double time_s = 0.0;
    for (Waypoint<TaskSpace>& waypoint : waypoints) {
      const double T = random.uniform(0.2, 0.6);
      const Vector3 v = any(random), w = any(random);
      point.x.p += 0.5 * T * (point.v.head<3>() + v) + 0.05 * T * any(random);
      point.x.r = (point.x.r * exp_so3(0.5 * T * (Vector3(point.v.tail<3>()) + w))).normalized();
      point.v << v, w;
      point.a << 0.5 * any(random), 0.5 * any(random);
      waypoint = {time_s, point};
      time_s += T;
    }
    for (int i = 0; i < 6; ++i) scale(worst());
  }
  TaskSpace::Segment segment(int index) const { return trajectory.segment(index, {}); }
  /// Returns the factor by which times must grow, from samples of the segments and their
  /// differences.
  double worst() const {
    double scale = 0.0;
    for (int k = 1; k <= kPieces; ++k) {
      const TaskSpace::Segment on = segment(k);
      const TaskSpace::Peaks peaks = TaskSpace::measure(on, limits, {}).peaks;
      const TaskSpace::Peaks most = TaskSpace::peaks(limits).reserved(kShare);
      for (std::size_t c = 0; c < 2; ++c) {
        scale = std::fmax(scale, peaks.v[c] / most.v[c]);
        scale = std::fmax(scale, std::sqrt(peaks.a[c] / most.a[c]));
        scale = std::fmax(scale, std::cbrt(peaks.j[c] / most.j[c]));
      }
    }
    return scale;
  }
  void scale(double factor) {
    for (Waypoint<TaskSpace>& waypoint : waypoints) {
      waypoint.time_s *= factor;
      waypoint.point.v /= factor;
      waypoint.point.a /= factor * factor;
    }
  }
  void open_until(int index) {
    trajectory.open = index < kPieces;
    trajectory.count = index + 1;
    waypoints[0].room = set_rooms(trajectory, settings, 0, 0, index, trajectory.open ? 0.0 : 1.0);
  }
  void start(double s, double rate) {
    path = Path<TaskSpace>(trajectory, {}, TaskLimits());
    path.enter(s);
    law.start(path, s, rate, TaskSpace::peaks(limits), kPeriod_s);
    last = path.at(s).at_rate(law.rate(), 0.0);
  }
  void step(double target) {
    const double s = law.s();
    law.step(path, target, TaskSpace::peaks(limits), kPeriod_s);
    const TaskSpace::Point out = path.at(law.s()).at_rate(law.rate(), law.slope());
    assert_true(law.rate() >= 0.0 && law.rate() <= 1.0 && law.s() >= s);
    shares.take(out, limits);
    const Vector6 change = out.a - last.a;
    if (trajectory.fields & kVelocityField) {
      const Vector6 dv = out.v - last.v;
      mean = std::fmax(mean, dv.head<3>().norm() / (kPeriod_s * limits.a_max));
      mean = std::fmax(mean, dv.tail<3>().norm() / (kPeriod_s * limits.alpha_max));
    }
    if (trajectory.fields & kAccelerationField) {
      jerk = std::fmax(jerk, change.head<3>().norm() / (kPeriod_s * limits.j_max));
      jerk = std::fmax(jerk, change.tail<3>().norm() / (kPeriod_s * limits.dalpha_max));
      const Vector6 error = (out.v - last.v) / kPeriod_s - 0.5 * (out.a + last.a);
      derivative = std::fmax(derivative, error.norm() / (kPeriod_s * limits.j_max));
    }
    last = out;
  }
};

constexpr Fields kAll[] = {0, kVelocityField, kVelocityField | kAccelerationField};

// Proves RG-11, RG-10.

void the_tip_keeps_limits_whatever_rate_is_asked_for_and_when(void**) {
  for (const Fields fields : kAll) {
    Random random{5};
    Shares all;
    double mean = 0.0, jerk = 0.0, derivative = 0.0;
    for (int n = trials(kPaths); n > 0; --n) {
      Runner runner(fields, random);
      runner.start(0.0, 1.0);
      double target = 1.0;
      int left = 0;
      for (int k = 0; k < 20000 && runner.law.s() < runner.trajectory.end_s(); ++k, --left) {
        if (left == 0) {
          const int which = random.below(4);
          target = which == 0 ? 0.0 : which == 1 ? 1.0 : random.uniform(0.0, 1.0);
          left = random.below(2) != 0 ? 1 + random.below(30) : 30 + random.below(470);
        }
        runner.step(target);
      }
      all.v = std::fmax(all.v, runner.shares.v);
      all.a = std::fmax(all.a, runner.shares.a);
      mean = std::fmax(mean, runner.mean);
      jerk = std::fmax(jerk, runner.jerk);
      derivative = std::fmax(derivative, runner.derivative);
    }
    print_message(
        "  fields %d: v %.9f a %.9f mean %.9f jerk %.4f, change of v beside mean a %.4f\n", fields,
        all.v, all.a, mean, jerk, derivative);
    assert_true(all.v <= 1.0 + 1e-9 && all.a <= 1.0 + 1e-9);
    assert_true(mean <= 1.0 + 1e-9 && jerk <= 1.001 && derivative <= 1.0);
  }
}

// Proves RG-14.

void an_open_path_of_the_tip_is_never_run_to_its_end(void**) {
  for (const Fields fields : kAll) {
    Random random{6};
    Shares all;
    double least_s = kInfinity;
    for (int n = trials(kPaths); n > 0; --n) {
      Runner runner(fields, random);
      int known = 1;
      runner.open_until(known);
      runner.start(0.0, 1.0);
      const double ahead_s = random.uniform(0.02, 0.3);
      for (int k = 0; k < 60000 && runner.law.s() < runner.trajectory.end_s(); ++k) {
        if (known < kPieces && runner.trajectory.end_s() - runner.law.s() < ahead_s)
          runner.open_until(++known);
        runner.step(1.0);
        if (runner.trajectory.open)
          least_s = std::fmin(least_s, runner.trajectory.end_s() - runner.law.s());
      }
      assert_int_equal(known, kPieces);
      all.v = std::fmax(all.v, runner.shares.v);
      all.a = std::fmax(all.a, runner.shares.a);
    }
    print_message("  fields %d: v %.9f a %.9f, least way left %.3f ms\n", fields, all.v, all.a,
                  1e3 * least_s);
    assert_true(all.v <= 1.0 + 1e-9 && all.a <= 1.0 + 1e-9 && least_s > 0.0);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_tip_keeps_limits_whatever_rate_is_asked_for_and_when),
      cmocka_unit_test(an_open_path_of_the_tip_is_never_run_to_its_end),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
