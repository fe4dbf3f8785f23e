// The paper's square: task-space generator, Cartesian pose control, ideal servo, with the tip by
// Orocos KDL. 65 s at 0.033 m/s, quintic from corner to corner; twice around, to stay within reach.
#include "gateway/reference_client.hpp"
#include "kernel/reference/blocks/task_reference_generator.hpp"
#include "tests/control/pose_bench.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kSides = 8;
constexpr double kSideTime_s = 65.0 / kSides, kMeanSpeed_m_s = 0.033;

struct Square {
  ChannelMemory<TaskSpace> channel;
  std::array<std::array<Waypoint<TaskSpace>, kSides>, kStores> waypoints;
  ReferenceClient<TaskSpace> client{channel};
  TaskReferenceGenerator trg;
  PoseBench bench;

  Status start() {
    JointVector ready;
    ready << 0.0, -0.25 * kPi, 0.0, -0.75 * kPi, 0.0, 0.5 * kPi, 0.25 * kPi;
    channel.settings.period_s = bench.dt_s;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = kSides;
    }
    TRY(bench.start(ready));
    trg.channel = &channel;
    trg.x.source = &bench.x;
    TRY(trg.start());
    bench.law.x_d.source = &trg.x_d.value;
    bench.law.v_d.source = &trg.v_d.value;
    return Status::kOk;
  }
  Status send() {
    constexpr double kSide_m = kSideTime_s * kMeanSpeed_m_s;
    constexpr double kCorners[kSides][2] = {{1, 0}, {1, 1}, {0, 1}, {0, 0},
                                            {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    Trajectory<TaskSpace>& square = *client.acquire();
    square.fields = kVelocityField | kAccelerationField;
    square.interpolation = Interpolation::kByFields;
    square.count = kSides;
    for (int i = 0; i < kSides; ++i) {
      Waypoint<TaskSpace>& corner = square.waypoints[i] = {};
      corner.time_s = (i + 1) * kSideTime_s;
      corner.point.x = bench.x;
      corner.point.x.p.y() += kSide_m * kCorners[i][0];
      corner.point.x.p.z() -= kSide_m * kCorners[i][1];
    }
    std::uint32_t id = 0;
    return client.send(square, id).status;
  }
  /// Returns the distance of the true flange, by KDL, from where it should be when the period ends,
  /// m.
  double distance() const {
    double p[3], r[3][3];
    kdl_flange(bench.true_q.data(), p, r);
    const Vector3 due = trg.x_d.value.p + bench.dt_s * trg.v_d.value.head<3>();
    return (due - Vector3(p)).norm();
  }
};

// Proves CP-10.

void the_square_is_tracked_to_a_fifth_of_a_millimetre(void**) {
  for (const int delay : {0, 1, 2}) {
    static Square squares[3];
    Square& square = squares[delay];
    square.bench.delay = delay;
    ASSERT_OK(square.start());
    ASSERT_OK(square.send());
    double sum = 0.0, most = 0.0;
    constexpr int kCycles = 65000;
    for (int k = 0; k < kCycles; ++k) {
      square.bench.measure();
      ASSERT_OK(square.trg.step(square.bench.dt_s));
      ASSERT_OK(square.bench.step());
      const double distance = square.distance();
      sum += distance * distance;
      most = std::max(most, distance);
    }
    const double rms = std::sqrt(sum / kCycles);
    print_message("measured %d periods ago: %.3g mm RMS, %.3g mm at most\n", delay, 1e3 * rms,
                  1e3 * most);
    assert_true(rms < 0.2e-3);
    if (delay == 0) assert_true(rms < 2e-6);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_square_is_tracked_to_a_fifth_of_a_millimetre),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
