// The lines `sdo = ...` of a file, read by the loader: what they mean, and what is refused, with
// place, value and limit.
// Proves CAN-20, ECAT-20.
#include "hal/cia402/object_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "hal/cia402/cia402_settings.hpp"
#include "kernel/load/loader.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {
namespace {

struct Board {
  Cia402Settings cia402;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.section("cia402", cia402);
  }
};

struct File {
  RoomyPipeline pipeline;
  Board board;
  LoadError error;

  /// `lines` begin in line 6.
  Status load(const std::string& lines) {
    constexpr Capabilities kRobot = {true, true, true, 100, 10000};
    std::string text = "[robot]\nname = ";
    text += std::string(Robot::kName) + "\nperiod_us = 1000\nq_c = robot.q\n[cia402]\n" + lines +
            "rated_torque = 3\n";
    return Loader({}, kRobot, board).load(text, pipeline, error);
  }
};

File& fresh() {
  static File* file = nullptr;
  delete file;
  return *(file = new File);
}

/// The refusal of one line, after its place.
void assert_refused(const std::string& line, const char* why) {
  File& file = fresh();
  assert_true(file.load("sdo = " + line + "\n") != Status::kOk);
  const std::string expected = std::string("6: [cia402] sdo: ") + why;
  if (expected != file.error.message().c_str()) print_error("%s\n", file.error.message().c_str());
  assert_string_equal(file.error.message().c_str(), expected.c_str());
}

void every_type_is_read_with_its_object_joint_and_line(void**) {
  File& file = fresh();
  ASSERT_OK(
      file.load("sdo = 0x2003:1 u16 5\nstore = 1\nsdo = joint3 0x2003:2 i32 -70\n"
                "sdo =\tjoint7  0x20aF:0xFF  i8   -0x80 # a comment\nsdo = 0x3000:0 f32 -1.5\n"
                "sdo = 0x3000:1 u32 4294967295\nsdo = 0x3000:2 i16 -32768\n"));
  struct Row {
    int line, joint, index, sub, bytes;
    std::uint32_t bits;
  };
  const Row rows[] = {{6, -1, 0x2003, 1, 2, 5},           {8, 2, 0x2003, 2, 4, 0xFFFFFFBA},
                      {9, 6, 0x20AF, 255, 1, 0x80},       {10, -1, 0x3000, 0, 4, 0xBFC00000},
                      {11, -1, 0x3000, 1, 4, 0xFFFFFFFF}, {12, -1, 0x3000, 2, 2, 0x8000}};
  const ObjectLines& lines = file.board.cia402.sdo;
  assert_int_equal(lines.count(), 6);
  for (int i = 0; i < 6; ++i) {
    const Row& row = rows[i];
    const ObjectLine& read = lines[i];
    assert_int_equal(read.line, row.line);
    assert_int_equal(read.joint, row.joint);
    assert_int_equal(read.object.index, row.index);
    assert_int_equal(read.object.sub, row.sub);
    assert_int_equal(read.object.bytes, row.bytes);
    assert_int_equal(read.bits, row.bits);
  }
  assert_true(file.board.cia402.store == 1);
}

