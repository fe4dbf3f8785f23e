// Tests the contact law alone: penetration, friction and the energy balance, against first
// integrals and closed forms of contact mechanics.
#include <algorithm>
#include <random>

#include "sim_plant/arm/contact.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr Material kWood = {1e5, 1.0, 0.3};
constexpr Material kMaterials[] = {{1e4, 0.0, 0.1}, kWood, {1e6, 50.0, 1.0}};

std::mt19937_64 g_random;

double uniform(double lo, double hi) {
  return lo + (hi - lo) * static_cast<double>(g_random() >> 11) * 0x1p-53;
}
Vector3 random_vector(double size) {
  return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
}
Vector3 random_plane_vector(double size) {
  return {uniform(-size, size), uniform(-size, size), 0.0};
}

int restart_random(void**) {
  g_random.seed(1);
  return 0;
}

void assert_vector(const Vector3& actual, const Vector3& expected, double tolerance) {
  ASSERT_NEAR((actual - expected).norm(), 0.0, tolerance);
}

// Proves SIM-5.

void the_normal_force_is_that_of_hunt_and_crossley(void**) {
  ASSERT_NEAR(normal_force(kWood, 1e-4, 0.0), 10.0, 1e-12);
  ASSERT_NEAR(normal_force(kWood, 1e-4, 0.5), 15.0, 1e-12);
  ASSERT_NEAR(normal_force(kWood, 1e-4, -0.5), 5.0, 1e-12);
  assert_true(normal_force(kWood, -1e-4, 1.0) == 0.0);
}

void the_force_begins_at_zero_and_never_pulls(void**) {
  for (const Material& material : kMaterials) {
    for (int n = 0; n < 10000; ++n) {
      const double rate = uniform(-3.0, 3.0), depth = uniform(-0.01, 0.01);
      assert_true(normal_force(material, depth, rate) >= 0.0);
      assert_true(normal_force(material, 1e-12, rate) <= 1e-3);
      assert_true(normal_force(material, -1e-12, rate) == 0.0);
    }
  }
}

/// Departure speed, m/s, of a ball of 1 kg that arrives with `speed`, by the Runge-Kutta method.
double rebound(const Material& material, double speed) {
  double x = 0.0, v = speed;  // depth and its rate
  const double h = 1e-6;
  const auto a = [&](double depth, double rate) { return -normal_force(material, depth, rate); };
  do {
    const double a1 = a(x, v), a2 = a(x + h / 2 * v, v + h / 2 * a1);
    const double a3 = a(x + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2);
    const double a4 = a(x + h * v + h * h / 2 * a2, v + h * a3);
    x += h * v + h * h / 6 * (a1 + a2 + a3);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  } while (x > 0.0);
  return -v;
}

// With u the depth rate, m u du = -k delta (1 + d u) ddelta. The ball leaves at the depth at which
// it arrived, so w - ln(1 + d w) / d takes the same value at w = speed and w = -rebound.
void a_ball_rebounds_as_the_first_integral_says(void**) {
  for (const double d : {0.5, 1.0, 5.0}) {
    for (const double speed : {0.05, 0.2, 1.0}) {
      const double out = rebound({1e5, d, 0.0}, speed);
      const double coming = speed - std::log1p(d * speed) / d;
      const double going = -out - std::log1p(-d * out) / d;
      ASSERT_NEAR(going / coming, 1.0, 1e-4);
      assert_true(out < speed);
    }
  }
  ASSERT_NEAR(rebound({1e5, 0.0, 0.0}, 0.2), 0.2, 1e-5);
}

/// A block of 1 kg on the box, pressed with N and pulled with F, both in N.
struct Block {
  Material material = kWood;
  double h_s = 0.25e-3, N = 10.0;
  Vector3 x = Vector3::Zero(), v = Vector3::Zero(), bristle = Vector3::Zero();

  void pull(const Vector3& F) {
    v += h_s * (F + friction_force(material, N, bristle, v));
    bristle = next_bristle(material, N, bristle, h_s * v, h_s);
    x += h_s * v;
  }
};

void below_the_cone_a_block_sticks_and_does_not_creep(void**) {
  Block block;
  const Vector3 F(0.0, 2.9, 0.0);                             // mu N = 3 N
  for (int k = 0; k < 4000; ++k) block.pull(F * k / 4000.0);  // a step would overshoot
  for (int k = 0; k < 4000; ++k) block.pull(F);
  assert_vector(block.x, F / (0.7 * 1e5), 1e-12);
  const Vector3 before = block.x;
  for (int k = 0; k < 40000; ++k) block.pull(F);
  assert_vector(block.x, before, 1e-15);
}

void above_the_cone_a_block_slides_with_what_is_left(void**) {
  Block block;
  const Vector3 F(4.0, 0.0, 0.0);
  for (int k = 0; k < 400; ++k) block.pull(F);
  const double before = block.v.x();
  for (int k = 0; k < 4000; ++k) block.pull(F);
  ASSERT_NEAR(block.v.x() - before, 4.0 - 3.0, 1e-9);  // N s, in 1 s
}

