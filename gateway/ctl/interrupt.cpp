#include "gateway/ctl/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace tactus::ctl {
namespace {

volatile std::sig_atomic_t came = 0;

void count(int) {
  came = came + 1;
}

}  // namespace

void count_interrupts() {
  struct sigaction action {};
  action.sa_handler = count;  // without SA_RESTART, so that poll() returns
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

int interrupts() {
  return came;
}

}  // namespace tactus::ctl
