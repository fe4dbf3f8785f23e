// Tests that an arm in random motion rests outside the margin of a box on its way, for every kind
// of chain: the loop behind the command is late, and does not know its load. Distances are those of
// KDL and FCL, of the true state of the plant. With TACTUS_TRIALS the motions of the first stops
// are repeated without the check, which tells how many were needless.
#include <optional>
#include <random>
#include <vector>

#include "tests/guard/collision_bench.hpp"
#include "tests/pipeline/pipeline_bench.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr double kMargin = 0.01;  // m, the default
constexpr int kRepeated = 100;    // stops, without the check

struct Chain {
  const char* name;
  std::string robot;        // rest of [robot], and sections before the blocks
  std::string blocks;       // after the model
  double payload_kg = 0.0;  // at most, which the law does not know
  double servo_s = 0.0;     // time constant of the robot's servo
};

const std::string kModel = "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n";
const std::string kJoints = "[jrg]\ntype = joint_reference_generator\nq = robot.q\ndq = robot.dq\n";
const std::string kPoses = "[trg]\ntype = task_reference_generator\nx = model.x\nv = model.v\n";
const std::string kAdmittance =
    "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\nmax_force = 300\nmax_moment = "
    "30\n"
    "tool = robot.tool\nstuck_s = 0\n"
    "[ac]\ntype = admittance\nx_d = trg.x_d\nv_d = trg.v_d\nh = sensor.h\nh_d = trg.h_d\n"
    "compliant_translation = xyz\ncompliant_rotation = none\nmass = 10 10 10\n"
    "damping = 2000 2000 2000\nstiffness = 1000 1000 50\ninertia = 1 1 1\n"
    "rotational_damping = 10 10 10\nrotational_stiffness = 10 10 10\n";
std::string pose_control(const std::string& of) {
  return "[cpc]\ntype = cartesian_pose\nx_d = " + of +
         "\nx = model.x\nJ = model.J\nq = robot.q\n"
         "position_gain = 10 10 10\nrotation_gain = 10 10 10\n";
}
/// Returns the lines of a shipped pipeline of this robot that begin with these words.
std::string lines(const char* chain, std::initializer_list<std::string_view> words) {
  std::ifstream file("pipelines/" + of_this_robot(chain) + ".ini");
  std::string found;
  for (std::string line; std::getline(file, line);)
    for (const std::string_view word : words)
      if (line.compare(0, word.size(), word) == 0) found += line + "\n";
  return found;
}
std::string pd_with(const std::string& gains) {
  return "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n" +
         gains;
}
std::string pd() {
  return pd_with(lines("_jrg_pdgc", {"kp ", "kd "}));
}
std::string pid(const std::string& q_d, const std::string& dq_d) {
  return "[pid]\ntype = pid\nq_d = " + q_d + "\ndq_d = " + dq_d +
         "\nq = robot.q\ndq = robot.dq\ng = model.g\nki = 0\n" +
         lines("_trg_ac_cpc_pid", {"kp ", "kd "});
}
/// A loop that overshoots is not to be stopped by the guard.
std::string room(const char* chain) {
  const std::string own = lines(chain, {"velocity_allowance ", "position_allowance "});
  return "[guard]\n" + (kDof == 6 ? own : "velocity_allowance = 0.6\nposition_allowance = 0.12\n");
}

struct Step {
  double time_s;
  JointVector goal;
};

class Trial {
 public:
  /// The box is on the way to the first point; near an arm that `holds`.
  Trial(const Chain& chain, std::uint64_t seed, bool holds = false) : chain_(chain), random_(seed) {
    oracle_.tip = Vector3::Zero();
    for (Cuboid& box : oracle_.boxes)
      box = {{{9.0, 9.0, 9.0}, {1.0, 0.0, 0.0, 0.0}}, {0.1, 0.1, 0.1}};
    from_ = free_posture(posture());
    plan();
    holds ? place_box(0.0, 0.0, 0.011) : place_box(0.3, 1.0, 0.05);
    payload_kg_ = uniform(0.0, chain.payload_kg);
  }
  /// Returns false if no arm could be armed here.
  bool begin(bool checked) {
    static std::optional<PipelineBench> bench;
    bench_ = &bench.emplace();
    return bench_->arm_with(text(checked)) == Status::kOk;
  }
  /// Runs the motion and what follows a stop. Returns how it ended.
  Status run() {
    Status status = Status::kOk;
    std::size_t sent = 0;
    while (status == Status::kOk && bench_->time_s() < end_s_) {
      if (sent < plan_.size() && bench_->time_s() >= plan_[sent].time_s) send(plan_[sent++].goal);
      status = cycle();
    }
    for (int i = 0; status == Status::kCollision && bench_->executive.busy() && i < 5000; ++i)
      static_cast<void>(cycle());
    look();
    return status;
  }
  /// Holds the arm where it is.
  void hold() {
    while (bench_->time_s() < 1.0) static_cast<void>(cycle());
    look();
  }
  double nearest() const { return nearest_; }  ///< m, of the box, since the trial was made or reset
  void forget() { nearest_ = 1.0; }
  bool of_box() const {
    return std::string(bench_->pipeline.collision_check.telemetry().first) == "block";
  }

