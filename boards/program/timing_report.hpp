// The times of a run, per stage, block and row, and what the degrade ladder did, in summary.json
// and on the screen.
#pragma once

#include <cstdio>

#include "kernel/executive.hpp"

namespace tactus {

/// `  "timing": {...},` of summary.json: stages by name, blocks as "step.<section>", rows as
/// "row.<name>".
void write_timing(std::FILE* file, const Pipeline& pipeline, const Executive& executive);
/// `  "rung": ..., "events": [...], "events_lost": ...,`: the rung on which the run ended, and what
/// led there.
void write_events(std::FILE* file, Rung rung, const EventLog& events);

void print_timing(const Pipeline& pipeline, const Executive& executive);
/// A line for every event after the start.
void print_events(const EventLog& events);

}  // namespace tactus
