/* Rodas5P for M z' = f(t, z): states first, then algebraic unknowns (rows of M that are zero).

   The generated file has defined, before it includes this one:
     AC_N, AC_NX, AC_NZ (nonzeros of J), AC_NF (numbers of the factors), AC_NC, AC_NU, AC_NG, AC_NK, AC_NKZ,
     AC_NT with ac_points, ac_point_first, ac_point_x (tables over time),
     ac_constants, ac_field, ac_field_jacobian, ac_factor, ac_solve, ac_nominal, ac_row, ac_column,
     and for tangents ac_constants_tangent, ac_field_tangent, ac_jacobian_tangent, ac_solve_vector.
   AC_TANGENTS and AC_EXPLICIT ask for what takes a compiler long and few runs need: tangents, and explicit methods.

   Sources: Steinebach (2023), BIT Numerical Mathematics 63:27 (method); Hairer and Wanner, Solving Ordinary
   Differential Equations II, IV.7 (implementation) and IV.8 (step size); the tangents differentiate the step itself. */

enum { AC_RODAS5P, AC_RK4, AC_ADAMS };
enum { AC_DONE, AC_MAX_STEPS, AC_SMALLEST_STEP, AC_SINGULAR, AC_NO_MEMORY, AC_STOPPED, AC_EVENT };

typedef struct {
    double t0, t1, rtol, first_step, smallest;
    const double *atol;            /* (n) absolute */
    int method;                    /* AC_RODAS5P; with AC_EXPLICIT also AC_RK4 (fixed steps of first_step) and AC_ADAMS */
    long max_steps;
    const double *z0, *p;
    const ac_signal *signals;
    const int *const *index;
    const double *nominal;         /* (n), where the file does not have them */
    long n_save;
    const double *save;            /* output times, in the direction of the run */
    int n_directions;              /* of the tangents: at most AC_LANES */
    const double *dz0, *dp;        /* (n, AC_LANES), (n_p, AC_LANES) */
    double *z_out, *dz_out;        /* (n_save, n), (n_save, n, AC_LANES) */
    double *z_end, *dz_end;        /* (n), (n, AC_LANES): the last accepted point */
    double t_end;
    long steps, accepted, rejected, pivoted, saved;
    int (*watch)(double t);        /* called about once a second; not zero ends the run */
    long watched;                  /* second of the last call */
    int located;                   /* events end the run */
    int open;                      /* nothing is saved at t1 */
    double step;                   /* to go on with after t_end */
    double *noise;                 /* (AC_NR) values this small of a condition are rounding */
    int *switched;                 /* (AC_NR) conditions that have switched at t_end */
    long most_passed, passed;      /* events that only switch modes may be passed in the run; how many were */
    double *passed_t;              /* (most_passed) their times, */
    long *passed_saved;            /* (most_passed) what was saved before each, */
    int *passed_switched;          /* (most_passed, AC_NR) and the conditions that switched */
    double *largest;               /* (AC_NR) largest values of the conditions at events */
} ac_problem;

/* Whether the run is to end. */
static inline int ac_watched(ac_problem *q) {
    if (!q->watch) return 0;
    const long now = (long)time(NULL);
    if (now == q->watched) return 0;
    q->watched = now;
    return q->watch(q->t_end);
}

#if AC_NG > 0
typedef struct { /* of the normal equations of projection.h */
    double g[AC_NG], G[AC_NGZ + 1];
    double matrix[AC_NG][AC_NX], follow[AC_N - AC_NX + 1][AC_NX + 1];
    double normal[AC_NG * AC_NG], rhs[AC_NG], size[AC_NG];
    int pivot[AC_NG];
    double rr[(AC_N - AC_NX) * (AC_N - AC_NX) + 1];
    int rpivot[AC_N - AC_NX + 1];
} ac_projection;
#endif

#if defined(AC_FAMILIES) && AC_N > 500
#define AC_SPARSE_ONLY /* no room for dense factors with pivots, which are made where those of fixed order fail */
#endif

