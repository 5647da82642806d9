/* Rodas5P for M z' = f(t, z): states first, then algebraic unknowns (rows of M that are zero).

   The generated file has defined, before it includes this one:
     AC_N, AC_NX, AC_NZ (nonzeros of J), AC_NF (numbers of the factors), AC_NC, AC_NU, AC_NG, AC_NK, AC_NKZ,
     ac_constants, ac_field, ac_field_jacobian, ac_factor, ac_solve, ac_nominal, ac_row, ac_column,
     and for tangents ac_constants_tangent, ac_field_tangent, ac_jacobian_tangent, ac_solve_vector.

   Sources: Steinebach (2023), BIT Numerical Mathematics 63:27 (method); Hairer and Wanner, Solving Ordinary
   Differential Equations II, IV.7 (implementation) and IV.8 (step size); the tangents differentiate the step itself. */

enum { AC_RODAS5P, AC_RK4, AC_ADAMS };
enum { AC_DONE, AC_MAX_STEPS, AC_SMALLEST_STEP, AC_SINGULAR, AC_NO_MEMORY, AC_STOPPED, AC_EVENT };

typedef struct {
    double t0, t1, rtol, first_step, smallest;
    const double *atol;            /* (n) absolute */
    int method;                    /* AC_RODAS5P, AC_RK4 (fixed steps of first_step), AC_ADAMS */
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
        w->y[i] = big > 0.0 ? 1.0 / big : 1.0;
        for (int j = 0; j < AC_N; j++) w->dense[i * AC_N + j] *= w->y[i] * ac_nominal[j];
        w->F[i] = w->y[i];
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

/* Inputs and their rates at time t. */
static inline void ac_inputs(ac_work *w, double t) {
    for (int i = 0; i < AC_NU; i++) {
        const ac_signal *s = w->m.signals + i;
        w->u[i] = s->n == 1 ? s->v[0] : ac_table(s->n, s->t, s->v, t);
        w->du[i] = s->n == 1 ? 0.0 : ac_table_slope(s->n, s->t, s->v, t);
    }
}

static inline void ac_value(ac_work *w, double t, const double *z, double *f) {
    ac_inputs(w, t);
    ac_field(&w->m, t, z, f);
}

/* Whether the determinant of the factors is negative, but for the order of the rows. */
static int ac_negative(const ac_work *w) {
    int odd = 0;
    for (int i = 0; i < AC_N; i++) odd ^= w->F[AC_NF - AC_N + i] < 0.0;
    return odd;
}

/* Whether a mode grows faster than a step of the size in d can follow. Such a step would damp it: beyond its pole at
   h lambda = 1 / gamma an implicit method takes growth for decay, and a solution stays at an equilibrium that it has to
   leave. The determinant of d M - J has changed its sign then, compared with that for a large d; `reference` is the sign
   there, which is looked at again before anything is said. Modes in pairs are not seen.
   Hairer and Wanner, Solving Ordinary Differential Equations II, IV.2 (poles of the stability function). */
static int ac_outrun(ac_work *w, double d, int *reference) {
    if (w->pivoted || ac_negative(w) == *reference) return 0;
    if (!ac_factorise(w, copysign(1e30, d)) && !w->pivoted) *reference = ac_negative(w);
    return !ac_factorise(w, d) && !w->pivoted && ac_negative(w) != *reference;
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

/* Largest error of a step in units of the tolerance, of the first n unknowns. */
static double ac_error(const ac_problem *q, const ac_work *w, int n) {
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        const double scale = q->atol[i] + q->rtol * ac_max(fabs(w->z[i]), fabs(w->z1[i]));
        const double e = fabs(w->k[7][i]) / scale;
        if (!(e <= worst)) worst = e; /* keeps what is not a number */
    }
    return worst;
}

/* Whether a smallest step may be taken in spite of its error: it crosses a jump of the right-hand side or of algebraic
   unknowns. States are continuous; where they jump, the solution has ended. */
#define AC_JUMP 1e3
static int ac_jumped(const ac_problem *q, const ac_work *w) { return ac_error(q, w, AC_NX) <= AC_JUMP; }

#define AC_DENSE_OUTPUT(NAME, TYPE)                                                                             \
    static void NAME(double s, const TYPE *y0, const TYPE *y1, TYPE (*v)[AC_N], TYPE *out) {                    \
        for (int i = 0; i < AC_N; i++)                                                                          \
            out[i] = (1.0 - s) * y0[i] + s * (y1[i] + (1.0 - s) * (v[0][i] + s * (v[1][i] + s * v[2][i])));     \
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
AC_DENSE_OUTPUT(ac_interpolate_vector, ac_vector)
AC_BACK(ac_back_vector, ac_vector, ac_solve_vector, ac_dense_solve_vector)

/* Tangents of the accepted step: each stage differentiated, W du = d(right-hand side) + dJ u. */
static void ac_step_tangent(ac_work *w, ac_tangent_work *d, double t, double h) {
    const double inverse = 1.0 / h;
    ac_inputs(w, t);
#ifdef AC_FAMILIES
    ac_model base = w->m; /* all variables at the start of the step, and their tangents */
    base.v = d->all, base.dv = d->d_all, base.dva = d->d_all_a;
    ac_field(&base, t, w->z, w->y);
    ac_along(&base, t, ac_zero, d->dz, d->dy);
    memset(w->y, 0, sizeof w->y);
    ac_second(&base, t, 1.0, w->y, d->dz, d->dft);
#else
    ac_jacobian_tangent(&w->m, t, w->z, d->dz, d->dJ, d->dft);
#endif
    for (int s = 0; s < 8; s++) {
        ac_vector *k = d->dk[s];
        for (int i = 0; i < AC_N; i++) w->y[i] = w->z[i], d->dy[i] = d->dz[i];
        for (int j = 0; j < s; j++) {
            const double a = ac_A[s][j];
            if (a != 0.0)
                for (int i = 0; i < AC_N; i++) w->y[i] += a * w->k[j][i], d->dy[i] += a * d->dk[j][i];
        }
        const double at = t + ac_nodes[s] * h;
        ac_inputs(w, at);
        ac_field_tangent(&w->m, at, w->y, d->dy, k);
        for (int j = 0; j < s; j++) {
            const double c = ac_C[s][j] * inverse;
            for (int i = 0; i < AC_NX; i++) k[i] += c * d->dk[j][i];
        }
        const double weight = ac_D[s] * h;
        if (weight != 0.0)
            for (int i = 0; i < AC_N; i++) k[i] += weight * d->dft[i];
#ifdef AC_FAMILIES
        ac_inputs(w, t);
        ac_second(&base, t, 0.0, w->k[s], d->dz, d->second);
        for (int i = 0; i < AC_N; i++) k[i] += d->second[i];
#else
        for (int e = 0; e < AC_NZ; e++) k[ac_row[e]] += w->k[s][ac_column[e]] * d->dJ[e];
#endif
        ac_back_vector(w, k);
    }
    for (int i = 0; i < AC_N; i++) d->dz1[i] = d->dz[i];
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < AC_N; i++) d->dz1[i] += ac_B[j] * d->dk[j][i];
    for (int r = 0; r < 3; r++)
        for (int i = 0; i < AC_N; i++) {
            d->dv[r][i] = ac_zero;
            for (int j = 0; j < 8; j++) d->dv[r][i] += ac_H[r][j] * d->dk[j][i];
        }
}
#endif

/* A first step: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4, for the states. */
static double ac_first_step(const ac_problem *q, ac_work *w, double direction) {
    double d0 = 0.0, d1 = 0.0, d2 = 0.0;
    const double span = fabs(q->t1 - q->t0);
    for (int i = 0; i < AC_NX; i++) {
        const double scale = q->atol[i] + q->rtol * fabs(w->z[i]);
        d0 = ac_max(d0, fabs(w->z[i]) / scale);
        d1 = ac_max(d1, fabs(w->f[i]) / scale);
    }
    double h = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 * span : 0.01 * d0 / d1;
    h = ac_min(h, span);
    for (int i = 0; i < AC_N; i++) w->y[i] = w->z[i] + (i < AC_NX ? direction * h * w->f[i] : 0.0);
    ac_value(w, q->t0 + direction * h, w->y, w->k[0]);
    for (int i = 0; i < AC_NX; i++) {
        const double scale = q->atol[i] + q->rtol * fabs(w->z[i]);
        d2 = ac_max(d2, fabs(w->k[0][i] - w->f[i]) / scale / h);
    }
    const double big = ac_max(d1, d2);
    const double second = big <= 1e-15 ? ac_max(1e-6 * span, 1e-3 * h) : pow(0.01 / big, 1.0 / 5.0);
    const double found = ac_min(ac_min(100.0 * h, second), span);
    return found > 0.0 ? found : 1e-6 * span;
}

#if AC_NX == 0 && AC_N > 0
/* Without states nothing has to be integrated: what is saved solves the equations of its time, from the interpolated
   values, which stay where Newton's method does not converge. */
static void ac_save_solved(const ac_problem *q, long n, ac_work *w, void *tangents) {
    double z[AC_N], v[3][AC_N];
    memcpy(z, q->z_out + n * AC_N, sizeof z);
    memcpy(v, w->v, sizeof v);
    const int failed = ac_slope(w, q->save[n], z, w->f);
    memcpy(w->v, v, sizeof v);
    if (failed) return;
    memcpy(q->z_out + n * AC_N, z, sizeof z);
#ifdef AC_TANGENTS
    if (!tangents) return;
    ac_vector *dz = (ac_vector *)q->dz_out + n * AC_N, move[AC_N];
    ac_field_tangent(&w->m, q->save[n], z, dz, move);
    ac_back_vector(w, move);
    for (int i = 0; i < AC_N; i++) dz[i] += move[i];
#else
    (void)tangents;
#endif
}
#endif

static void ac_save(const ac_problem *q, long n, double s, ac_work *w, void *tangents) {
    ac_interpolate(s, w->z, w->z1, w->v, q->z_out + n * AC_N);
#ifdef AC_TANGENTS
    ac_tangent_work *d = tangents;
    if (d) ac_interpolate_vector(s, d->dz, d->dz1, d->dv, (ac_vector *)q->dz_out + n * AC_N);
#else
    (void)tangents;
#endif
#if AC_NX == 0 && AC_N > 0
    ac_save_solved(q, n, w, tangents);
#endif
}

/* How far from the end of a step, at t1, the last time may be that is saved in it. What is saved at an event is what
   follows it, and a time that differs from that of the event by rounding is the event's. */
static double ac_until(const ac_problem *q, double t1, int event, int last) {
    if (event) return -1e-13 * fabs(t1) - 1e-300;
    return q->open && last ? -1e-300 : 0.0;
}

static int ac_integrate(ac_problem *q, ac_work *w, void *tangents) {
    const double direction = q->t1 >= q->t0 ? 1.0 : -1.0;
    double t = q->t0, error_before = 1e-4, h_before = 0.0, tried = NAN, sums[AC_NK + 1];
    int forced = 0, rejected_before = 0, fresh = 1, reference = 0;
    ac_inputs(w, t);
    ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
    double h = q->first_step > 0.0 ? q->first_step : ac_first_step(q, w, direction);
    memcpy(w->z1, w->z, sizeof w->z);
    memset(w->v, 0, sizeof w->v);
    ac_sums(w->z, sums);
#ifdef AC_TANGENTS
    ac_tangent_work *d = tangents;
    if (d) memcpy(d->dz1, d->dz, sizeof d->dz), memset(d->dv, 0, sizeof d->dv);
#endif
    while (q->saved < q->n_save && direction * (q->save[q->saved] - t) <= (q->open && t == q->t1 ? -1e300 : 0.0))
        ac_save(q, q->saved++, 0.0, w, tangents);
#if AC_NR > 0
    if (q->located) ac_arm(q, w, t);
#endif
    while (direction * (q->t1 - t) > 0.0) {
        if (q->steps >= q->max_steps) return AC_MAX_STEPS;
        if (ac_watched(q)) return AC_STOPPED;
        const double floor_ = ac_max(1e-14 * fabs(t), 1e-10 * q->smallest);
        if (!(h > floor_)) h = floor_;
        const int last = h >= fabs(q->t1 - t) * (1.0 - 1e-12);
        if (last) h = fabs(q->t1 - t);
        if (!fresh) {
            ac_inputs(w, t);
            ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
            fresh = 1;
        }
        double step = direction * h;
        q->steps++;
        const int singular = ac_factorise(w, 1.0 / (ac_gamma * step));
        q->pivoted += w->pivoted;
        const int at_floor = h <= 1.5 * floor_;
        if (!singular && !at_floor && ac_outrun(w, 1.0 / (ac_gamma * step), &reference)) {
            q->rejected++;
            h *= 0.5, rejected_before = 1;
            continue;
        }
        double error = NAN;
        if (!singular) {
            ac_stages(w, t, step);
            ac_combine(w, ac_B, w->z, w->z1);
            error = ac_error(q, w, AC_N);
        }
        const int finite = error - error == 0.0;
        int keep = finite && error <= 1.0;
        if (!keep && at_floor && !ac_resettle(w, t, &tried)) {
            fresh = 0, h = ac_max(h, 1e-3 * h_before);
            continue;
        }
        if (!keep && at_floor && finite && ac_jumped(q, w) && ++forced <= 50) keep = 1;
        else if (keep) forced = 0;
        if (!keep && at_floor) return singular ? AC_SINGULAR : AC_SMALLEST_STEP;
        const double size = ac_max(finite ? error : 1e10, 1e-10);
        double next = h * ac_clip(0.9 * pow(size, -0.2), 0.2, 8.0);
        if (!keep) {
            q->rejected++;
            h = finite ? next : 0.1 * h;
            rejected_before = 1;
            continue;
        }
        if (h_before > 0.0 && error <= 1.0) { /* predictive control: Gustafsson (1994) */
            const double predicted = 0.9 * (h / h_before) * pow(error_before / (size * size), 0.2) * h;
            next = ac_min(next, ac_clip(predicted, 0.2 * h, 8.0 * h));
        }
        if (rejected_before) next = ac_min(next, h);
        h_before = h;
        error_before = ac_max(size, 1e-2);
        rejected_before = 0;
        int event = 0;
#if AC_NR > 0
        if (q->located) {
            event = ac_to_switch(w, t, &step);
            if (event < 0) return AC_SINGULAR;
        }
#endif
#ifdef AC_TANGENTS
        if (d) ac_step_tangent(w, d, t, step);
#endif
        const double t1 = last && !event ? q->t1 : t + step;
        ac_keep(sums, w->z1);
#if AC_NG > 0
        ac_project(w, tangents, t1);
#endif
        const double until = ac_until(q, t1, event, last);
        if (q->saved < q->n_save && direction * (q->save[q->saved] - t1) <= until) {
            for (int r = 0; r < 3; r++) ac_combine(w, ac_H[r], NULL, w->v[r]);
            for (; q->saved < q->n_save && direction * (q->save[q->saved] - t1) <= until; q->saved++)
                ac_save(q, q->saved, (q->save[q->saved] - t) / step, w, tangents);
        }
        memcpy(w->z, w->z1, sizeof w->z);
#ifdef AC_TANGENTS
        if (d) memcpy(d->dz, d->dz1, sizeof d->dz);
#endif
        q->accepted++;
        t = q->t_end = t1;
        fresh = 0;
        q->step = h = next;
#if AC_NR > 0
        if (q->located) {
            ac_note(q, w, event);
            if (event) return AC_EVENT;
        }
#endif
    }
    return AC_DONE;
}

#include "explicit.h"

static int ac_explicit(ac_problem *q, ac_work *w) {
    ac_explicit_work *e = calloc(1, sizeof *e);
    if (!e) return AC_NO_MEMORY;
    const int result = q->method == AC_RK4 ? ac_fixed_steps(q, w, e) : ac_adams(q, w, e);
    free(e);
    return result;
}

/* To the end of the run or the first event. */
static int ac_stretch(ac_problem *q, ac_work *w, void *tangents) {
    return q->method == AC_RODAS5P ? ac_integrate(q, w, tangents) : ac_explicit(q, w);
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
    int result = ac_stretch(q, w, tangents);
#if AC_ONLY_MODES
    for (; result == AC_EVENT && ac_switch_modes(q, w); result = ac_stretch(q, w, tangents))
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
