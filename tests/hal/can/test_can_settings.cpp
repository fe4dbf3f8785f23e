// Settings of [can] that cannot be: refused with place, value, limit and remedy.
#include <cstring>

#include "hal/can/can_master.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

struct Plan {
  CanSettings can;
  cia402::Cia402Settings drive;
  CanMaster master;

  Plan() {
    can.interfaces = Value("can0");
    can.frames = Frames::kFd;
    can.commands = Commands::kPacked;
    drive.rated_torque.setConstant(3.0);
  }
  Status judge() { return master.configure(can, drive, Tool{}, CommandMode::kEffort, 1000, 10000); }
};

Plan& fresh() {
  static Plan* plan = nullptr;
  delete plan;
  return *(plan = new Plan);
}

void assert_refused(const char* interfaces, Status status, const char* why) {
  Plan& plan = fresh();
  plan.can.interfaces = Value(interfaces);
  ASSERT_STATUS(plan.judge(), status);
  if (std::strcmp(plan.master.why().c_str(), why) != 0)
    print_error("%s\n", plan.master.why().c_str());
  assert_string_equal(plan.master.why().c_str(), why);
}

// Proves CAN-9.
void names_that_no_interface_can_have_are_refused(void**) {
  ASSERT_OK(fresh().judge());
  assert_refused("can0 abcdefghijklmnop", Status::kTooLarge,
                 "[can] interfaces has 'abcdefghijklmnop', which has 16 characters; an interface"
                 " has at most 15: `ip -brief link` lists them");
  assert_refused("can0,can1", Status::kBadValue,
                 "[can] interfaces has 'can0,can1' with a comma; separate names by blanks, for"
                 " example: can0 can1 can2");
  assert_refused("can0, can1", Status::kBadValue,
                 "[can] interfaces has 'can0,' with a comma; separate names by blanks, for"
                 " example: can0 can1 can2");
  assert_refused("can0 can1 can0", Status::kBadValue,
                 "[can] interfaces has 'can0' twice; every bus has an interface of its own");
  assert_refused("a b c d e", Status::kTooLarge,
                 "[can] interfaces has 'e' after 4 others; there are at most 4 buses");
  Plan& plan = fresh();
  plan.can.interfaces = Value("abcdefghijklmno");
  ASSERT_OK(plan.judge());
}

struct Ranges {
  double vendor = 0.0, product = 0.0;

  template <class T>
  void param(const char* key, T&, const Range& range, const char*) {
    if (std::strcmp(key, "vendor") == 0) vendor = range.hi;
    if (std::strcmp(key, "product") == 0) product = range.hi;
  }
  template <class T>
  void choice(const char*, T&) {}
  void text(const char*, Value&, const char*) {}
};

/// 32 bits, all of them: some vendors have the highest.
void every_number_of_a_vendor_and_a_product_can_be_demanded(void**) {
  Plan& plan = fresh();
  Ranges ranges;
  plan.can.describe(ranges);
  assert_true(ranges.vendor == 4294967295.0 && ranges.product == 4294967295.0);
  plan.can.vendor = 4294967295.0;
  plan.can.product = 2147483648.0;
  ASSERT_OK(plan.judge());
  NodeSetup setup;
  const PdoLayout layout(CommandMode::kEffort, plan.can.frames, plan.can.commands);
  setup.begin(plan.can, layout, Slot(), CommandMode::kEffort, 1000);
  int found = 0;
  for (int i = 0; i < setup.count(); ++i) {
    const SetupStep& step = setup.step(i);
    found += step.index == 0x1018 && step.sub == 1 && step.value == 0xFFFFFFFF;
    found += step.index == 0x1018 && step.sub == 2 && step.value == 0x80000000;
  }
  assert_int_equal(found, 2);
  plan.can.vendor = 1.5;
  ASSERT_STATUS(plan.judge(), Status::kBadValue);
  assert_string_equal(plan.master.why().c_str(),
                      "[can] vendor or product is 1.5; 1018h:1 and :2 are whole numbers");
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(names_that_no_interface_can_have_are_refused),
      cmocka_unit_test(every_number_of_a_vendor_and_a_product_can_be_demanded),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
