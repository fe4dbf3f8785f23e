#include "gateway/page/page_files.hpp"

#include <array>

// The assembler copies a file to its place; gateway.mk names the files as what this one depends on.
#define PAGE_FILE(name, file)                                                          \
  asm(".pushsection .rodata\n.global page_" #name "\npage_" #name                      \
      ":\n"                                                                            \
      ".incbin \"gateway/page/web/" file "\"\n.global page_" #name "_end\npage_" #name \
      "_end:\n.byte 0\n.popsection\n");                                                \
  extern "C" const char page_##name[], page_##name##_end[];

PAGE_FILE(html, "page.html")
PAGE_FILE(css, "page.css")
PAGE_FILE(main, "main.js")
PAGE_FILE(link, "link.js")
PAGE_FILE(arm, "arm.js")
PAGE_FILE(kinematics, "kinematics.js")
PAGE_FILE(plots, "plots.js")
PAGE_FILE(wires, "wires.js")
PAGE_FILE(panel, "panel.js")

#undef PAGE_FILE

namespace tactus {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

constexpr const char* kScript = "text/javascript; charset=utf-8";

}  // namespace

const PageFile* page_file(std::string_view path) {
  static const std::array<PageFile, 9> files = {{
      {"/", "text/html; charset=utf-8", between(page_html, page_html_end)},
      {"/page.css", "text/css; charset=utf-8", between(page_css, page_css_end)},
      {"/main.js", kScript, between(page_main, page_main_end)},
      {"/link.js", kScript, between(page_link, page_link_end)},
      {"/arm.js", kScript, between(page_arm, page_arm_end)},
      {"/kinematics.js", kScript, between(page_kinematics, page_kinematics_end)},
      {"/plots.js", kScript, between(page_plots, page_plots_end)},
      {"/wires.js", kScript, between(page_wires, page_wires_end)},
      {"/panel.js", kScript, between(page_panel, page_panel_end)},
  }};
  for (const PageFile& file : files)
    if (file.path == path) return &file;
  return nullptr;
}

}  // namespace tactus
