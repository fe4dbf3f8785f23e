// The paper's square on the emulated UR10 while somebody moves the speed slider: the path stays,
// only the time changes.
#include <cmath>
#include <optional>
#include <string>

#include "boards/program/files.hpp"
#include "boards/program/session.hpp"
#include "boards/program/trajectory_input.hpp"
#include "hal/ur/ur_settings.hpp"
#include "tests/ur_core_hal.hpp"

namespace tactus::ur {
namespace {

Settings where_the_square_begins() {
  Settings settings;
  settings.initial_q << 1.4797, -0.8344, 1.8844, 2.0916, -1.4797, -3.1415;
  return settings;
}

/// pipelines/ur10_trg_cpc_real.ini as the program runs it.
struct SquareBench {
  static constexpr int kMaxWaypoints = 16;
  std::array<std::array<Waypoint<TaskSpace>, kMaxWaypoints>, kStores> poses;
  ReferenceChannel<JointSpace> channel;
  ReferenceChannel<TaskSpace> task_channel;
  Pipeline pipeline;
  UrSettings ur;
  GatewaySection gateway;
  RealtimeSettings realtime;
  CoreHal hal{where_the_square_begins()};
  Executive executive{hal, pipeline, nullptr};
  Recorder recorder{nullptr, 0};
  ReferenceClient<JointSpace> client{channel};
  ReferenceClient<TaskSpace> task_client{task_channel};
  Session session{"test",   0,      {},          pipeline, executive,
                  recorder, client, task_client, gateway,  realtime};
  TrajectoryInput input;
  std::string text;
  std::int64_t cycles = 0;

  void start() {
    Options options;
    std::snprintf(options.pipeline, sizeof options.pipeline, "pipelines/ur10_trg_cpc_real.ini");
    for (std::size_t i = 0; i < kStores; ++i) {
      task_channel.stores[i].waypoints = poses[i].data();
      task_channel.stores[i].capacity = kMaxWaypoints;
    }
    Loader loader({&channel, &task_channel}, hal.capabilities());
    loader.add(board_section("ur", ur));
    loader.add(board_section("gateway", gateway));
    loader.add(board_section("realtime", realtime));
    std::string_view read;
    assert_true(load_pipeline(options.pipeline, loader, pipeline, read));
    text = read;
    assert_true(read_input(session, options, input));
    ASSERT_OK(executive.start());
    assert_true(send_input(session, input));
  }
  const Pose& reference() const {
    return *static_cast<const Pose*>(pipeline.ports.find("trg.x_d")->value);
  }
};

/// From a point to the sides of the square, m; base frame, which is base_link turned by half a
/// turn.
double distance_to_square(const Vector3& p) {
  constexpr std::array<std::array<double, 2>, 5> kCorners = {
      {{0.1, 0.2}, {0.1, 0.7}, {-0.4, 0.7}, {-0.4, 0.2}, {0.1, 0.2}}};
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < kCorners.size(); ++i) {
    const Vector3 from(kCorners[i][0], -0.8, kCorners[i][1]);
    const Vector3 side = Vector3(kCorners[i + 1][0], -0.8, kCorners[i + 1][1]) - from;
    const double along = std::clamp((p - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - from - along * side).norm());
  }
  return nearest;
}

struct SquareRun {
  double worst_m = 0.0;  ///< of the true tip, once the reference is on the square
  double rms_m = 0.0;
  double took_s = 0.0;  ///< until the trajectory has succeeded
};

/// Runs the square to its end with the slider at slider(t).
template <class Slider>
SquareRun run_square(Slider slider) {
  static std::optional<SquareBench> kept;
  SquareBench& bench = kept.emplace();
  bench.start();
  SquareRun result;
  bool on_square = false, succeeded = false;
  double sum = 0.0;
  int counted = 0;
  constexpr int kMost = 60'000;
  for (int k = 0; k < kMost && !succeeded; ++k) {
    bench.hal.set_slider(slider(k * kCycle_s));
    ASSERT_OK(bench.executive.cycle({k * std::int64_t{8'000'000}}));
    bench.hal.tick();
    Report report;
    while (poll_report(bench.session, bench.input, report))
      succeeded = succeeded || report.outcome == Outcome::kSucceeded;
    // It comes from the side, and is on the first corner a cycle after it has been within 0.1 mm.
    on_square = on_square || distance_to_square(bench.reference().p) < 1e-4;
    result.took_s = k * kCycle_s;
    if (!on_square) continue;
    const double off = distance_to_square(bench.hal.image().actual_tcp_pose.head<3>());
    result.worst_m = std::max(result.worst_m, off);
    sum += off * off;
    ++counted;
  }
  assert_true(succeeded);
  result.rms_m = std::sqrt(sum / counted);
  std::printf("    off the path: rms %.3f mm, at most %.3f mm; %.1f s\n", 1e3 * result.rms_m,
              1e3 * result.worst_m, result.took_s);
  return result;
}

const SquareRun& at_full_speed() {
  static const SquareRun result = run_square([](double) { return 1.0; });
  return result;
}

// Proves URH-23.

void at_full_speed_the_tip_is_on_the_square(void**) {
  assert_true(at_full_speed().worst_m < 3e-3);
  assert_true(at_full_speed().took_s < 67.0);
}

void a_slider_that_sweeps_does_not_lead_off_the_path(void**) {
  // 100 % -> 10 % -> 100 % in 30 s, about the second corner
  const SquareRun swept = run_square([](double t) {
    return t > 15.0 && t < 45.0 ? 0.55 + 0.45 * std::cos(2.0 * M_PI * (t - 15.0) / 30.0) : 1.0;
  });
  assert_true(swept.worst_m <= 1.1 * at_full_speed().worst_m);  // at a corner
  assert_true(swept.rms_m <= at_full_speed().rms_m);
  assert_true(swept.took_s > at_full_speed().took_s + 10.0);
}

void a_slider_at_zero_holds_the_square_and_it_goes_on_afterwards(void**) {
  const SquareRun held = run_square([](double t) { return t > 24.0 && t < 30.0 ? 0.0 : 1.0; });
  assert_true(held.worst_m <= 1.02 * at_full_speed().worst_m);  // corners fall between other cycles
  ASSERT_NEAR(held.took_s, at_full_speed().took_s + 6.0, 0.1);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(at_full_speed_the_tip_is_on_the_square),
      cmocka_unit_test(a_slider_that_sweeps_does_not_lead_off_the_path),
      cmocka_unit_test(a_slider_at_zero_holds_the_square_and_it_goes_on_afterwards),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
