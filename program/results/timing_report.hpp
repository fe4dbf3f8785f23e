// The times of a run, per stage, block and row, and the events of the degrade ladder, for
// summary.json and the screen.
#pragma once

#include <cstdio>

#include "kernel/cycle/executive.hpp"

namespace tactus {

/// Writes `  "timing": {...},` of summary.json: stages by name, blocks as "step.<section>", rows as
/// "row.<name>".
void write_timing(std::FILE* file, const Pipeline& pipeline, const Executive& executive);
/// Writes `  "rung": ..., "events_lost": ..., "events": [...],`: the rung on which the run ended
/// and the changes of rung before, each with the time of log.csv at which it occurred; what is said
/// of a drive has a "text".
void write_events(std::FILE* file, Rung rung, const EventLog& events, const Hal& hal,
                  double period_s);

void print_timing(const Pipeline& pipeline, const Executive& executive);
/// "nominal -> stop: state: ...", or the words on a drive if the rung stays.
Message describe(const Event& event, const Hal& hal);
/// Prints a line for every event but rearms and the switching off, with the same time.
void print_events(const EventLog& events, const Hal& hal, double period_s);

}  // namespace tactus
