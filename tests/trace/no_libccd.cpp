// Stands for libccd in programs without shared libraries: none of their pipelines has a convex
// body.
#include <ccd/ccd.h>

#include <cstdlib>

extern "C" int ccdGJKIntersect(const void* /*one*/, const void* /*other*/, const ccd_t* /*ccd*/) {
  std::abort();
}
