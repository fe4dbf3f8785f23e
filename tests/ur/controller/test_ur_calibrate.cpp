// Tests scripts/robot-calibrate beside the emulated controller: the table that it writes is the arm
// whose calibration it has read, and what it refuses.
#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "sim_plant/ur/motion/calibration.hpp"
#include "sim_plant/ur/wire/state_messages.hpp"
#include "tests/program/program_bench.hpp"
#include "tests/ur/free_ports.hpp"

namespace tactus::ur {
namespace {

int plant_tree(void**) {
  const int offset = free_offset("127.0.0.1", -20000);
  setenv("OFFSET", (Text<15>() << offset).c_str(), 1);
  setenv("PORT", (Text<15>() << kPrimaryPort + offset).c_str(), 1);
  setenv("OPTIONS", "--name ur10_left --root $S/tree", 1);
  return shell(
      "mkdir -p $S/tree/kernel/robots && cp kernel/robots/ur10*.hpp $S/tree/kernel/robots");
}

// Proves CAL-1.

/// By the command of the page, at another address.
void the_table_of_a_told_calibration_is_that_arm(void**) {
  assert_succeeds(
      "$P --bind 127.0.0.1 --port-offset $OFFSET --calibration 7 --duration 30 > $S/said & "
      "while [ ! -s $S/said ]; do sleep 0.05; done; "
      "command=$(sed -n '/^## Your own arm/,/^## /{/^scripts/p}' docs/robots/ur10.md); cd $S; "
      "eval \"$R/$command --address 127.0.0.1 --port $PORT --root $S/tree\"; "
      "code=$?; kill $!; exit $code");
  assert_has_all(output(), {" mrad at worst", "wrote kernel/robots/ur10_left.hpp",
                            "next: make BOARD=ur10_left_socket, and build/ur10_left_socket/"});
  assert_succeeds(
      "g++ -std=c++17 -O1 -I$S/tree -I. -isystem /usr/include/eigen3 -DEIGEN_DONT_VECTORIZE "
      "-include kernel/core/build.hpp -DTACTUS_ROBOT=Ur10_left "
      "-DTACTUS_ROBOT_TABLES='\"kernel/robots/ur10_left_capsules.hpp\"' "
      "tests/ur/controller/against_dh.cpp hal/ur/arm_calibration.cpp kernel/core/text.cpp "
      "-o $S/against_dh && $S/against_dh $S/ur10_left.txt");
  print_message("%.*s", static_cast<int>(output().size()), output().data());
  assert_true(tactus::number_after(output(), "pose ") < 1e-9);
  // The bodies are where those of the nominal arm are, but for its errors.
  assert_true(tactus::number_after(output(), "capsule ") < 0.015);
  assert_true(tactus::number_after(output(), "torque ") < 1.5);
}

void what_was_saved_writes_the_same_table(void**) {
  assert_succeeds(
      "cp -r $S/tree $S/told && "
      "eval scripts/robot-calibrate --from $S/ur10_left.txt $OPTIONS --force && "
      "diff -r $S/told $S/tree");
}

void make_finds_the_board_with_the_table_of_the_arm(void**) {
  assert_succeeds(
      "ln -s $R/[!bk.]* $S/tree; cp -rn $R/boards $S/tree; cd $S/tree && "
      "make -s BOARD=ur10_left_socket list-runs && make -s BOARD=ur10_left_socket list-tests && "
      "make -pn BOARD=ur10_left_socket | grep '^OF_ROBOT'");
  assert_true(
      has(output(), "-DTACTUS_ROBOT=Ur10_left -DTACTUS_ROBOT_TABLES='\"kernel/robots/ur10_left_"));
  assert_true(output().find("ur10_trg") == std::string_view::npos);
}

/// Prints what the pages state: how far the tip of an arm is from where the nominal table has it.
void a_drawn_calibration_is_of_published_size(void**) {
  std::vector<double> off_mm, longest_m;
  std::mt19937_64 random(1);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const DhTable dh = draw_calibration(seed), again = draw_calibration(seed);
    assert_true(dh.d == again.d && dh.theta == again.theta);
    longest_m.push_back(std::max({std::abs(dh.d[1]), std::abs(dh.d[2]), std::abs(dh.d[3])}));
    for (int i = 0; i < 1000; ++i) {
      Joints q;
      for (double& angle : q) angle = 0x1p-63 * static_cast<double>(random()) * 3.14 - 3.14;
      off_mm.push_back(1e3 * (forward(q, dh).p - forward(q).p).norm());
    }
  }
  std::sort(off_mm.begin(), off_mm.end());
  std::sort(longest_m.begin(), longest_m.end());
  print_message("off by %.2f mm at the median, %.2f mm at worst; d up to %.0f m\n",
                off_mm[off_mm.size() / 2], off_mm.back(), longest_m.back());
  assert_true(off_mm[off_mm.size() / 2] > 1.0 && off_mm.back() < 20.0);
  assert_true(longest_m[longest_m.size() / 2] > 20.0);
}

// Proves CAL-2.

/// Serves bytes once; the script refuses them.
void assert_refused(const std::string& bytes, const char* said) {
  std::FILE* file = std::fopen(in_folder("bytes").c_str(), "wb");
  std::fwrite(bytes.data(), 1, bytes.size(), file);
  std::fclose(file);
  const int code = shell(
      "/usr/bin/python3 -c \"import socket, sys\n"
      "with socket.create_server(('127.0.0.1', int(sys.argv[1]))) as port:\n"
      "    print(flush=True)\n"
      "    port.accept()[0].sendall(open(sys.argv[2], 'rb').read())\" $PORT $S/bytes > $S/up & "
      "while [ ! -s $S/up ]; do sleep 0.05; done; rm $S/up; "
      "eval scripts/robot-calibrate --address 127.0.0.1 --port $PORT $OPTIONS --force");
  assert_int_equal(code, 2);
  assert_true(has(errors(), "robot-calibrate: 127.0.0.1 port "));
  assert_true(has(errors(), said));
}

/// The first state that a controller sends.
std::string state_of(const DhTable& dh) {
  std::array<std::uint8_t, 2048> bytes;
  ByteWriter out(bytes.data(), bytes.size());
  write_robot_state(Image{}, Version{}, dh, true, out);
  return {reinterpret_cast<const char*>(out.data()), out.size()};
}

/// A packet with its length in front.
std::string packet(const std::string& rest) {
  return std::string({0, 0, 0, static_cast<char>(rest.size() + 4)}) + rest;
}

void what_is_no_calibration_of_a_ur10_is_refused(void**) {
  using namespace std::string_literals;
  DhTable ur10e = kDhOfUr10e, ur5 = draw_calibration(1), broken = ur5;
  ur10e.calibrated = true;
  ur5.a[1] += 0.187;
  broken.theta[2] = std::numeric_limits<double>::infinity();
  assert_refused(state_of(kDh), "calibration status 0, expected 2: the arm has no calibration in");
  assert_refused(state_of(ur10e),
                 "joint 2 (shoulder) is 53.4 mm and 0.0 mrad from where a UR10 has it");
  assert_refused(state_of(ur5), ", limits 10 mm and 20 mrad; it is another arm");
  assert_refused(state_of(broken), "theta of joint 3 is inf, which is not finite");
  assert_refused(state_of(kDh).substr(0, 300), "the data end 300 bytes into ");
  assert_refused("\xff\xff\xff\xff\x10"s,
                 "4294967295 bytes are announced, limits 5 and 16384; is this the");
  assert_refused(packet("\x10\0\0\0\x03\x05"s), "3 bytes are announced, limits 5 and 16384");
  assert_refused(packet("\x10\0\0\0\x07\x05\0\0"s), "kinematics of 2 bytes, expected 220");
  assert_refused(packet("\x14\0\0\0\0\0\0\0\0\xfe\x03\x02UR\x03\x04"s),
                 "software 3.4 tells no calibration, 3.6 and later do; update the controller");
}

/// A saved file that is changed by sed, options, and what the refusal says.
struct Refusal {
  const char *change, *options, *said;
};

constexpr Refusal kRefusals[] = {
    {"/theta/d", "--force", "changed.txt: its crc32 is not that of the lines above it; take a"},
    {"/crc32/d", "--force", "changed.txt: its crc32 is not that of the lines above it; take a"},
    {"", "", "ur10_left.hpp exists; give --force to replace the robot's files, or another --name"},
    {"", "--save $S/ur10_left.txt --name ur10_more", "ur10_left.txt exists; give another --save"},
    {"", "--port 70000", "--port 70000: 1 to 65535"},
    {"", "--force --name ur10_mine", "ur10_mine.hpp exists and is not of this script; choose"},
    {"", "--force --name ur10_capsules", "--name ur10_capsules: ur10_ and small letters and"},
    {"", "--force --name ../ur10_x", "--name ../ur10_x: ur10_ and small letters and digits"},
};

void files_and_names_that_do_not_fit_are_refused(void**) {
  assert_succeeds("touch $S/tree/kernel/robots/ur10_mine.hpp; cp -r $S/tree/kernel $S/before");
  for (const Refusal& refusal : kRefusals) {
    setenv("CHANGE", refusal.change, 1);
    setenv("MORE", refusal.options, 1);
    assert_int_equal(shell("sed \"$CHANGE\" $S/ur10_left.txt > $S/changed.txt && "
                           "eval scripts/robot-calibrate --from $S/changed.txt $OPTIONS $MORE"),
                     2);
    assert_true(has(errors(), refusal.said));
  }
  assert_succeeds("diff -r $S/before $S/tree/kernel");
}

}  // namespace
}  // namespace tactus::ur

int main(int, char** argv) {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(the_table_of_a_told_calibration_is_that_arm, plant_tree),
      cmocka_unit_test(what_was_saved_writes_the_same_table),
      cmocka_unit_test(what_is_no_calibration_of_a_ur10_is_refused),
      cmocka_unit_test(files_and_names_that_do_not_fit_are_refused),
      cmocka_unit_test(make_finds_the_board_with_the_table_of_the_arm),
      cmocka_unit_test(a_drawn_calibration_is_of_published_size),
  };
  return tactus::run_program_tests(argv[0], tests, "ur10_emulator");
}