typedef struct {
    ac_model m;
    double c[AC_NC + 1], u[AC_NU + 1], du[AC_NU + 1];
    double p[AC_NP + 1], z[AC_N], z1[AC_N], f[AC_N], ft[AC_N], J[AC_NZ + 1], F[AC_NF + 1], k[8][AC_N], v[3][AC_N], y[AC_N];
    int pivoted;                   /* the factors are dense, with pivots */
#ifdef AC_FAMILIES
    double all[AC_NALL], all_a[AC_NALL], rates[AC_NP + 1], f_all[AC_N];
    ac_vector d_all[AC_NALL], d_inputs[AC_NP + 1], seed[AC_N], swept[AC_N];
#endif
#ifndef AC_SPARSE_ONLY
    int pivot[AC_N];
    double dense[AC_N * AC_N];
#endif
#if AC_NR > 0
    double g0[AC_NR], g1[AC_NR], g2[AC_NR], g3[AC_NR], slack[AC_NR], rate[AC_NR], scan[5][AC_NR];
    const double *noise;
    char candidate[AC_NR];
#endif
#if AC_ONLY_MODES
    double all[AC_NALL];
#endif
#if AC_NG > 0
    ac_projection projection;
#endif
} ac_work;

#ifdef AC_TANGENTS
typedef struct {
    ac_vector dc[AC_NC + 1], dz[AC_N], dz1[AC_N], dft[AC_N], dk[8][AC_N], dy[AC_N], dv[3][AC_N];
    double size[AC_LANES];
#ifdef AC_FAMILIES
    double all[AC_NALL];
    ac_vector d_all[AC_NALL], d_all_a[AC_NALL], second[AC_N];
#else
    ac_vector dJ[AC_NZ + 1];
#endif
} ac_tangent_work;
#endif

#ifdef AC_FAMILIES
static void ac_room(ac_model *m, ac_work *w, const double *p) {
    memcpy(w->p, p, sizeof(double) * AC_NP);
    m->p = w->p, m->v = w->all, m->va = w->all_a, m->pa = w->rates, m->f = w->f_all;
    m->dv = w->d_all, m->dpi = w->d_inputs, m->seed = w->seed, m->swept = w->swept;
}
#endif

/* Factors of W = d M - J; 0 if it could be factorised. */
static int ac_factorise(ac_work *w, double d) {
    w->pivoted = ac_factor(&w->m, d, w->J, w->F);
    if (!w->pivoted) return 0;
#ifdef AC_SPARSE_ONLY
    return 1;
#else
    memset(w->dense, 0, sizeof w->dense);
    for (int i = 0; i < AC_NX; i++) w->dense[i * AC_N + i] = d;
    for (int e = 0; e < AC_NZ; e++) w->dense[ac_row[e] * AC_N + ac_column[e]] -= w->J[e];
    for (int i = 0; i < AC_N; i++) { /* rows to size one in units of the nominal values */
        double big = 0.0;
        for (int j = 0; j < AC_N; j++) big = ac_max(big, fabs(w->dense[i * AC_N + j]) * ac_nominal[j]);
        w->F[i] = big > 0.0 ? 1.0 / big : 1.0;
        for (int j = 0; j < AC_N; j++) w->dense[i * AC_N + j] *= w->F[i] * ac_nominal[j];
    }
    return ac_dense_factor(AC_N, w->dense, w->pivot);
#endif
}

#ifdef AC_SPARSE_ONLY
#define AC_BACK(NAME, TYPE, FAST, DENSE) \
    static void NAME(const ac_work *w, TYPE *b) { FAST(&w->m, w->F, b); }
#else
#define AC_BACK(NAME, TYPE, FAST, DENSE)                              \
    static void NAME(const ac_work *w, TYPE *b) {                     \
        if (!w->pivoted) {                                            \
            FAST(&w->m, w->F, b);                                           \
            return;                                                   \
        }                                                             \
        for (int i = 0; i < AC_N; i++) b[i] *= w->F[i];               \
        DENSE(AC_N, w->dense, w->pivot, b);                           \
        for (int i = 0; i < AC_N; i++) b[i] *= ac_nominal[i];         \
    }
#endif
AC_BACK(ac_back, double, ac_solve, ac_dense_solve)

