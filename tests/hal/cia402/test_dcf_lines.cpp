// scripts/dcf-sdo: what it prints of a device configuration file is what the loader takes, and what
// it leaves out is what the loader refuses. Runs from the root of the project.
// Proves CAN-20, ECAT-20.
#include <unistd.h>

#include <cstdio>
#include <string>

#include "hal/cia402/object_lines.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {
namespace {

std::string path() {
  return "/tmp/tactus-dcf-" + std::to_string(getpid()) + ".dcf";
}

/// What the script prints of a file with that text.
std::string lines_of(const std::string& text, const std::string& options = "") {
  std::FILE* file = std::fopen(path().c_str(), "w");
  assert_non_null(file);
  std::fputs(text.c_str(), file);
  std::fclose(file);
  std::FILE* script = popen(("scripts/dcf-sdo " + path() + " " + options).c_str(), "r");
  assert_non_null(script);
  std::string printed;
  char bytes[4096];
  while (const std::size_t size = std::fread(bytes, 1, sizeof bytes, script))
    printed.append(bytes, size);
  assert_int_equal(pclose(script), 0);
  std::remove(path().c_str());
  return printed;
}

std::string object(const char* section, const char* type, const char* value, const char* more) {
  return std::string("[") + section + "]\nParameterName=P\nObjectType=0x7\nDataType=" + type +
         "\nAccessType=rw\nParameterValue=" + value + "\n" + more + "\n";
}

void what_differs_from_its_default_becomes_a_line(void**) {
  const std::string file =
      "[FileInfo]\nFileName=a.dcf\n[DeviceComissioning]\nNodeID=0x03\n; a comment\n"
      "[2003]\nParameterName=Maker's\nObjectType=0x8\nSubNumber=3\n" +
      object("2003sub1", "0x0006", "0x10", "DefaultValue=5") +
      object("2003sub2", "0x0004", "0xFFFFFFBA", "") +
      object("2003subA", "0x0005", "010", "DefaultValue=8") +  // octal
      object("2004", "0x0008", "0.5", "DefaultValue=1") +
      object("2005", "0x0008", "0x3F000000", "") +
      object("2006", "0x0007", "$NODEID+0x200", "DefaultValue=0") +
      object("2007", "0x0003", "-5", "DefaultValue=") + object("2008", "0x0005", "0x100", "") +
      object("2009", "0x0009", "text", "") + object("200A", "0x0006", "7", "AccessType=ro") +
      object("200B", "0x0006", "7", "DefaultValue=0x7") + object("6040", "0x0006", "7", "") +
      object("1400sub1", "0x0007", "$NODEID+0x200", "") +
      "[200C]\nParameterName=Only a default\nDataType=0x0006\nDefaultValue=3\n";
  assert_string_equal(lines_of(file).c_str(),
                      "sdo = 0x2003:1 u16 16  # P\n"
                      "sdo = 0x2003:2 i32 -70  # P\n"
                      "sdo = 0x2004:0 f32 0.5  # P\n"
                      "sdo = 0x2005:0 u32 1056964608  # P\n"
                      "sdo = 0x2006:0 u32 515  # P\n"
                      "sdo = 0x2007:0 i16 -5  # P\n"
                      "# 2008h:0 = 0x100: 0x100 is out of range; u8 is 0 to 255\n"
                      "# 2009h:0 = text: its data type, 0009h, is none of a line\n"
                      "# 200Ah:0 = 7: it is read-only\n"
                      "# 6040h:0 = 7: it is a command, which only the cycle gives\n"
                      "# 1400h:1 = $NODEID+0x200: this program sets up the process data\n");
  assert_string_equal(
      lines_of(object("2006", "0x0007", "$NODEID+1", ""), "--joint 3 --node 9").c_str(),
      "sdo = joint3 0x2006:0 u32 10  # P\n");
  assert_string_equal(lines_of(object("2006", "0x0007", "$NODEID+1", "")).c_str(),
                      "# 2006h:0 = $NODEID+1: it depends on the node's number; give --node\n");
}

/// A file is what somebody has sent: it writes no line but those of its objects.
void a_hostile_file_prints_no_line_that_it_has_not(void**) {
  const std::string file = object("2003", "0x0006", "5", "") + object("2004", "0x0008", "nan", "") +
                           object("2005", "0x0008", "1e400", "") +
                           "[2006]\nParameterName\nDataType\nAccessType\nParameterValue=1\n" +
                           object("2007", "0x0006", "7", "ParameterName=a\n  store = 1\n") +
                           object("2008", "0x0006", "8", "ParameterName=\x0b\x7f\n");
  assert_string_equal(lines_of(file).c_str(),
                      "sdo = 0x2003:0 u16 5  # P\n"
                      "# 2004h:0 = nan: nan is out of range; f32 is -3.40282346e+38 to "
                      "3.40282346e+38\n"
                      "# 2005h:0 = 1e400: 1e400 is out of range; f32 is -3.40282346e+38 to "
                      "3.40282346e+38\n"
                      "# 2006h:0 = 1: its data type, 0000h, is none of a line\n"
                      "sdo = 0x2007:0 u16 7  # a\n"
                      "sdo = 0x2008:0 u16 8  # ?\n");
}

void what_it_prints_is_what_the_loader_takes(void**) {
  std::string file;
  for (int index = 0x1000; index <= 0xFFFF; index += 3) {
    char section[8];
    std::snprintf(section, sizeof section, "%04X", static_cast<unsigned>(index));
    file += object(section, "0x0006", "5", "");
  }
  std::string printed = lines_of(file, "2>/dev/null");
  int taken = 0, refused = 0;
  for (int index = 0x1000; index <= 0xFFFF; index += 3) {
    const std::string line = printed.substr(0, printed.find('\n'));
    printed.erase(0, line.size() + 1);
    const bool given = line.compare(0, 6, "sdo = ") == 0;
    assert_int_equal(given, kept_by_program(static_cast<std::uint16_t>(index)) == nullptr);
    ++(given ? taken : refused);
    if (!given) continue;
    ObjectLines lines;
    Message why;
    ASSERT_OK(lines.add(line.substr(6, line.find('#') - 6), 1, why));
    assert_int_equal(lines[0].object.index, index);
    assert_int_equal(lines[0].bits, 5);
  }
  assert_true(printed.empty() && taken > 10000 && refused > 500);
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_differs_from_its_default_becomes_a_line),
      cmocka_unit_test(a_hostile_file_prints_no_line_that_it_has_not),
      cmocka_unit_test(what_it_prints_is_what_the_loader_takes),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
