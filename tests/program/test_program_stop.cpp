// Tests [expect] collision_stop on the shipped run that is stopped above a vase, and on changes of
// it: each ends otherwise, and is not as expected.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

int plant_vase(void**) {
  return shell(
      "mkdir -p $S/t && cp $P $S/t/tactus && cp -r pipelines $S/t && cd $S/t/pipelines && "
      "v=fer_trg_cpc_vase.ini && sed 's/^collision_stop .*/collision_stop = link6 vase/' $v "
      ">other.ini && "
      "sed 's/^centre .*/centre = -1 0.1 0/' $v >away.ini && "
      "sed 's/^margin .*/&\\nallow = tool vase/' $v >tool.ini && sed 's/^margin .*/&\\n"
      "allow = tool vase, link7 vase, link6 vase, link5 vase, link4 vase/' $v >let.ini && "
      "sed 's/^margin .*/&\\nallow = tool vase\\nlink_point = link7 0 0 -0.06, 0 0 "
      "0.08, 0.04 0.04 0.08\\nlink_rounding = 0.005/; "
      "s/^collision_stop .*/collision_stop = link7 vase/' $v >hull.ini && "
      "sed 's/^.model./[guard]\\nmax_acceleration = 0.02\\nlimiting_window = "
      "0.05\\nlimiting_share = 0.1\\n&/' $v >slow.ini && sed 's/^.model./[executive]\\nstop_ms = "
      "101\\n&/' $v >moving.ini");
}

int run_all(const char* run, const char* more = "") {
  return shell(
      (Line("cd $S/t && $R/scripts/run_all --no-pictures -- ./tactus ") << run << more).c_str());
}

// Proves RUN-31.

void an_arm_that_is_stopped_as_stated_succeeds(void**) {
  assert_int_equal(run_all("fer_trg_cpc_vase"), 0);
  assert_true(has(output(), "  RUN   fer_trg_cpc_vase: succeeded\n"));
  assert_true(has(output(), "  tool to vase  stopped at "));
  assert_true(has(output(), "  stopped at 10 mm or more  as expected\n"));
  const std::string_view summary = file_of("t/out/fer_trg_cpc_vase/summary.json");
  assert_true(has(summary, "\"stated\": \"tool vase\", \"met\": true}, \"met\": true}"));
  assert_true(has(summary, "\"cause\": \"at_rest\", \"status\": \"kCollision\""));
}

/// In its hull the link is 35 mm shorter than in its capsule, which would be in the vase.
void a_link_is_as_far_from_the_body_as_its_hull(void**) {
  assert_int_equal(run_all("hull"), 0);
  assert_true(has(output(), "  link7 to vase  stopped at "));
}

/// Nothing in the way, or nothing that counts: the square is done, through the vase if it is there.
void an_arm_that_is_not_stopped_is_not_as_expected(void**) {
  assert_int_equal(run_all("away let"), 1);
  assert_true(has(output(), "  RUN   away: not as stated\n"));
  assert_true(has(output(), "  tool to vase  not stopped; nearest: 1."));
  assert_true(has(output(), "  tool to vase  not stopped; nearest: they met"));
  for (const char* run : {"away", "let"})
    assert_true(
        has(errors(), (Line(run) << ".ini: [expect] collision_stop: the arm was not stopped, "
                                    "expected a stop before tool and vase meet\n")
                          .c_str()));
}

void another_pair_or_cause_or_no_rest_is_not_as_expected(void**) {
  assert_int_equal(run_all("other tool slow moving"), 1);
  assert_true(has(errors(),
                  "other.ini: [expect] collision_stop: the arm was stopped before vase and "
                  "tool meet, expected a stop before link6 and vase meet\n"));
  assert_true(has(errors(),
                  "tool.ini: [expect] collision_stop: the arm was stopped before vase and "
                  "link7 meet, expected a stop before tool and vase meet\n"));
  assert_true(has(errors(),
                  "slow.ini: [expect] collision_stop: the arm was stopped by the guard "
                  "limited too many commands (83), expected a stop before "));
  assert_true(has(errors(), "meet, not at rest, expected a stop before tool and vase meet\n"));
  assert_true(has(output(), "  RUN   other: collision (77)\n"));
  assert_true(has(output(), "\n0 of 4 runs as expected\n"));
}

void check_accepts_the_stop_that_is_stated(void**) {
  for (const char* run : {"fer_trg_cpc_vase", "other", "away"})
    assert_int_equal(shell((Line("cd $S/t && ./tactus check pipelines/") << run << ".ini").c_str()),
                     std::string_view(run) == "other" ? 2 : 0);
  assert_true(has(errors(), "in the rehearsal the arm was not stopped"));
}

