// Tests sets of parameters for a pipeline that runs: what is taken, what is refused, and that it is
// all or nothing.
#include "kernel/load/parameter_book.hpp"

#include <cmath>
#include <string>

#include "kernel/pipeline/with_block.hpp"
#include "tests/load/loader_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// A pipeline that was started, with its book.
struct BookBench : LoaderBench {
  ParameterBook* book = nullptr;
  LoadError why;

  BookBench() {
    ASSERT_OK(load(kValid));
    ASSERT_OK(pipeline.start(state_at(0.0, 0.0)));
    book = new ParameterBook(pipeline);
  }
  ~BookBench() { delete book; }
  BookBench(const BookBench&) = delete;
  BookBench& operator=(const BookBench&) = delete;

  Status set(std::initializer_list<ParameterText> texts) {
    return book->prepare(texts.begin(), static_cast<int>(texts.size()), why);
  }
  /// Lets the pipeline take what is prepared.
  void take(bool runs = true) {
    ASSERT_OK(pipeline.retune(book->tuning(), runs).status);
    book->commit();
  }
  const PdGravity& pd(std::string_view name) {
    int i = 0;
    while (std::string_view(pipeline.name(i)) != name) ++i;
    return *static_cast<const PdGravity*>(pipeline[i].place);
  }
  bool says(const char* part) const {
    return std::string_view(why.message()).find(part) != std::string_view::npos;
  }
  /// The set is refused with this status, and every part of the text is in the message; nothing is
  /// left to take.
  void refuses(std::initializer_list<ParameterText> texts, Status status,
               std::initializer_list<const char*> parts) {
    ASSERT_STATUS(set(texts), status);
    for (const char* part : parts) {
      if (!says(part)) print_error("'%s' is not in '%s'\n", part, why.message().c_str());
      assert_true(says(part));
    }
    for (const void* copy : book->tuning().copies) assert_null(copy);
  }
};

// Proves PAR-1.

void a_set_is_read_as_the_same_lines_of_a_file(void**) {
  BookBench bench;
  ASSERT_OK(bench.set(
      {{"stiff", "kp", "  200 "}, {"soft", "kd", "1 2 3 4 5 6 7.5"}, {"stiff", "kd", "2e1"}}));
  bench.take();
  LoaderBench& file = *new LoaderBench;
  ASSERT_OK(file.load(edit(kValid, "kp = 100\nkd = 1e1", "kp = 200\nkd = 2e1")));
  for (int i = 0; i < kDof; ++i) {
    assert_true(bench.pd("stiff").params.kp[i] == 200.0);
    assert_true(bench.pd("stiff").params.kd[i] == 20.0);
    assert_true(bench.pd("soft").params.kp[i] == 10.0);  // as before
  }
  assert_true(bench.pd("soft").params.kd[6] == 7.5);
  assert_true(bench.pd("soft").params.kd[0] == 1.0);
  delete &file;
}

/// The same text in a file and in a set is refused with the same words, or taken by both.
void a_value_is_judged_as_in_a_file(void**) {
  BookBench bench;
  for (const char* value :
       {"nan", "inf", "-inf", "-1", "0", "0x10", "1e999", "1 2 3", "1 2 3 4 5 6 7 8",
        "1 2 3 4 5 6 x", "1,5", "1e-400", "5", "1e300", "1 2 3 4 5 6 -7", "+5", "--5", "5 5"}) {
    LoaderBench& file = *new LoaderBench;
    const std::string line = std::string("kp = ") + value;
    const Status by_file = file.load(edit(kValid, "kp = 100", line));
    const Status by_set = bench.set({{"stiff", "kp", value}});
    assert_true(by_set == by_file);
    assert_string_equal(bench.why.reason.c_str(), file.error.reason.c_str());
    bench.book->drop();
    delete &file;
  }
}

// Proves PAR-2.

void what_is_wrong_is_named_with_place_value_limit_and_remedy(void**) {
  BookBench b;
  b.refuses({{"stiff", "kp", "-3"}}, Status::kBadValue, {"[stiff]", "kp", "-3", "> 0"});
  b.refuses({{"stiff", "kp", ""}}, Status::kBadValue, {"[stiff]", "kp", "missing"});
  b.refuses({{"stiff", "kq", "3"}}, Status::kUnknownKey, {"[stiff]", "kq", "kp, kd"});
  b.refuses({{"stif", "kp", "3"}}, Status::kUnknownKey, {"[stif]", "soft, stiff"});
  b.refuses({{"stiff", "kp", "3"}, {"stiff", "kp", "3"}}, Status::kDuplicate, {"kp", "once"});
  b.refuses({}, Status::kMissingKey, {"empty"});
  b.refuses({{"", "kp", "3"}}, Status::kBadSyntax, {"section"});
  b.refuses({{"stiff", "", "3"}}, Status::kBadSyntax, {"[stiff]", "key"});
}

