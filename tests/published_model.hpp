// What other codes say of the robots at a few states: KDL 1.5.1, RBDL 3.3.1, MuJoCo 2.2.2, DART
// 6.12.1 and a computation in long double, which agree to 1e-13; printed to nine decimals.
#pragma once

#include "kernel/model/robot.hpp"

namespace tactus {

struct Fer;
struct Ur10;

template <int dof>
struct PublishedState {
  double q[dof], flange[3], g[dof];  // rad; m; N m
};

template <int dof>
struct PublishedInertia {
  double q[dof], diagonal[dof];  // rad; of M(q), kg m^2
};

template <int dof>
struct PublishedOrientation {
  double q[dof], r[3][3];  // rad; the flange's axes are the columns
};

template <class R>
struct Published;

inline constexpr double kPi = 3.14159265358979323846;

// clang-format off
template <>
struct Published<Fer> {  // inertias of Gaz et al., RA-L 2019
  static constexpr PublishedState<7> kStates[] = {
      {{0, 0, 0, 0, 0, 0, 0},
       {0.088, 0, 0.926},
       {0, -3.434431908, 0, -3.257223812, 0, 1.694216799, 0}},
      {{0, -kPi / 4, 0, -3 * kPi / 4, 0, kPi / 2, kPi / 4},
       {0.306890567, 0, 0.590282052},
       {0, -1.771375549, -0.644000320, 18.573590391, 0.633846185, 1.693684730, 0}},
      {{0, 1.2, 0, -0.8, 0, 2, 0.785},
       {0.795921192, 0, 0.178828478},
       {0, -49.911774899, 0.848886279, 19.103078580, 0.576381989, 1.693697451, 0}},
      {{1.2, -0.4, 0.9, -2.2, -0.7, 1.9, 0.4},
       {-0.229961942, 0.417649531, 0.508307849},
       {0, -4.417651148, -7.653185171, 18.126851123, 0.364091699, 0.849760292, 0.066090034}},
      {{-0.5, 0.3, -1.1, -2.8, 1.3, 0.6, -1},
       {0.113909260, -0.242127928, 0.272754829},
       {0, -13.885631930, -4.286601610, 8.162908066, 0.412329069, -1.522871901, -0.064970161}},
  };
  static constexpr PublishedInertia<7> kInertia = {
      {0, -kPi / 4, 0, -3 * kPi / 4, 0, kPi / 2, kPi / 4},
      {0.461178322, 1.444958892, 0.878925238, 0.788735575, 0.027854616, 0.032556770, 0.004909652}};
  // What Franka's drawing of the arm upright shows.
  static constexpr PublishedOrientation<7> kOrientation = {
      {0, 0, 0, 0, 0, 0, 0}, {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
};

template <>
struct Published<Ur10> {
  static constexpr PublishedState<6> kStates[] = {
      {{0, 0, 0, 0, 0, 0},
       {-1.184300000, -0.256141000, 0.011600000},
       {0, -119.172179205, -38.425873005, 0, 0, 0}},
      {{0, -kPi / 2, 0, -kPi / 2, 0, 0},
       {0, -0.256141000, 1.427300000},
       {0, 0, 0, 0, 0, 0}},
      {{0, -kPi / 2, kPi / 2, -kPi / 2, -kPi / 2, 0},
       {-0.688000000, -0.163941000, 0.647100000},
       {0, -41.326008210, -41.326008210, -2.900135205, 0, 0}},
      {{0.3, -0.4, 0.6, -0.5, -1.2, 0.1},
       {-0.970268018, -0.506715901, 0.115997901},
       {0, -112.363715784, -37.991442734, -0.331528877, 0.063200896, 0}},
      {{-1, -2, -1.5, 2.2, 1, -0.7},
       {0.175853386, -0.669500001, 0.526843506},
       {0, 66.659187236, 33.056867348, -2.927298392, 0.307265116, 0}},
  };
  static constexpr PublishedInertia<6> kInertia = {
      {0, -kPi / 2, kPi / 2, -kPi / 2, -kPi / 2, 0},
      {3.114397400, 7.196538507, 2.582995779, 0.036993039, 0.004877591, 0.000340000}};
  // The product of the manufacturer's DH matrices.
  static constexpr PublishedOrientation<6> kOrientation = {
      {0.3, -1.1, 1.4, -0.7, 0.9, -0.4},
      {{0.572133678, 0.645804028, -0.505569196},
       {-0.578241076, -0.119532466, -0.807062109},
       {-0.581635894, 0.754088288, 0.305041867}}};
};
// clang-format on

}  // namespace tactus
