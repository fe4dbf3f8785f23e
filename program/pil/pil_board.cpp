#include "program/pil/pil_board.hpp"

#include "program/pil/pil_hal.hpp"
#include "program/run_board.hpp"
#include "program/sim/sim_sections.hpp"

namespace tactus {
namespace {

SimHal& plant() {
  static SimHal hal;
  return hal;
}

Status configure(const SimSections& sections, const Pipeline& pipeline, const Options& options) {
  plant().set_period(pipeline.robot.period_s());
  return plant().load(sections.plant, options.seed);
}

/// The image lies beside the program: build/BOARD/tactus, build/BOARD-m7/image.elf.
FilePath image_beside(std::string_view program) {
  const std::size_t slash = program.rfind('/');
  FilePath path(slash == std::string_view::npos ? "." : program.substr(0, slash));
  return path << "-m7/image.elf";
}

}  // namespace

int run_pil_board(int argc, char** argv, const char* board) {
  static const FilePath image = image_beside(argv[0]);
  static pil::PilHal hal(plant(), image.c_str());
  return run_board<SimSections>(argc, argv,
                                {board, hal, sizeof hal, false, configure, nullptr, &hal});
}

}  // namespace tactus
