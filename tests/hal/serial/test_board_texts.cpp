// The text of a board's pipeline: the embedded one, and another that comes over the link.
#include <algorithm>

#include "tests/hal/serial/board_bench.hpp"

namespace tactus::pil {
namespace {

// Proves BRD-7.
void the_embedded_text_is_there_until_another_is_loaded(void**) {
  BoardBench& bench = fresh();
  serial::Greeting embedded, loaded, again;
  ASSERT_OK(bench.board.greet(embedded));
  ASSERT_OK(bench.load(pipeline_text() + "# another\n"));
  ASSERT_OK(bench.board.greet(loaded));
  assert_true(loaded.text != embedded.text);
  std::uint8_t bytes[16];
  ByteWriter part(bytes, sizeof bytes);
  part.u32(0);
  part.text("[robot");
  ASSERT_OK(bench.board.request(Kind::kText, part));
  ASSERT_OK(bench.request(Kind::kStart, static_cast<std::uint8_t>(Pace::kLockStep)));
  ASSERT_OK(bench.board.greet(again));
  assert_true(again.text == embedded.text);
}

void a_text_is_checked_before_it_takes_effect(void**) {
  BoardBench& bench = fresh();
  ASSERT_STATUS(bench.load("[robot]\nname = fer\nperiod_us = 0\n"), Status::kBadValue);
  ByteReader from = bench.board.answer();
  const std::string_view why = from.text(from.u8());
  assert_true(why.find("3: [robot] period_us") == 0);
  assert_true(why.find("[100, 100000]") != std::string_view::npos);
  bench.start(Pace::kLockStep);  // the embedded one is there again
}

void a_text_that_is_too_long_or_another_than_was_sent_is_refused(void**) {
  BoardBench& bench = fresh();
  static char text[9000];
  std::fill_n(text, sizeof text, '#');
  ASSERT_STATUS(bench.load({text, sizeof text}), Status::kTooLarge);
  std::uint8_t bytes[12];
  ByteWriter whole(bytes, sizeof bytes);
  whole.u32(4);
  whole.u64(1);
  ASSERT_STATUS(bench.board.request(Kind::kLoad, whole), Status::kWireFormat);
}

}  // namespace
}  // namespace tactus::pil

int main() {
  using namespace tactus::pil;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_embedded_text_is_there_until_another_is_loaded),
      cmocka_unit_test(a_text_is_checked_before_it_takes_effect),
      cmocka_unit_test(a_text_that_is_too_long_or_another_than_was_sent_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