 private:
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }
  JointVector posture() {
    const JointLimits limits;
    JointVector q;
    for (int i = 0; i < kDof; ++i) {
      const double reach = std::min(1.5, 0.45 * (limits.q_max[i] - limits.q_min[i]) - 0.2);
      q[i] = 0.5 * (limits.q_max[i] + limits.q_min[i]) + uniform(-reach, reach);
    }
    return q;
  }
  JointVector free_posture(JointVector q) {
    while (oracle_.nearest(q).distance < 0.02) q = posture();
    return q;
  }
  /// Points, each of which comes while the arm still moves to the one before.
  void plan() {
    double time_s = 0.7;
    const int count = 1 + static_cast<int>(uniform(0.0, 3.99));
    for (JointVector goal = from_; static_cast<int>(plan_.size()) < count;) {
      goal = free_posture(goal + uniform(0.1, 1.0) * (posture() - goal));
      plan_.push_back({time_s, goal});
      time_s += uniform(0.1, 0.8);
    }
    end_s_ = time_s + 1.0;
  }
  /// About a share of the way to the first point, and at least so far, m, from the arm.
  void place_box(double least_share, double largest_share, double distance) {
    Cuboid& box = oracle_.boxes[0];
    do {
      const JointVector q = from_ + uniform(least_share, largest_share) * (plan_[0].goal - from_);
      FclPlace link;
      kdl_link(q.data(), static_cast<int>(uniform(3.0, kDof + 0.99)), link.p, link.r);
      for (int i = 0; i < 3; ++i) box.pose.p[i] = link.p[i] + uniform(-0.2, 0.2);
      for (double& edge : box.size) edge = uniform(0.02, 0.2);
    } while (to_box(from_) < distance);
  }
  std::string text(bool checked) const {
    std::string q;
    for (const double angle : from_) q += " " + std::to_string(angle);
    char scene[512];
    const Cuboid& box = oracle_.boxes[0];
    std::snprintf(scene, sizeof scene,
                  "payload_kg = %.9g\npayload_com = 0 0 0.05\nservo_time_constant_s = %g\n"
                  "[block]\ntype = box\ncentre = %.9g %.9g %.9g\nsize = %.9g %.9g %.9g\n%s%g\n",
                  payload_kg_, chain_.servo_s, box.pose.p[0], box.pose.p[1], box.pose.p[2],
                  box.size[0], box.size[1], box.size[2],
                  checked ? "[collision]\nunknown_payload = " : "[recorder]\ndivisor = 1 # ",
                  chain_.payload_kg);
    return std::string("[robot]\nname = ") + Robot::kName + "\nperiod_us = 1000\n" + chain_.robot +
           "[plant]\ninitial_q =" + q + "\n" + scene + kModel + chain_.blocks;
  }
  void send(const JointVector& goal) {
    std::uint32_t id = 0;
    if (bench_->pipeline.takes_joints) {
      JointSpace::Point point;
      point.q = goal;
      ASSERT_OK(bench_->client.send(point, id).status);
      return;
    }
    FclPlace flange;
    kdl_flange(goal.data(), flange.p, flange.r);
    Matrix3 r;
    for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = flange.r[i / 3][i % 3];
    TaskSpace::Point point;
    point.x = {{flange.p[0], flange.p[1], flange.p[2]}, Eigen::Quaterniond(r)};
    ASSERT_OK(bench_->task_client.send(point, id).status);
  }
  Status cycle() {
    const Status status = bench_->executive.cycle(bench_->next());
    if (bench_->cycles % 10 == 0) look();
    return status;
  }
  void look() { nearest_ = std::min(nearest_, to_box(bench_->hal.arm().q())); }
  double to_box(const JointVector& q) const {
    double least = 1.0;
    for (int body = 1; body <= kToolBody; ++body)
      least = std::min(least, oracle_.between(q, kFirstBoxBody, body));
    return least;
  }

  const Chain& chain_;
  std::mt19937_64 random_;
  CollisionBench oracle_;
  PipelineBench* bench_ = nullptr;
  JointVector from_;
  std::vector<Step> plan_;
  double end_s_ = 0.0, payload_kg_ = 0.0, nearest_ = 1.0;
};

struct Tally {
  int stops = 0, refused = 0, below = 0, needless = 0;
  double nearest = 1.0;
};

/// Adds a trial that was stopped before the box.
void add(Trial& trial, Tally& tally) {
  ++tally.stops;
  tally.nearest = std::min(tally.nearest, trial.nearest());
  if (!(trial.nearest() > kMargin)) ++tally.below;
  if (std::getenv("TACTUS_TRIALS") == nullptr || tally.stops > kRepeated) return;
  trial.forget();
  assert_true(trial.begin(false));
  if (trial.run() == Status::kOk && trial.nearest() > kMargin) ++tally.needless;
}

