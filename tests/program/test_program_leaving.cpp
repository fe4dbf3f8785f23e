// Tests how a run in real time leaves its robot: at once after the last cycle, and with what the
// robot says of its drives. The robot is a simulated one that does not know that they are disabled.
#include <dirent.h>

#include "program/run_board.hpp"
#include "program/sim/sim_sections.hpp"
#include "sim_plant/arm/sim_hal.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

int threads() {
  DIR* const folder = opendir("/proc/self/task");
  int count = 0;
  while (const dirent* entry = readdir(folder)) count += entry->d_name[0] != '.';
  closedir(folder);
  return count;
}

class Doubtful final : public Hal {
 public:
  SimHal robot;
  int threads_at_the_end = 0;

  Capabilities capabilities() const override { return robot.capabilities(); }
  Status connect(CommandMode mode) override { return robot.connect(mode); }
  Status read(const CycleTime& now, RobotState& state) override { return robot.read(now, state); }
  Status write(const RobotCommand& command) override { return robot.write(command); }
  Status disconnect() override {
    threads_at_the_end = threads();
    static_cast<void>(robot.disconnect());
    return Status::kBusTimeout;
  }
  Message trouble() override { return Message("joint 3: it has not confirmed"); }
};

Doubtful& doubtful() {
  static Doubtful hal;
  return hal;
}
Status configure(const SimSections& sections, const Pipeline& pipeline, const Options& options) {
  doubtful().robot.set_period(pipeline.robot.period_s());
  return doubtful().robot.load(sections.plant, options.seed);
}

WireCounts counts() {
  return {{{"frames", 4500}, {"lost", 3}, {"before_sync0_us", 412, 517}}};
}

// Proves CAN-15, ECAT-12.
/// The threads of log and trajectory still run when the wire is closed: drives that watch for
/// commands do not wait until they have ended.
void drives_that_did_not_confirm_end_a_run_that_reached_its_goal_with_exit_code_1(void**) {
  Line file = write("rt.ini", {kPipeline, kBusyHost});
  Line out = in_folder("a");
  const char* words[] = {"tactus", "run",         file.c_str(), "--realtime", "--duration",
                         "0.1",    "--no-figure", "--out",      out.c_str()};
  char* arguments[16] = {};
  for (std::size_t i = 0; i < std::size(words); ++i) arguments[i] = const_cast<char*>(words[i]);
  const int kept = dup(STDERR_FILENO);
  assert_non_null(std::freopen(in_folder("err").c_str(), "w", stderr));
  const int code = run_board<SimSections>(
      static_cast<int>(std::size(words)), arguments,
      {"doubtful", doubtful(), 0, false, configure, nullptr, nullptr, counts});
  std::fflush(stderr);
  assert_int_equal(dup2(kept, STDERR_FILENO), STDERR_FILENO);
  close(kept);
  assert_int_equal(code, 1);
  assert_true(has(errors(), "rt.ini: not disabled: "));
  assert_true(has(errors(), ": joint 3: it has not confirmed\n"));
  assert_true(has(file_of("a/summary.json"),
                  "\"result\": {\"code\": 1, \"name\": \"drives not disabled\", \"why\": \"no data "
                  "from the robot in time (96): joint 3: it has not confirmed\"}"));
  assert_true(
      has(file_of("a/summary.json"),
          "  \"wire\": {\"frames\": 4500, \"lost\": 3, \"before_sync0_us\": [412, 517]},\n"));
  assert_true(doubtful().threads_at_the_end > 1);
  assert_int_equal(threads(), 1);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(
          drives_that_did_not_confirm_end_a_run_that_reached_its_goal_with_exit_code_1),
  };
  return run_program_tests(argv[0], tests);
}
