// A script that does what a page tells its reader to do, and compares.
#pragma once

#include "tests/program/program_bench.hpp"

namespace tactus {

struct PageScript {
  const char* command;

  void assert_true_of(const char* page) const { assert_succeeds((Line(command) << page).c_str()); }
  /// The page.md that the test has written is not true, for this reason.
  void assert_finds(const char* complaint) const {
    assert_int_equal(shell((Line(command) << "$S/page.md").c_str()), 1);
    assert_true(has(errors(), complaint));
  }
};

}  // namespace tactus
