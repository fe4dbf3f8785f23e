// Ctrl-C and its kin, as a count that the verbs look at: the first asks for an orderly end, the
// second ends at once.
#pragma once

namespace tactus::ctl {

/// Counts SIGINT, SIGTERM and SIGHUP from now on, instead of being ended by them. A wait for
/// something to arrive returns when one comes.
void count_interrupts();

/// Returns how many have come.
int interrupts();

}  // namespace tactus::ctl
