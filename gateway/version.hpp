#pragma once

namespace tactus {

/// The version of the programs: its number, and the commit if it was built in a repository.
extern const char* const kVersion;

}  // namespace tactus
