// The pipeline file PIPELINE_FILE, as it was at build time.
#pragma once

#include <cstddef>
#include <string_view>

asm(".section .rodata\n.global pipeline_text, pipeline_text_end\n"
    "pipeline_text:\n.incbin \"" PIPELINE_FILE "\"\npipeline_text_end:\n.byte 0\n.text\n");
extern "C" const char pipeline_text[], pipeline_text_end[];

inline std::string_view pipeline_file() {
  return {pipeline_text, static_cast<std::size_t>(pipeline_text_end - pipeline_text)};
}
