// `tactus scan` of a board with EtherCAT: the slaves of a segment, and what each shows.
#pragma once

#include "program/session/options.hpp"

namespace tactus {

/// Prints the slaves at every interface; changes no state and no setting of them. Returns the exit
/// code: kEndedOtherwise if an interface has no slave or breaks down, kRefused if one cannot be
/// opened.
int scan_segment(const Options& options);

}  // namespace tactus
