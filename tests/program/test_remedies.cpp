// Tests that what the program tells people to do helps: every row makes a mistake, reads the
// remedies, applies each and sees the run succeed; and makes another mistake, of which they are not
// told. docs/mistakes.md has the list.
#include <string>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Shell commands in a folder with p.ini, a law of torques that takes t.csv to joint 1 at 0.2 rad.
struct Remedy {
  const char* cause;
  const char* said;     ///< by the run, which fails
  const char* words;    ///< the remedy in what is said
  const char* applied;  ///< after it the same run succeeds
  const char* other;    ///< another cause, of which the words are not said
};

constexpr const char* kLaw =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\ndq = robot.dq\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n"
    "[plant]\narming_cycles = 0\n"
    "[gateway]\nsettle_s = 0.1\n"
    "[recorder]\ndivisor = 10\ntracking = jrg.q_d robot.q\n";
constexpr const char* kTo = "2,0.2,-0.785398,0,-2.356194,0,1.570796,0.785398\n";
constexpr const char* kBack = "4,0,-0.785398,0,-2.356194,0,1.570796,0.785398\n";

// `to SECTION LINES` adds lines to a section of p.ini.
constexpr const char* kSags =
    "to plant 'payload_kg = 3'; to jrg 'path_tolerance = 0.05\\ngoal_time_s = 0.5'; rm t.csv";
constexpr const char* kTurned =
    "to plant 'mounting = 1.57 0 0'; to jrg 'path_tolerance = 0.05\\ngoal_time_s = 0.5'; rm t.csv";
constexpr const char* kSlow =
    "to jrg 'path_tolerance = 0.03'; sed -i 's/^2,0.2/2.2,1.1/; /^4/d' t.csv";
constexpr const char* kFar = "to jrg 'goal_tolerance = 1e-6\\ngoal_time_s = 0.5'";
constexpr const char* kWeak =
    "to jrg 'goal_tolerance = 0.005 1 1 1 1 1 1\\ngoal_time_s = 0.5'; "
    "sed -i 's/= 500 400/= 50 400/' p.ini";
constexpr const char* kLate =
    "to jrg 'goal_tolerance = 0.005 1 1 1 1 1 1\\ngoal_time_s = 0.2\\nstopped_velocity = 0'; "
    "sed -i 's/= 500 400/= 100 400/; s/= 50 40/= 100 40/' p.ini";
constexpr const char* kSwings =
    "to jrg 'goal_tolerance = 1\\nstopped_velocity = 0.01\\ngoal_time_s = 0.3'; "
    "to plant 'friction = 0'; sed -i 's/= 50 40/= 0.5 40/' p.ini";
constexpr const char* kBrief =
    "to jrg 'goal_tolerance = 1\\nstopped_velocity = 0\\ndwell_ms = 500\\ngoal_time_s = 0.4'";
constexpr const char* kTip =
    "sed '/^trajectory/d; s/_gain = 10 10 10/_gain = 400 400 400/; "
    "s/^type = cartesian_pose/&\\nhold_tolerance = 0.001/' $R/pipelines/fer_trg_cpc.ini >p.ini; "
    "printf '[plant]\\nservo_time_constant_s = 0.05\\ndelay_cycles = 4\\nposition_noise_rad = "
    "5e-5\\n' >>p.ini; rm t.csv; more='--duration 14'";
constexpr const char* kMillimetres =
    "cp $R/pipelines/fer_trg_cpc.ini p.ini; awk -F, -v OFS=, '/^[0-9]/ { $2 *= 1000; $3 *= 1000; "
    "$4 *= 1000 } 1' $R/pipelines/trajectories/fer_square.csv >t.csv";
constexpr const char* kAtRest =
    "awk '{ for (i = 1; i <= 7; ++i) $0 = $0 (NR > 1 ? \",0\" : \",dq\" i \"_rad_s\") } 1' t.csv "
    ">u; "
    "mv u t.csv";
constexpr const char* kHurried =
    "awk '{ for (i = 1; i <= 7; ++i) $0 = $0 (NR > 1 ? \",0\" : \",dq\" i \"_rad_s\") } 1' t.csv "
    ">u; "
    "sed 's/^4,0,/2.3,1,/' u >t.csv; to gateway 'times = exact'";

