// The [gateway] section of a pipeline file: how references reach the pipeline.
#pragma once

#include "kernel/describe.hpp"
#include "kernel/load_error.hpp"
#include "kernel/reference/joint_space.hpp"

namespace tactus {

inline constexpr std::array<const char*, 4> kInterpolationWords = {"by_fields", "linear", "cubic",
                                                                   "quintic"};

struct GatewaySection {
  Value trajectory;  ///< default trajectory file, relative to the pipeline file
  Interpolation interpolation = Interpolation::kByFields;
  double settle_s = 2.0;  ///< how long a run goes on after its trajectory has ended

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.text("trajectory", trajectory, "default trajectory file");
    visit.choice("interpolation", interpolation, kInterpolationWords);
    visit.param("settle_s", settle_s, Range{0.0, 3600.0}, "s");
  }
};

}  // namespace tactus