void assert_rests_before_a_box(const Chain& chain) {
  const int wanted = trials(tries(50, 5));
  Tally tally;
  for (int seed = 0; tally.stops < wanted; ++seed) {
    assert_true(seed < 20 * wanted);
    static std::optional<Trial> trial_;
    Trial& trial = trial_.emplace(chain, static_cast<std::uint64_t>(seed));
    if (!trial.begin(true)) {
      ++tally.refused;
      continue;
    }
    const Status status = trial.run();
    if (status == Status::kCollision && trial.of_box()) add(trial, tally);
    if (status == Status::kOk) assert_true(trial.nearest() > kMargin);  // none is missed
  }
  print_message("%s: %d stops, %d below the margin, nearest %.1f mm, %d needless; %d not armed\n",
                chain.name, tally.stops, tally.below, 1e3 * tally.nearest, tally.needless,
                tally.refused);
  assert_int_equal(tally.below, 0);
  assert_true(tally.refused < tally.stops / 2);
}

// Proves COL-14.

void positions(void**) {
  assert_rests_before_a_box({"JRG", "q_c = jrg.q_d\n", kJoints});
}
void positions_of_a_slow_servo(void**) {
  assert_rests_before_a_box({"JRG, 20 ms servo", "q_c = jrg.q_d\n", kJoints, 0.0, 0.02});
}
void poses(void**) {
  assert_rests_before_a_box(
      {"TRG -> CPC", "q_c = cpc.q_c\n", kPoses + pose_control("trg.x_d\nv_d = trg.v_d")});
}
void poses_that_yield(void**) {
  assert_rests_before_a_box({"TRG -> AC -> CPC", "q_c = cpc.q_c\n",
                             kPoses + kAdmittance + pose_control("ac.x_c\nv_d = ac.v_c")});
}
void torques_without_a_velocity(void**) {
  assert_rests_before_a_box({"JRG -> PD", "tau_c = pd.tau\n" + room("_jrg_pdgc"), kJoints + pd()});
}
void torques_with_a_velocity(void**) {
  need_one_of({"fer_trg_ac_cpc_pid", "ur10_trg_ac_cpc_pid"});
  assert_rests_before_a_box(
      {"JRG -> PID", "tau_c = pid.tau\n" + room("_jrg_pid"), kJoints + pid("jrg.q_d", "jrg.dq_d")});
}
void torques_of_an_unknown_load(void**) {
  need_one_of({"fer_trg_ac_cpc_pid", "ur10_trg_ac_cpc_pid"});
  assert_rests_before_a_box({"JRG -> PID, 2.5 kg", "tau_c = pid.tau\n" + room("_jrg_pid"),
                             kJoints + pid("jrg.q_d", "jrg.dq_d"), 2.5});
}
void torques_to_poses(void**) {
  need_one_of({"fer_trg_ac_cpc_pid", "ur10_trg_ac_cpc_pid"});
  assert_rests_before_a_box(
      {"TRG -> CPC -> PID", "tau_c = pid.tau\n" + room("_jrg_pid"),
       kPoses + pose_control("trg.x_d\nv_d = trg.v_d") + pid("cpc.q_c", "cpc.dq_c")});
}

// Proves COL-16.

/// The load pulls when the drives are enabled. No brake helps then: near a box the arm is not
/// armed.
void assert_stays_before_a_box(const char* name, const std::string& law) {
  const Chain chain = {name, "tau_c = pd.tau\n" + room("_jrg_pdgc"), kJoints + law, 2.5};
  const int wanted = trials(tries(60, 10));
  int armed = 0;
  for (int seed = 0; seed < wanted; ++seed) {
    static std::optional<Trial> trial;
    trial.emplace(chain, static_cast<std::uint64_t>(seed), true);
    if (!trial->begin(true)) continue;
    ++armed;
    trial->hold();
    assert_true(trial->nearest() > kMargin);
  }
  print_message("%s: %d armed, %d not\n", name, armed, wanted - armed);
  assert_true(armed > wanted / 20 && armed < wanted - wanted / 10);
}

void an_unknown_load_that_pulls_at_once(void**) {
  assert_stays_before_a_box("JRG -> PD, 2.5 kg", pd());
}
/// A load above a joint pulls the more, the more the joint yields.
void an_unknown_load_that_tips_the_arm_over(void**) {
  assert_stays_before_a_box("JRG -> soft PD, 2.5 kg", pd_with("kp = 120\nkd = 20\n"));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(positions),
      cmocka_unit_test(positions_of_a_slow_servo),
      cmocka_unit_test(poses),
      cmocka_unit_test(poses_that_yield),
      cmocka_unit_test(torques_without_a_velocity),
      cmocka_unit_test(torques_with_a_velocity),
      cmocka_unit_test(torques_of_an_unknown_load),
      cmocka_unit_test(torques_to_poses),
      cmocka_unit_test(an_unknown_load_that_pulls_at_once),
      cmocka_unit_test(an_unknown_load_that_tips_the_arm_over),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
