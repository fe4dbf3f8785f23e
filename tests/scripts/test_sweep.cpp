// Tests scripts/sweep: a row for each run, the numbers of which are those of `tactus run`.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Two gains and three seeds; every run stands for 20 ms.
constexpr const char* kSweep =
    "printf '[sweep]\\nprogram = %s\\npipeline = a.ini\\nduration_s = 0.02\\nseeds = 1 4..5\\n"
    "[set]\\npd.kp = 500 | 700 # N m/rad\\nplant.friction = uniform(0.5, 1.5)\\n' $P "
    ">gains.sweep; ";

/// Runs the commands where a.ini and gains.sweep are; $sweep runs the latter.
void assert_sweeps(const char* commands) {
  write("a.ini", {kPipeline});
  Text<4095> line("cd $S && rm -rf rows.csv kept && ");
  line << kSweep << "sweep=\"$R/scripts/sweep gains.sweep --out rows.csv\"; " << commands;
  assert_succeeds(line.c_str());
}

// Proves RUN-33.

void every_run_has_a_row_with_the_numbers_of_the_run(void**) {
  assert_sweeps(
      "$sweep && [ \"$(cut -d, -f1,3 rows.csv | tr '\\n' ' ')\" = "
      "'pd.kp,seed 500,1 500,4 500,5 700,1 700,4 700,5 ' ] && "
      "friction=$(awk -F, '$1 == 700 && $3 == 4 { print $2 }' rows.csv) && "
      "[ $friction = $(awk -F, '$1 == 500 && $3 == 4 { print $2 }' rows.csv) ] && "
      "[ $(cut -d, -f2 rows.csv | sort -u | wc -l) = 4 ] && "
      "$P run a.ini --duration 0.02 --no-log --out one --seed 4 --set pd.kp=700 "
      "--set plant.friction=$friction >/dev/null && "
      "/usr/bin/python3 -c 'import csv, json; error = "
      "json.load(open(\"one/summary.json\"))[\"tracking\"][0]; "
      "row = list(csv.DictReader(open(\"rows.csv\")))[4]; "
      "assert [float(row[f\"robot.q_{i}_rms\"]) for i in range(1, 8)] == error[\"rms\"], row; "
      "assert row[\"result\"] == \"succeeded\" and row[\"cycles\"] == \"20\", row' && [ ! -e kept "
      "]");
}

void a_sweep_that_was_interrupted_goes_on_to_the_same_rows(void**) {
  assert_sweeps(
      "$sweep && cp rows.csv whole.csv && head -c -40 whole.csv | sed 3d >rows.csv && "
      "$sweep --jobs 1 >said; grep -q '^sweep: 6 runs, 4 of them are in ' said && "
      "sort whole.csv >whole.sorted && "
      "sort rows.csv | cmp - whole.sorted && "
      "$sweep >said && grep -q 'nothing to do' said && sort rows.csv | cmp - whole.sorted");
}

/// Otherwise old numbers would pass for those of the new file.
void rows_of_another_pipeline_do_not_count(void**) {
  assert_sweeps(
      "$sweep && sed -i 's/^kd = .*/kd = 40/' a.ini && "
      "$sweep >said && grep -q '^sweep: 6 runs, 0 of them are in ' said && [ $(wc -l <rows.csv) = "
      "13 ]");
}

void a_refused_run_has_a_row_that_says_why_and_the_others_go_on(void**) {
  assert_sweeps(
      "sed -i 's/500 |/-1 |/' gains.sweep; code=0; $sweep || code=$?; [ $code = 1 ] && "
      "[ $(grep -c 'refused,.*pd.kp=-1: .pd. kp: joint 1: -1 N m/rad is out of range' rows.csv) = "
      "3 ] "
      "&& [ $(grep -c succeeded rows.csv) = 3 ] && [ $(head -n 1 rows.csv | grep -c q_7_final) = 1 "
      "]");
}

void logs_are_kept_if_they_are_asked_for(void**) {
  assert_sweeps(
      "$sweep --keep kept && for case in $(tail -n +2 rows.csv | cut -d, -f4); do "
      "test -s kept/$case/log.csv -a -s kept/$case/pipeline.ini || exit 1; done");
}

void a_mistake_in_the_file_of_a_sweep_is_named(void**) {
  assert_sweeps(
      "try() { sed \"$1\" gains.sweep >wrong.sweep; code=0; "
      "$R/scripts/sweep wrong.sweep --out wrong.csv 2>said || code=$?; "
      "[ $code = 2 ] && grep -q \"$2\" said; }; "
      "try 's/^pipeline.*//' '.sweep. pipeline: missing' && "
      "try 's/^pipeline.*/pipeline = b.ini/' '.sweep. pipeline: there is no file b.ini' && "
      "try 's/^seeds.*/seeds = 4..1/' \"seeds: '4..1' are 0; give 1 to 1000000\" && "
      "try 's/^seeds.*/seeds = 1-4/' \"seeds: '1-4' is neither a whole number nor a range\" && "
      "try 's/^seeds/sedes/' '.sweep. sedes: there is no such key; it has duration_s, ' && "
      "try 's/^.set./[sets]/' '.sets. is none of .sweep., .set.' && "
      "try 's/0.5, 1.5/low, high/' 'write uniform(LOW, HIGH)' && "
      "echo a,b >wrong.csv && try '' 'has the rows of another sweep, or of none' && "
      "{ flock held.csv $R/scripts/sweep gains.sweep --out held.csv 2>said; [ $? = 2 ]; } && "
      "grep -q 'held.csv: another sweep writes its rows; wait for its end' said && "
      "for out in . /dev/full; do $R/scripts/sweep gains.sweep --out $out 2>said; "
      "[ $? = 2 ] && grep -q 'sweep: .*: a folder or a device' said || exit 1; done");
}

void the_file_of_the_page_is_that_of_the_example(void**) {
  assert_succeeds(
      "plain() { sed 's/ *#.*//; /^ *$/d' \"$@\"; }; plain pipelines/fer_gains.sweep >$S/example "
      "&& "
      "sed -n '/^```ini$/,/^```$/p' docs/sweep.md | sed '/^```/d' | plain | cmp - $S/example");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_run_has_a_row_with_the_numbers_of_the_run),
      cmocka_unit_test(a_sweep_that_was_interrupted_goes_on_to_the_same_rows),
      cmocka_unit_test(rows_of_another_pipeline_do_not_count),
      cmocka_unit_test(a_refused_run_has_a_row_that_says_why_and_the_others_go_on),
      cmocka_unit_test(logs_are_kept_if_they_are_asked_for),
      cmocka_unit_test(a_mistake_in_the_file_of_a_sweep_is_named),
      cmocka_unit_test(the_file_of_the_page_is_that_of_the_example),
  };
  return run_program_tests(argv[0], tests);
}
