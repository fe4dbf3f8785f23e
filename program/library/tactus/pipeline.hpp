// A whole pipeline: the loader that builds it from the text of a file, and the executive that runs
// its cycles with a Hal, behind the guard.
#pragma once

#include <tactus/core.hpp>

#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
