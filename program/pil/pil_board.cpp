#include "program/pil/pil_board.hpp"

#include <unistd.h>

#include "program/pil/pil_hal.hpp"
#include "program/run_board.hpp"
#include "program/sim/sim_sections.hpp"

namespace tactus {
namespace {

pil::PilHal& robot() {
  static pil::PilHal hal;
  return hal;
}

Status configure(const SimSections& sections, const Pipeline& pipeline, const Options& options) {
  const PlantParams plant = sections.plant.mounted_as(pipeline.robot.mounting);
  return robot().load(plant, pipeline.robot.period_s(), options);
}

/// The image is in a folder beside that of the program: build/fer_m7/tactus,
/// build/fer_m7-m7/image.elf, or both with -convex: built with libccd.
pil::BoardImage own_image(std::string_view board) {
  char program[512];
  const ssize_t size = readlink("/proc/self/exe", program, sizeof program);
  std::string_view folder(program, size > 0 ? static_cast<std::size_t>(size) : 0);
  folder = folder.substr(0, folder.rfind('/'));
  const std::size_t name = folder.rfind('/');
  const bool convex = folder.find("-convex", name) != std::string_view::npos;
  return pil::image_of(folder.substr(0, name), board, convex ? "-convex/image.elf" : "/image.elf");
}

}  // namespace

int run_pil_board(int argc, char** argv, const char* board) {
  robot().set_image(own_image(board));
  return run_board<SimSections>(
      argc, argv, {board, robot(), sizeof(pil::PilHal), false, configure, nullptr, &robot()});
}

}  // namespace tactus
