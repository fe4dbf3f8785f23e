// The lines `sdo = ...` over any wire: what they leave in the dictionaries of the emulated drives,
// and how often they write. A bench is given as
//
//   struct Wire { using Bench; static Bench& fresh(); static const drives::Dictionary&
//                 dictionary(Bench&, int joint); }
//
// The expected values are worked out from the random draws, not from the lines as they are read.
#pragma once

#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "sim_plant/drives/dictionary.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {

struct LineObject {
  int index, sub;
  const char* type;
  double low, high;
};
inline constexpr LineObject kLineObjects[] = {
    {0x2003, 1, "u16", 0, 65535}, {0x2003, 2, "i32", -1000, 1000}, {0x2003, 3, "f32", -4, 4},
    {0x6065, 0, "u32", 1, 4e9},   {0x6084, 0, "u32", 1, 4e9},      {0x607D, 1, "i32", -2e9, 2e9},
};
inline constexpr int kLineObjectCount = 6;

inline drives::Slot slot(const LineObject& object) {
  return drives::slot_of(static_cast<std::uint16_t>(object.index),
                         static_cast<std::uint8_t>(object.sub));
}

template <class Wire>
struct LineCases {
  using Bench = typename Wire::Bench;
  using Wanted = std::map<int, std::int64_t>;  // by object, of one joint

  static void add(Bench& bench, const std::string& text) {
    static int line = 0;
    Message why;
    const Status status = bench.drive.sdo.add(text, ++line, why);
    if (status != Status::kOk) print_error("%s: %s\n", text.c_str(), why.c_str());
    ASSERT_OK(status);
  }
  static bool says(Bench& bench, const char* part) {
    const Message said = bench.hal.trouble();
    if (std::strstr(said.c_str(), part) != nullptr) return true;
    print_error("'%s' is not in: %s\n", part, said.c_str());
    return false;
  }
  static void assert_refused(const char* line, Status expected, const char* says_part) {
    Bench& bench = Wire::fresh();
    add(bench, line);
    ASSERT_OK(bench.load());
    ASSERT_STATUS(bench.executive.start(), expected);
    assert_true(says(bench, says_part));
  }

  /// A line of an object with a value that is that of the drive in every third; what it leaves.
  static std::int64_t draw(Random& random, const LineObject& object, std::int64_t now,
                           const std::string& joint, std::string& text) {
    char value[40];
    std::int64_t wanted = now;
    if (object.type[0] == 'f') {
      const float number =
          random.below(3) == 0 ? 0.5F : static_cast<float>(random.uniform(object.low, object.high));
      std::uint32_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      wanted = bits;
      std::snprintf(value, sizeof value, "%.9g", static_cast<double>(number));
    } else {
      if (random.below(3) != 0)
        wanted = static_cast<std::int64_t>(random.uniform(object.low, object.high));
      const bool hexadecimal = wanted >= 0 && random.below(2) == 0;
      std::snprintf(value, sizeof value, hexadecimal ? "0x%llX" : "%lld",
                    static_cast<long long>(wanted));
    }
    char line[120];
    std::snprintf(line, sizeof line, "%s0x%X:%d %s %s", joint.c_str(), object.index, object.sub,
                  object.type, value);
    text = line;
    return wanted;
  }

  /// Adds random lines of every object; what they ask of each joint.
  static std::array<Wanted, kDof> add_lines(Bench& bench, Random& random) {
    std::array<Wanted, kDof> wanted;
    for (int o = 0; o < kLineObjectCount; ++o) {
      const LineObject& object = kLineObjects[o];
      const std::int64_t now = Wire::dictionary(bench, 0).get(slot(object));
      const int whom = random.below(3);  // nobody, all, some
      std::string text;
      if (whom == 1) {
        const std::int64_t value = draw(random, object, now, "", text);
        add(bench, text);
        for (Wanted& of_joint : wanted) of_joint[o] = value;
      }
      for (int j = 0; j < kDof && whom == 2; ++j) {
        if (random.below(3) != 0) continue;
        const std::string joint = "joint" + std::to_string(j + 1) + " ";
        wanted[static_cast<std::size_t>(j)][o] = draw(random, object, now, joint, text);
        add(bench, text);
      }
    }
    return wanted;
  }

  static int line_writes(Bench& bench, int joint) {
    int sum = 0;
    for (const LineObject& object : kLineObjects)
      sum += Wire::dictionary(bench, joint).writes(slot(object));
    return sum;
  }
  static int stores(Bench& bench, int joint) {
    return Wire::dictionary(bench, joint).writes(drives::slot_of(0x1010, 1));
  }

  static void try_all() {
    leave_what_they_say();
    write_to_no_drive_of_an_arm_with_a_wrong_one();
    set_what_is_judged();
    refuse_what_a_drive_does_not_take();
    store_in_its_own_time();
  }

