// Whose a store is: nobody can send one that is away, by the client or past it, and no window takes
// more waypoints than it holds.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kQuintic = kVelocityField | kAccelerationField;

#define ASSERT_OUTCOME(report, expected) \
  assert_int_equal(static_cast<int>((report).outcome), static_cast<int>(expected))

/// From home to 0.3 rad beside it in two seconds.
Trajectory<JointSpace>* motion(ReferenceBench& bench) {
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
  bench.add(*motion, 0.0, 0.0);
  bench.add(*motion, 2.0, 0.3);
  return motion;
}

int index_of(const ReferenceBench& bench, const Trajectory<JointSpace>* trajectory) {
  return static_cast<int>(trajectory - bench.channel.stores.data());
}

/// A request to follow `store` that no client would send is refused in the next cycle, and gives
/// nothing back.
void assert_refused(ReferenceBench& bench, int store) {
  constexpr std::uint32_t kId = 1000;
  Request<JointSpace> request;
  request.id = kId;
  request.kind = RequestKind::kTrajectory;
  request.store = store;
  assert_true(bench.channel.requests.post(request));
  ASSERT_OK(bench.step());
  const Report report = bench.final_of(kId);
  ASSERT_OUTCOME(report, Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kReferenceSize);
  assert_int_equal(report.store, -1);
}

// Proves RG-5, RG-1.

void a_store_is_sent_once_until_it_comes_back(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* first = motion(bench);
  std::uint32_t id = 0, again = 0;
  assert_true(bench.client.send(*first, id).ok());
  ASSERT_STATUS(bench.client.send(*first, again).status, Status::kNoFreeStore);
  ASSERT_OK(bench.run(1000));
  ASSERT_STATUS(bench.client.send(*first, again).status, Status::kNoFreeStore);
  assert_int_equal(again, 0);
  ASSERT_OK(bench.run(1100));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
  ASSERT_NEAR((bench.out().q - first->waypoints[1].point.q).norm(), 0.0, 1e-12);
  bench.home = bench.out().q;
  assert_ptr_equal(motion(bench), first);
  assert_true(bench.client.send(*first, again).ok());
}

void a_store_of_nobody_is_not_sent(void**) {
  static ReferenceBench bench;
  static Trajectory<JointSpace> strange;
  strange = *motion(bench);
  std::uint32_t id = 0;
  ASSERT_STATUS(bench.client.send(strange, id).status, Status::kNoFreeStore);
  ASSERT_STATUS(bench.client.append(strange, {}).status, Status::kNothingToExtend);
  ASSERT_STATUS(bench.client.flush(strange, true, id).status, Status::kNothingToExtend);
}

void the_store_of_what_runs_is_not_accepted_again(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* running = motion(bench);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*running, id).ok());
  ASSERT_OK(bench.run(1001));
  assert_refused(bench, index_of(bench, running));
  ASSERT_NEAR(bench.out().q[0] - bench.home[0], 0.15, 1e-3);  // half way, in half the time
  ASSERT_OK(bench.run(1100));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
}

void the_store_of_what_waits_is_not_accepted_again(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* waiting = motion(bench);
  waiting->start_s = 1.0;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*waiting, id).ok());
  ASSERT_OK(bench.run(500));
  assert_refused(bench, index_of(bench, waiting));
  ASSERT_OK(bench.run(2600));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
}

void the_store_of_a_path_that_is_braked_on_is_not_accepted_again(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* given_up = motion(bench);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*given_up, id).ok());
  ASSERT_OK(bench.run(1000));
  assert_true(bench.client.cancel(id).ok());
  ASSERT_OK(bench.step());
  assert_refused(bench, index_of(bench, given_up));
  assert_false(bench.out().standing());
}

void a_store_that_there_is_not_and_an_empty_one_are_refused(void**) {
  static ReferenceBench bench;
  bench.channel.stores[1].count = 0;
  for (const int store : {-1, kStores, 1 << 20, 1}) assert_refused(bench, store);
}

// Proves RG-14.

/// At the border: full when sent, one more for every waypoint that the motion does not need any
/// more, and never one over those it does.
void a_window_takes_as_many_waypoints_as_it_holds_and_no_more(void**) {
  static ReferenceBench bench;
  constexpr int kWindow = 8;
  Trajectory<JointSpace>* stream = bench.trajectory(kQuintic);
  stream->capacity = kWindow;
  stream->open = true;
  for (int i = 0; i < kWindow; ++i) bench.add(*stream, 0.1 * i, 0.0);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*stream, id).ok());
  int count = kWindow, most = 0;
  for (int k = 0; k < 1500; ++k) {
    const int needed = bench.channel.needed[0].load();
    Waypoint<JointSpace> next = stream->waypoints[0];
    next.time_s = 0.1 * count;
    const int room = kWindow - (count - needed);
    for (int i = 0; i < room; ++i, ++count, next.time_s = 0.1 * count)
      ASSERT_OK(bench.client.append(*stream, next).status);
    const double oldest_s = stream->waypoints[needed % kWindow].time_s;
    ASSERT_STATUS(bench.client.append(*stream, next).status, Status::kWindowFull);
    assert_true(stream->waypoints[needed % kWindow].time_s == oldest_s);
    if (room > 0) ASSERT_OK(bench.client.flush(*stream, false, id).status);
    ASSERT_OK(bench.step());
    bench.final_of(0);
    most = std::max(most, room);
  }
  assert_true(most > 0 && count > 15);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_store_is_sent_once_until_it_comes_back),
      cmocka_unit_test(a_store_of_nobody_is_not_sent),
      cmocka_unit_test(the_store_of_what_runs_is_not_accepted_again),
      cmocka_unit_test(the_store_of_what_waits_is_not_accepted_again),
      cmocka_unit_test(the_store_of_a_path_that_is_braked_on_is_not_accepted_again),
      cmocka_unit_test(a_store_that_there_is_not_and_an_empty_one_are_refused),
      cmocka_unit_test(a_window_takes_as_many_waypoints_as_it_holds_and_no_more),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
