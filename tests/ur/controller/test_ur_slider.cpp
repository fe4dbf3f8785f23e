// Tests the paper's square on the emulated UR10 while a user moves the speed slider: the path
// stays, and the trajectory takes the time that the slider implies.
#include <cmath>
#include <optional>
#include <string>

#include "boards/ur10_socket/ur_sections.hpp"
#include "hal/ur/servo_program.hpp"
#include "hal/ur/ur_state.hpp"
#include "kernel/core/hal.hpp"
#include "program/session/files.hpp"
#include "program/session/session.hpp"
#include "program/session/trajectory_input.hpp"
#include "tests/support/testing.hpp"
#include "tests/ur/controller/ur_bench.hpp"

namespace tactus::ur {
namespace {

/// The emulated controller as a Hal, without sockets and without a clock. The program that the UR's
/// HAL uploads takes its set-points from the registers; a cycle of the kernel is a cycle of the
/// controller.
class CoreHal final : public Hal {
 public:
  explicit CoreHal(const Settings& settings) { bench_.start(settings); }

  Capabilities capabilities() const override {
    Capabilities offered;
    offered.position = offered.wrench = true;
    offered.min_period_us = offered.max_period_us = 8000;
    return offered;
  }
  Status connect(CommandMode) override {
    assert_true(bench_.started());
    return Status::kOk;
  }
  Status read(const CycleTime& now, RobotState& state) override {
    const Image& image = bench_.image();
    state.q = image.actual_q;
    state.dq = image.actual_qd;
    state.speed_scaling = time_scaling(image.speed_scaling, image.target_speed_fraction);
    state.stamp_ns = now.stamp_ns;
    state.drives.fill({drive_state(), true});
    return Status::kOk;
  }
  /// Uploads the program once; then it holds the arm where it is, or follows.
  Status write(const RobotCommand& command) override {
    if (command.request == DriveRequest::kDisable) return Status::kOk;
    if (!uploaded_) upload();
    if (!bench_.image().program_running) return Status::kOk;
    if (count_ == 0) held_ = bench_.image().actual_q;
    if (command.request == DriveRequest::kFollow) held_ = command.value;
    Machine& machine = bench_.controller().machine();
    for (int i = 0; i < 6; ++i) machine.io.input.doubles[kServoRegister + i] = held_[i];
    machine.io.input.ints[kServoRegister] = ++count_;
    return Status::kOk;
  }
  Status disconnect() override { return Status::kOk; }

  void tick() { bench_.ticks(1); }
  void set_slider(double fraction) { bench_.controller().machine().io.speed_fraction = fraction; }
  const Image& image() { return bench_.image(); }

 private:
  DriveState drive_state() {
    if (!uploaded_) return DriveState::kDisabled;
    if (bench_.image().program_running) return DriveState::kEnabled;
    return count_ == 0 ? DriveState::kArming : DriveState::kFault;
  }
  void upload() {
    ServoProgram script;
    script.lookahead_s = 0.1;
    script.gain = 300.0;
    const int session = bench_->open(Service::kPrimary);
    bench_.send(session, write_servo_program(script, text_));
    uploaded_ = true;
  }

  Bench bench_;
  ServoProgramText text_;
  std::int32_t count_ = 0;
  bool uploaded_ = false;
  JointVector held_ = JointVector::Zero();  // rad: the last set-point
};

Settings where_the_square_begins() {
  Settings settings;
  settings.initial_q << 1.4797, -0.8344, 1.8844, 2.0916, -1.4797, -3.1415;
  return settings;
}

/// pipelines/ur10_trg_cpc_real.ini as the program runs it.
struct SquareBench {
  static constexpr int kMaxWaypoints = 16;
  std::array<std::array<Waypoint<TaskSpace>, kMaxWaypoints>, kStores> poses;
  ChannelMemory<JointSpace> channel;
  ChannelMemory<TaskSpace> task_channel;
  RoomyPipeline pipeline;
  UrSections board;
  CoreHal hal{where_the_square_begins()};
  Executive executive{hal, pipeline};
  Recorder recorder{nullptr, 0};
  ReferenceClient<JointSpace> client{channel};
  ReferenceClient<TaskSpace> task_client{task_channel};
  Session session{"test",        false,          0,           {},     hal,
                  pipeline,      executive,      recorder,    client, task_client,
                  board.gateway, board.realtime, board.expect};
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
    Loader loader({&channel, &task_channel}, hal.capabilities(), board);
    std::string_view read;
    assert_true(load_pipeline(options.pipeline, loader, pipeline, read));
    text = read;
    assert_true(read_input(session, options, input));
    ASSERT_OK(executive.start());
    Status status = executive.arm();
    while (status == Status::kArming) {
      ASSERT_STATUS(cycle(), Status::kArming);
      status = executive.arm();
    }
    ASSERT_OK(status);
    assert_true(send_input(session, input));
  }
  /// One cycle of the kernel, and one of the controller.
  Status cycle() {
    const Status status = executive.cycle({cycles++ * std::int64_t{8'000'000}});
    hal.tick();
    return status;
  }
  const Pose& reference() const {
    return *static_cast<const Pose*>(pipeline.ports.find("trg.x_d")->value);
  }
};

/// Distance of a point from the sides of the square, m; base frame, which is base_link rotated by
/// half a turn.
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
  double rms_m = 0.0;    ///< over the time of the trajectory, which the slider stretches
  double took_s = 0.0;   ///< until the reference is 0.2 m past the second corner
};

