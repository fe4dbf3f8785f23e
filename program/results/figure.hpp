// The figure of a run, drawn by scripts/figure.
#pragma once

namespace tactus {

/// Draws `folder`/figure.png and .pdf. A figure that cannot be drawn is reported on the error
/// stream and fails nothing else.
void draw_figure(const char* folder);

}  // namespace tactus
