/* Events: a step at whose end a condition is not as its mode says is shortened until it ends just behind the switch.

   A condition k holds where g_k < 0 (or <= 0); its mode is a parameter that is held during a run. The earliest switch is
   found on the dense output (scan.h); then steps are taken up to it, with Newton's method for its time, so that the result
   does not depend on the interpolation.
   Shampine and Thompson (2000), Event location for ordinary differential equations, Comput. Math. Appl. 39. */

#define AC_NEWTON 20

/* dz: the derivatives of the states at (t, x); w goes along in z and is improved by Newton's method. 0 if it converged. */
static int ac_slope(ac_work *w, double t, double *z, double *dz) {
    if (AC_N == AC_NX) {
        ac_value(w, t, z, dz);
        return 0;
    }
    double before = INFINITY;
    for (int turn = 0; turn < AC_NEWTON; turn++) {
        double *ignored = w->v[0], *r = w->v[1], size = 0.0;
        ac_inputs(w, t);
        ac_field_jacobian(&w->m, t, z, dz, ignored, w->J);
        if (ac_factorise(w, 1e30)) return 1; /* the states stand still, the algebraic unknowns follow */
        for (int i = 0; i < AC_N; i++) r[i] = i < AC_NX ? 0.0 : dz[i];
        ac_back(w, r);
        for (int i = AC_NX; i < AC_N; i++) {
            z[i] += r[i];
            size = ac_max(size, fabs(r[i]) / ac_max(fabs(z[i]), ac_nominal[i]));
            if (!(r[i] - r[i] == 0.0)) return 1;
        }
        if (size <= 1e-13 || (size <= 1e-9 && size >= 0.5 * before)) {
            ac_value(w, t, z, dz);
            return 0;
        }
        before = size;
    }
    return 1;
}

/* Where no step is small enough the algebraic unknowns may not solve their equations: a step that ends just behind a kink
   has their slopes before it, which may be those of an open valve for a closed one. Newton's method finds them from where
   they are, unless it has been tried at this time; 0 if it moved them. */
static AC_UNUSED int ac_resettle(ac_work *w, double t, double *tried) {
    if (AC_N == AC_NX || *tried == t) return 1;
    *tried = t;
    double z[AC_N];
    memcpy(z, w->z, sizeof z);
    if (ac_slope(w, t, z, w->f)) return 1;
    const int moved = memcmp(z, w->z, sizeof z);
    memcpy(w->z, z, sizeof z);
    return !moved;
}

#if AC_NR > 0
/* How far condition k is on the other side than its mode says; what is positive counts, or 0 too where `at_zero`. */
static inline double ac_beyond(const ac_work *w, const double *g, int k, int *at_zero) {
    const int slot = ac_root_slot[k], holds = slot < 0 || w->m.p[slot] != 0.0;
    *at_zero = holds == ac_root_strict[k];
    return holds ? g[k] : -g[k];
}

static inline int ac_switched(const ac_work *w, const double *g, int k) {
    int at_zero;
    const double beyond = ac_beyond(w, g, k, &at_zero);
    return w->slack[k] > 0.0 ? beyond > w->slack[k] : beyond > 0.0 || (at_zero && beyond == 0.0);
}

static int ac_any(const ac_work *w, const double *g) {
    for (int k = 0; k < AC_NR; k++)
        if (ac_switched(w, g, k)) return 1;
    return 0;
}

/* Conditions that are at their switch at the start of a run but for rounding have some slack until they are away from it. */
static void ac_arm(const ac_problem *q, ac_work *w, double t) {
    ac_inputs(w, t);
    ac_roots(&w->m, t, w->z, w->g0);
    memset(w->slack, 0, sizeof w->slack);
    w->noise = q->noise;
    for (int k = 0; k < AC_NR; k++)
        if (ac_switched(w, w->g0, k) || fabs(w->g0[k]) < q->noise[k]) w->slack[k] = 10.0 * fabs(w->g0[k]) + q->noise[k];
}

/* The solution within a step, 0 <= s <= 1. */
typedef void (*ac_curve)(const ac_work *w, const void *data, double s, double *out);

static void ac_dense_curve(const ac_work *w, const void *data, double s, double *out) {
    (void)data;
    ac_interpolate(s, w->z, w->z1, w->v[0], w->v[1], w->v[2], out);
}

static void ac_at(ac_work *w, double t, double h, ac_curve curve, const void *data, double s, double *g) {
    curve(w, data, s, w->y);
    ac_inputs(w, t + s * h);
    ac_roots(&w->m, t + s * h, w->y, g);
}

#include "scan.h"

/* The step of size h again, from the same start; 1 if it cannot be made. */
static int ac_again(ac_work *w, double t, double h) {
    ac_inputs(w, t);
    ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
    if (ac_factorise(w, 1.0 / (ac_gamma * h))) return 1;
    ac_stages(w, t, h);
    ac_combine(w, ac_B, w->z, w->z1);
    return 0;
}

