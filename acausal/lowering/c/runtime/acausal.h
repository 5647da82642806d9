/* Runtime of generated models: types, small functions, dense linear algebra.

   A generated file defines the sizes and includes this header, then the equations, then solver.h. Nothing here
   allocates memory or keeps state between calls. */
#ifndef ACAUSAL_H
#define ACAUSAL_H
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifndef AC_LANES
#define AC_LANES 4 /* directions that one sweep of tangents carries */
#endif
typedef double ac_vector __attribute__((vector_size(8 * AC_LANES), aligned(8)));
static const ac_vector ac_zero = {0.0};

/* A pivot this small beside its row is not trusted: a solution with it loses as many digits, and the error of a step is told
   from what is left. Large systems have no factors with pivots to fall back on (AC_SPARSE_ONLY). */
#if defined(AC_FAMILIES) && AC_N > 500
#define AC_PIVOT 1e-12
#else
#define AC_PIVOT 1e-8
#endif
#ifndef AC_EXPORT
#define AC_EXPORT __attribute__((visibility("default")))
#endif
#define AC_UNUSED __attribute__((unused))

static inline AC_UNUSED double ac_min(double a, double b) { return a <= b ? a : b; }
static inline AC_UNUSED double ac_max(double a, double b) { return a >= b ? a : b; }
/* The larger of both; what is not a number stays. */
static inline AC_UNUSED double ac_worse(double worst, double x) { return x <= worst || worst != worst ? worst : x; }
static inline AC_UNUSED double ac_clip(double x, double lo, double hi) { return x < lo ? lo : x > hi ? hi : x; }
static inline AC_UNUSED double ac_sign(double x) { return (x > 0.0) - (x < 0.0); }
static inline AC_UNUSED double ac_mod(double a, double b) { return a - b * floor(a / b); }

/* Last k with x[k] <= at, 0 <= k <= n - 2; x increases. */
static inline AC_UNUSED int ac_interval(int n, const double *x, double at) {
    int lo = 0, hi = n - 1;
    while (hi - lo > 1) {
        const int mid = (lo + hi) / 2;
        if (x[mid] <= at) lo = mid;
        else hi = mid;
    }
    return lo;
}

/* Piecewise linear interpolation, constant outside. */
static AC_UNUSED double ac_table(int n, const double *x, const double *y, double at) {
    if (!(at > x[0])) return at == at ? y[0] : at;
    if (at >= x[n - 1]) return y[n - 1];
    const int k = ac_interval(n, x, at);
    return y[k] + (y[k + 1] - y[k]) / (x[k + 1] - x[k]) * (at - x[k]);
}

static AC_UNUSED double ac_table_slope(int n, const double *x, const double *y, double at) {
    if (at < x[0] || at >= x[n - 1]) return 0.0;
    const int k = ac_interval(n, x, at);
    return (y[k + 1] - y[k]) / (x[k + 1] - x[k]);
}

/* LU factors of the row-major matrix a (m, m), in place; 0, or 1 if it is singular. Pivots are those entries that are the
   largest parts of the sums of their rows: of x = 1e-11 y and 3 x + y = 1 the first row gives x, and the small difference
   is kept. Higham (2002), Accuracy and Stability of Numerical Algorithms, 9.8. */
static AC_UNUSED int ac_dense_factor(int m, double *a, int *pivot) {
    int bad = 0;
    double scale[m > 0 ? m : 1];
    for (int i = 0; i < m; i++) {
        double sum = 0.0;
        for (int j = 0; j < m; j++) sum += fabs(a[i * m + j]);
        scale[i] = sum > 0.0 ? 1.0 / sum : 1.0;
    }
    for (int k = 0; k < m; k++) {
        int best = k;
        for (int i = k + 1; i < m; i++)
            if (fabs(a[i * m + k]) * scale[i] > fabs(a[best * m + k]) * scale[best]) best = i;
        pivot[k] = best;
        scale[best] = scale[k];
        if (best != k)
            for (int j = 0; j < m; j++) {
                const double swap = a[k * m + j];
                a[k * m + j] = a[best * m + j];
                a[best * m + j] = swap;
            }
        bad |= !(fabs(a[k * m + k]) > 0.0);
        const double inverse = 1.0 / a[k * m + k];
        for (int i = k + 1; i < m; i++) {
            const double factor = a[i * m + k] *= inverse;
            if (factor != 0.0)
                for (int j = k + 1; j < m; j++) a[i * m + j] -= factor * a[k * m + j];
        }
    }
    return bad;
}

#define AC_DENSE_SOLVE(NAME, TYPE)                                                       \
    static AC_UNUSED void NAME(int m, const double *a, const int *pivot, TYPE *b) {      \
        for (int k = 0; k < m; k++) {                                                    \
            const TYPE swap = b[k];                                                      \
            b[k] = b[pivot[k]];                                                          \
            b[pivot[k]] = swap;                                                          \
        }                                                                                \
        for (int i = 1; i < m; i++)                                                      \
            for (int j = 0; j < i; j++) b[i] -= a[i * m + j] * b[j];                     \
        for (int i = m - 1; i >= 0; i--) {                                               \
            for (int j = i + 1; j < m; j++) b[i] -= a[i * m + j] * b[j];                 \
            b[i] /= a[i * m + i];                                                        \
        }                                                                                \
    }
AC_DENSE_SOLVE(ac_dense_solve, double)
AC_DENSE_SOLVE(ac_dense_solve_vector, ac_vector)

/* The same with a step of refinement, from the matrix a and its factors: as accurate as if its entries were known to
   rounding, each of them, where rows and unknowns have unlike sizes. Skeel (1980), Iterative refinement implies numerical
   stability for Gaussian elimination, Math. Comp. 35. */
static AC_UNUSED void ac_dense_solve_refined(int m, const double *a, const double *factors, const int *pivot, double *b) {
    double left[m > 0 ? m : 1];
    memcpy(left, b, sizeof(double) * m);
    ac_dense_solve(m, factors, pivot, b);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) left[i] -= a[i * m + j] * b[j];
    ac_dense_solve(m, factors, pivot, left);
    for (int i = 0; i < m; i++) b[i] += left[i];
}

/* A signal over time: n points, interpolated linearly; n == 1 is a constant. */
typedef struct {
    int n;
    const double *t, *v;
} ac_signal;

/* What the equations of a model are evaluated with. */
typedef struct {
    const double *p;          /* parameters, the inputs in their places after them */
    const double *c;          /* expressions of parameters */
    const ac_vector *dp, *dc; /* tangents of both */
    const ac_signal *signals; /* inputs */
    double *u, *du;           /* inputs and their rates at the time of the call */
    const int *const *index;  /* index rows of families */
    const double *nominal;
#ifdef AC_FAMILIES            /* room for all variables, their derivatives along one direction, and tangents of both */
    double *v, *va, *pa, *f;
    ac_vector *dv, *dva, *dpi, *seed, *swept;
#endif
} ac_model;

#ifdef AC_FAMILIES
/* Inputs into their places among the parameters, and their rates. */
static inline void ac_feed(const ac_model *m) {
    for (int i = 0; i < AC_NU; i++) ((double *)m->p)[AC_NPAR + i] = m->u[i], m->pa[AC_NPAR + i] = m->du[i];
}

static inline void ac_feed_rates(const ac_model *m, ac_vector dt) {
    for (int i = 0; i < AC_NU; i++) m->dpi[AC_NPAR + i] = m->du[i] * dt;
}
#endif
#endif
