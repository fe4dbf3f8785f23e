// Tests the results of `make run`: the table, the report and the code metric. The scripts are
// started as a user starts them, from the root of the project.
#include <csignal>
#include <ctime>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// The arm sags until the guard stops it.
constexpr const char* kWeak =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n[pd]\ntype = pd_gravity\nq_d = "
    "robot.q\n"
    "q = robot.q\ndq = robot.dq\nkp = 1\nkd = 1\n[guard]\nmax_velocity = 1e-3\n";

int count(std::string_view text, std::string_view part) {
  int found = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// A tree in the scratch folder with a pipeline that succeeds and one that does not, and a copy of
/// the program, which finds no script that draws figures.
int plant_pipelines(void**) {
  shell("mkdir -p $S/t/pipelines/trajectories && cp $P $S/t/tactus");
  write("t/pipelines/good.ini", {kPipeline, "[gateway]\ntrajectory = trajectories/t.csv\n"});
  write("t/pipelines/trajectories/t.csv", {kHeader, kReady});
  write("t/pipelines/weak.ini", {kWeak});
  return 0;
}

// Proves RUN-4, RUN-5.

void a_run_that_fails_stops_no_other_and_the_table_says_so(void**) {
  assert_int_equal(shell("cd $S/t && $R/scripts/run_all -- ./tactus weak nowhere good"), 1);
  assert_true(has(output(), "  RUN   weak: measured velocity limit (68)\n"));
  assert_true(has(output(), "  RUN   nowhere: refused\n"));
  assert_true(has(output(), "  RUN   good: succeeded\n"));
  assert_true(has(output(), "\nweak     fer, simulated  nothing "));
  assert_true(has(output(), "  measured velocity limit (68)\nnowhere  "));
  assert_true(has(output(), "  refused\ngood     fer, simulated  nothing  max joint error  "));
  assert_true(has(output(), "  as expected\n\n1 of 3 runs as expected\n"));
  assert_true(has(errors(), "weak.ini: stopped: joint "));
  assert_true(has(errors(), " rad/s exceeds 0.0011 rad/s (68)\n"));
  assert_true(has(errors(), "nowhere.ini: "));
}

/// Checks the folder that the three runs above have left.
void the_report_shows_every_run_and_what_failed(void**) {
  const std::string_view page = file_of("t/out/report.html");
  for (const char* part : {
           "1 of 3 runs as expected",
           "\"provenance\">2 runs of a robot arm simulated by MuJoCo; 1 run <b>unknown</b>, for "
           "which ",
           "<p class=\"note\">Made 20",
           "judged by its mean force",
           "<td data-head=\"verdict\">as expected<small>20",
           "<a href=\"#run-weak\">weak</a>",
           "<tr class=\"failed\" data-run=\"weak\">",
           "<tr class=\"failed\" data-run=\"nowhere\">",
           "<tr class=\"met\" data-run=\"good\">",
           "did not succeed: <b>measured velocity limit (68)</b>",
           "weak.ini: stopped: joint ",
           "out/nowhere/summary.json: No such file or directory",
           "<section id=\"run-good\">",
           "Waypoints (circles), reference (dashed) and measured (solid) joint position",
           "Tracking error, jrg.q_d - robot.q",
           "The guard limited 0 of ",
           "Execution times",
           "kernel/control/pd_gravity",
           "905 of its 1745 source lines (52 %)",
       })
    assert_true(has(page, part));
  assert_int_equal(count(page, ": arm and path\""), 2);
  assert_int_equal(count(page, "src=\""), count(page, "src=\"data:image/svg+xml;base64,"));
  assert_true(has(page, "content=\"default-src 'none'; img-src data:; "));  // fetches nothing
}

void the_images_of_the_report_are_well_formed(void**) {
  assert_succeeds(
      "/usr/bin/python3 -c \"import base64, os, re, xml.etree.ElementTree as tree\n"
      "page = open(os.environ['S'] + '/t/out/report.html').read()\n"
      "for data in re.findall('svg.xml;base64,([^\\\"]*)', page):\n"
      "    assert tree.fromstring(base64.b64decode(data)).tag.endswith('svg')\"");
}

// Proves RUN-6.

void a_damaged_file_is_named_and_the_rest_is_drawn(void**) {
  assert_int_equal(
      shell("cd $S/t/out && for c in json log key form cell flat; do cp -r good $c; done\n"
            "echo '{' >json/summary.json; rm log/log.csv\n"
            "sed -i 's/\"signals\"/\"other\"/' key/summary.json\n"
            "sed -i 's/\"rate_hz\": 1000/\"rate_hz\": \"fast\"/' form/summary.json\n"
            "sed -i '3s/,[^,]*/,x/' cell/log.csv; sed -i 3s/,.*// flat/log.csv\n"
            "cd .. && $R/scripts/report out json log key form cell flat nothing good"),
      1);
  for (const char* part : {
           "report: out/json/summary.json: not JSON: ",
           "report: out/log/log.csv: No such file or directory\n",
           "report: out/key/summary.json: no key 'signals'\n",
           "report: out/form/summary.json: rate_hz: \"fast\" is not ",
           "report: out/cell/log.csv:3: robot.q_1 is 'x', not a number\n",
           "report: out/flat/log.csv:3: 1 cells, the header has ",
           "report: out/nothing/summary.json: No such file or directory\n",
       })
    assert_true(has(errors(), part));
  assert_int_equal(count(errors(), "\n"), 7);
  const std::string_view page = file_of("t/out/report.html");
  assert_true(has(page, "out/cell/log.csv:3: robot.q_1 is &#x27;x&#x27;, not a number"));
  assert_int_equal(count(page, ": arm and path\""), 1);
}

// Proves RUN-10.

/// The first ended before its first cycle, the second has a FIFO, the third no name in UTF-8.
void a_folder_is_shown_whatever_it_is_called_and_holds(void**) {
  assert_int_equal(
      shell(
          "cd $S/t && mkdir -p odd && cd odd && for c in none fifo; do cp -r ../out/good $c; done\n"
          "sed -i 's/\"cycles\": [0-9]*/\"cycles\": 0/; s/\"code\": 0/\"code\": 39/; "
          "s/succeeded/kNotAtRest/' none/summary.json; sed -i 2,\\$d none/log.csv\n"
          "rm fifo/log.csv; mkfifo fifo/log.csv; cp -r ../out/good x:y; cp -r ../out/weak x_y\n"
          "cp -r ../out/good \"$(printf 'b\\377d')\"; cd .. && timeout 100 $R/scripts/report odd"),
      1);
  assert_true(has(output(), "  refused: not at rest (39)\n"));
  assert_true(has(output(), "\nb\357\277\275d "));
  assert_true(has(output(), "  as expected\nx_y "));
  assert_string_equal(Line(errors()).c_str(), "report: odd/fifo/log.csv: not a regular file\n");
  const std::string_view page = file_of("t/odd/report.html");
  assert_true(has(page, "<section id=\"run-x.3a.y\">"));
  assert_true(has(page, "No real robot moved: 5 runs of a robot arm simulated by MuJoCo."));
  assert_false(exists("t/odd/report.part.html"));
}

void figure_and_report_say_what_they_lack(void**) {
  assert_int_equal(shell("mkdir -p $S/bare && $R/scripts/report $S/bare"), 1);
  assert_true(has(errors(), "/bare: no folder of a run in it\n"));
  assert_int_equal(shell("$R/scripts/figure $S/bare"), 1);
  assert_true(has(errors(), "/bare/summary.json: No such file or directory\n"));
}

// Proves RUN-5.

void success_is_0_and_nothing_of_an_earlier_run_is_left(void**) {
  assert_succeeds("cd $S/t && $R/scripts/run_all --no-pictures -- $P good");
  assert_true(has(output(), "\nout/report.html: "));
  const std::string_view page = file_of("t/out/report.html");
  assert_true(has(page, "No real robot moved: 1 run of a robot arm simu"));
  assert_true(has(page, ", without pictures</p>"));
  for (const char* picture : {"<img", "<figure", "<script"})
    assert_int_equal(count(page, picture), 0);
  assert_false(exists("t/out/runs.png"));
  write("t/pipelines/good.ini", {"[robot]\n"});
  assert_int_equal(shell("cd $S/t && $R/scripts/run_all -- $P good -- ./none weak"), 1);
  assert_true(has(errors(), "./none: No such file or directory\n"));
  for (const char* name : {"good/summary.json", "good/log.csv", "good/waypoints.csv",
                           "good/figure.png", "good/figure.pdf", "weak/summary.json"})
    assert_false(exists((Line("t/out/") << name).c_str()));
}

void an_interrupt_ends_what_is_under_way_and_begins_nothing_more(void**) {
  write("t/slow", {"#!/bin/sh\necho $$ >>$S/began\nsleep 10 >/dev/null 2>&1\necho >>$S/late\n"});
  assert_succeeds("chmod +x $S/t/slow");
  char words[3][96] = {"sh", "-c",
                       "cd $S/t && exec $R/scripts/run_all -- ./slow a b c >$S/out 2>$S/err"};
  char* const arguments[] = {words[0], words[1], words[2], nullptr};
  for (const int signal : {SIGINT, SIGTERM}) {
    std::remove(in_folder("began").c_str());
    pid_t child = 0;
    assert_int_equal(posix_spawn(&child, "/bin/sh", nullptr, nullptr, arguments, environ), 0);
    for (int i = 0; i < 60'000 && count(file_of("began"), "\n") < 2; ++i) {
      const timespec millisecond = {0, 1'000'000};
      nanosleep(&millisecond, nullptr);
    }
    assert_int_equal(kill(child, signal), 0);
    assert_int_equal(exit_code(child), 130);
    assert_true(has(errors(), "run_all: interrupted\n"));
    int first = 0, second = 0, third = 0;
    assert_int_equal(
        std::sscanf(Line(file_of("began")).c_str(), "%d %d %d", &first, &second, &third), 2);
    assert_int_equal(kill(first, 0), -1);
    assert_int_equal(kill(second, 0), -1);
    assert_false(exists("late"));
    assert_false(exists("t/out/c"));
  }
}

/// A drawing process interrupts the program that has begun it, and then draws for long.
void an_interrupt_while_figures_are_drawn_is_quiet(void**) {
  write("t/interrupt.py",
        {"import os, runpy, signal, sys, time\nroot, script = os.environ['R'], sys.argv[1]\n",
         "sys.path.insert(0, root + '/scripts')\nfrom reporting import plots, runs\n",
         "home = os.getpid()\ndef slow(*_):\n    os.kill(home, signal.SIGINT)\n",
         "    time.sleep(100)\nplots.write_figures = runs.folder_of = slow\n",
         "sys.argv[:2] = [script]\n",
         "runpy.run_path(f'{root}/scripts/{script}', run_name='__main__')\n"});
  for (const char* words : {"figure out/good", "report out good good"}) {
    Line line("cd $S/t && timeout 60 /usr/bin/python3 -B interrupt.py ");
    assert_int_equal(shell((line << words).c_str()), 130);
    assert_string_equal(Line(errors()).c_str(), "");
  }
}

// Proves RUN-8.

void the_code_metric_counts_code_and_nothing_else(void**) {
  assert_succeeds(
      "cd $S && mkdir -p tree/kernel/control tree/kernel/core "
      "tree/kernel/reference/motion tree/gateway");
  write("tree/kernel/control/law.hpp",
        {"// a comment\n#pragma once\n\n/* two\n lines */\nint f(); /* and */ // more\n"});
  write("tree/kernel/control/law.cpp",
        {"const char* a = \"/*\";\nint b;\nconst char* c = \"*/ //\";\n",
         "const char d = '\"'; // \"\n  \t\nint x; /*\n*/ int y;\n"});
  write("tree/kernel/reference/motion/r.cpp", {"int a;\nint b;\nint c; // c\n// d\n"});
  write("tree/kernel/core/mailbox.hpp", {"int m;\n"});
  assert_succeeds("$R/scripts/code_metric $S/tree | tr -s ' '");
  assert_true(has(output(), "kernel/control/law 3 8 27 %\n"));
  assert_true(has(output(), "in addition: kernel/core/mailbox.hpp 1 "));
  assert_true(has(output(), "in addition: gateway 0 "));
  assert_int_equal(shell("$R/scripts/code_metric $S/nowhere"), 1);
  assert_true(has(errors(), "/nowhere/kernel/core/mailbox.hpp: No such file or directory\n"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_run_that_fails_stops_no_other_and_the_table_says_so,
                             plant_pipelines),
      cmocka_unit_test(the_report_shows_every_run_and_what_failed),
      cmocka_unit_test(the_images_of_the_report_are_well_formed),
      cmocka_unit_test(a_damaged_file_is_named_and_the_rest_is_drawn),
      cmocka_unit_test(a_folder_is_shown_whatever_it_is_called_and_holds),
      cmocka_unit_test(figure_and_report_say_what_they_lack),
      cmocka_unit_test(an_interrupt_while_figures_are_drawn_is_quiet),
      cmocka_unit_test_setup(success_is_0_and_nothing_of_an_earlier_run_is_left, plant_pipelines),
      cmocka_unit_test(an_interrupt_ends_what_is_under_way_and_begins_nothing_more),
      cmocka_unit_test(the_code_metric_counts_code_and_nothing_else),
  };
  return run_program_tests(argv[0], tests);
}
