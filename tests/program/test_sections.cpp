// Tests that `ports` prints the sections that the board's loader reads, with the same settings and
// defaults.
#include "kernel/load/ini.hpp"
#include "kernel/robots/robot.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

using File = Text<16383>;

File minimal() {
  File text("[robot]\nname = ");
  text << Robot::kName << "\nperiod_us = 8000\nq_c = robot.q\n";
  return text;
}

/// The loader's refusal of a file, or ""; whether a robot can be reached is not tested.
std::string_view refusal(const File& text) {
  const Line path = write("sections.ini", {text.c_str()});
  if (tactus_run({"check", path.c_str()}) == 0) return {};
  const std::string_view place = path;
  std::string_view said = errors();
  if (said.substr(0, 10) == "real time:") said.remove_prefix(said.find('\n') + 1);
  assert_true(said.substr(0, place.size()) == place);
  said.remove_prefix(place.size());
  const bool of_robot = said.substr(0, 10) == ": refused:" || said.substr(0, 8) == ": robot:";
  return of_robot ? std::string_view() : said;
}

/// The output of `ports`.
std::string_view ports() {
  assert_int_equal(tactus_run({"ports"}), 0);
  return output();
}

std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(line.size() + (line.size() < text.size() ? 1 : 0));
  return line;
}

/// The section whose title a line of `ports` is, or "".
std::string_view title(std::string_view line) {
  if (line.substr(0, 4) != "## [" || line.back() != ']') return {};
  return line.substr(4, line.size() - 5);
}

/// A cell of a row, counted from 0.
std::string_view cell(std::string_view row, int index) {
  for (row.remove_prefix(1); index > 0; --index) row.remove_prefix(row.find('|') + 1);
  return trim(row.substr(0, row.find('|')));
}

/// The setting of a row of `ports` and its default, as a line of a file; "" if no default reads
/// back to the same number.
Line setting(std::string_view row) {
  if (row.substr(0, 3) != "| `") return {};
  const std::string_view key = cell(row, 0), what = cell(row, 1), value = cell(row, 3);
  if (key == "`rated_torque`") return Line("rated_torque = 3\n");  // the only one without default
  if (value.empty() || value == "required" || value == "neutral" || value == "none") return {};
  if (what.substr(0, 5) == "limit") return {};  // rounded, perhaps up
  return Line(key.substr(1, key.size() - 2)) << " = " << value << "\n";
}

// Proves CFG-6, RUN-3.

void ports_prints_the_sections_that_the_loader_has_and_no_other(void**) {
  Line printed;
  for (std::string_view text = ports(); !text.empty();) {
    const std::string_view name = title(take_line(text));
    if (!name.empty()) printed << (printed.empty() ? "" : ", ") << name;
  }
  Line expected(":5: [no_such] this board has no such section; it has ");
  expected << printed << "; a block has a type, one of ";
  assert_true(has(refusal(minimal() << "[no_such]\nkey = 1\n"), expected));
}

void every_printed_section_is_read_with_every_printed_setting(void**) {
  File text = minimal();
  int sections = 0, settings = 0;
  for (std::string_view left = ports(); !left.empty();) {
    const std::string_view line = take_line(left), name = title(line);
    if (line.substr(0, 9) == "## type =") break;
    if (!name.empty() && name != "robot") {
      text << "[" << name << "]\n";
      ++sections;
    }
    const Line given = sections > 0 ? setting(line) : Line();
    text << given;
    settings += given.empty() ? 0 : 1;
  }
  const std::string_view said = refusal(text);
  print_message("%d sections, %d settings %.*s\n", sections, settings,
                static_cast<int>(said.size()), said.data());
  assert_true(said.empty());
  assert_true(sections >= 8 && settings >= 50);
}

void the_section_of_another_kind_of_board_is_refused(void**) {
  const std::string_view printed = ports();
  int refused = 0;
  for (const char* name : {"plant", "ur", "can", "ethercat"}) {
    const Line heading(Line("\n## [") << name << "]\n");
    File text = minimal();
    text << "[" << name << "]\n";
    const std::string_view said = refusal(text);
    if (printed.find(heading) != std::string_view::npos) {
      assert_true(said.empty());
      continue;
    }
    assert_true(has(said, Line(":5: [") << name << "] this board has no such section; it has "));
    ++refused;
  }
  assert_int_equal(refused, 3);
}

// Proves RT-6.

void a_real_robot_does_not_start_without_real_time_unless_the_file_says_so(void**) {
  constexpr const char* kRefusal = "real time: refused: cpu (Invalid argument: choose a CPU";
  const bool ur = ports().find("\n## [ur]\n") != std::string_view::npos;
  const bool can = ports().find("\n## [can]\n") != std::string_view::npos;
  const bool ethercat = ports().find("\n## [ethercat]\n") != std::string_view::npos;
  const bool real = ur || can || ethercat;
  assert_true(
      has(ports(), real ? "| `required` | word | | refuse |" : "| `required` | word | | warn |"));
  for (const char* required : {"", "required = refuse\n", "required = warn\n"}) {
    File text = minimal();
    text << "[realtime]\ncpu = 1023\n" << required;
    if (ur) text << "[ur]\naddress = 127.0.0.1\nrtde_port = 1\n";  // nobody is there
    if (can) text << "[can]\ninterfaces = no_bus\n[cia402]\nrated_torque = 3\n";
    if (ethercat) text << "[ethercat]\ninterface = no_cable\n[cia402]\nrated_torque = 3\n";
    const Line path = write("start.ini", {text.c_str()}), out = in_folder("start");
    const int code = tactus_run({"run", path.c_str(), "--realtime", "--duration", "0.1",
                                 "--no-figure", "--out", out.c_str()});
    const bool refuses = *required == '\0' ? real : required[11] == 'r';
    assert_int_equal(code == 2 && errors().find(kRefusal) != std::string_view::npos, refuses);
    assert_true(refuses || has(errors(), "note: real time is not certain: cpu ("));
    // `check` judges what a run does; of a simulated arm, which may run in virtual time, it tells.
    const int checked = tactus_run({"check", path.c_str()});
    assert_int_equal(errors().find(kRefusal) != std::string_view::npos, refuses);
    assert_true(real ||
                (checked == 0 && (!refuses || has(errors(), "that ends `serve` and `run"))));
    assert_true(!real || checked == 2);
  }
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(ports_prints_the_sections_that_the_loader_has_and_no_other),
      cmocka_unit_test(every_printed_section_is_read_with_every_printed_setting),
      cmocka_unit_test(the_section_of_another_kind_of_board_is_refused),
      cmocka_unit_test(a_real_robot_does_not_start_without_real_time_unless_the_file_says_so),
  };
  return run_program_tests(argv[0], tests);
}
