// The claim of an interface: one program at a time. It needs no rights and no cable.
#include "hal/ethercat/packet_socket.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <string>

#include "tests/support/testing.hpp"

namespace tactus::ethercat {
namespace {

/// Another program's claim, by the name that is documented.
int claim_of_another(const char* interface) {
  const std::string name = std::string("tactus-ethercat-") + interface;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path + 1, name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  const int other = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (bind(other, reinterpret_cast<const sockaddr*>(&address), size) == 0) return other;
  ::close(other);
  return -1;
}

// Proves ECAT-13.
void an_interface_that_another_program_uses_is_refused(void**) {
  PacketSocket socket;
  Message why;
  const int other = claim_of_another("tacnone0");
  assert_true(other >= 0);
  ASSERT_STATUS(socket.open("tacnone0", why), Status::kBusConflict);
  assert_string_equal(why.c_str(),
                      "interface tacnone0: another Tactus program uses it; end it first");
  assert_false(socket.is_open());
  // One of another name is refused for another reason.
  assert_true(socket.open("tacnone1", why) != Status::kBusConflict);
  ::close(other);
  assert_true(socket.open("tacnone0", why) != Status::kBusConflict);
}

/// What could not be opened, or is closed, is free again.
void a_claim_ends_with_its_socket(void**) {
  PacketSocket socket;
  Message why;
  assert_true(socket.open("tacnone0", why) != Status::kOk);
  const int other = claim_of_another("tacnone0");
  assert_true(other >= 0);
  ::close(other);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_interface_that_another_program_uses_is_refused),
      cmocka_unit_test(a_claim_ends_with_its_socket),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
