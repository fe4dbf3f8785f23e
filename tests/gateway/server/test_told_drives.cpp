// Tests in virtual time what clients are told of drives that stood in fault, and that warn.
#include <cstring>

#include "gateway/server/drive_text.hpp"
#include "tests/gateway/server/cycle_bench.hpp"

namespace tactus {
namespace {

/// A robot that has words for its codes.
struct Worded final : Hal {
  Capabilities capabilities() const override { return {}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime&, RobotState&) override { return Status::kOk; }
  Status write(const RobotCommand&) override { return Status::kOk; }
  Status disconnect() override { return Status::kOk; }
  Message code_text(std::uint32_t code) const override {
    return code == 5 ? Message("error code 0005h, its own") : Message();
  }
};

// Proves LAD-15, LAD-16.
void what_is_told_of_drives_names_joint_and_code(void**) {
  const Worded hal;
  Event event;
  event.joint = 2;
  event.code = 5;
  event.status = Status::kDriveFault;
  assert_string_equal(describe_drive(hal, event).c_str(), "");
  event.cause = Cause::kDrive;
  assert_string_equal(describe_drive(hal, event).c_str(),
                      "joint 3: drive or safety fault (97), error code 0005h, its own");
  event.cause = Cause::kOldFault;
  assert_string_equal(describe_drive(hal, event).c_str(),
                      "joint 3 stood in fault, which arming clears: drive or safety fault (97), "
                      "error code 0005h, its own");
  event.code = 6;
  event.cause = Cause::kWarning;
  assert_string_equal(describe_drive(hal, event).c_str(), "joint 3 warns, the drive's code 6");
  event.code = 0;
  assert_string_equal(describe_drive(hal, event).c_str(), "joint 3 warns");
}

void turn(CycleBench& cycles, TestClient& client) {
  cycles.cycle();
  cycles.server->work(cycles.now_ns);
  client.read();
}

// Proves LAD-15, LAD-16.
void a_fault_from_before_a_rearm_and_a_warning_are_events(void**) {
  static CycleBench cycles;
  static TestClient client;
  cycles.start();
  cycles.welcome(client, "A");
  client.send(ask::kSubscribe, RawMessage().number(3, 1));
  turn(cycles, client);
  Drive& fourth = cycles.hal.state.drives[3];
  fourth.warns = true;
  turn(cycles, client);
  assert_non_null(std::strstr(client.event, "joint 4 warns"));
  const int told = client.events;
  for (int i = 0; i < 10; ++i) turn(cycles, client);
  assert_int_equal(client.events, told);

  cycles.executive.halt();
  cycles.hal.state.drives.fill({DriveState::kDisabled, true});
  fourth = {DriveState::kFault, true, Status::kDriveFault, false, 7};
  for (int i = 0; i < 100; ++i) turn(cycles, client);
  assert_true(cycles.executive.rung() == Rung::kDisabled);
  const int before = client.events;
  ASSERT_STATUS(cycles.executive.arm(), Status::kArming);
  turn(cycles, client);
  assert_int_equal(client.events, before + 2);  // and the rung
  assert_non_null(std::strstr(client.event,
                              "joint 4 stood in fault, which arming clears: drive or safety fault "
                              "(97), the drive's code 7"));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_is_told_of_drives_names_joint_and_code),
      cmocka_unit_test(a_fault_from_before_a_rearm_and_a_warning_are_events),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
