// The admittance wired to values that a test sets, with round gains: 100 N/m, 10 N m/rad.
#pragma once

#include "kernel/control/admittance.hpp"
#include "tests/control/force_and_moment.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline const Vector3 kOnes = Vector3::Ones();

/// The law wired to the values of a test, with wide bounds.
struct AdmittanceBench {
  Pose x_d;
  Vector6 v_d = Vector6::Zero(), h = Vector6::Zero(), h_d = Vector6::Zero();
  Admittance ac;
  AdmittanceBench() {
    ac.params.mass = ac.params.inertia = kOnes;
    ac.params.stiffness = 100.0 * kOnes;
    ac.params.damping = 40.0 * kOnes;
    ac.params.rotational_stiffness = 10.0 * kOnes;
    ac.params.rotational_damping = 12.0 * kOnes;
    ac.params.max_displacement = 1.0;
    ac.params.max_rotation = 1.8;
    ac.params.max_velocity = 2.0;
    ac.params.max_angular_velocity = 10.0;
    x_d = {{0.4, -0.2, 0.5}, exp_so3({0.7, -1.9, 0.4})};
    ac.x_d.source = &x_d;
    ac.v_d.source = &v_d;
    ac.h.source = &h;
    ac.h_d.source = &h_d;
  }
  void run(double duration_s, double dt_s = 1e-3) {
    for (int i = 0; i * dt_s < duration_s - 0.5 * dt_s; ++i) ASSERT_OK(ac.step(dt_s));
  }
  /// Return displacement (m) and rotation (rad) in base axes.
  Vector3 moved() const { return ac.x_c.value.p - x_d.p; }
  Vector3 turned() const { return log_so3(ac.x_c.value.r * x_d.r.conjugate()); }
};

}  // namespace tactus
