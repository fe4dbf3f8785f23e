// Tests the place on the path that feedback tells.
#include "tests/reference/generator/feedback_bench.hpp"

namespace tactus {
namespace {

// Proves RG-15.

void the_progress_is_the_place_on_the_path_under_an_override_and_in_a_pause(void**) {
  constexpr double kWay = 0.2, kWhole_s = 0.5;
  JointBench bench(1);
  ASSERT_OK(bench.block.start());
  bench.run(1);
  assert_true(bench.only().path_s == 0.0);
  JointSpace::Point goal = bench.measured;
  goal.q[0] += kWay;
  assert_true(bench.send(goal, kWhole_s));
  std::uint32_t id = 0;
  int standing = 0, half = 0;
  double last_s = 0.0;
  for (int k = 1; k <= 2000; ++k) {
    if (k == 150) assert_true(bench.client.set_override(0.5, id).ok());
    if (k == 300) assert_true(bench.client.pause(id).ok());
    if (k == 600) assert_true(bench.client.resume(id).ok());
    bench.run(1);
    const Feedback<JointSpace> message = bench.only();
    Report report;
    while (bench.client.poll(report)) {
    }
    if (message.id == 0) continue;
    const double u = message.path_s / message.path_end_s;
    ASSERT_NEAR(message.path_end_s, kWhole_s, 1e-12);
    ASSERT_NEAR(message.desired.q[0] - bench.measured.q[0],
                kWay * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u), 1e-9);
    standing += message.path_s == last_s && u < 1.0 ? 1 : 0;
    half += std::abs(message.path_s - last_s - 0.5 * kPeriod_s) < 1e-9 ? 1 : 0;
    last_s = message.path_s;
  }
  ASSERT_NEAR(last_s, kWhole_s, 1e-9);
  assert_true(standing > 150 && half > 200);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_progress_is_the_place_on_the_path_under_an_override_and_in_a_pause),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