constexpr const char* kNoLaw =
    "sed -i '/^.pd.$/,/^kd/d; s/tau_c = pd.tau/q_c = jrg.q_d/' p.ini; "
    "to plant 'servo_time_constant_s = 0.2'; "
    "to jrg 'goal_tolerance = 1e-9\\ngoal_time_s = 0.1'";

constexpr Remedy kRemedies[] = {
    {kSags, "joint 6 (fer_joint6): path error 0.1", "look at gains",
     "sed -i '/^kp/s/.*/kp = 500 4000 400 3000 400 400 10/' p.ini", kFar},
    {kSags, "its reference rests", "gains, tool", "to robot 'tool_mass = 3'", kFar},
    {kTurned, "its reference rests", "tool and mounting", "to robot 'mounting = 1.57 0 0'", kSlow},
    {kSags, "its reference rests", "path_tolerance = 0",
     "sed -i 's/^path_tolerance.*/path_tolerance = 0/' p.ini", kFar},
    {kSlow, "path not followed: joint 1", "more time", "sed -i 's/^2.2/20/' t.csv", kFar},
    {kSlow, "path not followed: joint 1", "raise the gains",
     "sed -i 's/= 500 400/= 2000 400/' p.ini", kNoLaw},
    {kSlow, "path not followed: joint 1", "or path_tolerance",
     "sed -i 's/^path_tolerance.*/path_tolerance = 2/' p.ini", kFar},
    {kFar, "goal not reached", "goal_tolerance", "sed -i 's/= 1e-6/= 0.05/' p.ini", kSlow},
    {kWeak, "goal not reached", "raise the gains", "sed -i 's/= 50 400/= 5000 400/' p.ini", kNoLaw},
    {kLate, "goal not reached", "goal_time_s", "sed -i 's/^goal_time_s.*/goal_time_s = 9/' p.ini",
     kSlow},
    {kSwings, "velocity", "raise the damping", "sed -i 's/= 0.5 40/= 50 40/' p.ini", kFar},
    {kSwings, "velocity", "stopped_velocity",
     "sed -i 's/^stopped_velocity.*/stopped_velocity = 1/' p.ini", kFar},
    {kBrief, "but not for dwell_ms", "a shorter dwell_ms",
     "sed -i 's/dwell_ms = 500/dwell_ms = 50/' p.ini", kFar},
    {kBrief, "but not for dwell_ms", "a longer goal_time_s",
     "sed -i 's/time_s = 0.4/time_s = 4/' p.ini", kFar},
    {"more='--duration 3'", "the trajectory ends at 4 s", "a longer --duration",
     "more='--duration 9'", kFar},
    {"sed -i 's/^2,.*/2,0,-45,0,-135,0,90,45/; 3d' t.csv", "position -45 rad", "degrees",
     "sed -i '1s/rad/deg/g' t.csv", "sed -i '2s/-0.785398/-1.9/' t.csv"},
    {"sed -i '2{h;d};3G' t.csv", "is earlier than", "sort them",
     "{ head -1 t.csv; tail -2 t.csv | sort; } >u; mv u t.csv", "sed -i '2s/^2/-2/' t.csv"},
    {"sed -i '2s/^2/-2/' t.csv", "is earlier than 0 s", "begin at t = 0 or later",
     "sed -i '2s/^-2/2/' t.csv", "sed -i '2{h;d};3G' t.csv"},
    {"sed -i 's/^4/1795000004/; s/^2/1795000002/' t.csv", "is later than", "subtract the first",
     "sed -i 's/^179500000//' t.csv", "sed -i '2{h;d};3G' t.csv"},
    {"sed -i 's/^2,0.2/0,1/' t.csv", "distance from the reference", "begin there",
     "sed -i 's/^0,1/0,0/' t.csv", kSlow},
    {"sed -i 's/^2,0.2/0,1/' t.csv", "distance from the reference", "or later than at t = 0",
     "sed -i 's/^0,1/2.9,0.3/; s/^4/7/' t.csv", kSlow},
    {"sed -i 's/^4,0/2.1,1/' t.csv", "velocity step", "this part more time",
     "sed -i 's/^2.1,1/9,1/' t.csv", "sed -i 's/^2,0.2/0,1/' t.csv"},
    {"sed -i 's/^4,0/2.6,1/' t.csv", "velocity step", "interpolation = monotone",
     "to gateway 'interpolation = monotone'", "sed -i 's/^2,0.2/0,1/' t.csv"},
    {"to robot 'tool_com = 0 0 0.1'", "a centre of mass of nothing", "add tool_mass, in kg",
     "to robot 'tool_mass = 0.2'", kFar},
    {"to robot 'tool_mass = 0.2'; sed -i '/^tool =/d' p.ini", "gives a tool or a mounting",
     "add tool = robot.tool", "to model 'tool = robot.tool'", kFar},
    {"sed -i '/^kd/d' p.ini", "the key is missing", "add it, in N m s/rad",
     "to pd 'kd = 50 40 40 5 2 2 1'", "sed -i 's/^kd.*/kd = -1/' p.ini"},
    {"printf '[expect]\\ntracking_m = 1\\n' >>p.ini", "no error of a pose is measured",
     "[recorder] tracking, reference first", "sed -i 's/^tracking = .*/& jrg.x_d model.x/' p.ini",
     kFar},
    {"to gateway 'wrap = nearest'", "wrap = nearest", "leave it out", "sed -i '/^wrap/d' p.ini",
     kFar},
    {"more='--out p.ini/o'", "Not a directory", "choose another --out", "more='--out other'", kFar},
    {"printf '[realtime]\\ncpu = 1023\\nrequired = refuse\\n' >>p.ini; "
     "more='--realtime --duration 0.05'; rm t.csv",
     "real time: refused", "with required = warn",
     "sed -i 's/= refuse/= warn/' p.ini; printf '[executive]\\nmax_slip = 1000\\nmax_late = "
     "16\\nlate_window = 1\\nmax_overruns = 16\\noverrun_window = 1\\n' >>p.ini",
     kFar},
    {kTip, "rotation: path error 0.00", "look at gains",
     "sed -i 's/ = 400 400 400/ = 10 10 10/' p.ini", kFar},
    {kTip, "block [cpc]: its reference rests", "hold_tolerance = 0",
     "sed -i 's/^hold_tolerance.*/hold_tolerance = 0/' p.ini", kSags},
    {kMillimetres, "position 4", "are these millimetres",
     "sed -i 's/x_m,y_m,z_m/x_mm,y_mm,z_mm/' t.csv", "sed -i 's/^2,0.2/2,9/' t.csv"},
    {"sed -i 's/^4,0/2.6,1/' t.csv", "velocity step", "give velocities", kAtRest, kHurried},
    {kHurried, " exceeds ", "give this part more time", "sed -i 's/^2.3/9/' t.csv", kSlow},
};

