// Headers that nearly every source includes, compiled once for each way of compiling. Every source
// names its own includes all the same: the checks read it without this file.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <variant>

#include <Eigen/Core>
#include <Eigen/Geometry>