/* The smallest step at time t. */
static inline double ac_smallest_step(const ac_problem *q, double t) {
    return ac_max(1e-14 * fabs(t), 1e-10 * q->smallest);
}

/* Inputs and their rates at time t. */
static inline void ac_inputs(ac_work *w, double t) {
    for (int i = 0; i < AC_NU; i++) {
        const ac_signal *s = w->m.signals + i;
        w->u[i] = s->n == 1 ? s->v[0] : ac_table(s->n, s->t, s->v, t);
        w->du[i] = s->n == 1 ? 0.0 : ac_table_slope(s->n, s->t, s->v, t);
    }
}

/* The next of n increasing points: the first above `at`, or the last that is not; n or -1 where there is none. */
static inline int ac_next_point(const double *x, int n, double at, int upwards) {
    int lo = 0, hi = n;
    while (lo < hi) {
        const int mid = (lo + hi) / 2;
        if (x[mid] > at) hi = mid;
        else lo = mid + 1;
    }
    return upwards ? lo : lo - 1;
}

#if AC_NT > 0
/* Up to just before a table over time is read at its next point, from t on; from there to just behind, in a step of the
   size `least` or of that of rounding: within all other steps each table has one slope, also where a point moves with a
   parameter. If not `crossed`, up to just behind the point at once. */
static double ac_table_point(
    const double *x, int n, double at, double slope, double t, double direction, double least, int crossed) {
    const int k = ac_next_point(x, n, at, direction * slope > 0.0);
    if (k < 0 || k >= n || slope == 0.0) return direction * INFINITY;
    const double point = t + (x[k] - at) / slope, rounding = 1e-15 * (fabs(point) + fabs(at / slope));
    const double gap = direction * (point - t);
    if (crossed && gap - rounding > least) return point - direction * rounding;
    return t + direction * ac_max(least, gap + rounding);
}
#endif

/* Up to where inputs and tables over time are smooth, from t towards q->t1: they have a kink at each of their points. A
   step beyond one would pass over what happens there, as a pulse between two evaluations. Points of inputs that are nearer
   than `least` count as reached; those of tables are `crossed` in a step of that size. */
static double ac_smooth_until(const ac_problem *q, const ac_work *w, double t, double least, int crossed) {
    const double direction = q->t1 >= t ? 1.0 : -1.0;
    double to = q->t1;
    for (int i = 0; i < AC_NU; i++) {
        const ac_signal *s = w->m.signals + i;
        if (s->n == 1) continue;
        const int k = ac_next_point(s->t, s->n, t + direction * least, direction > 0.0);
        if (k >= 0 && k < s->n && direction * (to - s->t[k]) > 0.0) to = s->t[k];
    }
#if AC_NT > 0
    double at[AC_NT], slope[AC_NT];
    ac_points(&w->m, t, at, slope);
    for (int k = 0; k < AC_NT; k++) {
        const int first = ac_point_first[k], n = ac_point_first[k + 1] - first;
        const double point = ac_table_point(ac_point_x + first, n, at[k], slope[k], t, direction, least, crossed);
        if (direction * (to - point) > 0.0) to = point;
    }
#endif
    return to;
}

static inline void ac_value(ac_work *w, double t, const double *z, double *f) {
    ac_inputs(w, t);
    ac_field(&w->m, t, z, f);
}

/* The eight stages from (t, z), whose f, ft, J are there, with the factors of W; u_8 is the error estimate. */
static void ac_stages(ac_work *w, double t, double h) {
    const double inverse = 1.0 / h;
    for (int s = 0; s < 8; s++) {
        double *k = w->k[s];
        if (s == 0) {
            for (int i = 0; i < AC_N; i++) k[i] = w->f[i];
        } else {
            for (int i = 0; i < AC_N; i++) w->y[i] = w->z[i];
            for (int j = 0; j < s; j++) {
                const double a = ac_A[s][j];
                if (a != 0.0)
                    for (int i = 0; i < AC_N; i++) w->y[i] += a * w->k[j][i];
            }
            ac_value(w, t + ac_nodes[s] * h, w->y, k);
            for (int j = 0; j < s; j++) {
                const double c = ac_C[s][j] * inverse;
                for (int i = 0; i < AC_NX; i++) k[i] += c * w->k[j][i];
            }
        }
        const double d = ac_D[s] * h;
        if (d != 0.0)
            for (int i = 0; i < AC_N; i++) k[i] += d * w->ft[i];
        ac_back(w, k);
    }
}

