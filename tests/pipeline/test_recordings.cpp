// Tests recordings, positions with few digits or noise, in the shipped pipelines: what is accepted
// is followed to its end, and the guard has nothing to limit.
#include <unistd.h>

#include <cmath>

#include "kernel/math/so3.hpp"
#include "tests/pipeline/pipeline_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus {
namespace {

const char* recording() {
  static char path[64];
  std::snprintf(path, sizeof path, "/tmp/tactus-recording-%d.csv", static_cast<int>(getpid()));
  return path;
}

/// From 0 to 1 at rest, with the least jerk.
double progress(double share) {
  return share * share * share * (10.0 - 15.0 * share + 6.0 * share * share);
}

/// Numbers as printf writes them, each with an error of up to `noise`.
template <class Numbers>
void write(std::FILE* file, const Numbers& numbers, int decimals, double noise, Random& random) {
  for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
    std::fprintf(file, ",%.*f", decimals, numbers[i] + random.uniform(-noise, noise));
}

struct Teaching {
  double rate_hz = 0.0, noise = 0.0, length_s = 2.5;
  int decimals = 0;

  explicit Teaching(Random& random)
      : rate_hz(std::pow(10.0, random.uniform(1.5, 3.0))),
        noise(std::pow(10.0, random.uniform(-7.0, -3.3))),
        decimals(4 + random.below(6)) {}
  template <class Point>
  void write_file(const char* header, Point point, Random& random) const {
    std::FILE* file = std::fopen(recording(), "wb");
    assert_non_null(file);
    std::fprintf(file, "time_s%s\n", header);
    const int last = static_cast<int>(length_s * rate_hz);
    for (int i = 0; i <= last; ++i) {
      std::fprintf(file, "%.6f", 6.0 + i / rate_hz);
      write(file, point(progress(static_cast<double>(i) / last)), decimals, noise, random);
      std::fprintf(file, "\n");
    }
    std::fclose(file);
  }
};

std::string columns() {
  std::string header;
  for (int j = 0; j < kDof; ++j) header += ",q" + std::to_string(j + 1) + "_" + position_unit(j);
  return header;
}

/// Runs the recording to its end, with `without` left out of the pipeline.
void follow(const std::string& pipeline, const Teaching& how, const char* without = "") {
  const auto bench = std::make_unique<PipelineBench>();
  bench->start(pipeline, without, "", recording());
  assert_true(bench->input.smoothing().tolerance.allows());
  while (!is_final(bench->report.outcome) || bench->report.id != bench->input.id) {
    feed_input(bench->session, bench->input, 0);
    bench->cycle();
    assert_true(bench->time_s() < 12.0);
  }
  print_message("%s: %.0f Hz, %d decimals, noise %.1e: %s\n", pipeline.c_str(), how.rate_hz,
                how.decimals, how.noise, describe(bench->input.moved()).c_str());
  ASSERT_STATUS(bench->report.outcome, Outcome::kSucceeded);
  assert_int_equal(bench->limited(), 0);
}

// Proves CSV-8, PIPE-1.

void recordings_of_joints_are_followed_and_nothing_is_limited(void**) {
  Random random{21};
  for (const char* chain : {"_jrg_pdgc", "_jrg_pid"}) {
    const std::string pipeline = of_this_robot(chain);
    if (access(("pipelines/" + pipeline + ".ini").c_str(), R_OK) != 0) continue;
    const auto bench = std::make_unique<PipelineBench>();
    bench->start(pipeline);
    const JointVector from = bench->hal.arm().q();
    for (int trial = 0; trial < 4; ++trial) {
      const Teaching how(random);
      JointVector way;
      for (double& each : way) each = random.uniform(-0.3, 0.3);
      how.write_file(
          columns().c_str(), [&](double s) { return JointVector(from + s * way); }, random);
      follow(pipeline, how);
    }
  }
}

void recordings_of_the_tip_are_followed_and_nothing_is_limited(void**) {
  need_one_of({"fer_trg_cpc", "ur10_trg_cpc"});
  Random random{22};
  const std::string pipeline = of_this_robot("_trg_cpc");
  const auto bench = std::make_unique<PipelineBench>();
  bench->start(pipeline);
  bench->cycle();
  const Pose from = bench->output<Pose>("model.x");
  for (int trial = 0; trial < 4; ++trial) {
    Teaching how(random);
    how.noise *= 0.2;  // a metre is more than a radian
    const Vector3 way(0.0, -0.1, 0.05), turn(0.1, 0.2, random.uniform(-0.3, 0.3));
    const auto point = [&](double s) {
      const Eigen::Quaterniond r = exp_so3(Vector3(s * turn)) * from.r;
      Eigen::Matrix<double, 7, 1> numbers;
      numbers << from.p + s * way, r.w(), r.x(), r.y(), r.z();
      return numbers;
    };
    how.write_file(",x_m,y_m,z_m,qw,qx,qy,qz", point, random);
    follow(pipeline, how, kDof == 6 ? "motion_frame = base_link.x" : "");
  }
}

int remove_recording(void**) {
  std::remove(recording());
  return 0;
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(recordings_of_joints_are_followed_and_nothing_is_limited),
      cmocka_unit_test(recordings_of_the_tip_are_followed_and_nothing_is_limited),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_recording);
}
