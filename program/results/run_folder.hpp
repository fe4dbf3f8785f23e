// The folder of a run. Its files are those of one run: what an earlier one left is removed before
// the first cycle, and summary.json is written last and only if all others could be, so that a
// folder without it is incomplete.
#pragma once

#include <string_view>

#include "program/session/files.hpp"

namespace tactus {

/// Returns "folder/file".
FilePath in_folder(std::string_view folder, const char* file);

/// Makes the folder, locks it until the program ends, removes the results of an earlier run from
/// it, and writes `pipeline`, the text of the pipeline file, to pipeline.ini. False: prints the
/// reason to stderr.
bool begin_folder(std::string_view folder, std::string_view pipeline);

}  // namespace tactus