/* z1 = z + sum of weights times stages. */
static void ac_combine(const ac_work *w, const double *weights, const double *base, double *out) {
    for (int i = 0; i < AC_N; i++) out[i] = base ? base[i] : 0.0;
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < AC_N; i++) out[i] += weights[j] * w->k[j][i];
}

#define AC_DENSE_OUTPUT(NAME, TYPE)                                                                             \
    static void NAME(                                                                                           \
        double s, const TYPE *y0, const TYPE *y1, const TYPE *a, const TYPE *b, const TYPE *c, TYPE *out) {     \
        for (int i = 0; i < AC_N; i++)                                                                          \
            out[i] = (1.0 - s) * y0[i] + s * (y1[i] + (1.0 - s) * (a[i] + s * (b[i] + s * c[i])));              \
    }
AC_DENSE_OUTPUT(ac_interpolate, double)

#if AC_NG > 0
#include "projection.h"
#endif
#include "conserved.h"
#include "events.h"
#if AC_ONLY_MODES
#include "modes.h"
#endif
#ifdef AC_TANGENTS
#include "tangent.h"
#endif
#include "stepping.h"
#include "integrate.h"
#ifdef AC_EXPLICIT
#include "explicit.h"

static int ac_explicit(ac_problem *q, ac_work *w) {
    ac_explicit_work *e = calloc(1, sizeof *e);
    if (!e) return AC_NO_MEMORY;
    const int result = q->method == AC_RK4 ? ac_fixed_steps(q, w, e) : ac_adams(q, w, e);
    free(e);
    return result;
}
#endif

/* To the end of the run or the first event. */
static int ac_stretch(ac_problem *q, ac_work *w, ac_control *k, void *tangents) {
#ifdef AC_EXPLICIT
    if (q->method != AC_RODAS5P) return ac_explicit(q, w);
#endif
    return ac_integrate(q, w, k, tangents);
}

AC_EXPORT long acausal_size(int which) {
    const long sizes[] = {AC_N, AC_NX, AC_NP, AC_NI, AC_NIZ, AC_NALL, AC_LANES, sizeof(ac_problem), AC_NR};
    return sizes[which];
}

#ifndef AC_FAMILIES
AC_EXPORT const int *acausal_start_pattern(int column) { return column ? ac_i_column : ac_i_row; }
#endif

AC_EXPORT int acausal_run(ac_problem *q) {
    ac_work *w = calloc(1, sizeof *w);
    void *tangents = NULL;
    if (!w) return AC_NO_MEMORY;
    memset(&w->m, 0, sizeof w->m);
    w->m.p = w->p, w->m.c = w->c, w->m.dp = (const ac_vector *)q->dp, w->m.signals = q->signals;
    w->m.u = w->u, w->m.du = w->du, w->m.index = q->index, w->m.nominal = q->nominal;
#ifdef AC_FAMILIES
    ac_room(&w->m, w, q->p);
#else
    memcpy(w->p, q->p, sizeof(double) * AC_NP);
#endif
    memcpy(w->z, q->z0, sizeof w->z);
    q->t_end = q->t0;
    q->watched = (long)time(NULL);
    ac_constants(q->p, w->c);
#ifdef AC_TANGENTS
    if (q->n_directions > 0) {
        ac_tangent_work *d = tangents = calloc(1, sizeof *d);
        if (!d) return free(w), AC_NO_MEMORY;
        ac_constants_tangent(q->p, w->m.dp, d->dc);
        w->m.dc = d->dc;
        memcpy(d->dz, q->dz0, sizeof d->dz);
    }
#endif
    ac_control k = ac_anew(q->first_step);
    int result = ac_stretch(q, w, &k, tangents);
#if AC_ONLY_MODES
    for (; result == AC_EVENT && ac_switch_modes(q, w); result = ac_stretch(q, w, &k, tangents))
        q->t0 = q->t_end, q->first_step = q->step;
#endif
    memcpy(q->z_end, w->z, sizeof w->z);
#ifdef AC_TANGENTS
    if (tangents) memcpy(q->dz_end, ((ac_tangent_work *)tangents)->dz, sizeof(ac_vector) * AC_N);
#endif
    free(tangents);
    free(w);
    return result;
}

