"""An extreme-value fit that reports when its result must not be used.

If values are independent and come from one distribution, the largest values of equal blocks follow a generalised
extreme-value law, whose quantiles extrapolate beyond the values seen.  [Coles, An Introduction to Statistical Modeling
of Extreme Values, 2001, ch. 3] The fit is by maximum likelihood, the intervals by parametric bootstrap. Its assumptions
are tested first, at the level of 5 %:

  independence  Ljung-Box on the maxima           [Ljung and Box, Biometrika 65, 1978]
  one law       Mann-Whitney, first against second half of the maxima
  tail          Anderson-Darling, its law found by bootstrap because the parameters are fitted
  shape         within 0.5 of zero, above with its whole interval: beyond, the variance is not finite and a level
                means nothing; below, the likelihood is not regular  [Smith, Biometrika 72, 1985]
"""

import dataclasses

import numpy
from scipy import optimize, stats

LEVEL = 0.05
LAGS = 10
HEAVIEST = 0.5
BOOTSTRAPS = 99
FEWEST_BLOCKS = 50
NAN = float("nan")


@dataclasses.dataclass
class Extremes:
    """`level`, with its interval, is exceeded with the given probability; `why` it must not be quoted, or ''."""

    level: float
    low: float
    high: float
    shape: float
    blocks: int
    independence_p: float
    one_law_p: float
    tail_p: float
    why: str

    def quote(self):
        if self.why:
            return f"not quoted: {self.why}"
        return f"{self.level:.4g} [{self.low:.4g}, {self.high:.4g}]"


def ljung_box(values, lags=LAGS):
    """Returns p of independence, from the first autocorrelations."""
    centred = values - values.mean()
    scale = (centred**2).sum()
    n = len(values)
    rho = numpy.array([(centred[k:] * centred[: n - k]).sum() / scale for k in range(1, lags + 1)])
    return float(stats.chi2.sf(n * (n + 2) * (rho**2 / (n - numpy.arange(1, lags + 1))).sum(), lags))


def fit(maxima):
    """Returns (shape, location, scale) of the greatest likelihood; a positive shape means a heavy tail."""
    spread = maxima.std()
    start = (0.1, maxima.mean() - 0.45 * spread, numpy.log(0.78 * spread))  # of a Gumbel law, by moments

    def cost(parameters):
        shape, location, log_scale = parameters
        y = (maxima - location) * numpy.exp(-log_scale)
        if abs(shape) > 1e-6:
            z = 1.0 + shape * y
            if z.min() <= 0.0:
                return 1e12  # outside the law's support
            y = numpy.log(z) / shape
        return len(maxima) * log_scale + ((1.0 + shape) * y + numpy.exp(-y)).sum()

    found = optimize.minimize(cost, start, method="Nelder-Mead", options={"maxiter": 600, "fatol": 1e-3, "xatol": 1e-4})
    return found.x[0], found.x[1], numpy.exp(found.x[2])


def law(parameters):
    shape, location, scale = parameters
    return stats.genextreme(-shape, location, scale)


def anderson_darling(maxima, parameters):
    """Returns A^2, the distance from a law with weighted tails."""
    u = numpy.clip(law(parameters).cdf(numpy.sort(maxima)), 1e-12, 1 - 1e-12)
    odd = 2 * numpy.arange(1, len(u) + 1) - 1
    return -len(u) - (odd * (numpy.log(u) + numpy.log1p(-u[::-1]))).mean()


def not_quoted(why, blocks, independence_p=NAN, one_law_p=NAN):
    return Extremes(NAN, NAN, NAN, NAN, blocks, independence_p, one_law_p, NAN, why)


def bootstrap(parameters, blocks, in_block, seed):
    """Returns distances, levels and shapes of fits to values drawn from the law itself."""
    rng = numpy.random.default_rng(seed)
    fits = []
    for _ in range(BOOTSTRAPS):
        again = law(parameters).rvs(blocks, random_state=rng)
        refitted = fit(again)
        fits.append((anderson_darling(again, refitted), law(refitted).isf(in_block), refitted[0]))
    return numpy.array(fits).T


def why_not(tail_p, shape, heaviest):
    """Returns the first assumption about the fit that fails, in words."""
    if tail_p < LEVEL:
        return f"tail does not fit (p = {tail_p:.2g})"
    if heaviest >= HEAVIEST:
        return f"tail too heavy (shape up to {heaviest:.2f})"
    return f"likelihood not regular (shape {shape:.2f})" if shape <= -HEAVIEST else ""


def extremes(values, block, exceedance, seed=1):
    """Tests the values and extrapolates the level that one of them exceeds with probability `exceedance`."""
    values = numpy.asarray(values, dtype=float)
    blocks = len(values) // block
    if blocks < FEWEST_BLOCKS:
        return not_quoted(f"{blocks} blocks of {block}, fewer than {FEWEST_BLOCKS}", blocks)
    maxima = values[: blocks * block].reshape(blocks, block).max(axis=1)
    if maxima.std() <= 1e-9 * abs(maxima.mean()):
        return not_quoted("all maxima are the same", blocks)
    independence_p = ljung_box(maxima)
    one_law_p = float(stats.mannwhitneyu(maxima[: blocks // 2], maxima[blocks // 2 :]).pvalue)
    if independence_p < LEVEL:
        return not_quoted(f"maxima not independent (p = {independence_p:.2g})", blocks, independence_p, one_law_p)
    if one_law_p < LEVEL:
        return not_quoted(f"not of one law (p = {one_law_p:.2g})", blocks, independence_p, one_law_p)
    centre, unit = maxima.mean(), maxima.std()
    maxima = (maxima - centre) / unit
    in_block = -numpy.expm1(block * numpy.log1p(-exceedance))  # probability that a maximum exceeds it
    parameters = fit(maxima)
    distances, levels, shapes = bootstrap(parameters, blocks, in_block, seed)
    tail_p = (1 + (distances >= anderson_darling(maxima, parameters)).sum()) / (1 + BOOTSTRAPS)
    ends = [law(parameters).isf(in_block), *numpy.percentile(levels, [2.5, 97.5])]
    shape = float(parameters[0])
    why = why_not(tail_p, shape, numpy.percentile(shapes, 97.5))
    scaled = [float(centre + unit * each) for each in ends]
    return Extremes(*scaled, shape, blocks, independence_p, one_law_p, float(tail_p), why)
