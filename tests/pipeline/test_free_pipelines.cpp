// Tests the shipped pipelines in free motion against the true joints of the plant.
#include <algorithm>

#include "tests/oracles/kdl.hpp"
#include "tests/pipeline/pipeline_bench.hpp"

namespace tactus {
namespace {

// Proves PIPE-1.

/// Compares the reference of a cycle with the joints measured in that cycle.
void five_waypoints_are_followed_by_jrg_and_pid(void**) {
  need_one_of({"ur10_jrg_pid"});
  for (const char* trajectory : {"", "pipelines/trajectories/ur10_five_waypoints_quintic.csv"}) {
    static PipelineBench benches[2];
    PipelineBench& bench = benches[trajectory[0] == '\0' ? 0 : 1];
    bench.start("ur10_jrg_pid", "", "", trajectory);
    JointVector squares = JointVector::Zero();
    double most = 0.0;
    while (bench.time_s() < bench.input.end_s()) {
      const JointVector q = bench.hal.arm().q();
      bench.cycle();
      const JointVector e = bench.output<JointVector>("jrg.q_d") - q;
      squares += e.cwiseAbs2();
      most = std::max(most, e.cwiseAbs().maxCoeff());
    }
    const double rms =
        std::sqrt(squares.maxCoeff() / static_cast<double>(bench.cycles));  // the worst joint's
    print_message("%.2g rad RMS, %.2g at most\n", rms, most);
    assert_true(rms < 0.7e-3 && most < 2e-3);
    assert_int_equal(bench.limited(), 0);
  }
}

struct Square {
  const char *pipeline, *trajectory;
  double rms_m, most_m;  // largest allowed
};

/// Covers the first side of the square, the corner and part of the side with the turn. The
/// reference of a cycle is compared with the flange's true pose in that cycle by KDL. The law cpc
/// works towards the pose one period ahead, so the two have no phase difference.
void the_square_is_followed_by_trg_and_cpc(void**) {
  need_one_of({"ur10_trg_cpc"});
  constexpr const char* kAtRest = "pipelines/trajectories/ur10_square_at_rest.csv";
  // Where straight lines meet, the twist steps by 33 mm/s; the joints follow it within 30 ms.
  constexpr Square kSquares[] = {{"ur10_trg_cpc", "", 0.1e-3, 1e-3},
                                 {"ur10_trg_cpc", kAtRest, 2e-6, 4e-6},
                                 {"ur10_trg_cpc_125", kAtRest, 10e-6, 20e-6}};
  static PipelineBench benches[3];
  for (std::size_t i = 0; i < 3; ++i) {
    PipelineBench& bench = benches[i];
    bench.start(kSquares[i].pipeline, "", "", kSquares[i].trajectory);
    double squares = 0.0, most = 0.0;
    while (bench.time_s() < 24.0) {
      double p[3], r[3][3];
      kdl_flange(bench.hal.arm().q().data(), p, r);
      bench.cycle();
      const double e = (bench.output<Pose>("trg.x_d").p - Vector3(p)).norm();
      squares += e * e;
      most = std::max(most, e);
    }
    const double rms = std::sqrt(squares / static_cast<double>(bench.cycles));
    print_message("%s: %.2g mm RMS, %.2g at most\n", kSquares[i].pipeline, 1e3 * rms, 1e3 * most);
    assert_true(rms < kSquares[i].rms_m && most < kSquares[i].most_m);
    assert_int_equal(bench.limited(), 0);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(five_waypoints_are_followed_by_jrg_and_pid),
      cmocka_unit_test(the_square_is_followed_by_trg_and_cpc),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
