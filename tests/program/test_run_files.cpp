// Tests that a file which cannot be written is named, that a pipe is read as a file is, and that a
// hangup under nohup ends no run.
#include <algorithm>

#include "program/heap_count.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

Line pipeline() {
  return write("p.ini", {kPipeline});
}

// Proves RUN-22.

/// No file may grow beyond 64 blocks of 512 bytes, as if the disk were full.
void a_log_that_cannot_be_written_is_named_with_the_reason_and_its_rows(void**) {
  pipeline();
  assert_int_equal(shell("ulimit -f 64; exec $P run $S/p.ini --out $S/full"), 1);
  const std::string_view said = errors();
  assert_true(has(said, "/full/log.csv: File too large after "));
  assert_true(has(said, " of 1000 rows; make room or choose another --out\n"));
  assert_int_equal(std::count(said.begin(), said.end(), '\n'), 1);
  assert_true(has(output(), "  incomplete: ") && has(output(), " Hz: not recorded\n"));
  assert_false(has(output(), "succeeded"));
  assert_false(exists("full/summary.json") || exists("full/summary.json.part"));
  assert_true(exists("full/incomplete.txt"));
  assert_succeeds(
      "$P run $S/p.ini --no-figure --out $S/whole >$S/said && "
      "cmp -n 32768 $S/full/log.csv $S/whole/log.csv");
}

/// The disk takes 20 000 bytes of all files.
void a_disk_that_is_full_is_named(void**) {
  if (!kHeapIsCounted) _skip(__FILE__, __LINE__);  // a sanitizer must be the first library
  pipeline();
  write("full.c", {"#include <errno.h>\n#include <unistd.h>\n#include <sys/syscall.h>\n"
                   "long left = 20000;\n"
                   "ssize_t write(int file, const void* bytes, size_t size) {\n"
                   "  if (file > 2 && (left -= size) < 0) return errno = ENOSPC, -1;\n"
                   "  return syscall(SYS_write, file, bytes, size);\n}\n"});
  assert_int_equal(shell("gcc -shared -fPIC -o $S/full.so $S/full.c && "
                         "LD_PRELOAD=$S/full.so $P run $S/p.ini --out $S/nospace"),
                   1);
  assert_true(has(errors(), "/nospace/log.csv: No space left on device after "));
  assert_false(exists("nospace/summary.json"));
}

// Proves RUN-1.

void a_trajectory_from_a_pipe_is_read_and_hashed_as_a_file_is(void**) {
  pipeline();
  write("t.csv", {kHeader, kReady});
  assert_succeeds(
      "run() { timeout 60 $P run $S/p.ini --duration 0.2 --no-figure \"$@\" >$S/said; }\n"
      "cd $S && mkfifo fifo && run --trajectory t.csv --out one && "
      "{ cat t.csv >fifo & run --trajectory fifo --out two; } && "
      "cat t.csv | run --trajectory /dev/stdin --out three && run --out none && "
      "for o in one two three none; do grep config_hash $o/summary.json >$o/hash; done\n"
      "cmp one/hash two/hash && cmp one/hash three/hash && ! cmp -s one/hash none/hash");
}

// Proves RUN-23.

void a_hangup_does_not_end_a_run_under_nohup(void**) {
  pipeline();
  assert_succeeds(
      "size() { stat -c %s h/log.csv 2>/dev/null || echo 0; }\n"
      "grow() { until test $(size) -gt $(($1 + 100000)) -o -e h/summary.json; do sleep 0.01; "
      "done; }\n"
      "cd $S && { nohup $P run p.ini --duration 1000000 --no-figure --out h >said 2>&1 & }\n"
      "grow 0; kill -HUP $!; grow $(size); test ! -e h/summary.json; alive=$?\n"
      "kill -TERM $!; wait $!; test $? = 1 -a $alive = 0");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_log_that_cannot_be_written_is_named_with_the_reason_and_its_rows),
      cmocka_unit_test(a_disk_that_is_full_is_named),
      cmocka_unit_test(a_trajectory_from_a_pipe_is_read_and_hashed_as_a_file_is),
      cmocka_unit_test(a_hangup_does_not_end_a_run_under_nohup),
  };
  return run_program_tests(argv[0], tests);
}
