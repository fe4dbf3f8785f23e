#include "kernel/reference/translation_bounds.hpp"

namespace tactus {
namespace {

/// The larger of two; NaN if either is.
double larger(double a, double b) {
  return a > b ? a : b >= a ? b : a + b;
}

/// Lengths of the first four derivatives.
struct Lengths {
  double v, a, j, snap;
};

/// p and its derivatives, by number.
using Derivatives = std::array<VectorPolynomial, Polynomial::kOrder + 1>;

Lengths lengths_at(const Derivatives& p, double t) {
  return {p[1].at(t).norm(), p[2].at(t).norm(), p[3].at(t).norm(), p[4].at(t).norm()};
}

/// Between two times h apart a function f of time stays within h^2/8 max |f''| of its chord, and
/// the chord's length is largest at an end, hence
///   |f| <= max(|f| at the ends) + h^2/8 max |f''|.
/// From the constant fifth derivative of p this bounds the third, from the fourth, which is linear
/// in time, the second, and from the third the first.
Lengths bounds_between(const Lengths& x, const Lengths& y, double fifth, double h) {
  const double k = h * h / 8.0;
  Lengths most;
  most.snap = larger(x.snap, y.snap);
  most.j = larger(x.j, y.j) + k * fifth;
  most.a = larger(x.a, y.a) + k * most.snap;
  most.v = larger(x.v, y.v) + k * most.j;
  return most;
}

}  // namespace

TranslationBounds translation_bounds(const VectorPolynomial& path, double T) {
  constexpr int kPieces = 32;
  Derivatives p;
  p[0] = path;
  for (std::size_t i = 1; i < p.size(); ++i) p[i] = p[i - 1].derivative();
  const double fifth = p[5].at(0.0).norm(), h = T / kPieces;
  Lengths last = lengths_at(p, 0.0);
  TranslationBounds most = {last.v, last.a, last.j};
  for (int i = 1; i <= kPieces; ++i) {
    const Lengths next = lengths_at(p, h * i);
    const Lengths between = bounds_between(last, next, fifth, h);
    most = {larger(most.v, between.v), larger(most.a, between.a), larger(most.j, between.j)};
    last = next;
  }
  return most;
}

}  // namespace tactus