void what_is_fixed_is_refused_with_what_to_do(void**) {
  BookBench b;
  for (const ParameterText& fixed : {ParameterText{"guard", "max_velocity", "0.5"},
                                     {"robot", "tool_mass", "1"},
                                     {"robot", "name", "fer"},
                                     {"robot", "tau_c", "soft.tau"},
                                     {"jrg", "online", "limit"},
                                     {"jrg", "path_tolerance", "1"},
                                     {"stiff", "type", "pid"},
                                     {"stiff", "q_d", "robot.q"},
                                     {"stiff", "g", "model.g"},
                                     {"executive", "max_slip", "1"},
                                     {"recorder", "signals", "robot.q"}})
    b.refuses({fixed}, Status::kNotOffered, {"while the pipeline runs", "edit the pipeline file"});
}

void texts_that_are_no_parameters_are_refused(void**) {
  BookBench b;
  const std::string longest(192, '1'), far(5000, '1');
  for (const ParameterText& bad : {ParameterText{"stiff", "kp", "1\n[guard]"},
                                   {"stiff", "kp", "1 # 2"},
                                   {"stiff", "kp", "\x01"},
                                   {"stiff", "kp", "1\xff"},
                                   {"stiff", "kp", longest},
                                   {"stiff", "kp", far},
                                   {"stiff", far, "1"},
                                   {far, "kp", "1"},
                                   {"stiff]", "kp", "1"},
                                   {"[stiff", "kp", "1"},
                                   {"stiff", "kp = 1", "1"},
                                   {"stiff", "kp ", "1"},
                                   {" stiff", "kp", "1"},
                                   {"stiff", "k\xc3\xa4", "1"},
                                   {"st\tiff", "kp", "1"}}) {
    assert_true(b.set({bad}) != Status::kOk);
    for (const char c : std::string(b.why.message().c_str())) assert_true(c >= 0x20 && c < 0x7f);
  }
}

// Proves PAR-3.

void one_mistake_refuses_the_whole_set(void**) {
  BookBench b;
  ASSERT_OK(b.set({{"soft", "kp", "77"}}));
  b.take();
  b.refuses({{"stiff", "kp", "200"}, {"soft", "kp", "20"}, {"soft", "kd", "1 2"}},
            Status::kBadValue, {"[soft]", "kd"});
  ASSERT_OK(b.set({{"stiff", "kd", "3"}}));
  b.take();
  assert_true(b.pd("stiff").params.kp[0] == 100.0);
  assert_true(b.pd("soft").params.kp[0] == 77.0);
  assert_true(b.pd("stiff").params.kd[0] == 3.0);
}

/// Random sets of good and bad parameters against a model: a map of the values that are in force.
void random_sets_are_taken_whole_or_not_at_all(void**) {
  BookBench b;
  Random random{5};
  double kp[2] = {10.0, 100.0}, kd = 10.0;
  constexpr const char* kNames[] = {"soft", "stiff"};
  int taken = 0;
  for (int round = 0; round < 2000; ++round) {
    double next[2] = {kp[0], kp[1]}, next_kd = kd;
    std::array<std::array<char, 24>, 4> words;
    std::array<ParameterText, 4> set;
    int count = 0;
    bool good = true;
    for (int i = 0; i < 2; ++i) {
      if (random.below(2) == 0) continue;
      next[i] = random.below(4) == 0 ? -1.0 : 1.0 + random.below(1000);
      good = good && next[i] > 0.0;
      std::snprintf(words[i].data(), words[i].size(), "%.0f", next[i]);
      set[static_cast<std::size_t>(count++)] = {kNames[i], "kp", words[i].data()};
    }
    if (random.below(2) == 0) {
      next_kd = 1.0 + random.below(100);
      std::snprintf(words[2].data(), words[2].size(), "%.0f", next_kd);
      set[static_cast<std::size_t>(count++)] = {"stiff", "kd", words[2].data()};
    }
    if (random.below(8) == 0) {
      set[static_cast<std::size_t>(count++)] = {"stiff", "kx", "1"};
      good = false;
    }
    good = good && count > 0;
    const Status status = b.book->prepare(set.data(), count, b.why);
    assert_int_equal(status == Status::kOk, good);
    if (good && random.below(4) != 0) {
      b.take();
      kp[0] = next[0];
      kp[1] = next[1];
      kd = next_kd;
      ++taken;
    } else {
      b.book->drop();
    }
    for (int i = 0; i < 2; ++i) assert_true(b.pd(kNames[i]).params.kp[0] == kp[i]);
    assert_true(b.pd("stiff").params.kd[0] == kd);
  }
  assert_true(taken > 300);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_set_is_read_as_the_same_lines_of_a_file),
      cmocka_unit_test(a_value_is_judged_as_in_a_file),
      cmocka_unit_test(what_is_wrong_is_named_with_place_value_limit_and_remedy),
      cmocka_unit_test(what_is_fixed_is_refused_with_what_to_do),
      cmocka_unit_test(texts_that_are_no_parameters_are_refused),
      cmocka_unit_test(one_mistake_refuses_the_whole_set),
      cmocka_unit_test(random_sets_are_taken_whole_or_not_at_all),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
