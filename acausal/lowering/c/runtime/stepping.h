/* Step size control of Rodas5P. What it knows goes from one step to the next, and from one stretch of a run that is cut
   into communication steps to the next.

   Source: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8. Nothing here allocates memory. */

typedef struct {
    double h;                      /* size to be tried next; 0 to estimate one */
    double h_before, error_before; /* of the last accepted step, for predictive control */
    int rejected_before;           /* the size was reduced on the way to this step */
    int begun;                     /* the sums are known */
    double sums[AC_NK + 1];        /* linear first integrals */
    double size;                   /* of the step that is being made, */
    double to;                     /* end of the run, or a kink of the inputs before it, */
    int last, cut;                 /* which the step ends at; the step is smaller than it might be, to that end */
    int fresh;                     /* f, ft and J are those of its start */
    int forced;                    /* smallest steps in a row that were taken in spite of their error */
    int reference;                 /* sign of the determinant for small steps, see ac_outrun */
    double tried;                  /* time at which Newton's method was last tried, see ac_resettle */
} ac_control;

/* Nothing is known but a size to be tried: at the start, and behind an event. */
static ac_control ac_anew(double h) {
    ac_control k;
    memset(&k, 0, sizeof k);
    k.h = h, k.tried = NAN;
    return k;
}

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

/* Largest error of a step in units of the tolerance, of the first n unknowns. */
static double ac_error(const ac_problem *q, const ac_work *w, int n) {
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        const double scale = q->atol[i] + q->rtol * ac_max(fabs(w->z[i]), fabs(w->z1[i]));
        worst = ac_worse(worst, fabs(w->k[7][i]) / scale);
    }
    return worst;
}

/* Whether a smallest step may be taken in spite of its error: it crosses a jump of the right-hand side or of algebraic
   unknowns. States are continuous; where they jump, the solution has ended. */
#define AC_JUMP 1e3
static int ac_jumped(const ac_problem *q, const ac_work *w) { return ac_error(q, w, AC_NX) <= AC_JUMP; }

static void ac_refresh(ac_work *w, ac_control *k, double t) {
    if (k->fresh) return;
    ac_inputs(w, t);
    ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
    k->fresh = 1;
}

/* Before the first step of a stretch, at (t, w->z). */
static void ac_begin(const ac_problem *q, ac_work *w, ac_control *k, double t) {
    k->fresh = 0, k->tried = NAN;
    if (!k->begun) ac_sums(w->z, k->sums), k->begun = 1;
    if (k->h > 0.0) return;
    ac_refresh(w, k, t);
    k->h = ac_first_step(q, w, q->t1 >= t ? 1.0 : -1.0);
}

/* The size of the next step where `left` is left to k->to: two equal steps rather than one and a short rest. */
static void ac_limit(ac_control *k, double left, double least) {
    k->size = k->h > least ? k->h : least;
    k->last = k->size >= left * (1.0 - 1e-12);
    const double most = k->last ? left : 0.5 * left;
    k->cut = most < k->size;
    if (k->last || k->cut) k->size = most;
}

static void ac_reject(ac_problem *q, ac_control *k, double h) {
    q->rejected++;
    k->h = h, k->rejected_before = 1;
}

/* The next size from the error of a step; predictive where it was accepted.
   Gustafsson (1994), Control-theoretic techniques for stepsize selection in implicit Runge-Kutta methods. */
static void ac_accept(ac_problem *q, ac_control *k, double error) {
    const double h = k->size, size = ac_max(error, 1e-10), planned = k->h;
    double next = h * ac_clip(0.9 * pow(size, -0.2), 0.2, 8.0);
    if (k->h_before > 0.0 && error <= 1.0) {
        const double predicted = 0.9 * (h / k->h_before) * pow(k->error_before / (size * size), 0.2) * h;
        next = ac_min(next, ac_clip(predicted, 0.2 * h, 8.0 * h));
    }
    if (k->rejected_before) next = ac_min(next, h);
    if (k->cut) next = ac_max(next, planned); /* a step cut short says nothing against the planned one */
    k->h = next, k->h_before = h, k->error_before = ac_max(size, 1e-2), k->rejected_before = 0;
    q->accepted++;
}

/* The next step from (t, w->z) that is accepted, towards q->t1: its size is in k, its end in w->z1, its stages in w->k.
   AC_DONE, or why there is none. */
static int ac_step(ac_problem *q, ac_work *w, ac_control *k, double t) {
    const double direction = q->t1 >= t ? 1.0 : -1.0, least = ac_smallest_step(q, t);
    k->to = ac_smooth_until(q, w, t, least, 1);
    for (;;) {
        if (q->steps >= q->max_steps) return AC_MAX_STEPS;
        if (ac_watched(q)) return AC_STOPPED;
        ac_limit(k, fabs(k->to - t), least);
        ac_refresh(w, k, t);
        const double step = direction * k->size, d = 1.0 / (ac_gamma * step);
        const int singular = ac_factorise(w, d), at_floor = k->size <= 1.5 * least;
        q->steps++, q->pivoted += w->pivoted;
        if (!singular && !at_floor && ac_outrun(w, d, &k->reference)) {
            ac_reject(q, k, 0.5 * k->size);
            continue;
        }
        double error = NAN;
        if (!singular) {
            ac_stages(w, t, step);
            ac_combine(w, ac_B, w->z, w->z1);
            error = ac_error(q, w, AC_N);
        }
        const int finite = error - error == 0.0, good = finite && error <= 1.0;
        if (good) {
            k->forced = 0;
        } else if (!at_floor) {
            ac_reject(q, k, k->size * (finite ? ac_clip(0.9 * pow(error, -0.2), 0.2, 1.0) : 0.1));
            continue;
        } else if (!ac_resettle(w, t, &k->tried)) {
            k->fresh = 0, k->h = ac_max(k->size, 1e-3 * k->h_before);
            continue;
        } else if (!finite || !ac_jumped(q, w) || ++k->forced > 50) {
            return singular ? AC_SINGULAR : AC_SMALLEST_STEP;
        }
        ac_accept(q, k, error);
        return AC_DONE;
    }
}

/* Whether the tangents of a step are good, too, which was good else; the next size follows from theirs where that is
   smaller. Where they are not finite, or the step is as small as can be, there is no use in a smaller one. */
static AC_UNUSED int ac_tangents_good(ac_problem *q, ac_control *k, double error, double size) {
    const double next = size * ac_clip(0.9 * pow(ac_max(error, 1e-10), -0.2), 0.2, 8.0);
    const int hopeless = error - error != 0.0 || size <= 1e-10 * fabs(q->t1 - q->t0);
    if (error <= 1.0) k->h = ac_min(k->h, next);
    if (error <= 1.0 || hopeless) return 1;
    q->accepted--;
    ac_reject(q, k, next);
    return 0;
}
