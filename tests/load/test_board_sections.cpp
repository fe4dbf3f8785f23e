// Tests a board's sections: the loader knows every section in the board's list and no other.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "kernel/load/loader.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr const char* kNames[] = {"one", "two", "three", "four", "five", "six"};

struct Number {
  int value = 0;
  double share = 0.5;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("value", value, Range{0.0, 9.0}, "1");
    visit.param("share", share, Range{0.0, 1.0}, "m");
  }
};

/// A board with one section more than kNames; the test chooses the name of the last.
struct Board {
  std::array<Number, 6> numbers;
  const char* more = "seven";
  Number extra;

  template <class Visitor>
  void describe(Visitor& visit) {
    for (std::size_t i = 0; i < numbers.size(); ++i) visit.section(kNames[i], numbers[i]);
    visit.section(more, extra);
  }
};

/// A robot at rest, followed by the given sections.
struct Bench {
  RoomyPipeline pipeline;
  LoadError error;
  Text<1023> text{"[robot]\nname = "};

  explicit Bench(const char* sections) {
    text << Robot::kName << "\nperiod_us = 1000\nq_c = robot.q\n" << sections;
  }
  Status load(Board& board) { return Loader({}, kRobot, board).load(text, pipeline, error); }
  Status load() { return Loader({}, kRobot).load(text, pipeline, error); }
  bool says(const char* message) const {
    print_message("%s\n", error.message().c_str());
    return std::string_view(error.message()).substr(0, std::strlen(message)) == message;
  }
  static constexpr Capabilities kRobot = {true, true, true, 100, 10000};
};

// Proves CFG-6.

void every_section_of_a_board_is_read_however_many_it_has(void**) {
  static Bench bench("[six]\nvalue = 6\n[one]\nvalue = 1\n[five]\nvalue = 5\n[seven]\nvalue = 7\n");
  Board board;
  ASSERT_OK(bench.load(board));
  constexpr int kRead[] = {1, 0, 0, 0, 5, 6};
  for (std::size_t i = 0; i < board.numbers.size(); ++i)
    assert_int_equal(board.numbers[i].value, kRead[i]);
  assert_int_equal(board.extra.value, 7);
}

/// A mistake of whoever wrote the section, not of whoever wrote the file.
void a_default_out_of_its_own_range_is_refused_with_its_value(void**) {
  static Bench bench("[one]\nvalue = 1\n");
  Board board;
  board.numbers[0].share = 5.0;
  ASSERT_STATUS(bench.load(board), Status::kBadValue);
  assert_true(bench.says("5: [one] share: the default 5 m is out of range; it must be in [0, 1]"));
}

void a_section_that_the_board_does_not_have_is_refused_with_those_it_has(void**) {
  static Bench bench("[eight]\nvalue = 6\n");
  Board board;
  ASSERT_STATUS(bench.load(board), Status::kNotOffered);
  assert_true(
      bench.says("5: [eight] this board has no such section; it has robot, guard, "
                 "collision, task_limits, executive, recorder, one, two, three, four, "
                 "five, six, seven; a block has a type, one of robot_model, "));
  static Bench bare("[eight]\nvalue = 6\n");
  ASSERT_STATUS(bare.load(), Status::kNotOffered);
  assert_true(
      bare.says("5: [eight] this board has no such section; it has robot, guard, "
                "collision, task_limits, executive, recorder; a block has a type, "));
  ASSERT_STATUS(bare.load(), Status::kBadValue);
  assert_true(bare.says("a file was read into this pipeline before; take a new one"));
}

void a_section_with_a_type_is_a_block_whatever_other_boards_call_theirs(void**) {
  static Bench block("[six]\ntype = box\ncentre = 0 0 0\nsize = 1 1 1\n");
  ASSERT_OK(block.load());
  assert_int_equal(block.pipeline.count(), 1);
  static Bench unknown("[eight]\ntype = number\n");
  ASSERT_STATUS(unknown.load(), Status::kUnknownType);
  static Bench section("[six]\ntype = box\n");
  Board board;
  ASSERT_STATUS(section.load(board), Status::kUnknownKey);
}

void a_mistake_in_a_section_of_a_board_is_refused_where_it_is(void**) {
  static Bench range("[two]\n\nvalue = 10\n"), key("[two]\nvalues = 1\nvalue = x\n");
  Board board;
  ASSERT_STATUS(range.load(board), Status::kBadValue);
  assert_true(range.says("7: [two] value: 10 is out of range; it must be in [0, 9]"));
  ASSERT_STATUS(key.load(board), Status::kUnknownKey);
  assert_true(key.says("6: [two] values: the section has no such key; it has value"));
}

void a_required_number_without_a_unit_is_reported_without_one(void**) {
  static Bench missing("[two]\n");
  Board board;
  board.numbers[1].value = kRequiredInt;
  ASSERT_STATUS(missing.load(board), Status::kMissingKey);
  assert_string_equal(missing.error.message().c_str(),
                      "5: [two] value: the key is missing; add it");
}

/// Exit of a process whose board calls a section `name`: 0, or the signal that stopped it.
int load_with(const char* name) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);
    close(STDERR_FILENO);
    static Bench bench("[guard]\n[two]\n");
    Board board;
    board.more = name;
    _exit(bench.load(board) == Status::kOk ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
}

void a_name_that_two_sections_have_stops_a_test_build_and_costs_a_release_nothing(void**) {
  assert_int_equal(load_with("seven"), 0);
#ifdef NDEBUG
  constexpr int kEnd = 0;
#else
  constexpr int kEnd = SIGABRT;
#endif
  assert_int_equal(load_with("guard"), kEnd);
  assert_int_equal(load_with("two"), kEnd);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_section_of_a_board_is_read_however_many_it_has),
      cmocka_unit_test(a_default_out_of_its_own_range_is_refused_with_its_value),
      cmocka_unit_test(a_section_that_the_board_does_not_have_is_refused_with_those_it_has),
      cmocka_unit_test(a_section_with_a_type_is_a_block_whatever_other_boards_call_theirs),
      cmocka_unit_test(a_mistake_in_a_section_of_a_board_is_refused_where_it_is),
      cmocka_unit_test(a_required_number_without_a_unit_is_reported_without_one),
      cmocka_unit_test(
          a_name_that_two_sections_have_stops_a_test_build_and_costs_a_release_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
