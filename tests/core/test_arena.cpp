// Tests Arena: objects lie behind each other, each where its type may lie, and never beyond the
// end.
#include "kernel/core/arena.hpp"

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves MEM-4.

void objects_lie_behind_each_other_each_where_it_may(void**) {
  alignas(16) std::byte bytes[64];
  Arena arena(bytes, sizeof bytes);
  assert_ptr_equal(arena.take(3, 1), bytes);
  assert_ptr_equal(arena.take(8, 8), bytes + 8);
  assert_ptr_equal(arena.take(1, 1), bytes + 16);
  assert_ptr_equal(arena.take(16, 16), bytes + 32);
  assert_int_equal(arena.left(), 16);
  assert_int_equal(arena.size(), 64);
}

void the_last_byte_is_used_and_none_beyond(void**) {
  alignas(8) std::byte bytes[32];
  Arena arena(bytes, sizeof bytes);
  assert_null(arena.take(33, 1));
  assert_ptr_equal(arena.take(17, 1), bytes);
  assert_null(arena.take(9, 8));  // seven bytes are skipped, and eight are left
  assert_int_equal(arena.left(), 15);
  assert_ptr_equal(arena.take(8, 8), bytes + 24);
  assert_null(arena.take(1, 1));
  assert_int_equal(arena.left(), 0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(objects_lie_behind_each_other_each_where_it_may),
      cmocka_unit_test(the_last_byte_is_used_and_none_beyond),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
