// Tests the loader with randomly damaged files. Built with SANITIZE=address,undefined it proves
// that no such text makes it read or write out of bounds.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>

#include "tests/load/loader_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

LoaderBench bench;

char* line_begin(char* text, char* at) {
  while (at > text && at[-1] != '\n') --at;
  return at;
}

char* line_end(char* at, char* end) {
  at = std::find(at, end, '\n');
  return at == end ? end : at + 1;
}

void swap_lines(char* text, std::size_t size, std::size_t one, std::size_t other) {
  char* const a = line_begin(text, text + std::min(one, other));
  char* const b = line_begin(text, text + std::max(one, other));
  char* const end = line_end(b, text + size);
  if (a == b) return;
  const auto a_size = line_end(a, b) - a, b_size = end - b;
  std::rotate(a, b, end);                             // the first line after the second
  std::rotate(a + b_size, a + b_size + a_size, end);  // and now after those between them
}

/// Makes one random change to the first `size` bytes of `text`; returns the new size, at most the
/// old one.
std::size_t damage(std::mt19937_64& random, char* text, std::size_t size) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  if (size < 2) return size;
  const std::size_t at = below(size), length = below(size - at), other = below(size - length);
  switch (below(12)) {
    case 0:  // the end is missing
      return at;
    case 1:  // a part is missing
      std::memmove(text + at, text + at + length, size - at - length);
      return size - length;
    case 2:  // a part is repeated
      std::memmove(text + other, text + at, length);
      return size;
    case 3:  // any byte
      text[at] = static_cast<char>(random());
      return size;
    case 4:  // a flipped bit
      text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      return size;
    case 5:  // a byte of the file's syntax
      text[at] = "\n=[].#_- 0e"[below(11)];
      return size;
    case 6: swap_lines(text, size, at, other < size ? other : 0); return size;
    default:  // another digit
      for (std::size_t i = at; i < size; ++i) {
        if (text[i] < '0' || text[i] > '9') continue;
        text[i] = static_cast<char>('0' + below(10));
        break;
      }
      return size;
  }
}

/// Asserts that the refusal gives a line of the text and a reason, or is one of the two that
/// concern the whole file.
bool says_where_and_why(const LoadError& error, std::string_view text) {
  const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
  const std::string_view reason = error.reason;
  if (error.line == 0)
    return reason == "the file is empty: it has no section" || reason == "the section is missing";
  return error.status != Status::kOk && error.line <= lines && !reason.empty();
}

/// Loads the text from a block of its own, so that the address sanitizer detects a read past its
/// end, and runs a loaded pipeline for a cycle.
Status load_alone(const char* text, std::size_t size) {
  char* const block = static_cast<char*>(std::malloc(size));
  std::memcpy(block, text, size);
  const Status status = bench.load({block, size});
  if (status == Status::kOk && bench.pipeline.start(state_at(0.0, 0.0)) == Status::kOk)
    static_cast<void>(bench.pipeline.step(state_at(0.1, 0.1)));
  std::free(block);
  return status;
}

// Proves CFG-2, CFG-3.

void no_damage_crashes_the_loader_and_every_refusal_says_where_and_why(void**) {
  constexpr std::uint64_t kSeed = 1906;
  std::mt19937_64 random(kSeed);
  int loaded = 0, refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    char text[kValid.size()];
    std::size_t size = kValid.size();
    std::memcpy(text, kValid.data(), size);
    for (auto n = random() % 3 + 1; n > 0; --n) size = damage(random, text, size);
    const Status status = load_alone(text, size);
    const LoadError& error = bench.error;
    assert_true(status == error.status);
    const bool good = status == Status::kOk || says_where_and_why(error, {text, size});
    if (!good) print_error("seed %lu, text %d: '%s'\n", kSeed, i, error.message().c_str());
    assert_true(good);
    ++(status == Status::kOk ? loaded : refused);
  }
  assert_true(loaded > 1'000 && refused > 5'000);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_damage_crashes_the_loader_and_every_refusal_says_where_and_why),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
