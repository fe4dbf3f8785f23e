// Tests the program in real time: cycles by the wall clock, and the report on the host. No test
// depends on the speed of the host.
#include <csignal>
#include <ctime>

#include "tests/hal/os/host_tree.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

std::string_view file_of(const char* name) {
  static Content text;
  return content(in_folder(name).c_str(), text);
}

Line pipeline(const char* realtime) {
  return write("rt.ini", {kPipeline, kBusyHost, "[realtime]\n", realtime});
}

int run_into(const char* name, const Line& file, const char* duration = "0.2") {
  return tactus_run({"run", file.c_str(), "--realtime", "--duration", duration, "--no-figure",
                     "--out", in_folder(name).c_str()});
}

// Proves RT-4.

void a_run_in_real_time_ends_with_all_its_rows_and_a_summary(void**) {
  assert_int_equal(run_into("a", pipeline(""), "0.191"), 0);
  int lines = 0;
  for (const char c : file_of("a/log.csv")) lines += c == '\n';
  assert_int_equal(lines, 1 + 20);  // every tenth cycle, the last of them too
  assert_has_all(
      file_of("a/summary.json"),
      {"\"cycles\": 191,", "\"realtime\": {", "\"latency\": {\"min_ns\": ", "\"p99_ns\": ",
       "\"page_faults\": ", "\"steps\": {\"cpu\": \"not asked\", \"lock_memory\": \"",
       "\"recorder_dropped\": 0", "\"heap_allocations_in_cycle\": 0"});
  Line command("python3 -m json.tool ");
  command << in_folder("a/summary.json") << " >" << in_folder("json");
  assert_int_equal(std::system(command.c_str()), 0);
  assert_true(has(output(), "wake-up"));
  assert_true(has(output(), "real time: cpu not asked, "));
}

void a_run_in_virtual_time_says_nothing_of_it(void**) {
  const Line file = pipeline("required = refuse\ncpu = 1023\n");  // would be refused
  assert_int_equal(tactus_run({"run", file.c_str(), "--duration", "0.05", "--no-figure", "--out",
                               in_folder("v").c_str()}),
                   0);
  assert_true(file_of("v/summary.json").find("realtime\"") == std::string_view::npos);
}

void an_interrupt_ends_a_run_in_real_time_with_its_files_written(void**) {
  const Line file = pipeline("");
  const pid_t child = spawn({"run", file.c_str(), "--realtime", "--duration", "1000000",
                             "--no-figure", "--out", in_folder("c").c_str()});
  for (int i = 0; i < 60'000 && file_of("c/log.csv").empty(); ++i) {
    const timespec millisecond = {0, 1'000'000};
    nanosleep(&millisecond, nullptr);
  }
  assert_int_equal(kill(child, SIGINT), 0);
  assert_int_equal(exit_code(child), 1);
  assert_true(has(file_of("c/summary.json"), "{\"code\": 1, \"name\": \"interrupted\"}"));
  assert_true(has(file_of("c/summary.json"), "\"realtime\": {"));
}

// Proves RT-6.

void what_the_system_refuses_is_a_warning_or_ends_the_start_as_the_file_says(void**) {
  constexpr const char* kSaid = " cpu (Invalid argument: choose a CPU";
  assert_int_equal(run_into("w", pipeline("cpu = 1023\n")), 0);
  assert_true(has(errors(), "note: real time is not certain: cpu"));
  assert_true(has(errors(), kSaid));
  assert_true(output().find("real time: cpu") == std::string_view::npos);  // once is enough
  assert_true(has(file_of("w/summary.json"), "\"cpu\": \"refused\""));
  assert_int_equal(run_into("r", pipeline("cpu = 1023\nrequired = refuse\n")), 2);
  assert_true(has(errors(), kSaid));
  assert_true(has(errors(), "real time: refused: cpu"));
  assert_true(has(errors(), "; [realtime] required = refuse; with required = warn, on a desk,"));
  assert_false(exists("r"));
}

// Proves RT-5.

void doctor_prints_a_line_for_every_item_and_ends_with_1_if_one_that_is_required_hurts(void**) {
  HostTree tree;
  assert_int_equal(tactus_run({"doctor", "--root", tree.root(), "--cpu", "2"}), 0);
  for (const HostFile& file : kHostFiles) assert_true(has(output(), file.item));
  assert_true(has(output(), "ok       kernel           required  #1 SMP PREEMPT_RT"));
  assert_true(output().find("hurts ") == std::string_view::npos);
  tree.put("/proc/swaps", "Filename\n/swapfile file 1\n");
  assert_int_equal(tactus_run({"doctor", "--root", tree.root(), "--cpu", "2"}), 0);
  assert_true(has(output(), "hurts    swap             better    /swapfile\n"));
  assert_true(has(output(), " /proc/swaps: other programs wait for the disk"));
  assert_true(has(output(), "-> swapoff -a\n"));
  assert_true(has(output(), "unknown  coalescing       better    no interface is named\n"));
  assert_true(has(output(), "No required setting is known to hurt real time; 4 are unknown.\n"));
  assert_int_equal(tactus_run({"doctor", "--root", tree.root(), "--priority", "98"}), 0);
  tree.put("/proc/sys/kernel/version", "#1 SMP\n");
  assert_int_equal(tactus_run({"doctor", "--root", tree.root(), "--cpu", "2"}), 1);
  assert_true(has(output(), "hurts    kernel           required  #1 SMP\n"));
  tree.remove_all();
}

// Proves RT-8.

void options_that_are_no_plain_numbers_in_range_are_refused(void**) {
  for (const char* value : {"-1", "1024", "0x1", "1.5", "one", ""}) {
    assert_int_equal(tactus_run({"doctor", "--cpu", value}), 2);
    assert_true(has(errors(), "is not a whole number from 0 to 1023"));
  }
  for (const char* value : {"0", "99", "-5", "max"})
    assert_int_equal(tactus_run({"jitter", "--priority", value}), 2);
  for (const char* value : {"99", "100001", "1e3", "nan"})
    assert_int_equal(tactus_run({"jitter", "--period-us", value}), 2);
  for (const char* value : {"0", "-1", "nan", "inf", "1e6"})
    assert_int_equal(tactus_run({"jitter", "--duration", value}), 2);
  for (const char* value : {"gpu", "cpu;disk", "cpu,", ""})
    assert_int_equal(tactus_run({"jitter", "--load", value, "--duration", "0.01"}), 2);
  for (const char* value : {"", "a/b", "a b", "sixteen_letters_"})
    assert_int_equal(tactus_run({"doctor", "--interface", value}), 2);
  assert_int_equal(tactus_run({"doctor", "--interface", "fifteen_letters", "--cpu", "x"}), 2);
  assert_true(has(errors(), "--cpu"));
  assert_int_equal(tactus_run({"check", "x.ini", "--realtime"}), 2);
  assert_int_equal(tactus_run({"doctor", "x.ini"}), 2);
  assert_int_equal(tactus_run({"doctor", "--root", ""}), 2);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_run_in_real_time_ends_with_all_its_rows_and_a_summary),
      cmocka_unit_test(a_run_in_virtual_time_says_nothing_of_it),
      cmocka_unit_test(an_interrupt_ends_a_run_in_real_time_with_its_files_written),
      cmocka_unit_test(what_the_system_refuses_is_a_warning_or_ends_the_start_as_the_file_says),
      cmocka_unit_test(
          doctor_prints_a_line_for_every_item_and_ends_with_1_if_one_that_is_required_hurts),
      cmocka_unit_test(options_that_are_no_plain_numbers_in_range_are_refused),
  };
  return run_program_tests(argv[0], tests);
}
