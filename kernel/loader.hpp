// Loader: from the text of a pipeline file to a pipeline. Reads once, top to bottom; a block sees
// only what stands above it, which gives the order of execution and forbids cycles. All or nothing:
// the first mistake refuses the file.
#pragma once

#include <array>
#include <string_view>

#include "kernel/pipeline.hpp"
#include "kernel/section_reader.hpp"

namespace tactus {

/// A section the board adds to the kernel's own, [plant] for example: its settings as a visitor
/// sees them.
struct BoardSection {
  std::string_view name;
  void* settings = nullptr;
  void (*read)(void* settings, SectionReader& reader) = nullptr;
  void (*find)(void* settings, KeyFinder& finder) = nullptr;
};

template <class Settings>
BoardSection board_section(std::string_view name, Settings& settings) {
  return {name, &settings,
          [](void* p, SectionReader& reader) { static_cast<Settings*>(p)->describe(reader); },
          [](void* p, KeyFinder& finder) { static_cast<Settings*>(p)->describe(finder); }};
}

class Loader {
 public:
  /// `channels` go to the generators of the pipeline; `offered` is what the robot and its wire can
  /// do. [init]
  Loader(const Channels& channels, const Capabilities& offered)
      : channels_(channels), offered_(offered) {}

  /// Makes a section of the board's known; at most four. [init]
  void add(const BoardSection& section);

  /// Fills a fresh `pipeline`. On refusal `error` says where and why and the pipeline must not be
  /// run. [init]
  Status load(std::string_view text, Pipeline& pipeline, LoadError& error);

 private:
  Status load_sections(const Ini& ini, Pipeline& pipeline, LoadError& error);
  Status load_section(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                      LoadError& error);
  Status load_block(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                    LoadError& error);
  Status load_command(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                      LoadError& error);
  Status check_robot(const Ini& ini, const IniSection& section, const RobotSection& robot,
                     LoadError& error) const;
  static Status check_workspace(const Ini& ini, const IniSection& section, const TaskLimits& limits,
                                LoadError& error);
  Status check_command(const Ini& ini, const IniSection& section, const Pipeline& pipeline,
                       LoadError& error) const;

  Channels channels_, left_;  // all, and those no generator has taken yet
  Capabilities offered_;
  std::array<BoardSection, 4> board_sections_;
  std::size_t board_section_count_ = 0;
};

}  // namespace tactus
