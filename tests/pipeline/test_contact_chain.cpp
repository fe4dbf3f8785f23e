// Tests the wrench front end and the admittance, connected by a pipeline file, at the period of 8
// ms and with the gains of the wall experiment. The robot stays at rest while it is pushed.
#include "tests/load/loader_bench.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr std::string_view kChain =
    "[robot]\nname = fer\nperiod_us = 8000\ntau_c = pd.tau\n"
    "tool_mass = 2\ntool_com = 0 0 0.1\ntool_tip = 0 0 0.3\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[pd]\ntype = pd_gravity\nq_d = robot.q\nq = robot.q\ndq = robot.dq\nkp = 1\nkd = 1\n"
    "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\ntool = robot.tool\n"
    "max_force = 300\nmax_moment = 30\ntare_s = 0.4\ntare_timeout_s = 2\ntime_constant_s = 0.016\n"
    "tare_force_tolerance = 1\ntare_moment_tolerance = 0.1\nstuck_s = 1\n"
    "dead_force = 0.5\ndead_moment = 0.05\n"
    "[ac]\ntype = admittance\nx_d = model.x\nv_d = model.v\nh = sensor.h\nframe = base\n"
    "compliant_translation = xz\ncompliant_rotation = none\ndamping_given_as = ratio\n"
    "mass = 50 50 50\ndamping = 7.5 7.5 10\nstiffness = 20000 20000 6000\n"
    "inertia = 50 50 50\nrotational_damping = 7.5 7.5 7.5\n"
    "rotational_stiffness = 20000 20000 20000\n"
    "max_displacement = 0.05\nmax_velocity = 0.1\nmax_force = 80\n"
    "max_rotation = 0.1\nmax_angular_velocity = 0.5\nmax_moment = 10\n";

/// A torque-controlled robot with a force/torque sensor.
constexpr Capabilities kSensing = {false, false, true, 100, 10000, true};

template <class Type>
const Type& output(const LoaderBench& bench, const char* port) {
  return *static_cast<const Type*>(bench.pipeline.ports.find(port)->value);
}

// Proves WF-1, AD-2.

/// The flange's axes are those of the base, so the sensor reads base axes; 40 N along x at the tip.
void a_push_on_the_tip_moves_the_commanded_pose_by_the_compliance(void**) {
  LoaderBench bench;
  ASSERT_OK(bench.load(kChain, kSensing));
  RobotState state = state_at(0.0, 0.0);
  ASSERT_OK(bench.pipeline.start(state));
  const Pose x = output<Pose>(bench, "model.x");
  const Matrix3 to_flange = x.r.matrix().transpose();  // the tip's axes are the flange's
  const auto feel = [&](const Vector3& force) {
    const Vector3 weight = to_flange * Vector3(0.0, 0.0, -2.0 * 9.81), push = to_flange * force;
    state.ft.head<3>() = Vector3(1.0, 2.0, 3.0) + weight + push;
    state.ft.tail<3>() = Vector3(0.1, 0.2, 0.3) + Vector3(0.0, 0.0, 0.1).cross(weight) +
                         Vector3(0.0, 0.0, 0.3).cross(push);
  };
  for (int i = 0; i < 51; ++i) {
    feel(1e-9 * i * Vector3::Ones());
    assert_int_equal(output<bool>(bench, "sensor.taring"), i <= 49);
    ASSERT_OK(bench.pipeline.step(state));
  }
  assert_true(output<Pose>(bench, "ac.x_c").p == x.p);
  for (int i = 0; i < 1000; ++i) {
    feel({40.5 + 1e-9 * i, 0.0, 0.0});
    ASSERT_OK(bench.pipeline.step(state));
  }
  assert_close(output<Vector6>(bench, "sensor.h").head<3>(), {40.0, 0.0, 0.0}, 1e-5);
  assert_close(output<Pose>(bench, "ac.x_c").p - x.p, {40.0 / 20000.0, 0.0, 0.0}, 1e-7);
  assert_true(output<Pose>(bench, "ac.x_c").r.coeffs() == x.r.coeffs());
}

// Proves CFG-2.

void what_is_no_set_of_axes_is_refused(void**) {
  for (const std::string_view wrong : {"zx", "1 0 1", "x z", "XZ", "all"}) {
    LoaderBench bench;
    std::array<char, 64> line;
    const std::size_t size = append_text(line.data(), 0, line.size(), "compliant_translation = ");
    const std::string_view key(line.data(), append_text(line.data(), size, line.size(), wrong));
    ASSERT_STATUS(bench.load(edit(kChain, "compliant_translation = xz", key), kSensing),
                  Status::kBadValue);
    assert_string_equal(bench.error.key.c_str(), "compliant_translation");
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_push_on_the_tip_moves_the_commanded_pose_by_the_compliance),
      cmocka_unit_test(what_is_no_set_of_axes_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
