// Loader: builds a pipeline from the text of a pipeline file. It reads once, top to bottom; a block
// sees only the sections above it, which gives the order of execution and forbids cycles. All or
// nothing: the first mistake refuses the file.
#pragma once

#include <string_view>

#include "kernel/load/section_loader.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// The switches on which the memory of the kernel's types depends. It is an argument of
/// Loader::load(), so that a program for another robot, or with another number of targets, than the
/// library that it links with has no such function: the linker's message names both.
template <class OfRobot, int chunk_targets>
struct Layout {};
using OwnLayout = Layout<Robot, kChunkTargets>;

class Loader {
 public:
  /// `channels` go to the generators of the pipeline; `offered` is what the robot and its wire can
  /// do. [init]
  Loader(const Channels& channels, const Capabilities& offered)
      : channels_(channels), offered_(offered) {}
  /// Takes `sections` in addition to the pipeline's own, [plant] for example: those that the board
  /// lists in describe(visitor) by visitor.section(name, settings). [init]
  template <class Sections>
  Loader(const Channels& channels, const Capabilities& offered, Sections& sections)
      : channels_(channels), offered_(offered), sections_(&sections) {
    describe_ = [](void* p, SectionLoader& loader) { static_cast<Sections*>(p)->describe(loader); };
  }

  /// Fills a fresh `pipeline`. If the file is refused, `error` says where and why, and the pipeline
  /// must not be run. [init]
  Status load(std::string_view text, Pipeline& pipeline, LoadError& error, OwnLayout = {});

 private:
  Status load_sections(const Ini& ini, Pipeline& pipeline, LoadError& error);
  Status load_section(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                      LoadError& error);
  Status load_block(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                    LoadError& error);
  Status load_command(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                      LoadError& error);
  Status check_command(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                       LoadError& error) const;
  Status check_outputs(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                       LoadError& error) const;

  Channels channels_, left_;  // all channels, and those that no generator has taken
  Capabilities offered_;
  void* sections_ = nullptr;  // the board's, and how they are listed; none: it adds nothing
  void (*describe_)(void* sections, SectionLoader& loader) = [](void*, SectionLoader&) {};
};

}  // namespace tactus