/// Runs the first side, the second corner and a part of the second side, with the slider at
/// slider(t).
template <class Slider>
SquareRun run_square(Slider slider) {
  static std::optional<SquareBench> kept;
  SquareBench& bench = kept.emplace();
  bench.start();
  SquareRun result;
  bool on_square = false;
  double sum = 0.0, passed = 0.0;
  constexpr int kMost = 10'000;
  int k = 0;
  for (; k < kMost && bench.reference().p[0] > -0.1; ++k) {
    const double share = slider(k * kCycle_s);
    bench.hal.set_slider(share);
    ASSERT_OK(bench.cycle());
    // It comes from the side, and is on the first corner a cycle after it has been within 0.1 mm.
    on_square = on_square || distance_to_square(bench.reference().p) < 1e-4;
    if (!on_square) continue;
    const double off = distance_to_square(bench.hal.image().actual_tcp_pose.head<3>());
    result.worst_m = std::max(result.worst_m, off);
    sum += share * off * off;
    passed += share;
  }
  assert_true(k < kMost);
  result.took_s = k * kCycle_s;
  result.rms_m = std::sqrt(sum / passed);
  std::printf("    off the path: rms %.3f mm, at most %.3f mm; %.2f s\n", 1e3 * result.rms_m,
              1e3 * result.worst_m, result.took_s);
  return result;
}

const SquareRun& at_full_speed() {
  static const SquareRun result = run_square([](double) { return 1.0; });
  return result;
}
/// Just below 100 %, the program on the robot begins its servoj anywhere in a cycle, so the
/// set-point it takes is up to a cycle old: the worst case of a slider that does not move.
const SquareRun& at_95_percent() {
  static const SquareRun result = run_square([](double) { return 0.95; });
  return result;
}
void assert_on_the_path(const SquareRun& run) {
  assert_true(run.rms_m <= 1.01 * at_95_percent().rms_m);
  assert_true(run.worst_m <= 1.01 * at_95_percent().worst_m);
}

// Proves URH-23.

void a_slider_that_stands_keeps_the_tip_on_the_square(void**) {
  assert_true(at_full_speed().worst_m < 3e-3);
  assert_true(at_95_percent().worst_m < 3e-3);
  ASSERT_NEAR(at_full_speed().took_s, 26.0, 0.1);
  ASSERT_NEAR(at_95_percent().took_s, at_full_speed().took_s / 0.95, 0.05);
}

void a_slider_that_sweeps_does_not_lead_off_the_path(void**) {
  // 100 % -> 10 % -> 100 % in 30 s, of which the trajectory waits for 13.5 s, around the corner
  const SquareRun swept = run_square([](double t) {
    return t > 9.0 && t < 39.0 ? 0.55 + 0.45 * std::cos(2.0 * M_PI * (t - 9.0) / 30.0) : 1.0;
  });
  assert_on_the_path(swept);
  ASSERT_NEAR(swept.took_s, at_full_speed().took_s + 13.5, 0.05);
}

void a_slider_at_zero_holds_the_square_and_it_goes_on_afterwards(void**) {
  const auto held_from = [](double begin_s) {
    const SquareRun held =
        run_square([begin_s](double t) { return t > begin_s && t < begin_s + 3.0 ? 0.0 : 1.0; });
    ASSERT_NEAR(held.took_s, at_full_speed().took_s + 3.0, 0.1);
    return held;
  };
  assert_on_the_path(held_from(18.0));
  // In the corner itself the robot needs 0.2 s to stop, in which it draws closer to the reference.
  assert_true(held_from(20.0).worst_m < 3e-3);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_slider_that_stands_keeps_the_tip_on_the_square),
      cmocka_unit_test(a_slider_that_sweeps_does_not_lead_off_the_path),
      cmocka_unit_test(a_slider_at_zero_holds_the_square_and_it_goes_on_afterwards),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
