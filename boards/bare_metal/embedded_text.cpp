#include "boards/bare_metal/embedded_text.hpp"

asm(".section .rodata\n.global pipeline_text, pipeline_text_end\n"
    "pipeline_text:\n.incbin \"" PIPELINE_FILE "\"\npipeline_text_end:\n.byte 0\n.text\n");
extern "C" const char pipeline_text[], pipeline_text_end[];

namespace bare {

std::string_view embedded_text() {
  return {pipeline_text, static_cast<std::size_t>(pipeline_text_end - pipeline_text)};
}

}  // namespace bare
