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

std::string_view folder_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? "." : path.substr(0, slash);
}

/// The image lies beside the folder of the program: build/BOARD/tactus, build/BOARD-m7/image.elf.
FilePath image_of(std::string_view board, std::string_view program) {
  FilePath path(folder_of(program));
  return path << "/../" << board << "-m7/image.elf";
}

}  // namespace

int run_pil_board(int argc, char** argv, const char* board) {
  static const FilePath image = image_of(board, argv[0]);
  static pil::PilHal hal(plant(), image.c_str());
  return run_board<SimSections>(argc, argv,
                                {board, hal, sizeof hal, false, configure, nullptr, &hal});
}

}  // namespace tactus
