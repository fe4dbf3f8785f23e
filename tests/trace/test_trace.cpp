// Tests of what the comparison of machines rests on: every bit that goes out is in the hash, and
// one that differs is found.
#include <cstring>
#include <limits>

#include "gateway/fnv1a.hpp"
#include "tests/program/program_bench.hpp"
#include "tests/trace/trace.hpp"

namespace tactus {
namespace {

Text<4096> printed;

void print(const char* line) {
  printed << line;
}

Trace fresh(const TraceWindow& window = {0, 0xffffffff, 1}) {
  printed = {};
  return {window, print};
}

template <class Value>
std::uint64_t hash_of(Value value) {
  Trace trace = fresh();
  trace.add("value", value);
  return trace.hash();
}

// Proves EXE-11.

void the_hash_is_that_of_the_eight_bytes_from_the_lowest(void**) {
  assert_true(hash_of(std::uint64_t{0x4847464544434241}) == fnv1a("ABCDEFGH"));
}

void the_sign_of_a_zero_and_the_bits_of_a_nan_count(void**) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  double other = 0.0;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &nan, sizeof bits);
  bits ^= 1;
  std::memcpy(&other, &bits, sizeof bits);
  assert_true(hash_of(0.0) != hash_of(-0.0));
  assert_true(hash_of(nan) != hash_of(-nan));
  assert_true(hash_of(nan) != hash_of(other));
}

void the_order_of_two_values_counts(void**) {
  Trace one = fresh(), other = fresh();
  const double forth[] = {1.0, 2.0}, back[] = {2.0, 1.0};
  one.add("values", forth, 2);
  other.add("values", back, 2);
  assert_true(one.hash() != other.hash());
}

void a_window_prints_the_hash_of_some_cycles_or_the_values_of_all(void**) {
  Trace hashes = fresh({1, 4, 2});
  for (int k = 0; k < 6; ++k) hashes.end_cycle();
  assert_string_equal(printed.c_str(), "2 cbf29ce484222325\n4 cbf29ce484222325\n");
  Trace values = fresh({1, 1, 0});
  for (int k = 0; k < 3; ++k) {
    values.add("q", -0.0);
    values.end_cycle();
  }
  assert_string_equal(printed.c_str(), "1 q 0 8000000000000000\n");
}

void every_output_of_a_kind_that_a_pipeline_has_counts(void**) {
  Jacobian jacobian = Jacobian::Zero();
  PortEntry port{Name("model"), "J", Quantity::kJacobian, &jacobian};
  Trace before = fresh();
  before.add(port);
  jacobian(5, kDof - 1) = 1.0;
  Trace after = fresh({0, 0, 0});
  after.add(port);
  assert_true(before.hash() != after.hash());
  Line last("0 model.J ");
  last << 6 * kDof - 1 << " 3ff0000000000000\n";
  assert_true(has(printed, last));
}

void a_bit_that_differs_is_found_by_cycle_and_value(void**) {
  for (const char* cycle : {"0", "1", "255", "256", "257", "699"}) {
    setenv("CYCLE", cycle, 1);
    assert_int_equal(shell("/usr/bin/python3 tests/trace/find_bit.py $P $S $CYCLE"), 1);
    assert_true(has(output(), (Line(" cycle ") << cycle << ", robot.q[2]\n").c_str()));
    assert_true(has(output(), "3f50624de0000000 != 3f50624dc0000000"));
  }
}

void the_same_tape_gives_the_same_bytes_whatever_the_memory_held(void**) {
  assert_int_equal(shell("/usr/bin/python3 tests/trace/find_bit.py $P $S 0 90"), 0);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_hash_is_that_of_the_eight_bytes_from_the_lowest),
      cmocka_unit_test(the_sign_of_a_zero_and_the_bits_of_a_nan_count),
      cmocka_unit_test(the_order_of_two_values_counts),
      cmocka_unit_test(a_window_prints_the_hash_of_some_cycles_or_the_values_of_all),
      cmocka_unit_test(every_output_of_a_kind_that_a_pipeline_has_counts),
      cmocka_unit_test(a_bit_that_differs_is_found_by_cycle_and_value),
      cmocka_unit_test(the_same_tape_gives_the_same_bytes_whatever_the_memory_held),
  };
  return run_program_tests(argv[0], tests, "trace");
}
