// Reads from the text of a program that streams set-points its sockets and the parameters of its
// servoj.
#pragma once

#include <string_view>

#include "sim_plant/ur/motion/servo_law.hpp"

namespace tactus::ur {

struct SocketPlace {
  std::string_view host;
  int port = 0;
  std::string_view name;
};

/// Finds the call of `function` with literal address and port and this socket name. False: there is
/// none.
bool find_socket_named(std::string_view text, std::string_view function, std::string_view name,
                       SocketPlace& place);

/// Returns lookahead and gain of the first servoj that has them, or the defaults of URScript.
ServoLaw find_servo_law(std::string_view text);

}  // namespace tactus::ur
