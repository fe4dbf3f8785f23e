// The rounding of times within a motion.
#pragma once

namespace tactus {

/// Times are sums of periods; a billionth of a second is far below any period and far above the
/// rounding of the sum.
inline constexpr double kTimeRounding_s = 1e-9;

}  // namespace tactus
