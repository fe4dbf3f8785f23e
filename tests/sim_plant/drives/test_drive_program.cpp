// fer_drives: its command line, its sockets, and the program itself on the other end of a socket
// pair.
#include <linux/can.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>

#include "sim_plant/drives/server/bus_socket.hpp"
#include "sim_plant/drives/server/eds.hpp"
#include "sim_plant/drives/server/options.hpp"
#include "tests/support/testing.hpp"

namespace tactus::drives {
namespace {

char g_program[512];

template <std::size_t N>
bool parse(const char* const (&words)[N], DrivesOptions& options) {
  char* arguments[N];
  for (std::size_t i = 0; i < N; ++i) arguments[i] = const_cast<char*>(words[i]);
  int exit_code = 0;
  const bool good = parse_drives_options(static_cast<int>(N), arguments, options, exit_code);
  if (!good) assert_int_equal(exit_code, 2);
  return good;
}

// Proves DRV-7.
void buses_and_nodes_are_read(void**) {
  DrivesOptions options;
  const char* const words[] = {"fer_drives", "--bus", "vcan0:1,2,3",  "--bus",
                               "vcan1:4-5",  "--fd",  "--descriptor", "7:6,7",
                               "--duration", "2.5",   "--fault",      "kind=reboot at=3",
                               "--seed",     "9"};
  assert_true(parse(words, options));
  assert_int_equal(options.bus_count, 3);
  assert_string_equal(options.buses[0].interface, "vcan0");
  assert_int_equal(options.buses[0].count, 3);
  assert_int_equal(options.buses[1].nodes[1], 5);
  assert_int_equal(options.buses[2].descriptor, 7);
  assert_string_equal(options.buses[2].interface, "");
  assert_int_equal(options.buses[2].nodes[0], 6);
  assert_true(options.fd);
  assert_string_equal(options.faults[0], "kind=reboot at=3");
  assert_int_equal(options.seed, 9);
  ASSERT_NEAR(options.duration_s, 2.5, 0.0);
}

void a_wrong_command_line_is_refused(void**) {
  for (const char* bus : {"vcan0", "vcan0:", ":1", "vcan0:0", "vcan0:128", "vcan0:3-1", "vcan0:1;2",
                          "vcan0:1-8", "a_name_that_is_too_long:1"}) {
    DrivesOptions options;
    const char* const words[] = {"fer_drives", "--bus", bus};
    assert_false(parse(words, options));
  }
  DrivesOptions options;
  const char* const none[] = {"fer_drives"};
  assert_false(parse(none, options));
  const char* const descriptor[] = {"fer_drives", "--descriptor", "x:1"};
  assert_false(parse(descriptor, options));
  const char* const joints[] = {"fer_drives", "--bus", "a:1", "--joints", "0",  "0",
                                "0",          "0",     "0",   "0",        "nan"};
  assert_false(parse(joints, options));
}

void packets_are_frames(void**) {
  int pair[2];
  assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, pair), 0);
  static BusSocket socket;
  assert_true(socket.adopt(pair[1]));
  can::CanFrame frame;
  assert_false(socket.receive(frame));
  canfd_frame raw{};
  raw.can_id = 0x123 | CAN_EFF_FLAG;  // left out
  raw.len = 8;
  assert_true(send(pair[0], &raw, CAN_MTU, 0) > 0);
  raw.can_id = 0x123;
  raw.len = 9;  // longer than a classic frame can be
  assert_true(send(pair[0], &raw, CAN_MTU, 0) > 0);
  assert_true(send(pair[0], &raw, 5, 0) > 0);  // no frame
  raw.len = 12;
  raw.data[11] = 0xAB;
  assert_true(send(pair[0], &raw, CANFD_MTU, 0) > 0);
  assert_true(socket.receive(frame));
  assert_int_equal(frame.id, 0x123);
  assert_int_equal(frame.size, 12);
  assert_int_equal(frame.data[11], 0xAB);
  assert_true(frame.fd);
  assert_false(socket.receive(frame));
  assert_true(socket.send(frame));
  canfd_frame back{};
  assert_int_equal(recv(pair[0], &back, sizeof back, 0), CANFD_MTU);
  assert_int_equal(back.len, 12);
  frame.fd = false;
  frame.size = 2;
  assert_true(socket.send(frame));
  assert_int_equal(recv(pair[0], &back, sizeof back, 0), CAN_MTU);
  close(pair[0]);
  assert_false(socket.receive(frame));
  assert_int_equal(socket.descriptor(), -1);
}