/// Runs the files of a row after these commands; returns the exit code.
int run_after(const char* cause, const char* remedy) {
  write("p.ini", {kLaw});
  write("t.csv", {kHeader, kTo, kBack});
  Text<4095> command(
      "cd $S && rm -rf o other && more=''\n"
      "to() { sed -i \"/^.$1.$/a $2\" p.ini; }\n");
  command << cause << "\n"
          << remedy
          << "\n! test -f t.csv || more=\"--trajectory t.csv $more\"\n"
             "case \"$more\" in *--out*) ;; *) more=\"--out o $more\" ;; esac\n"
             "case \"$more\" in *.csv*|*--dur*) ;; *) more=\"--duration 2 $more\" ;; esac\n"
             "$P run p.ini --no-figure $more";
  return shell(command.c_str());
}

// Proves RUN-30.

void every_remedy_helps_and_is_not_named_where_the_cause_is_another(void**) {
  int failed = 0;
  for (const Remedy& row : kRemedies) {
    const bool fails = run_after(row.cause, "") != 0;
    const std::size_t at = errors().find(row.said);
    const bool said = fails && has(errors(), row.said) && has(errors().substr(at), row.words);
    const bool helps = said && run_after(row.cause, row.applied) == 0;
    if (said && !helps) has(errors(), "no error");
    const bool other_fails = run_after(row.other, "") != 0;
    const bool apart = other_fails && errors().find(row.words) == std::string_view::npos;
    if (!apart) has(errors(), "nothing of it");
    if (said && helps && apart) continue;
    print_error("%s: '%s': said %d, helps %d, apart %d\n", row.said, row.words, said, helps, apart);
    ++failed;
  }
  assert_int_equal(failed, 0);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_remedy_helps_and_is_not_named_where_the_cause_is_another),
  };
  return run_program_tests(argv[0], tests);
}
