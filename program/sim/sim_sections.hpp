// SimSections: the sections that a simulated board adds to the pipeline's own.
#pragma once

#include "program/session/host_sections.hpp"
#include "sim_plant/arm/plant_params.hpp"

namespace tactus {

struct SimSections : HostSections {
  PlantParams plant;

  template <class Visitor>
  void describe(Visitor& visit) {
    HostSections::describe(visit);
    visit.section("plant", plant);
  }
};

}  // namespace tactus
