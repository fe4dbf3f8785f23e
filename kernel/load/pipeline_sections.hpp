// PipelineSections: the SectionLoader of the pipeline's own sections, which looks at some of them
// as a whole as soon as they have been read.
#pragma once

#include "kernel/load/section_loader.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

class PipelineSections : public SectionLoader {
 public:
  PipelineSections(const Ini& ini, const IniSection& section, PortTable& ports, LoadError& error,
                   const Capabilities& offered)
      : SectionLoader(ini, section, ports, error), offered_(offered) {}

  using SectionLoader::section;
  void section(const char* name, RobotSection& robot);
  void section(const char* name, TaskLimits& limits);

 private:
  void check_robot(const RobotSection& robot);
  void check_workspace(const TaskLimits& limits);
  void refuse(Status status, const char* key, std::string_view reason);

  const Capabilities& offered_;
};

}  // namespace tactus