void the_data_sheet_describes_the_objects(void**) {
  static char text[200000];
  std::FILE* file = std::tmpfile();
  assert_non_null(file);
  assert_true(print_eds(file));
  std::rewind(file);
  text[std::fread(text, 1, sizeof text - 1, file)] = '\0';
  std::fclose(file);
  for (const char* part :
       {"\n[6040]\nParameterName=Controlword\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n"
        "DefaultValue=0\nPDOMapping=1\n",
        "\n[1018]\nParameterName=Identity object\nObjectType=0x9\nSubNumber=5\n",
        "\n[1801sub1]\nParameterName=Sub-index 1\nObjectType=0x7\nDataType=0x0007\n"
        "AccessType=rw\nDefaultValue=$NODEID+0xC0000280\n",
        "\n[1008]\nParameterName=Manufacturer device name\nObjectType=0x7\nDataType=0x0009\n"
        "AccessType=ro\nDefaultValue=Tactus emulated servo drive\n",
        "\n[60B2]\nParameterName=Torque offset\n",
        "\n[MandatoryObjects]\nSupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018\n"}) {
    if (std::strstr(text, part) == nullptr) print_error("missing: %s\n", part);
    assert_non_null(std::strstr(text, part));
  }
}

/// Receives packets until one has this identifier.
bool await(int socket, unsigned id, can_frame& frame) {
  pollfd polled{socket, POLLIN, 0};
  while (poll(&polled, 1, 10000) == 1 && recv(socket, &frame, sizeof frame, 0) == CAN_MTU)
    if (frame.can_id == id) return true;
  return false;
}

void the_program_answers_and_ends_with_its_bus(void**) {
  int pair[2];
  assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, pair), 0);
  char nodes[32];
  std::snprintf(nodes, sizeof nodes, "%d:1-7", pair[1]);
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    close(pair[0]);
    execl(g_program, g_program, "--descriptor", nodes, static_cast<char*>(nullptr));
    _exit(127);
  }
  close(pair[1]);
  can_frame frame{};
  assert_true(await(pair[0], 0x707, frame));
  assert_int_equal(frame.data[0], 0);
  frame = {};
  frame.can_id = 0x604;
  frame.can_dlc = 8;
  frame.data[0] = 0x40;
  frame.data[2] = 0x10;
  assert_int_equal(send(pair[0], &frame, sizeof frame, 0), CAN_MTU);
  assert_true(await(pair[0], 0x584, frame));
  assert_int_equal(frame.data[4], 0x92);
  close(pair[0]);
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status));
  assert_int_equal(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace tactus::drives

int main(int, char** argv) {
  using namespace tactus::drives;
  // The program is two folders above that of this test.
  const char* name = std::strrchr(argv[0], '/');
  const int folder = name != nullptr ? static_cast<int>(name - argv[0]) : 0;
  std::snprintf(g_program, sizeof g_program, "%.*s/../../../fer_drives", folder, argv[0]);
  const CMUnitTest tests[] = {
      cmocka_unit_test(buses_and_nodes_are_read),
      cmocka_unit_test(a_wrong_command_line_is_refused),
      cmocka_unit_test(packets_are_frames),
      cmocka_unit_test(the_data_sheet_describes_the_objects),
      cmocka_unit_test(the_program_answers_and_ends_with_its_bus),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
