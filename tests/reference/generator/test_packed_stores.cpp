// Packed stores: more waypoints fit if they give fewer fields, and a trajectory in a packed store
// is judged and followed as in a store of whole waypoints, to the last bit.
#include <optional>

#include "kernel/reference/space/task_space.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kWhole = 20;   // whole waypoints that a store holds
constexpr int kTotal = 400;  // waypoints of the swing, the last at rest like the first

/// Returns waypoint `index` of a swing of all joints about home, from rest, with velocities.
Waypoint<JointSpace> swing_waypoint(const ReferenceBench& bench, int index) {
  constexpr double kSpacing_s = 0.05;
  constexpr double kRate = 13.0 * 3.14159265358979323846 / (kSpacing_s * (kTotal - 1));  // rad/s
  Waypoint<JointSpace> waypoint;
  waypoint.time_s = kSpacing_s * index;
  const double s = std::sin(kRate * waypoint.time_s), c = std::cos(kRate * waypoint.time_s);
  waypoint.point.q = bench.home + JointVector::Constant(0.2 * s * s * s);
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
    most = std::max(most, (packed->out().q - packed->home).cwiseAbs().maxCoeff());
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
      cmocka_unit_test(as_many_waypoints_fit_as_their_fields_take),
      cmocka_unit_test(a_store_that_is_acquired_again_is_empty),
      cmocka_unit_test(a_waypoint_comes_out_as_it_went_in_and_touches_no_other),
      cmocka_unit_test(more_fields_than_the_store_holds_are_refused),
      cmocka_unit_test(a_stream_through_a_packed_window_is_the_one_through_whole_waypoints),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