/// The report measures by itself: of the same run, a wider margin is not kept.
void a_distance_below_the_margin_is_not_as_expected(void**) {
  assert_int_equal(run_all("fer_trg_cpc_vase",
                           " >/dev/null; sed -i 's/^margin .*/margin = 0.2/' "
                           "out/fer_trg_cpc_vase/pipeline.ini; "
                           "$R/scripts/report --no-pictures out fer_trg_cpc_vase"),
                   1);
  assert_true(has(output(), "  stopped at 200 mm or more  not as expected\n"));
}

void a_stop_that_cannot_be_judged_is_refused(void**) {
  const char* const refused[][2] = {
      {"tool vas", "unknown body 'vas'; its names are those of [collision] allow"},
      {"tool", "'tool' is not a pair of names, as in: tool table"},
      {"vase vase", "'vase vase' is not a pair of names, as in: tool table"},
      {"link6 link7", "[collision] does not check link6 against link7"},
      {"tool vase x", "'tool vase x' is not a pair of names, as in: tool table"}};
  for (const auto& [pair, why] : refused) {
    const Line line = Line("cd $S/t && sed 's/^collision_stop.*/collision_stop = ")
                      << pair << "/' pipelines/fer_trg_cpc_vase.ini >pipelines/bad.ini && "
                      << "./tactus check pipelines/bad.ini";
    assert_int_equal(shell(line.c_str()), 2);
    assert_true(has(errors(), (Line("bad.ini: [expect] collision_stop: ") << why << "\n").c_str()));
  }
  assert_int_equal(shell("cd $S/t && sed '/^.collision/,/^margin/d' pipelines/fer_trg_cpc_vase.ini "
                         ">pipelines/bad.ini && ./tactus run pipelines/bad.ini"),
                   2);
  assert_true(has(errors(), "collision_stop: there is no [collision], which would stop the arm\n"));
}

/// Distances of known places: points beside the faces, edges and corners of a box, rods around a
/// cylinder; and the smallest of random ways, of which every row is looked at.
void the_report_measures_distances_by_itself(void**) {
  assert_succeeds(
      "cd scripts && /usr/bin/python3 -B -c \"import numpy as np\n"
      "from reporting import arm, clearance\n"
      "box = clearance.core({'core': 'box', 'half': [1, 2, 3]})\n"
      "at = lambda *p: clearance.apart(np.array([p], float), box)\n"
      "assert np.allclose([at(4, 0, 3), at(4, 6, 0), at(-4, -6, 15)], [3, 5, 13], atol=1e-5)\n"
      "assert at(0, 1, 2) == 0\n"
      "flat = {'core': 'hull', 'rounding': 0, 'points': [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}\n"
      "assert len(arm.surface(flat)[0]) > 3\n"
      "drum = clearance.core({'core': 'cylinder', 'half': [.5, .5, 2]})\n"
      "rods = [np.array([[2 * c - s, 2 * s + c, 1], [2 * c + s, 2 * s - c, 1]]) for c, s in"
      " [(np.cos(a), np.sin(a)) for a in np.arange(.1, 6, .3)]]\n"
      "found = np.array([clearance.apart(rod, drum) for rod in rods])\n"
      "assert np.all(found < 1.5 + 1e-6) and np.all(found > 1.499)\n"
      "random = np.random.default_rng(1)\n"
      "for _ in range(20):\n"
      "    way = np.cumsum(random.normal(0, .1, (60, 1, 3)), axis=0) + [[0, 0, 6], [1, 0, 6]]\n"
      "    every = [clearance.apart(ends, box) - .3 for ends in way]\n"
      "    near = clearance.nearest_of([(way, .2)], [(box[None], .1)])\n"
      "    assert abs(near - min(every)) < 1e-12\"");
}

void the_body_is_what_the_mesh_gives(void**) {
  assert_succeeds(
      "scripts/hull pipelines/meshes/vase.obj >$S/vase && [ -s $S/vase ] && "
      "! grep -vxFf pipelines/fer_trg_cpc_vase.ini $S/vase");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(an_arm_that_is_stopped_as_stated_succeeds, plant_vase),
      cmocka_unit_test(a_link_is_as_far_from_the_body_as_its_hull),
      cmocka_unit_test(an_arm_that_is_not_stopped_is_not_as_expected),
      cmocka_unit_test(another_pair_or_cause_or_no_rest_is_not_as_expected),
      cmocka_unit_test(check_accepts_the_stop_that_is_stated),
      cmocka_unit_test(a_distance_below_the_margin_is_not_as_expected),
      cmocka_unit_test(a_stop_that_cannot_be_judged_is_refused),
      cmocka_unit_test(the_report_measures_distances_by_itself),
      cmocka_unit_test(the_body_is_what_the_mesh_gives),
  };
  return run_program_tests(argv[0], tests);
}