void sliding_the_force_is_mu_times_normal_against_the_velocity(void**) {
  for (const Material& material : kMaterials) {
    for (int n = 0; n < 50; ++n) {
      const Vector3 v = random_plane_vector(0.3), across(-v.y(), v.x(), 0.0);
      const double N = uniform(1.0, 50.0), h_s = 0.25e-3;
      Vector3 bristle = 1e-5 * across;
      for (int k = 0; k < 8000; ++k) bristle = next_bristle(material, N, bristle, h_s * v, h_s);
      assert_vector(friction_force(material, N, bristle, v), -material.friction * N * v / v.norm(),
                    1e-3 * material.friction * N);
    }
  }
}

void the_bristle_is_bounded_at_every_stiffness_and_step(void**) {
  for (int n = 0; n < 2000; ++n) {
    const Material material = {std::pow(10.0, uniform(3.0, 9.0)), 1.0, uniform(0.0, 2.0)};
    const double h_s = std::pow(10.0, uniform(-6.0, -2.0)), N = uniform(0.0, 100.0);
    Vector3 bristle = Vector3::Zero();
    for (int k = 0; k < 200; ++k) {
      bristle = next_bristle(material, N, bristle, random_plane_vector(1e-3), h_s);
      assert_true(0.7 * material.stiffness * bristle.norm() <= material.friction * N * (1 + 1e-9));
    }
  }
}

// Proves SIM-5, SIM-6.

void friction_stays_in_the_cone_and_never_gives_energy(void**) {
  for (int n = 0; n < 2000; ++n) {
    const Material material = {std::pow(10.0, uniform(3.0, 7.0)), 1.0, uniform(0.0, 2.0)};
    const double h_s = std::pow(10.0, uniform(-6.0, -3.0));
    Vector3 bristle = Vector3::Zero();
    for (int k = 0; k < 100; ++k) {
      const double N = uniform(-20.0, 50.0) < 0.0 ? 0.0 : uniform(0.0, 50.0);
      const Vector3 moved = random_plane_vector(1e-4 * uniform(0.0, 1.0));
      const Vector3 F = friction_force(material, N, bristle + moved, moved / h_s);
      const double before = stored_energy(material, 0.0, bristle);
      bristle = next_bristle(material, N, bristle, moved, h_s);
      assert_true(F.norm() <= material.friction * N * (1.0 + 1e-12));
      const double gained = stored_energy(material, 0.0, bristle) - before, work = -F.dot(moved);
      assert_true(gained <= work + 1e-12);
    }
  }
}

/// A smooth closed path around an upper edge of a box of 0.2 m, in and out of contact; t in [0, 1].
Vector3 wander(double t, const Vector3 (&a)[4]) {
  Vector3 x(0.108, 0.0, 0.108);
  for (int i = 0; i < 4; ++i) x += a[i] * std::sin(2.0 * M_PI * (i + 1) * t);
  return x;
}

void over_any_motion_more_work_goes_in_than_is_stored(void**) {
  Box box;
  box.half_extents = Vector3(0.1, 0.1, 0.1);
  constexpr int kSteps = 20000;
  double taken = 0.0;
  for (int n = 0; n < 30; ++n) {
    const Material& material = kMaterials[n % 3];
    const Vector3 a[4] = {random_vector(4e-3), random_vector(4e-3), random_vector(2e-3),
                          random_vector(1e-3)};
    Vector3 bristle = Vector3::Zero();
    double work = 0.0, most = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double h_s = 1.0 / kSteps, t = k * h_s;
      const Vector3 before = wander(t, a), after = wander(t + h_s, a),
                    middle = wander(t + h_s / 2, a);
      const Touch touch = find_touch(box, middle, 0.01);
      const Vector3 way = after - before, moved = tangential(way, touch.normal);
      const double N = normal_force(material, touch.depth, -touch.normal.dot(way) / h_s);
      const Vector3 z = N > 0.0 ? tangential(bristle, touch.normal) : Vector3::Zero();
      const Vector3 F = touch.normal * N + friction_force(material, N, z + moved, moved / h_s);
      bristle = N > 0.0 ? next_bristle(material, N, z, moved, h_s) : Vector3::Zero();
      work -= F.dot(way);
      const double depth = find_touch(box, after, 0.01).depth;
      const double stored = stored_energy(material, depth, bristle);
      most = std::max(most, stored);
      assert_true(stored <= work + 1e-4 * most + 1e-6);  // error of the midpoint rule
    }
    taken += work;
  }
  assert_true(taken > 0.1);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_normal_force_is_that_of_hunt_and_crossley),
      cmocka_unit_test_setup(the_force_begins_at_zero_and_never_pulls, restart_random),
      cmocka_unit_test(a_ball_rebounds_as_the_first_integral_says),
      cmocka_unit_test(below_the_cone_a_block_sticks_and_does_not_creep),
      cmocka_unit_test(above_the_cone_a_block_slides_with_what_is_left),
      cmocka_unit_test_setup(sliding_the_force_is_mu_times_normal_against_the_velocity,
                             restart_random),
      cmocka_unit_test_setup(the_bristle_is_bounded_at_every_stiffness_and_step, restart_random),
      cmocka_unit_test_setup(friction_stays_in_the_cone_and_never_gives_energy, restart_random),
      cmocka_unit_test_setup(over_any_motion_more_work_goes_in_than_is_stored, restart_random),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