void a_line_with_a_mistake_is_refused_where_it_is(void**) {
  constexpr const char* kForm = "; a line is such as 0x2003:1 u16 5, or joint3 0x2003:1 i32 -70";
  const auto form = [&](const char* text) { return std::string(text) + kForm; };
  assert_refused("0x2003:1 u8 300", "u8 300 is out of range; it must be in [0, 255]");
  assert_refused("0x2003:1 u8 256", "u8 256 is out of range; it must be in [0, 255]");
  assert_refused("0x2003:1 u16 -1", "u16 -1 is out of range; it must be in [0, 65535]");
  assert_refused("0x2003:1 i16 0xFFFF",
                 "i16 0xFFFF is out of range; it must be in [-32768, 32767]");
  assert_refused("0x2003:1 i32 -2147483649",
                 "i32 -2147483649 is out of range; it must be in [-2147483648, 2147483647]");
  assert_refused("0x2003:1 u32 99999999999999999999999",
                 "u32 99999999999999999999999 is out of range; it must be in [0, 4294967295]");
  assert_refused("0x2003:1 f32 nan", "'nan' is not a finite number");
  assert_refused("0x2003:1 f32 3.5e38",
                 "f32 3.5e38 is out of range; it must be in [-3.4028235e38, 3.4028235e38]");
  for (const char* text : {"1e-50", "-1e-50", "1e-400", "0.0001e-45", "1.17549e-38", "-1e-45"})
    assert_refused(
        std::string("0x2003:1 f32 ") + text,
        (std::string("f32 ") + text + " is too small; write 0, or at least 1.1754944e-38").c_str());
  for (const char* text : {"0", "-0", "0.000", "0e-99", "1.1754944e-38", "-1.1754944e-38"})
    ASSERT_OK(fresh().load(std::string("sdo = 0x2003:1 f32 ") + text + "\n"));
  for (const char* text : {"1.5", "five", "0x", "-", "0xG", "1e3", "5u", "--5", "+5"})
    assert_refused(
        std::string("0x2003:1 u16 ") + text,
        (std::string("'") + text + "' is not a whole number, decimal or from 0x on hexadecimal")
            .c_str());
  assert_refused("0x2003:1 U16 5",
                 "unknown type 'U16'; expected one of u8, u16, u32, i8, i16, i32, f32");
  assert_refused("joint8 0x2003:1 u16 5", "'joint8': the joints are joint1 to joint7");
  assert_refused("joint0 0x2003:1 u16 5", "'joint0': the joints are joint1 to joint7");
  assert_refused("joint 0x2003:1 u16 5", "'joint': the joints are joint1 to joint7");
  for (const char* text : {"0x2003:1", "0x2003:1 u16", "joint3 0x2003:1 u16", "0x2003:1 u16 5 6"})
    assert_refused(
        text, form((std::string("'") + text + "' is no object, type and value").c_str()).c_str());
  for (const char* text : {"0x2003", "2003h:1", "8195:1", "0x2003:", ":1", "0x2003:one", "0x:1"})
    assert_refused(
        std::string(text) + " u16 5",
        form((std::string("'") + text + "' is no object with its sub-index, such as 0x6065:0")
                 .c_str())
            .c_str());
  assert_refused("0x2003:256 u16 5",
                 "'0x2003:256' is out of range; objects are 0x1000:0 to 0xFFFF:255");
  assert_refused("0x12003:1 u16 5",
                 "'0x12003:1' is out of range; objects are 0x1000:0 to 0xFFFF:255");
  assert_refused("0xFFF:1 u16 5", "'0xFFF:1' is out of range; objects are 0x1000:0 to 0xFFFF:255");
}

void an_object_of_the_start_up_or_the_cycle_is_refused_with_the_reason(void**) {
  // Of the first axis and, of a profile's objects, of the second.
  const int kept[] = {0x1005, 0x1006, 0x1010, 0x1011, 0x1016, 0x1017, 0x1400,
                      0x1600, 0x1A03, 0x1BFF, 0x1C00, 0x1C12, 0x1C33, 0x6007,
                      0x6040, 0x605A, 0x605C, 0x6085, 0x607C, 0x6060, 0x6071,
                      0x607A, 0x60B1, 0x60C2, 0x60FE, 0x60FF, 0x6840, 0x68FF};
  for (const int index : kept) {
    char line[40], part[40];
    std::snprintf(line, sizeof line, "sdo = 0x%X:0 u8 1\n", index);
    std::snprintf(part, sizeof part, "%04Xh is not for a line: ", index);
    File& file = fresh();
    ASSERT_STATUS(file.load(line), Status::kNotOffered);
    assert_non_null(std::strstr(file.error.message().c_str(), part));
    assert_int_equal(file.error.line, 6);
  }
  assert_refused(
      "0x1010:1 u32 1",
      "1010h is not for a line: it stores the drive's parameters; use [cia402] store = 1");
  for (const int index : {0x1004, 0x1018, 0x1C50, 0x2000, 0x5FFF, 0x6065, 0x6072, 0x60A9, 0x6084})
    assert_null(kept_by_program(static_cast<std::uint16_t>(index)));
}

void an_object_is_given_once_for_a_joint(void**) {
  struct Row {
    const char *lines, *why;
  };
  const Row rows[] = {
      {"sdo = 0x2003:1 u16 5\nsdo = 0x2003:1 u16 6\n", "for all joints at line 6"},
      {"sdo = joint3 0x2003:1 u16 5\nsdo = 0x2003:1 u16 6\n", "for joint 3 at line 6"},
      {"sdo = 0x2003:1 u16 5\nsdo = joint3 0x2003:1 i32 6\n", "for all joints at line 6"},
      {"sdo = joint3 0x2003:1 u16 5\nsdo = joint3 0x2003:0x1 u16 5\n", "for joint 3 at line 6"}};
  for (const Row& row : rows) {
    File& file = fresh();
    ASSERT_STATUS(file.load(row.lines), Status::kDuplicate);
    assert_string_equal(
        file.error.message().c_str(),
        (std::string("7: [cia402] sdo: 2003h:1 is already given ") + row.why).c_str());
  }
  ASSERT_OK(
      fresh().load("sdo = joint3 0x2003:1 u16 5\nsdo = joint4 0x2003:1 u16 5\n"
                   "sdo = 0x2003:2 u16 5\n"));
  std::string lines;
  for (int i = 0; i < 32; ++i) lines += "sdo = 0x2003:" + std::to_string(i) + " u16 5\n";
  ASSERT_OK(fresh().load(lines));
  File& full = fresh();
  ASSERT_STATUS(full.load(lines + "sdo = 0x2004:0 u16 5\n"), Status::kTooLarge);
  assert_string_equal(full.error.message().c_str(), "38: [cia402] sdo: more than 32 lines");
  File& twice = fresh();  // only sdo may be repeated
  ASSERT_STATUS(twice.load("sdo = 0x2003:1 u16 5\nstore = 1\nstore = 1\n"), Status::kDuplicate);
  assert_string_equal(twice.error.message().c_str(),
                      "8: [cia402] store: the key is already given at line 7");
}

