#include "kernel/reference/space/vector_bounds.hpp"

#include "kernel/math/so3.hpp"

namespace tactus {
namespace {

constexpr int kClosePieces = 16, kFinePieces = 32;

/// The larger of two numbers; NaN if either is.
double larger(double a, double b) {
  return a > b ? a : b >= a ? b : a + b;
}
double smaller(double a, double b) {
  return a < b ? a : b <= a ? b : a + b;
}

/// Lengths of the first five derivatives of a path, at one time or as bounds between two.
struct Lengths {
  double v, a, j, snap, fifth;
};

Lengths lengths_at(const VectorPolynomial& here) {
  const auto& c = here.c;
  return {c[1].norm(), 2.0 * c[2].norm(), 6.0 * c[3].norm(), 24.0 * c[4].norm(),
          120.0 * c[5].norm()};
}

/// Between two times h apart a function f of time differs from its chord by at most k max |f''|
/// with k = h^2/8, and the chord's length is largest at an end, hence
///   |f| <= max(|f| at the ends) + k max |f''|.                                                (1)
/// The fifth derivative is constant, the fourth linear in time.
Lengths lengths_between(const Lengths& x, const Lengths& y, double k) {
  Lengths most;
  most.fifth = x.fifth;
  most.snap = larger(x.snap, y.snap);
  most.j = larger(x.j, y.j) + k * most.fifth;
  most.a = larger(x.a, y.a) + k * most.snap;
  most.v = larger(x.v, y.v) + k * most.j;
  return most;
}

/// Lengths of the derivatives of a rotation vector, and of the motion that it describes.
struct Turning {
  Lengths phi;
  VectorBounds motion;
};

Turning turning_at(const VectorPolynomial& here) {
  const TurningRates rates = turning_rates(here);
  return {lengths_at(here), {rates.w.norm(), rates.alpha.norm(), rates.jerk.norm()}};
}

// In axes that do not turn, those of the start, the motion is w = J phi' and its derivatives, with
// the left Jacobian J(phi) = J_r(-phi) = integral over u in [0, 1] of exp(u [phi]x) du. The n-th
// derivative of exp at a skew matrix in directions H_1 ... H_n is a mean of products of rotations
// and of the H_i, so its norm is at most the product of the |H_i|. Along phi(t), by the chain rule
// and with the factors u^n integrated,
//   |J| <= 1,  |J'| <= V/2,  |J''| <= A/2 + V^2/3,  |J'''| <= P/2 + V A + V^3/4,
//   |J''''| <= S/2 + 4/3 V P + A^2 + 3/2 V^2 A + V^4/5
// for lengths V, A, P, S, F of the derivatives of phi. Therefore, by Leibniz' rule for J phi',
//   |w| <= V,  |w'| <= A + V^2/2,  |w''| <= P + 3/2 V A + V^3/3,                                (2)
//   |w'''| <= S + 2 V P + 3/2 A^2 + 2 V^2 A + V^4/4,
//   |w''''| <= F + 5/2 V S + 5 A P + 10/3 V^2 P + 5 V A^2 + 5/2 V^3 A + V^5/5,
// of which (1) uses |w''|, |w'''| and |w''''| for w, alpha = w' and the jerk w''. The smaller of
// the bounds (1) and (2) is returned.
VectorBounds turning_of(const Lengths& phi) {
  const double v = phi.v;
  return {v, phi.a + 0.5 * v * v, phi.j + 1.5 * v * phi.a + v * v * v / 3.0};
}

VectorBounds turning_between(const Turning& x, const Turning& y, double k) {
  const Lengths m = lengths_between(x.phi, y.phi, k);
  const VectorBounds outer = turning_of(m);
  const double v = m.v, a = m.a, p = m.j, s = m.snap, vv = v * v;
  const double w3 = s + 2.0 * v * p + 1.5 * a * a + 2.0 * vv * a + 0.25 * vv * vv;
  const double w4 = m.fifth + 2.5 * v * s + 5.0 * a * p + 10.0 / 3.0 * vv * p + 5.0 * v * a * a +
                    2.5 * vv * v * a + 0.2 * vv * vv * v;
  return {smaller(outer.v, larger(x.motion.v, y.motion.v) + k * outer.j),
          smaller(outer.a, larger(x.motion.a, y.motion.a) + k * w3),
          smaller(outer.j, larger(x.motion.j, y.motion.j) + k * w4)};
}

/// Returns the largest bounds of all pieces. `at` samples a path at its beginning, `between` turns
/// two samples into bounds for the piece between them.
template <int pieces, class At, class Between>
VectorBounds largest(const VectorPolynomial& path, double T, At at, Between between) {
  const double h = T / pieces;
  auto last = at(path);
  VectorBounds most = {0.0, 0.0, 0.0};
  for (int i = 1; i <= pieces; ++i) {
    const auto next = at(path.from(h * i));
    const VectorBounds piece = between(last, next, h * h / 8.0);
    most = {larger(most.v, piece.v), larger(most.a, piece.a), larger(most.j, piece.j)};
    last = next;
  }
  return most;
}

}  // namespace

/// The axes turn with the body, which adds w x w = 0 to the derivative of w, and w x alpha to that
/// of alpha.
TurningRates turning_rates(const VectorPolynomial& phi) {
  const auto r = RightJacobian(phi.c[0]).rates(phi.c[1], 2.0 * phi.c[2], 6.0 * phi.c[3]);
  return {r.w, r.dw, r.ddw + r.w.cross(r.dw)};
}

VectorBounds translation_bounds(const VectorPolynomial& p, double T, Accuracy accuracy) {
  const auto between = [](const Lengths& x, const Lengths& y, double k) {
    const Lengths most = lengths_between(x, y, k);
    return VectorBounds{most.v, most.a, most.j};
  };
  return accuracy == Accuracy::kFine ? largest<kFinePieces>(p, T, lengths_at, between)
                                     : largest<kClosePieces>(p, T, lengths_at, between);
}

VectorBounds rotation_bounds(const VectorPolynomial& phi, double T, Accuracy accuracy) {
  if (accuracy == Accuracy::kFine) return largest<kFinePieces>(phi, T, turning_at, turning_between);
  if (accuracy == Accuracy::kClose)
    return largest<kClosePieces>(phi, T, turning_at, turning_between);
  return largest<kClosePieces>(phi, T, lengths_at,
                               [](const Lengths& x, const Lengths& y, double k) {
                                 return turning_of(lengths_between(x, y, k));
                               });
}

}  // namespace tactus
