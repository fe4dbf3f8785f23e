// Tests that a build with sanitizers sees what is planted where tests/support/eigen.ignore could
// hide it: in Eigen's headers, and in what a compiler keeps in registers if nothing in them is
// judged.
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <new>

#include "kernel/core/precompiled.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

#ifdef TACTUS_SANITIZED

using Seven = Eigen::Matrix<double, 7, 1>;
volatile double one = 1.0, sink = 0.0;

void read_beyond_an_array() {
  const double o = one, numbers[6] = {o, o, o, o, o, o};
  sink = Eigen::Map<const Seven>(numbers).sum();
}

void use_an_array_that_has_gone() {
  const double o = one;
  Eigen::Map<const Seven> map(nullptr);
  {
    const double numbers[7] = {o, o, o, o, o, o, o};
    new (&map) Eigen::Map<const Seven>(numbers);
  }
  sink = map.sum();
}

void use_a_temporary_that_has_gone() {
  const auto made = [] { return Seven(Seven::Constant(double(one))); };
  const auto row = made().transpose();
  sink = row.sum();
}

void use_a_part_of_a_temporary_that_has_gone() {
  const Seven all = Seven::Constant(double(one));
  const auto head = (2.0 * all).eval().head<3>();
  sink = head.sum();
}

void read_an_element_that_is_not_there() {
  const Seven all = Seven::Constant(double(one));
  sink = all.coeff(static_cast<Eigen::Index>(7.0 * one));
}

void make_an_integer_of_nan() {
  const Seven all = Seven::Constant(one * std::nan(""));
  sink = all.cast<int>().eval()[3];
}

void add_integers_beyond_the_largest() {
  const Eigen::Vector3i large = Eigen::Vector3i::Constant(static_cast<int>(2e9 * one));
  sink = (large + large).eval()[0];
}

constexpr void (*kPlants[])() = {read_beyond_an_array,
                                 use_an_array_that_has_gone,
                                 use_a_temporary_that_has_gone,
                                 use_a_part_of_a_temporary_that_has_gone,
                                 read_an_element_that_is_not_there,
                                 make_an_integer_of_nan,
                                 add_integers_beyond_the_largest};

/// The status of a process in which the plant is run.
int status_of(void (*plant)()) {
  const pid_t child = fork();
  if (child == 0) {
    close(STDERR_FILENO);
    plant();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

// Proves CHK-6.

void what_is_planted_is_seen(void**) {
  for (const auto plant : kPlants) assert_int_not_equal(status_of(plant), 0);
}

#else

void what_is_planted_is_seen(void**) {
  _skip(__FILE__, __LINE__);
}

#endif

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {cmocka_unit_test(what_is_planted_is_seen)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