#ifndef AC_FAMILIES
/* All parameters from those that are given: p holds defaults and given values on entry. */
AC_EXPORT void acausal_parameters(const unsigned char *given, double *p) { ac_parameters(given, p); }

/* Start values that depend on parameters. */
AC_EXPORT void acausal_starts(const double *p, double *s) { ac_starts(p, s); }

static void ac_held(ac_model *m, const double *p, double *c, double *u) {
    memset(m, 0, sizeof *m);
    for (int i = 0; i < AC_NU; i++) u[i] = p[AC_NPAR + i], u[AC_NU + i] = 0.0;
    ac_constants(p, c);
    m->p = p, m->c = c, m->u = u, m->du = u + AC_NU;
}

/* What must hold at the start, and its derivatives with respect to z; inputs as they are in p. */
AC_EXPORT void acausal_conditions(const double *p, double t, const double *z, double *g, double *G) {
    double c[AC_NC + 1], u[2 * AC_NU + 1];
    ac_model m;
    ac_held(&m, p, c, u);
    ac_conditions(&m, t, z, g, G);
}

#endif

/* The algebraic unknowns in z from the states in z, by Newton's method from what they are; 0 if it converged. */
AC_EXPORT int acausal_settle(
    const double *p, const ac_signal *signals, const int *const *index, const double *nominal, double t, double *z) {
    ac_work *w = calloc(1, sizeof *w);
    if (!w) return 1;
    w->m.p = p, w->m.c = w->c, w->m.u = w->u, w->m.du = w->du, w->m.signals = signals, w->m.index = index;
    w->m.nominal = nominal;
#ifdef AC_FAMILIES
    ac_room(&w->m, w, p);
#endif
    ac_constants(p, w->c);
    const int failed = ac_slope(w, t, z, w->f);
    free(w);
    return failed;
}

/* Every variable at n points; inputs follow their signals. 0, or 1 where there is no memory. */
AC_EXPORT int acausal_observe(
    const double *p, const ac_signal *signals, const int *const *index, long n, const double *t, const double *z,
    double *all) {
    ac_work *w = calloc(1, sizeof *w);
    if (!w) return 1;
    w->m.p = p, w->m.c = w->c, w->m.u = w->u, w->m.du = w->du, w->m.signals = signals, w->m.index = index;
#ifdef AC_FAMILIES
    ac_room(&w->m, w, p);
#endif
    ac_constants(p, w->c);
    for (long k = 0; k < n; k++) {
        ac_inputs(w, t[k]);
        ac_observe(&w->m, t[k], z + k * AC_N, all + k * AC_NALL);
    }
    free(w);
    return 0;
}

#if defined(AC_TANGENTS) && !defined(AC_FAMILIES)
AC_EXPORT void acausal_parameters_tangent(const unsigned char *given, const double *p, double *dp) {
    ac_parameters_tangent(given, p, (ac_vector *)dp);
}

AC_EXPORT void acausal_starts_tangent(const double *p, const double *dp, double *ds) {
    ac_starts_tangent(p, (const ac_vector *)dp, (ac_vector *)ds);
}

AC_EXPORT void acausal_conditions_tangent(
    const double *p, const double *dp, double t, const double *z, const double *dz, double *dg) {
    double c[AC_NC + 1], u[2 * AC_NU + 1];
    ac_vector dc[AC_NC + 1];
    ac_model m;
    ac_held(&m, p, c, u);
    ac_constants_tangent(p, (const ac_vector *)dp, dc);
    m.dp = (const ac_vector *)dp, m.dc = dc;
    ac_conditions_tangent(&m, t, z, (const ac_vector *)dz, (ac_vector *)dg);
}
#endif
