// Tests the room between what is admitted and what the guard stops: the arm of every shipped chain
// of torques follows random motions as fast as its references may be, to the ends of their ranges
// too, and no measured joint ends them; straight lines with the largest steps of velocity are not
// limited by the guard.
#include <fstream>
#include <memory>

#include "tests/pipeline/pipeline_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr int kLongest = 4000;  // cycles between two requests

/// What the measured joints used of a limit, as a share of it, and how far they were beyond a
/// range.
struct Most {
  JointVector speed = JointVector::Zero();   // 1
  JointVector beyond = JointVector::Zero();  // rad

  void see(const JointVector& q, const JointVector& dq, const JointLimits& limits) {
    speed = speed.cwiseMax(dq.cwiseAbs().cwiseQuotient(limits.dq_max));
    beyond = beyond.cwiseMax(limits.q_min - q).cwiseMax(q - limits.q_max);
  }
  void print(const char* name) const {
    print_message("%s, joint: speed, share of the limit; beyond the range, rad\n", name);
    for (int i = 0; i < kDof; ++i) print_message("  %d: %.3f %.4f\n", i + 1, speed[i], beyond[i]);
  }
};

/// A position for one joint or for all: at one end of the range or the other, or between them.
JointVector target(Random& random, JointVector q, const JointLimits& limits) {
  const int only = random.below(2 * kDof);
  for (int i = 0; i < kDof; ++i) {
    if (only < kDof && only != i) continue;
    const double lo = std::max(limits.q_min[i], q[i] - 3.0);
    const double hi = std::min(limits.q_max[i], q[i] + 3.0);
    const int where = random.below(4);
    q[i] = where == 0 ? lo : where == 1 ? hi : random.uniform(lo, hi);
  }
  return q;
}

void send_point(PipelineBench& bench, const JointVector& q) {
  JointSpace::Point point;
  point.q = q;
  std::uint32_t id = 0;
  ASSERT_OK(bench.client.send(point, id).status);
}

/// Sends a point, or jogs one joint at nine tenths of its limit or at the whole of it.
void send_one(PipelineBench& bench, Random& random) {
  const JointLimits& limits = bench.channel.settings.limits;
  if (random.below(4) > 0)
    return send_point(bench, target(random, bench.output<JointVector>("jrg.q_d"), limits));
  Velocity<JointSpace> jog;
  const int joint = random.below(kDof);
  jog.timeout_s = 0.5;
  jog.rates[joint] = (random.below(2) == 0 ? -1.0 : 1.0) * (random.below(2) == 0 ? 0.9 : 1.0) *
                     limits.dq_max[joint];
  std::uint32_t id = 0;
  ASSERT_OK(bench.client.send(jog, id).status);
}

/// Sends a pose near `start`, on the side where neither wall nor table is.
void send_pose(PipelineBench& bench, Random& random, const Pose& start) {
  const bool at_wall = kDof == 6;
  const double far = at_wall ? 0.03 : 0.1;  // m
  TaskSpace::Point point;
  point.x = start;
  for (int i = 0; i < 3; ++i) point.x.p[i] += random.uniform(-far, far);
  point.x.p[at_wall ? 1 : 2] = start.p[at_wall ? 1 : 2] + random.uniform(0.0, far);
  std::uint32_t id = 0;
  ASSERT_OK(bench.task_client.send(point, id).status);
}

/// Runs for some cycles, or until the arm is at rest.
void run(PipelineBench& bench, int cycles, Most& most) {
  for (int k = 0; k < cycles; ++k) {
    const Status status = bench.executive.cycle(bench.next());
    const Guard::Telemetry& guard = bench.executive.guard().telemetry();
    if (status != Status::kOk)
      print_error("joint %d: %g, limit %g\n", guard.tripped_joint + 1, guard.tripped_value,
                  guard.tripped_limit);
    ASSERT_OK(status);
    const JointVector& dq = bench.output<JointVector>("robot.dq");
    most.see(bench.output<JointVector>("robot.q"), dq, bench.pipeline.guard.limits);
    Report report;
    while (bench.client.poll(report) || bench.task_client.poll(report)) {
    }
    if (k > 500 && dq.cwiseAbs().maxCoeff() < 1e-3) break;
  }
}

/// Returns the file without its collision check, which stops fast motions near wall and table, and
/// with points that are kept within limits.
std::string without_check(std::ifstream& file) {
  std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const char* begin : {"[collision]", "online = forward"}) {
    const std::size_t at = text.find(begin);
    if (at != std::string::npos)
      text.erase(at, text.find(*begin == '[' ? "\n[" : "\n", at) + 1 - at);
  }
  return text;
}

