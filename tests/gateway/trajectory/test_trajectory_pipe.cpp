// Tests trajectories that come through a pipe: only their beginning can be judged before they move.
#include <fcntl.h>

#include "tests/gateway/trajectory/stream_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kRows = 600, kWindow = 100;
constexpr Fields kCubic = kVelocityField;

std::array<char, 1 << 20> text;  // of the stream's file
std::size_t text_size = 0;

/// A pipe that holds a whole file; its path is that of its reading end.
struct Pipe {
  int ends[2] = {-1, -1};
  char path[32];

  Pipe() {
    assert_int_equal(pipe2(ends, O_CLOEXEC), 0);
    assert_true(fcntl(ends[1], F_SETPIPE_SZ, 1 << 20) > 0);
    std::snprintf(path, sizeof path, "/proc/self/fd/%d", ends[0]);
  }
  void write(std::size_t begin, std::size_t end) const {
    assert_int_equal(::write(ends[1], text.data() + begin, end - begin), end - begin);
  }
  void close() {
    for (int& end : ends) {
      if (end >= 0) ::close(end);
      end = -1;
    }
  }
  void close_writer() {
    ::close(ends[1]);
    ends[1] = -1;
  }
};

template <class Damage>
void make_text(Damage damage) {
  Random random{11};
  write_swing<JointSpace>(Swing(random, 0.1, 3.0), kRows, kCubic, damage);
  std::FILE* file = std::fopen(stream_file(), "rb");
  assert_non_null(file);
  text_size = std::fread(text.data(), 1, text.size(), file);
  std::fclose(file);
}
void make_text() {
  make_text([](int, double&, JointSpace::Point&) {});
}

/// Returns where the line of a waypoint begins.
std::size_t line_of(int row) {
  std::size_t at = 0;
  for (int line = 0; line <= row; ++line)
    at = static_cast<std::size_t>(
        static_cast<char*>(std::memchr(text.data() + at, '\n', text_size - at)) + 1 - text.data());
  return at;
}

StreamBench<JointSpace>& fresh(int which) {
  static std::array<StreamBench<JointSpace>*, 2> benches{};
  auto& bench = benches[static_cast<std::size_t>(which)];
  delete bench;
  bench = new StreamBench<JointSpace>;
  return *bench;
}

// Proves CSV-5.

void a_pipe_gives_the_same_references_as_the_file(void**) {
  make_text();
  Pipe pipe;
  pipe.write(0, text_size);
  pipe.close_writer();
  StreamBench<JointSpace>&file = fresh(0), &piped = fresh(1);
  assert_true(file.open(kMostRows));
  assert_true(piped.open(kWindow, false, Interpolation::kByFields, pipe.path));
  assert_false(piped.stream.whole_known());
  while (piped.outcome == Outcome::kStarted && piped.cycles < 60'000) {
    file.step();
    piped.step();
    assert_true(file.out().q == piped.out().q && file.out().dq == piped.out().dq);
  }
  ASSERT_STATUS(piped.outcome, Outcome::kSucceeded);
  assert_true(piped.stream.whole_known());
  assert_int_equal(piped.stream.count(), kRows);
  assert_true(piped.stream.hash() == file.stream.hash());
  pipe.close();
}

// Proves CSV-7.

void a_slow_pipe_makes_the_arm_wait_on_its_path_and_go_on(void**) {
  make_text();
  Pipe pipe;
  pipe.write(0, line_of(kWindow + 30));
  StreamBench<JointSpace>& piped = fresh(1);
  assert_true(piped.open(kWindow, false, Interpolation::kByFields, pipe.path));
  for (int k = 0; k < 60'000 && piped.outcome != Outcome::kStarved; ++k) piped.step();
  ASSERT_STATUS(piped.outcome, Outcome::kStarved);
  assert_true(piped.out().standing());
  assert_int_equal(piped.stream.count(), kWindow + 30);  // nothing is kept back
  pipe.write(line_of(kWindow + 30), text_size);
  pipe.close_writer();
  for (int k = 0; k < 60'000 && piped.outcome == Outcome::kStarved; ++k) piped.step();
  ASSERT_STATUS(piped.outcome, Outcome::kSucceeded);
  pipe.close();
}

// Proves CSV-6.

void a_later_waypoint_of_a_pipe_is_refused_on_the_way_with_its_line(void**) {
  constexpr int kBroken = 400;
  make_text([](int row, double&, JointSpace::Point& point) {
    if (row == kBroken) point.q[3] += 10.0;
  });
  Pipe pipe;
  pipe.write(0, text_size);
  pipe.close_writer();
  StreamBench<JointSpace>& piped = fresh(1);
  assert_true(piped.open(kWindow, false, Interpolation::kByFields, pipe.path));
  FeedResult fed = FeedResult::kAhead;
  for (int k = 0; k < 60'000 && fed != FeedResult::kRefused; ++k) fed = piped.step();
  ASSERT_STATUS(fed, FeedResult::kRefused);
  ASSERT_STATUS(piped.stream.refusal().verdict.status, Status::kPositionLimit);
  assert_int_equal(piped.stream.refusal().verdict.waypoint, kBroken);
  assert_int_equal(piped.stream.refusal().line, kBroken + 2);
  for (int k = 0; k < 60'000 && piped.outcome != Outcome::kStarved; ++k) piped.step();
  assert_true(piped.out().standing());  // on the part before
  pipe.close();
}

void a_pipe_that_does_not_move_the_arm_is_judged_to_its_end(void**) {
  for (const bool broken : {false, true}) {
    make_text([=](int row, double&, JointSpace::Point& point) {
      if (broken && row == kRows - 1) point.dq[0] = 0.1;
    });
    Pipe pipe;
    pipe.write(0, text_size);
    pipe.close_writer();
    StreamBench<JointSpace>& piped = fresh(1);
    assert_true(piped.open(kWindow, false, Interpolation::kByFields, pipe.path));
    assert_true(piped.stream.judge_rest(piped.client.settings()) != broken);
    if (broken) assert_int_equal(piped.stream.refusal().line, kRows + 1);
    if (!broken) assert_int_equal(piped.stream.count(), kRows);
    pipe.close();
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_pipe_gives_the_same_references_as_the_file),
      cmocka_unit_test(a_slow_pipe_makes_the_arm_wait_on_its_path_and_go_on),
      cmocka_unit_test(a_later_waypoint_of_a_pipe_is_refused_on_the_way_with_its_line),
      cmocka_unit_test(a_pipe_that_does_not_move_the_arm_is_judged_to_its_end),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_stream_file);
}
