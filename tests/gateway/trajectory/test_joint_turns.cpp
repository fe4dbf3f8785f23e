// Tests that the angles of joints without end are taken the short way if that is asked for, and
// that nothing else is changed; the oracle is numpy.unwrap. Valid for any robot: one whose joints
// all have stops changes nothing.
#include "gateway/joint_turns.hpp"

#include <cmath>
#include <cstring>

#include "gateway/trajectory/trajectory_reader.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSeeds = 5;

bool continuous(int joint) {
  return (Robot::kContinuousJoints >> joint & 1U) != 0;
}

JointSpace::Point at(double angle) {
  JointSpace::Point point;
  point.q.setConstant(angle);
  return point;
}

/// Opens a file of the folder.
void open(TrajectoryReader<JointSpace>& reader, const char* name) {
  CsvError error;
  assert_true(reader.open(in_folder(name).c_str(), false, 0, error));
}

bool next(TrajectoryReader<JointSpace>& reader, Waypoint<JointSpace>& waypoint) {
  CsvError error;
  const RowResult taken = reader.next(waypoint, error);
  assert_true(taken != RowResult::kRefused);
  return taken == RowResult::kWaypoint;
}

void write_files(int seed) {
  Line command("$R/tests/gateway/trajectory/wrapped_files.py $S ");
  command << seed << " " << static_cast<int>(Robot::kContinuousJoints);
  for (int i = 0; i < kDof; ++i) command << " " << position_unit(i);
  assert_succeeds(command.c_str());
}

bool same(const JointVector& a, const JointVector& b) {
  return std::memcmp(a.data(), b.data(), sizeof a) == 0;
}

/// Compares one waypoint with the same as it was written and with what the oracle makes of it.
void compare(const JointSpace::Point& taken, const JointSpace::Point& written,
             const JointSpace::Point& oracle) {
  for (int i = 0; i < kDof; ++i) {
    const double turns = (taken.q[i] - written.q[i]) / (2.0 * kPi);
    if (!continuous(i)) assert_true(taken.q[i] == written.q[i]);
    ASSERT_NEAR(turns, std::round(turns), 1e-12);
    ASSERT_NEAR(taken.q[i], oracle.q[i], 1e-11);
  }
  assert_true(same(taken.dq, written.dq) && same(taken.ddq, written.ddq));
}

// Proves CSV-9.

void wrapped_files_are_taken_as_numpy_unwraps_them(void**) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    write_files(seed);
    static TrajectoryReader<JointSpace> reader, file, oracle;
    Waypoint<JointSpace> taken, written, expected;
    open(file, "wrapped.csv");
    assert_true(next(file, written));
    reader.take_angles(Wrap::kNearest, written.point.q);
    for (int pass = 0; pass < 2; ++pass) {  // the second time after a rewind
      CsvError error;
      if (pass == 0)
        open(reader, "wrapped.csv");
      else
        assert_true(reader.rewind(error));
      open(file, "wrapped.csv");
      open(oracle, "unwrapped.csv");
      JointVector last = written.point.q;
      int rows = 0;
      for (; next(reader, taken); last = taken.point.q, ++rows) {
        assert_true(next(file, written) && next(oracle, expected));
        compare(taken.point, written.point, expected.point);
        for (int i = 0; i < kDof; ++i)
          if (continuous(i)) assert_true(std::abs(taken.point.q[i] - last[i]) <= kPi + 1e-9);
      }
      assert_int_equal(rows, 400);
      assert_null(reader.turns().longest());
      open(file, "wrapped.csv");
      assert_true(next(file, written));
    }
  }
}

void files_are_taken_as_they_are_written_unless_it_is_asked_for(void**) {
  write_files(1);
  static TrajectoryReader<JointSpace> reader, oracle;
  open(reader, "wrapped.csv");
  open(oracle, "wrapped.csv");
  reader.take_angles(Wrap::kAsGiven, JointVector::Constant(50.0));
  Waypoint<JointSpace> taken, written;
  while (next(reader, taken)) {
    assert_true(next(oracle, written));
    assert_true(same(taken.point.q, written.point.q));
  }
  assert_true((reader.turns().longest() != nullptr) == (Robot::kContinuousJoints != 0));
}

