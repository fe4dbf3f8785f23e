// What is read from the text of a program that streams set-points: where it connects to, and the
// parameters of its servoj.
#pragma once

#include <string_view>

#include "sim_plant/ur/servo_law.hpp"

namespace tactus::ur {

struct SocketPlace {
  std::string_view host;
  int port = 0;
  std::string_view name;
};

/// The n-th call of `function` with an address and a port that are written out; false: there is
/// none.
bool find_socket(std::string_view text, std::string_view function, int n, SocketPlace& place);
/// The one under this socket name.
bool find_socket_named(std::string_view text, std::string_view function, std::string_view name,
                       SocketPlace& place);

/// Lookahead and gain of the first servoj that names them; the defaults of URScript else.
ServoLaw find_servo_law(std::string_view text);

}  // namespace tactus::ur
