// `tactus scan`: the nodes of one or several CAN buses, and what each reports.
#pragma once

#include "program/session/options.hpp"

namespace tactus {

/// Prints the nodes of every bus; changes none of them. Returns the exit code: kEndedOtherwise if a
/// bus has no node or breaks down, kRefused if one cannot be opened.
int scan(const Options& options);

}  // namespace tactus