void half_turns_stay_and_turns_beyond_count_go(void**) {
  constexpr struct {
    double reference, angle, nearest;
  } kCases[] = {
      {0.0, kPi, kPi},
      {0.0, -kPi, -kPi},
      {0.0, 3.1416, 3.1416},  // as files write it
      {3.141593, 0.0, 0.0},
      {kPi, -kPi, kPi},
      {-kPi, kPi, -kPi},
      {3.0, -3.0, 2.0 * kPi - 3.0},
      {-3.0, 3.0, 3.0 - 2.0 * kPi},
      {-12.0, 6.0, 6.0 - 6.0 * kPi},
      {12.5, 0.1, 0.1 + 4.0 * kPi},
      {0.0, 2000.0 * kPi + 0.5, 0.5},
  };
  for (const auto& [reference, angle, nearest] : kCases) {
    JointTurns turns;
    turns.begin(Wrap::kNearest, JointVector::Constant(reference));
    JointSpace::Point point = at(angle);
    turns.take(point);
    for (int i = 0; i < kDof; ++i) ASSERT_NEAR(point.q[i], continuous(i) ? nearest : angle, 1e-11);
  }
}

void what_is_no_angle_stays(void**) {
  const double kNan = std::nan("");
  for (const double wrong : {1e300, -1e300, 1e6, kInfinity, -kInfinity, kNan}) {
    for (const double reference : {0.0, 1e300, kInfinity, kNan}) {
      JointTurns turns;
      turns.begin(Wrap::kNearest, JointVector::Constant(reference));
      JointSpace::Point point = at(wrong), after = at(1.0);
      turns.take(point);
      turns.take(after);
      assert_true(same(point.q, JointVector::Constant(wrong)));
      assert_true(std::isfinite(after.q[0]));
      for (const int waypoint : {-1, 0, 1, 2})
        assert_null(turns.explain({Status::kVelocityStep, waypoint, 0, 1.0, 0.0}));
    }
  }
}

void joints_that_are_left_out_hold(void**) {
  JointTurns turns;
  turns.begin(Wrap::kNearest, JointVector::Constant(9.0));
  turns.leave_out({1U});
  JointSpace::Point point = at(0.0);
  turns.take(point);
  assert_true(point.q[0] == 0.0);
}

// Proves CSV-10.

/// Two waypoints of joint `i`, the others at rest.
JointTurns steps(int joint, double from, double to) {
  JointTurns turns;
  JointSpace::Point point = at(0.0);
  point.q[joint] = from;
  turns.begin(Wrap::kAsGiven, point.q);
  turns.take(point);
  point.q[joint] = to;
  turns.take(point);
  turns.take(point);
  return turns;
}

void a_turn_explains_a_refusal_at_or_beside_it(void**) {
  for (int i = 0; i < kDof; ++i) {
    const JointTurns turns = steps(i, 3.1, -3.1);  // by 0.0832 rad less than a turn
    const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(i)];
    const bool reaches = limit.q_min <= -3.1;
    for (const Status status : {Status::kVelocityStep, Status::kPositionLimit, Status::kJerkLimit})
      for (const int waypoint : {0, 1, 2}) {
        const TurnStep* const step = turns.explain({status, waypoint, i, 1.0, 0.0});
        assert_true((step != nullptr) == reaches);
        if (step == nullptr) continue;
        assert_int_equal(step->waypoint, 1);
        ASSERT_NEAR(step->step, -6.2, 1e-12);
        ASSERT_NEAR(step->nearest, 2.0 * kPi - 6.2, 1e-12);
        const Message text = remedy(*step);
        assert_non_null(std::strstr(text.c_str(), "2 pi"));
        assert_true((std::strstr(text.c_str(), "wrap = nearest") != nullptr) == continuous(i));
      }
    assert_null(turns.explain({Status::kVelocityStep, 3, i, 1.0, 0.0}));
    assert_null(turns.explain({Status::kVelocityStep, 1, (i + 1) % kDof, 1.0, 0.0}));
    assert_null(turns.explain({Status::kReferenceTime, 1, i, 1.0, 0.0}));
    assert_true((turns.longest() != nullptr) == (reaches && continuous(i)));
  }
}

void what_is_no_turn_explains_nothing(void**) {
  for (int i = 0; i < kDof; ++i) {
    const double kDegrees = 170.0;
    for (const double to : {kDegrees, 3.0, 1e300}) {
      const JointTurns turns = steps(i, 0.0, to);
      assert_null(turns.explain({Status::kPositionLimit, 1, i, to, 1.0}));
      assert_null(turns.longest());
    }
    // A long way of a joint with stops is a way.
    if (!continuous(i)) assert_null(steps(i, 1.0, -3.0).explain({Status::kVelocityStep, 1, i}));
  }
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(wrapped_files_are_taken_as_numpy_unwraps_them),
      cmocka_unit_test(files_are_taken_as_they_are_written_unless_it_is_asked_for),
      cmocka_unit_test(half_turns_stay_and_turns_beyond_count_go),
      cmocka_unit_test(what_is_no_angle_stays),
      cmocka_unit_test(joints_that_are_left_out_hold),
      cmocka_unit_test(a_turn_explains_a_refusal_at_or_beside_it),
      cmocka_unit_test(what_is_no_turn_explains_nothing),
  };
  return run_program_tests(argv[0], tests);
}