static int ac_ends(ac_work *w, double t1) {
#if AC_NG > 0
    ac_project(w, NULL, t1);
#endif
    if (AC_N > AC_NX && ac_slope(w, t1, w->z1, w->y)) return 1;
    ac_inputs(w, t1);
    ac_roots(&w->m, t1, w->z1, w->g2);
    return 0;
}

/* Rates at which the conditions pass their switch at s, on the dense output, and which of them have switched there. */
static void ac_passing(ac_work *w, double t, double h, double s) {
    const double aside = ac_max(1e-6, 1e-12 * fabs(t / h)), back = s > aside ? s - aside : 0.0;
    ac_at(w, t, h, ac_dense_curve, NULL, back, w->g1);
    ac_at(w, t, h, ac_dense_curve, NULL, s, w->g3);
    for (int k = 0; k < AC_NR; k++) {
        int at_zero;
        w->rate[k] = (ac_beyond(w, w->g3, k, &at_zero) - ac_beyond(w, w->g1, k, &at_zero)) / (s - back);
        w->candidate[k] = ac_switched(w, w->g3, k);
    }
}

/* How far, in parts of the step, its end is behind the switch of what has switched there or is to switch. */
static double ac_overshoot(const ac_work *w) {
    double over = -INFINITY;
    for (int k = 0; k < AC_NR; k++) {
        int at_zero;
        if (!w->candidate[k] && !ac_switched(w, w->g2, k)) continue;
        const double by = (ac_beyond(w, w->g2, k, &at_zero) - w->slack[k]) / w->rate[k];
        if (w->rate[k] > 0.0 && by - by == 0.0) over = ac_max(over, by);
    }
    return over;
}

/* Steps to the switch that the dense output has at s: 1, with z1 behind it; 0 if there is none within reach; -1. */
static int ac_land(ac_work *w, double t, double h, double s, double *step) {
    double before = 0.0, behind = 2.0, further = 2e-16 * ac_max(fabs(t / h), 1.0);
    for (int turn = 0; turn < 60; turn++) {
        if (s > 1.0) s = 1.0;
        if (ac_again(w, t, s * h) || ac_ends(w, t + s * h)) return -1;
        const double over = ac_overshoot(w), near = 1e-12 + 4e-16 * fabs(t / h);
        if (ac_any(w, w->g2)) {
            if (fabs(over) <= near || s - before <= near || !(over > -INFINITY)) {
                *step = s * h;
                return 1;
            }
            behind = s;
            s = over > 0.0 && s - over > before ? s - over : 0.5 * (before + behind);
            continue;
        }
        before = s;
        if (behind > 1.0 && (s >= 1.0 || further > 1e-6)) return 0;
        if (over < 0.0 && over > -0.1) s -= over;
        s += further, further *= 4.0;
        if (s >= behind) s = 0.5 * (before + behind);
    }
    return 0;
}

/* Shortens the step that w holds to the first switch in it. 1: it now ends there; 0: nothing switches; -1: failure; 2: it
   is too long for its dense output, which switches where steps do not.
   In the end w has the stages and factors of the step of size *step, and z1 (consistent) at its end. What is a switch on
   the dense output only, by rounding, gets some slack. */
static int ac_to_switch(ac_work *w, double t, double *step) {
    const double h = *step;
    for (int attempt = 0; attempt <= AC_NR; attempt++) {
        for (int r = 0; r < 3; r++) ac_combine(w, ac_H[r], NULL, w->v[r]);
        const double s = ac_first_switch(w, t, h, ac_dense_curve, NULL);
        if (s > 1.0) return 0;
        ac_passing(w, t, h, s);
        const int found = ac_land(w, t, h, s, step);
        if (found < 0) return -1;
        if (found) {
            if (AC_N == AC_NX) return 1;
            ac_inputs(w, t); /* the factors of the step, which Newton's method for its end has replaced */
            ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
            return ac_factorise(w, 1.0 / (ac_gamma * *step)) ? -1 : 1;
        }
        for (int k = 0; k < AC_NR; k++)
            if (w->candidate[k]) w->slack[k] = ac_max(2.0 * w->slack[k], 10.0 * fabs(w->g3[k]) + 1e-300);
        *step = h;
        if (ac_again(w, t, h)) return -1;
    }
    return 2;
}

/* After a step whose end has the values g2: tells what has switched, or goes on from there. */
static void ac_note(ac_problem *q, ac_work *w, int event) {
    for (int k = 0; k < AC_NR; k++) {
        if (event) {
            q->switched[k] = ac_switched(w, w->g2, k);
            continue;
        }
        w->g0[k] = w->g2[k];
        int at_zero;
        if (ac_beyond(w, w->g2, k, &at_zero) < -w->slack[k]) w->slack[k] = 0.0;
    }
}
#endif
