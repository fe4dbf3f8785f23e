// Tests the program's refusals: exit code, place and reason.
#include <string>

#include "tests/program/program_bench.hpp"
#include "tests/support/cases.hpp"

namespace tactus {
namespace {

/// "path:12: ..." or, if it concerns the whole file, "path: ...".
bool refused_as_expected(const FileCase& file, int code) {
  const std::string_view text = errors(), path = file.path.data();
  const bool digit = file.expected.front() >= '0' && file.expected.front() <= '9';
  const std::size_t begin = path.size() + (digit ? 1 : 2);
  if (code != 2 || text.size() <= begin || text.substr(0, path.size()) != path ||
      text.back() != '\n' || text.substr(path.size(), begin - path.size()) != (digit ? ":" : ": "))
    return has(text, file.path.data()) && false;
  return file.expects(text.substr(begin, text.size() - begin - 1)) && output().empty();
}

// Proves CFG-2.

void every_pipeline_with_a_mistake_is_refused_with_its_message_and_exit_code_2(void**) {
  const int count = judge_cases("tests/refused/pipelines", [](const FileCase& file) {
    return refused_as_expected(file, tactus_run({"check", file.path.data()}));
  });
  assert_true(count > 0);
}

// Proves CSV-2.

void every_trajectory_with_a_mistake_is_refused_with_its_message_and_exit_code_2(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  const int count = judge_cases("tests/refused/trajectories", [&](const FileCase& file) {
    return refused_as_expected(
        file, tactus_run({"check", pipeline.c_str(), "--trajectory", file.path.data()}));
  });
  assert_true(count > 0);
}

// Proves CFG-2, CSV-2, RUN-2.

void run_refuses_as_check_does_and_writes_nothing(void**) {
  const Line pipeline = write("p.ini", {kPipeline}), out = in_folder("refused");
  int runs = 0;
  const auto chosen = [&](const FileCase& file) {  // those with an n at the end
    runs += file.name.back() == 'n';
    return file.name.back() == 'n';
  };
  const int pipelines = judge_cases("tests/refused/pipelines", [&](const FileCase& file) {
    return !chosen(file) ||
           refused_as_expected(
               file, tactus_run({"run", file.path.data(), "--no-figure", "--out", out.c_str()}));
  });
  assert_true(pipelines > 0 && runs >= 23);
  const int trajectories = judge_cases("tests/refused/trajectories", [&](const FileCase& file) {
    return !chosen(file) ||
           refused_as_expected(
               file, tactus_run({"run", pipeline.c_str(), "--trajectory", file.path.data(),
                                 "--no-figure", "--out", out.c_str()}));
  });
  assert_true(trajectories > 0 && runs >= 28);
  assert_false(exists("refused"));
}

// Proves RG-6, RUN-2.

void check_refuses_every_trajectory_that_breaks_a_limit_and_no_other(void**) {
  std::string text(kPipeline);  // without the noise of the state from which it is judged
  text.erase(text.find("[plant]"), text.find("[model]") - text.find("[plant]"));
  const Line pipeline =
      write("p.ini", {text.c_str(), "[guard]\nstop_reserve = 0.1\n[gateway]\ntimes = exact\n"});
  const auto as_expected = [&](const FileCase& file) {
    const char* path = file.path.data();
    const int code = tactus_run({"check", pipeline.c_str(), "--trajectory", path});
    if (file.expected == "accepted") return code == 0 && has(output(), ": accepted, ");
    // The program adds the waypoint's time: "waypoint 2 (t = 1.5 s), joint 4 ...".
    const std::size_t place = file.expected.find_first_of(",:");
    const std::size_t end = std::min(file.expected.find("..."), file.expected.size());
    Line begin(path);
    begin << ": refused: " << file.expected.substr(0, place);
    return code == 2 && has(errors(), begin) && output().empty() &&
           has(errors(), file.expected.substr(place, end - place));
  };
  assert_true(judge_cases("tests/hostile", as_expected) > 0);
}

// Proves RUN-1, CFG-2.

void a_file_that_cannot_be_read_is_refused_with_the_reason(void**) {
  assert_int_equal(tactus_run({"check", "tests/there_is_none.ini"}), 2);
  assert_true(
      errors() ==
      "tests/there_is_none.ini: No such file or directory; give the path of a pipeline file\n");
  assert_int_equal(tactus_run({"run", "tests"}), 2);
  assert_true(errors() == "tests: Is a directory; give the path of a pipeline file\n");
  static char blanks[65537];
  std::memset(blanks, '\n', sizeof blanks - 1);
  const Line path = write("large.ini", {blanks, "\n"});
  assert_int_equal(tactus_run({"check", path.c_str()}), 2);
  assert_true(has(errors(), "large.ini: the file is larger than 65536 bytes\n"));
  const Line pipeline = write("p.ini", {kPipeline});
  assert_int_equal(tactus_run({"check", pipeline.c_str(), "--trajectory", "none.csv"}), 2);
  assert_true(errors() ==
              "none.csv: No such file or directory; give the path of a trajectory file\n");
}

void a_command_line_that_is_not_understood_is_refused(void**) {
  const Line path = write("p.ini", {kPipeline}), out = in_folder("refused");
  const char* p = path.c_str();
  assert_int_equal(tactus_run({}), 2);
  assert_true(has(errors(), "a verb is required: run, serve, check, ports, doctor or jitter"));
  assert_int_equal(tactus_run({"frobnicate"}), 2);
  assert_true(has(errors(), "frobnicate"));
  for (const char* verb : {"run", "check"}) {
    assert_int_equal(tactus_run({verb}), 2);
    assert_true(has(errors(), "pipeline is required"));
    assert_int_equal(tactus_run({verb, ""}), 2);
    assert_int_equal(tactus_run({verb, p, p}), 2);
    assert_int_equal(tactus_run({verb, p, "--no-such-option"}), 2);
    assert_true(has(errors(), "--no-such-option"));
    assert_int_equal(tactus_run({verb, p, "--trajectory"}), 2);
    assert_int_equal(tactus_run({verb, p, "--trajectory", ""}), 2);
  }
  assert_int_equal(tactus_run({"check", p, "--seed", "1"}), 2);
  for (const char* value : {"nan", "inf", "-1", "0", "0x10", "5s", "1e9", ""}) {
    assert_int_equal(tactus_run({"run", p, "--out", out.c_str(), "--duration", value}), 2);
    assert_true(has(errors(), "is not a number from 0.001 to 1000000"));
  }
  for (const char* value : {"-1", "1.5", "18446744073709551616", "0x1", "one", ""}) {
    assert_int_equal(tactus_run({"run", p, "--out", out.c_str(), "--seed", value}), 2);
    assert_true(has(errors(), "is not a whole number of up to 64 bits"));
  }
  assert_false(exists("refused"));
}

// Proves RUN-3.

void help_and_ports_end_with_zero(void**) {
  for (const char* words : {"--help", "--help-all"}) {
    assert_int_equal(tactus_run({words}), 0);
    assert_true(has(output(), "Exit codes: 0 succeeded; 1 ended otherwise; 2 refused before"));
  }
  assert_int_equal(tactus_run({"ports"}), 0);
  assert_has_all(output(), {"## [robot]", "`period_us`", "## type = pd_gravity", "`kp`"});
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_pipeline_with_a_mistake_is_refused_with_its_message_and_exit_code_2),
      cmocka_unit_test(every_trajectory_with_a_mistake_is_refused_with_its_message_and_exit_code_2),
      cmocka_unit_test(run_refuses_as_check_does_and_writes_nothing),
      cmocka_unit_test(check_refuses_every_trajectory_that_breaks_a_limit_and_no_other),
      cmocka_unit_test(a_file_that_cannot_be_read_is_refused_with_the_reason),
      cmocka_unit_test(a_command_line_that_is_not_understood_is_refused),
      cmocka_unit_test(help_and_ports_end_with_zero),
  };
  return run_program_tests(argv[0], tests);
}