  static void leave_what_they_say() {
    Random random{20};
    int lines = 0, written = 0;
    for (int trial = 0; trial < 25; ++trial) {
      Bench& bench = Wire::fresh();
      ASSERT_OK(bench.load());
      bench.drive.store = random.below(2);
      const std::array<Wanted, kDof> wanted = add_lines(bench, random);
      std::array<int, kDof> differ{};
      for (int j = 0; j < kDof; ++j)
        for (const auto& [o, value] : wanted[static_cast<std::size_t>(j)]) {
          ++lines;
          differ[static_cast<std::size_t>(j)] +=
              Wire::dictionary(bench, j).get(slot(kLineObjects[o])) != value;
        }
      for (const int starts : {1, 2}) {
        const Status status = bench.executive.start();
        if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
        ASSERT_OK(status);
        for (int j = 0; j < kDof; ++j) {
          const int differs = differ[static_cast<std::size_t>(j)];
          for (const auto& [o, value] : wanted[static_cast<std::size_t>(j)])
            assert_true(Wire::dictionary(bench, j).get(slot(kLineObjects[o])) == value);
          assert_int_equal(line_writes(bench, j), differs);
          assert_int_equal(stores(bench, j), bench.drive.store != 0 && differs > 0);
          if (starts == 1) written += differs;
        }
      }
    }
    print_message("%d lines of a joint, %d of them written\n", lines, written);
    assert_true(written > 100 && written < lines);
  }

  /// Neither the wrong drive nor any other is written to: all say first who they are.
  static void write_to_no_drive_of_an_arm_with_a_wrong_one() {
    for (const int joint : {0, 3, 6}) {
      Bench& bench = Wire::fresh();
      bench.drive.serial << 1001, 1002, 1003, 1004, 1005, 1006, 1007;
      bench.drive.serial[joint] = 77;
      add(bench, "0x2003:1 u16 5");
      bench.drive.store = 1;
      ASSERT_OK(bench.load());
      ASSERT_STATUS(bench.executive.start(), Status::kRefusedByRobot);
      assert_true(says(bench, "[cia402] serial is 77"));
      for (int j = 0; j < kDof; ++j) assert_int_equal(Wire::dictionary(bench, j).writes(), 0);
    }
  }

  static void set_what_is_judged() {
    for (const bool set : {false, true}) {
      Bench& bench = Wire::fresh();
      bench.plant.velocity_unit = 0x00B44700;  // rev/min
      bench.drive.velocity_units.setConstant(16777216.0);
      if (set) add(bench, "0x60A9:0 u32 0x00B50300");
      ASSERT_OK(bench.load());
      ASSERT_STATUS(bench.executive.start(), set ? Status::kOk : Status::kRefusedByRobot);
    }
  }

  static void refuse_what_a_drive_does_not_take() {
    assert_refused("joint3 0x2003:2 i32 1001", Status::kRefusedByRobot,
                   ", 2003h:2 = 1001: it cannot be written: ");
    assert_refused("0x2003:2 i32 -1001", Status::kRefusedByRobot, "value too low (06090032h)");
    assert_refused("0x2003:4 u8 8", Status::kRefusedByRobot, "the object is read-only (06010002h)");
    assert_refused("0x2004:0 u8 8", Status::kRefusedByRobot, "2004h:0 = 8: it cannot be read: ");
    assert_refused("joint7 0x2003:5 i8 -7", Status::kRefusedByRobot,
                   "2003h:5 = -7: it keeps -6; give a value that it keeps");
    assert_refused("0x2003:1 u32 3", Status::kRefusedByRobot,
                   "2003h:1 = 3: the object has 2 bytes, u32 has 4");
    Bench& bench = Wire::fresh();
    add(bench, "0x2003:4 u8 7");  // as it is
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.executive.start());
  }

  static void store_in_its_own_time() {
    Bench& bench = Wire::fresh();
    bench.plant.store_ns = 2'000'000'000;
    bench.drive.store = 1;
    add(bench, "joint2 0x2003:2 i32 -70");
    add(bench, "0x2003:4 u8 7");
    add(bench, "joint3 0x2003:3 f32 1.5");
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.executive.start());
    assert_string_equal(bench.hal.master.written(0).c_str(),
                        "2003h:2 = -70 written to the drives of joints 2; stored in 2");
    assert_string_equal(bench.hal.master.written(1).c_str(),
                        "2003h:3 = 1.5 written to the drives of joints 3; stored in 3");
    assert_true(bench.hal.master.written(2).empty());

    Bench& slow = Wire::fresh();
    slow.plant.store_ns = 2'000'000'000;
    slow.drive.store = 1;
    slow.drive.store_ms = 1500;
    add(slow, "0x2003:1 u16 5");
    ASSERT_OK(slow.load());
    ASSERT_STATUS(slow.executive.start(), Status::kBusTimeout);
    assert_true(says(slow, "no answer within 1500 ms"));
    assert_true(says(slow, "[cia402] store"));
    assert_string_equal(slow.hal.master.written(0).c_str(),
                        "2003h:1 = 5 written to the drives of joints 1");
  }
};

}  // namespace tactus::cia402
