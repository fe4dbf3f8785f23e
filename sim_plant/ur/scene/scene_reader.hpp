// SceneReader: takes the surroundings of the arm from a pipeline file, by the kernel's own readers:
//
//   type = frame, type = box   the boxes, in the base frame
//   [robot]                    mounting; tool_mass, tool_com: the payload; tool_tip: the ball that
//                              touches
//   [plant], if there is one   mounting, payload, ball and material, as on a simulated board
//
// Everything else in the file is left to the program that runs it.
#pragma once

#include <array>
#include <string_view>

#include "kernel/guard/obstacle.hpp"
#include "kernel/load/section_reader.hpp"
#include "kernel/reference/blocks/frame.hpp"
#include "sim_plant/ur/motion/body.hpp"

namespace tactus::ur {

class SceneReader {
 public:
  /// Fills `around` from the text of a pipeline file. If it is refused, `error` says where and why.
  /// kNotOffered for a robot that is not this one, kTooLarge for more boxes than a scene has, and
  /// what the loader returns for a mistake in one of the sections above. [init]
  Status read(std::string_view text, Surroundings& around, LoadError& error);

 private:
  Status read_section(const IniSection& section, Surroundings& around, LoadError& error);
  Status read_robot(const IniSection& section, Surroundings& around, LoadError& error);
  Status read_plant(const IniSection& section, Surroundings& around, LoadError& error);
  Status read_frame(const IniSection& section, LoadError& error);
  Status read_box(const IniSection& section, Scene& scene, LoadError& error);
  template <class Block>
  Status read_block(const IniSection& section, Block& block, LoadError& error);

  Ini ini_;
  PortTable ports_;
  std::array<tactus::Frame, kMaxSections> frames_;  // their poses, which the boxes refer to
  std::size_t frame_count_ = 0;
};

}  // namespace tactus::ur
