// A trajectory that comes from a pipe can be read only once, but a run reads it twice: for its
// waypoints and for the hash of its configuration.
#pragma once

#include "program/session/files.hpp"

namespace tactus {

/// Returns a path under which the input at `path` can be read more than once: `path` itself if it
/// is a regular file or cannot be read, otherwise that of a copy in memory, until the program ends.
/// An input of more than 1 GiB is cut off there.
FilePath seekable(const FilePath& path);

}  // namespace tactus
