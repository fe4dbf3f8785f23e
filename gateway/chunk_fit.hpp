// The curve of a chunk: a natural cubic spline through its targets, or one that smooths them, in
// the chart of the target in the middle. Runs outside the cycle.
//
// With spacings h, targets y and second derivatives g at the inner knots, the spline that minimizes
// the sum of (y - f)^2 plus L times the integral of f''^2 is
//   (R + L Q^T Q) g = Q^T y,   f = y - L Q g
// with the tridiagonal R and Q of the spacings; L = 0 interpolates.
// [Reinsch, Smoothing by spline functions, Numerische Mathematik 10, 1967; Green and Silverman,
// Nonparametric regression and generalized linear models, 1994, section 2.3]
#pragma once

#include "gateway/chunk.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/reference/motion/admission_settings.hpp"

namespace tactus {

/// Judges a chunk: number, numbers and times of the targets, positions, given velocities, and the
/// mean velocities between targets, which may be up to four times the limit. [any, not cyclic]
template <class Space>
Verdict judge_chunk(const Chunk<Space>& chunk, const AdmissionSettings<Space>& settings);

/// Writes the curve of a chunk that was judged and is not relative. [any, not cyclic]
template <class Space>
void fit_chunk(const Chunk<Space>& chunk, const AdmissionSettings<Space>& settings,
               ChunkCurve<Space>& curve);

}  // namespace tactus