/// Does this with every shipped chain of these that the robot has, armed.
template <class Act>
void with_each(std::initializer_list<const char*> chains, Act act) {
  for (const char* chain : chains) {
    const std::string name = of_this_robot(chain);
    std::ifstream file("pipelines/" + name + ".ini");
    if (!file.good()) continue;
    const auto bench = std::make_unique<PipelineBench>();
    ASSERT_OK(bench->arm_with(without_check(file)));
    act(*bench, name.c_str());
  }
}

// Proves GRD-13.

void no_accepted_motion_ends_in_a_fault(void**) {
  with_each({"_jrg_pdgc", "_jrg_pid", "_trg_cpc", "_trg_ac_cpc_pid"},
            [](PipelineBench& bench, const char* name) {
              const bool joints = bench.pipeline.takes_joints;
              Random random{1};
              Most most;
              run(bench, joints ? 1 : 2000, most);  // the tare of a sensor
              const Pose start = bench.output<Pose>("model.x");
              for (int n = trials(tries(joints ? 60 : 10, joints ? 15 : 5)); n > 0; --n) {
                joints ? send_one(bench, random) : send_pose(bench, random, start);
                run(bench, random.below(3) == 0 ? random.below(kLongest / 4) : kLongest, most);
              }
              most.print(name);
            });
}

/// Points from side to side, in rhythms that one joint or all may swing in.
void no_rhythm_of_points_ends_in_a_fault(void**) {
  constexpr struct {
    double way;  // rad
    std::array<int, 4> cycles;
  } kRhythms[] = {{0.15, {140, 181, 190, 220}}, {0.5, {250, 350, 450, 600}}};
  with_each({"_jrg_pdgc", "_jrg_pid"}, [&](PipelineBench& bench, const char* name) {
    Most most;
    run(bench, 1, most);
    const JointVector home = bench.output<JointVector>("jrg.q_d");
    const JointLimits& limits = bench.channel.settings.limits;
    for (int which = 0; which < kDof + 2; ++which) {
      JointVector sides = JointVector::Ones();
      for (int i = 0; i < kDof; ++i)
        sides[i] = which < kDof                  ? (i == which ? 1.0 : 0.0)
                   : which == kDof || i % 2 == 0 ? 1.0
                                                 : -1.0;
      for (const auto& rhythm : kRhythms)
        for (const int cycles : rhythm.cycles)
          for (int n = 0; n < 24; ++n) {
            const JointVector q = home + (n % 2 == 0 ? rhythm.way : -rhythm.way) * sides;
            send_point(bench, q.cwiseMax(limits.q_min).cwiseMin(limits.q_max));
            run(bench, cycles, most);
          }
    }
    most.print(name);
  });
}

/// Moves one joint along a line and back, with the largest step of velocity where it turns.
void send_line(PipelineBench& bench, int joint) {
  const JointLimits& limits = bench.channel.settings.limits;
  const JointVector home = bench.output<JointVector>("jrg.q_d");
  const double inwards = home[joint] > 0.5 * (limits.q_min[joint] + limits.q_max[joint]) ? -1 : 1;
  const double step = limits.velocity_step[joint], time_s = std::min(0.3 / step, 0.5);
  Trajectory<JointSpace>* const line = bench.client.acquire();
  assert_non_null(line);
  line->interpolation = Interpolation::kLinear;
  line->count = 3;
  for (int i = 0; i < 3; ++i) {
    line->waypoints[i].time_s = i * time_s;
    line->waypoints[i].point.q = home;
  }
  line->waypoints[1].point.q[joint] += inwards * 0.5 * step * time_s;
  std::uint32_t id = 0;
  ASSERT_OK(bench.client.send(*line, id).status);
}

// Proves GRD-14.

void the_largest_step_of_a_line_is_not_limited(void**) {
  with_each({"_jrg_pdgc", "_jrg_pid"}, [](PipelineBench& bench, const char*) {
    Most most;
    run(bench, 1000, most);
    for (int joint = 0; joint < kDof; ++joint) {
      send_line(bench, joint);
      run(bench, 2000, most);
      assert_int_equal(bench.executive.guard().telemetry().limited_cycles, 0);
    }
  });
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_accepted_motion_ends_in_a_fault),
      cmocka_unit_test(no_rhythm_of_points_ends_in_a_fault),
      cmocka_unit_test(the_largest_step_of_a_line_is_not_limited),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
