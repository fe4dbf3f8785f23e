// Ctrl-C and similar signals, as a count that the verbs read: the first requests an orderly end,
// the second ends at once.
#pragma once

namespace tactus::ctl {

/// Counts SIGINT, SIGTERM and SIGHUP from now on, instead of being ended by them. A wait for
/// something to arrive returns when one arrives.
void count_interrupts();

/// Returns the number of signals so far.
int interrupts();

}  // namespace tactus::ctl