/// What is told of a value of any bits has the fewest digits that a reader of singles, here the C
/// library's, takes back to it.
void a_single_is_told_with_the_fewest_digits_that_give_it_back(void**) {
  Random random{9};
  ObjectLine line;
  line.type = ValueType::kF32;
  line.object.bytes = 4;
  std::array<int, 10> by_digits{};
  for (int trial = 0; trial < 200000; ++trial) {
    const auto high = static_cast<std::uint32_t>(random.below(65536));
    std::uint32_t bits = high << 16 | static_cast<std::uint32_t>(random.below(65536));
    if (trial % 2 == 0) bits &= 0xFFFF0000;
    float value = 0.0F;
    if (trial % 3 == 0) {  // as people write them
      value = static_cast<float>(random.below(100000) * std::pow(10.0, random.below(20) - 10));
      std::memcpy(&bits, &value, sizeof bits);
    }
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    Message said;
    line.append(said, bits);
    if (std::strtof(said.c_str(), nullptr) != value) print_error("%08x: %s\n", bits, said.c_str());
    assert_true(std::strtof(said.c_str(), nullptr) == value);
    int digits = 0;
    bool leads = true;
    for (const char* at = said.c_str(); *at != '\0' && *at != 'e'; ++at) {
      leads = leads && (*at < '1' || *at > '9');
      digits += *at >= '0' && *at <= '9' && !leads;
    }
    if (value == std::floor(value) && std::abs(value) < 4294967296.0F) continue;  // all of them
    char shorter[400];
    std::snprintf(shorter, sizeof shorter, "%.*g", std::max(digits - 1, 1),
                  static_cast<double>(value));
    assert_true(digits <= 1 || std::strtof(shorter, nullptr) != value);
    ++by_digits[static_cast<std::size_t>(digits)];
  }
  for (const int digits : {1, 5, 6, 7, 8, 9})
    print_message("%d digits: %d\n", digits, by_digits[static_cast<std::size_t>(digits)]);
  assert_true(by_digits[9] > 100 && by_digits[5] > 100);
}

/// Whatever the text is, it is a line within its type's range or a refusal with a reason.
void any_text_is_a_line_or_a_refusal(void**) {
  constexpr const char* kObjects[] = {"0x2003:1", "0x5FFF:0xFF", "0x6040:0", "8195:1", ":"};
  constexpr const char* kTypes[] = {"u8", "i16", "f32", "i32", "u64"};
  constexpr const char* kValues[] = {"5", "-1", "0x7F", "1e3", "nan"};
  Random random{3};
  int taken = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = random.below(2) == 0 ? "joint" + std::to_string(random.below(9)) + " " : "";
    for (const auto& words : {kObjects, kTypes, kValues})
      text += std::string(words[random.below(5)]) + " ";
    for (int edits = random.below(3); edits > 0 && !text.empty(); --edits)
      text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
          static_cast<char>(random.uniform(-128, 127));
    ObjectLines lines;
    Message why;
    const bool ok = lines.add(text, 1, why) == Status::kOk;
    taken += ok;
    assert_int_equal(lines.count(), ok);
    assert_int_equal(why.empty(), ok);
    if (!ok) continue;
    assert_true(lines[0].joint >= -1 && lines[0].joint < kDof && lines[0].object.index >= 0x1000);
    assert_true(lines[0].object.bytes == 4 || lines[0].bits >> (8 * lines[0].object.bytes) == 0);
  }
  print_message("%d of 20000 are lines\n", taken);
  assert_true(taken > 1000 && taken < 19000);
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_type_is_read_with_its_object_joint_and_line),
      cmocka_unit_test(a_line_with_a_mistake_is_refused_where_it_is),
      cmocka_unit_test(an_object_of_the_start_up_or_the_cycle_is_refused_with_the_reason),
      cmocka_unit_test(an_object_is_given_once_for_a_joint),
      cmocka_unit_test(a_single_is_told_with_the_fewest_digits_that_give_it_back),
      cmocka_unit_test(any_text_is_a_line_or_a_refusal),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
