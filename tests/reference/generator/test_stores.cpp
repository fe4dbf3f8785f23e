// Whose a store is: nobody can send one that is away, by the client or past it, and no window takes
// more waypoints than it holds.
// Packed stores: more waypoints fit if they give fewer fields, and a trajectory in a packed store
// is judged and followed as in a store of whole waypoints, to the last bit.
#include <optional>

#include "kernel/reference/space/task_space.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr Fields kQuintic = kVelocityField | kAccelerationField;

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
  bench.home.q = bench.out().q;
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
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.15, 1e-3);  // half way, in half the time
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

constexpr int kWhole = 20;   // whole waypoints that a store holds
constexpr int kTotal = 400;  // waypoints of the swing, the last at rest like the first

/// Returns waypoint `index` of a swing of all joints about home, from rest, with velocities.
Waypoint<JointSpace> swing_waypoint(const ReferenceBench& bench, int index) {
  constexpr double kSpacing_s = 0.05;
  constexpr double kRate = 13.0 * 3.14159265358979323846 / (kSpacing_s * (kTotal - 1));  // rad/s
  Waypoint<JointSpace> waypoint;
  waypoint.time_s = kSpacing_s * index;
  const double s = std::sin(kRate * waypoint.time_s), c = std::cos(kRate * waypoint.time_s);
  waypoint.point.q = bench.home.q + JointVector::Constant(0.2 * s * s * s);
  waypoint.point.dq.setConstant(0.6 * kRate * s * s * c);
  waypoint.point.ddq.setConstant(1e300);  // is not given, so nobody may read it
  return waypoint;
}

/// A generator whose first store is packed, or holds as many whole waypoints.
struct StoreBench : ReferenceBench {
  std::array<Waypoint<JointSpace>, kWaypoints> store;
  Trajectory<JointSpace>* stream = nullptr;
  std::uint32_t goal = 0;
  int sent = 0;

  StoreBench(Fields fields, bool packed, int capacity) {
    channel.stores[0].waypoints = store.data();
    channel.stores[0].capacity = packed ? kWhole : capacity;
    stream = packed ? client.acquire(fields) : client.acquire();
    stream->fields = fields;
    stream->count = 0;
  }
  void fill(int count) {
    for (; sent < count; ++sent) stream->set(stream->count++, swing_waypoint(*this, sent));
  }
  /// Appends until the window is full or `total` are sent, and sends what was appended.
  void feed(int total) {
    const int before = sent;
    while (sent < total && client.append(*stream, swing_waypoint(*this, sent)).ok()) ++sent;
    std::uint32_t id = 0;
    if (sent > before) ASSERT_OK(client.flush(*stream, sent == total, id).status);
  }
};

// Proves RG-25.

void as_many_waypoints_fit_as_their_fields_take(void**) {
  constexpr int kNumber = sizeof(double), kBytes = kWhole * sizeof(Waypoint<JointSpace>);
  const std::array<Fields, 4> fields = {0, kVelocityField, kVelocityField | kAccelerationField,
                                        kEffortField};
  for (int vectors = 1; vectors <= 4; ++vectors) {
    ReferenceBench bench;
    bench.channel.stores[0].capacity = kWhole;
    const Trajectory<JointSpace>& packed =
        *bench.client.acquire(fields[static_cast<std::size_t>(vectors - 1)]);
    assert_int_equal(packed.capacity, kBytes / (kNumber * (vectors * kDof + 2)));
    assert_int_equal(bench.client.acquire()->capacity, kWhole);  // whole again
  }
  Trajectory<TaskSpace> poses;
  poses.capacity = 70;
  poses.pack(0);
  assert_int_equal(poses.capacity, 256);
  poses.pack(kVelocityField);
  assert_int_equal(poses.capacity, 154);
  poses.clear();
  assert_int_equal(poses.capacity, 70);
}

/// Who goes on with a store after the next acquire() must not have it read in another layout.
void a_store_that_is_acquired_again_is_empty(void**) {
  ReferenceBench bench;
  bench.channel.stores[0].capacity = kWhole;
  Trajectory<JointSpace>& kept = *bench.client.acquire(kVelocityField);
  kept.count = 2;
  kept.open = kept.exact = true;
  kept.start_s = 1.0;
  for (int i = 0; i < kept.count; ++i) {
    Waypoint<JointSpace> waypoint;
    waypoint.time_s = i;
    kept.set(i, waypoint);
  }
  assert_ptr_equal(bench.client.acquire(0), &kept);
  std::uint32_t id = 0;
  ASSERT_STATUS(bench.client.send(kept, id).status, Status::kReferenceSize);
  assert_true(!kept.open && !kept.exact && kept.start_s == kStartAtOnce);
}

