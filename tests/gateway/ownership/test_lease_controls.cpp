// Tests who may slow the arm down and who may make it faster: the table of ownership in
// docs/gateway.md, for controls.
#include "tests/gateway/server/client_bench.hpp"

namespace tactus {
namespace {

// Proves GW-3.

/// Who may send which control: the table, for every owner, kind, override in force and wish.
void everybody_may_slow_the_arm_down_and_only_its_owner_makes_it_faster(void**) {
  constexpr struct {
    std::uint32_t kind;
    double rate;
  } kControls[] = {{ask::kCancel, 0.0},   {ask::kPause, 0.0},    {ask::kResume, 0.0},
                   {ask::kOverride, 0.0}, {ask::kOverride, 0.3}, {ask::kOverride, 0.5},
                   {ask::kOverride, 0.6}, {ask::kOverride, 1.0}, {ask::kOverride, NAN}};
  for (const bool owned : {false, true}) {
    for (const bool by_owner : {false, true}) {
      for (const double before : {0.5, 1.0}) {
        for (const auto& control : kControls) {
          if (by_owner && !owned) continue;
          TwoClients& two = fresh_clients();
          two.a.lease(5);
          two.a.send(ask::kOverride, RawMessage().real(1, before));
          two.run(2);
          if (!owned) two.a.send(ask::kLease, RawMessage().number(1, 1));
          TestClient& from = by_owner ? two.a : two.b;
          const std::uint32_t number = from.control(control.kind, control.rate);
          two.run(2);
          const bool slows = control.kind != ask::kResume &&
                             (control.kind != ask::kOverride || control.rate <= before);
          assert_int_equal(from.status[number],
                           by_owner || slows ? 0 : static_cast<int>(Status::kNotOwner));
          assert_int_equal(from.finals[number], by_owner || slows);
        }
      }
    }
  }
}

void a_cancel_of_somebody_else_ends_what_still_comes_and_its_owner_hears_of_it(void**) {
  TwoClients& two = fresh_clients();
  two.a.send(ask::kSubscribe, RawMessage().number(3, 1));
  two.a.lease(1, 60000);
  JointVector far = ServerBench::home().q;
  far[0] += 0.5;
  two.a.point(far);
  const std::uint32_t goal = two.a.send(ask::kBegin);
  two.run(100);
  assert_false(two.bench.generator.reference().standing());
  const std::uint32_t before = two.a.epoch, cancel = two.b.send(ask::kCancel);
  two.run(1000);
  assert_int_equal(two.b.outcome[cancel], 14);  // EXECUTED
  assert_int_equal(two.a.outcome[goal], 13);    // CANCELED
  assert_string_equal(two.a.event, "B has canceled what runs");
  two.a.send(ask::kPing);
  two.run(1);
  assert_true(two.a.epoch > before);
  assert_true(two.bench.generator.reference().standing());
  assert_true(two.bench.generator.reference().q[0] < far[0] - 0.1);
}

void everybody_hears_of_a_control_its_sender_and_the_owner_too(void**) {
  constexpr struct {
    std::uint32_t kind;
    const char* text;
  } kControls[] = {{ask::kPause, " has paused the arm"},
                   {ask::kResume, " has ended the pause"},
                   {ask::kOverride, " has set the override to 50 %"},
                   {ask::kCancel, " has canceled what runs"}};
  for (const bool by_owner : {false, true}) {
    for (const auto& [kind, text] : kControls) {
      if (kind == ask::kResume && !by_owner) continue;
      TwoClients& two = fresh_clients();
      for (TestClient* client : {&two.a, &two.b})
        client->send(ask::kSubscribe, RawMessage().number(3, 1));
      two.a.lease(1, 60000);
      JointVector far = ServerBench::home().q;
      far[0] += 0.5;
      two.a.point(far);
      two.a.send(ask::kBegin);
      two.run(100);
      (by_owner ? two.a : two.b).control(kind, 0.5);
      two.run(10);
      const Message expected = Message(by_owner ? "A" : "B") << text;
      assert_string_equal(two.a.event, expected.c_str());
      assert_string_equal(two.b.event, expected.c_str());
    }
  }
}

void others_cannot_fill_the_mailbox_of_controls_before_its_owner(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(5);
  two.run(1);
  std::uint32_t first = 0, last = 0;
  for (int i = 0; i < 20; ++i) {
    last = two.b.send(ask::kPause);
    if (first == 0) first = last;
  }
  two.bench.server.work(two.bench.now_ns);
  const std::uint32_t lower = two.a.send(ask::kOverride, RawMessage().real(1, 0.5));
  two.bench.server.work(two.bench.now_ns);
  two.run(3);
  assert_int_equal(two.b.status[first], 0);
  assert_int_equal(two.b.status[last], static_cast<int>(Status::kMailboxFull));
  assert_int_equal(two.a.status[lower], 0);
}

/// The server has not yet seen that the owner's override is in force.
void a_higher_override_of_somebody_else_is_refused_in_the_cycle_too(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(5);
  two.run(1);
  two.a.send(ask::kOverride, RawMessage().real(1, 0.2));
  const std::uint32_t raise = two.b.send(ask::kOverride, RawMessage().real(1, 0.9));
  two.bench.server.work(two.bench.now_ns);
  two.run(3);
  assert_int_equal(two.b.status[raise], 0);
  assert_int_equal(two.b.finals[raise], 1);
  ASSERT_NEAR(two.bench.generator.motion_state().override, 0.2, 0.0);
  assert_true(std::strstr(two.a.event, "override") == nullptr);
}

void the_override_is_whole_again_after_a_rearm(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(5, 60000);
  two.a.send(ask::kOverride, RawMessage().real(1, 0.2));
  two.stop_and_rearm();
  const std::uint32_t lower = two.b.send(ask::kOverride, RawMessage().real(1, 0.9));
  two.run(2);
  assert_int_equal(two.b.status[lower], 0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(everybody_may_slow_the_arm_down_and_only_its_owner_makes_it_faster),
      cmocka_unit_test(a_cancel_of_somebody_else_ends_what_still_comes_and_its_owner_hears_of_it),
      cmocka_unit_test(everybody_hears_of_a_control_its_sender_and_the_owner_too),
      cmocka_unit_test(others_cannot_fill_the_mailbox_of_controls_before_its_owner),
      cmocka_unit_test(a_higher_override_of_somebody_else_is_refused_in_the_cycle_too),
      cmocka_unit_test(the_override_is_whole_again_after_a_rearm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
