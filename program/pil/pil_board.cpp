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
  return robot().load(sections.plant, pipeline.robot.period_s(), options);
}

/// The image lies beside the folder of the program: build/BOARD/tactus, build/BOARD-m7/image.elf.
FilePath image_of(std::string_view board) {
  char program[512];
  const ssize_t size = readlink("/proc/self/exe", program, sizeof program);
  std::string_view folder(program, size > 0 ? static_cast<std::size_t>(size) : 0);
  folder = folder.substr(0, folder.rfind('/'));
  FilePath path(folder.substr(0, folder.rfind('/')));
  return path << "/" << board << "-m7/image.elf";
}

}  // namespace

int run_pil_board(int argc, char** argv, const char* board) {
  static const FilePath image = image_of(board);
  robot().set_image(image.c_str());
  return run_board<SimSections>(
      argc, argv, {board, robot(), sizeof(pil::PilHal), false, configure, nullptr, &robot()});
}

}  // namespace tactus