void a_waypoint_comes_out_as_it_went_in_and_touches_no_other(void**) {
  ReferenceBench bench;
  bench.channel.stores[0].capacity = kWhole;
  Trajectory<JointSpace>& packed = *bench.client.acquire(kVelocityField);
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < packed.capacity; ++i) packed.set(i, swing_waypoint(bench, i + round));
  for (int i = 0; i < packed.capacity; ++i) {
    const Waypoint<JointSpace> out = packed.at(i), in = swing_waypoint(bench, i + 1);
    assert_true(out.time_s == in.time_s && out.point.q == in.point.q);
    assert_true(out.point.dq == in.point.dq && out.point.ddq == JointVector::Zero());
    assert_true(out.room == 1.0F && out.halfway == 1.0F);
  }
}

void more_fields_than_the_store_holds_are_refused(void**) {
  ReferenceBench bench;
  Trajectory<JointSpace>& packed = *bench.client.acquire(0);
  packed.count = 2;
  packed.set(0, swing_waypoint(bench, 0));
  packed.set(1, swing_waypoint(bench, 1));
  packed.interpolation = Interpolation::kMonotone;  // chooses velocities
  assert_int_equal(static_cast<int>(bench.client.admit(packed).status),
                   static_cast<int>(Status::kReferenceSize));
  packed.interpolation = Interpolation::kByFields;
  packed.fields = kVelocityField;
  assert_int_equal(static_cast<int>(bench.client.admit(packed).status),
                   static_cast<int>(Status::kReferenceSize));
}

void a_stream_through_a_packed_window_is_the_one_through_whole_waypoints(void**) {
  static std::optional<StoreBench> packed, whole;
  packed.emplace(kVelocityField, true, 0);
  const int window = packed->stream->capacity;
  assert_true(window > kWhole && window < ReferenceBench::kWaypoints);
  whole.emplace(kVelocityField, false, window);
  for (StoreBench* bench : {&*packed, &*whole}) {
    bench->stream->open = true;
    bench->fill(30);
    ASSERT_OK(bench->client.send(*bench->stream, bench->goal).status);
  }
  Outcome ends[2] = {Outcome::kStarted, Outcome::kStarted};
  double most = 0.0;
  for (int k = 0; k < 25000; ++k) {
    int i = 0;
    for (StoreBench* bench : {&*packed, &*whole}) {
      bench->feed(kTotal);
      ASSERT_OK(bench->step());
      const Report report = bench->final_of(bench->goal);
      if (report.outcome != Outcome::kStarted) ends[i] = report.outcome;
      ++i;
    }
    assert_int_equal(packed->sent, whole->sent);
    assert_true(packed->out().q == whole->out().q && packed->out().dq == whole->out().dq);
    most = std::max(most, (packed->out().q - packed->home.q).cwiseAbs().maxCoeff());
  }
  assert_int_equal(packed->sent, kTotal);
  assert_true(ends[0] == ends[1] && ends[0] == Outcome::kSucceeded);
  assert_true(most > 0.15);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_store_is_sent_once_until_it_comes_back),
      cmocka_unit_test(a_store_of_nobody_is_not_sent),
      cmocka_unit_test(the_store_of_what_runs_is_not_accepted_again),
      cmocka_unit_test(the_store_of_what_waits_is_not_accepted_again),
      cmocka_unit_test(the_store_of_a_path_that_is_braked_on_is_not_accepted_again),
      cmocka_unit_test(a_store_that_there_is_not_and_an_empty_one_are_refused),
      cmocka_unit_test(a_window_takes_as_many_waypoints_as_it_holds_and_no_more),
      cmocka_unit_test(as_many_waypoints_fit_as_their_fields_take),
      cmocka_unit_test(a_store_that_is_acquired_again_is_empty),
      cmocka_unit_test(a_waypoint_comes_out_as_it_went_in_and_touches_no_other),
      cmocka_unit_test(more_fields_than_the_store_holds_are_refused),
      cmocka_unit_test(a_stream_through_a_packed_window_is_the_one_through_whole_waypoints),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
