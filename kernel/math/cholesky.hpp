// Cholesky factorisation A = L D L^T of a small symmetric matrix that is positive definite, with
// ones on the diagonal of L: no square root, and no loop but of constant length.
#pragma once

#include <Eigen/Core>

namespace tactus {

template <int n>
class Cholesky {
 public:
  using Matrix = Eigen::Matrix<double, n, n>;
  using Vector = Eigen::Matrix<double, n, 1>;

  /// Factorises A + shift I. Reads the lower triangle of A; if that is not finite, no result is.
  /// [cyclic]
  void compute(const Matrix& A, double shift) {
#pragma GCC unroll 8
    for (int i = 0; i < n; ++i) {
#pragma GCC unroll 8
      for (int j = 0; j < i; ++j) {
        L_(i, j) = A(i, j);
#pragma GCC unroll 8
        for (int k = 0; k < j; ++k) L_(i, j) -= L_(i, k) * L_(j, k);
      }
      double d = A(i, i) + shift;
#pragma GCC unroll 8
      for (int j = 0; j < i; ++j) {  // until here L_(i, j) is an element of L D
        const double scaled = L_(i, j) * inverse_d_[j];
        d -= L_(i, j) * scaled;
        L_(i, j) = scaled;
      }
      inverse_d_[i] = 1.0 / d;
    }
  }

  /// Returns (A + shift I)^-1 b. [cyclic]
  Vector solve(const Vector& b) const {
    Vector x = b;
#pragma GCC unroll 8
    for (int i = 1; i < n; ++i) {
#pragma GCC unroll 8
      for (int j = 0; j < i; ++j) x[i] -= L_(i, j) * x[j];
    }
    x.array() *= inverse_d_.array();
#pragma GCC unroll 8
    for (int i = n - 1; i > 0; --i) {
#pragma GCC unroll 8
      for (int j = 0; j < i; ++j) x[j] -= L_(i, j) * x[i];
    }
    return x;
  }

  /// Returns the trace of (A + shift I)^-1: the sum of the squares of L^-1, row i divided by D_i.
  /// [cyclic]
  double trace_of_inverse() const {
    Matrix M;  // -L^-1 below the diagonal
    double trace = 0.0;
#pragma GCC unroll 8
    for (int i = 0; i < n; ++i) {
      double sum = 1.0;
#pragma GCC unroll 8
      for (int j = 0; j < i; ++j) {
        M(i, j) = L_(i, j);
#pragma GCC unroll 8
        for (int k = j + 1; k < i; ++k) M(i, j) -= L_(i, k) * M(k, j);
        sum += M(i, j) * M(i, j);
      }
      trace += sum * inverse_d_[i];
    }
    return trace;
  }

 private:
  Matrix L_;  // below the diagonal
  Vector inverse_d_;
};

}  // namespace tactus
