/* Explicit methods for the states; the algebraic unknowns are solved for at every evaluation.

   Classical Runge-Kutta of order 4 with a fixed step: Hairer, Norsett and Wanner, Solving Ordinary Differential
   Equations I, II.1. Adams methods of order 1 to 12 with variable step, predicted, evaluated, corrected, evaluated: the
   same book, III.5 (formulas) and III.7 (order and step size). */

#define AC_ORDERS 12

typedef struct {
    double k[4][AC_N], phi[AC_ORDERS + 3][AC_N], past[AC_ORDERS + 2][AC_N];
    double h, end[AC_N], f1[AC_N], predicted[AC_N], x[AC_ORDERS + 2], z0[AC_N], ignored[AC_N];
} ac_explicit_work;

static void ac_hermite(
    double s, double h, const double *y0, const double *f0, const double *y1, const double *f1, double *out) {
    const double a = s * s * (3.0 - 2.0 * s), b = h * s * (1.0 - s) * (1.0 - s), c = h * s * s * (s - 1.0);
    for (int i = 0; i < AC_NX; i++) out[i] = (1.0 - a) * y0[i] + a * y1[i] + b * f0[i] + c * f1[i];
    for (int i = AC_NX; i < AC_N; i++) out[i] = (1.0 - s) * y0[i] + s * y1[i];
}

/* Whether what is due at time `at` is saved in a step that ends at t1. */
static int ac_due(const ac_problem *q, double at, double t1, double direction, int event) {
    return direction * (at - t1) <= ac_until(q, t1, event, t1 == q->t1);
}

#if AC_NR > 0
/* Ends a step of size *h at the first switch on the curve through it: z1 is then consistent there, 1 is returned, -1 where
   that fails. */
static int ac_cut(const ac_problem *q, ac_work *w, ac_explicit_work *e, double t, double *h, ac_curve curve, void *data) {
    if (!q->located) return 0;
    double s = ac_first_switch(w, t, *h, curve, data), further = 2e-16 * ac_max(fabs(t / *h), 1.0);
    for (int turn = 0; s <= 1.0 && turn < 40; turn++) {
        double *out = e->predicted;
        curve(w, data, s, out);
        if (AC_N > AC_NX && ac_slope(w, t + s * *h, out, e->ignored)) return -1;
        ac_inputs(w, t + s * *h);
        ac_roots(&w->m, t + s * *h, out, w->g2);
        if (ac_any(w, w->g2)) {
            memcpy(w->z1, out, sizeof w->z1);
            *h *= s;
            return 1;
        }
        if (s == 1.0) return 0;
        if (turn > 12) { /* by rounding, on the curve only */
            for (int k = 0; k < AC_NR; k++)
                if (ac_switched(w, w->g3, k)) w->slack[k] = ac_max(2.0 * w->slack[k], 10.0 * fabs(w->g3[k]) + 1e-300);
            return 0;
        }
        s = ac_min(s + further, 1.0), further *= 4.0;
    }
    return 0;
}
#endif

/* Output inside a step from t to t1; the algebraic unknowns are solved for at the output time. */
static int ac_save_between(ac_problem *q, ac_work *w, ac_explicit_work *e, double t, double h, double direction, int event) {
    while (q->saved < q->n_save && ac_due(q, q->save[q->saved], t + h, direction, event)) {
        double *out = q->z_out + q->saved * AC_N;
        const double at = q->save[q->saved];
        ac_hermite((at - t) / e->h, e->h, w->z, w->f, e->end, e->f1, out);
        if (AC_N > AC_NX && ac_slope(w, at, out, e->ignored)) return 1;
        q->saved++;
    }
    return 0;
}

#if AC_NR > 0
static void ac_hermite_curve(const ac_work *w, const void *data, double s, double *out) {
    const ac_explicit_work *e = data;
    ac_hermite(s, e->h, w->z, w->f, e->end, e->f1, out);
}
#endif

static int ac_fixed_steps(ac_problem *q, ac_work *w, ac_explicit_work *e) {
    static const double node[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const double direction = q->t1 >= q->t0 ? 1.0 : -1.0, span = fabs(q->t1 - q->t0);
    const long count = (long)ceil(span / q->first_step * (1.0 - 1e-12));
    if (ac_slope(w, q->t0, w->z, w->f)) return AC_SINGULAR;
    for (; q->saved < q->n_save && ac_due(q, q->save[q->saved], q->t0, direction, 0); q->saved++)
        memcpy(q->z_out + q->saved * AC_N, w->z, sizeof w->z);
    q->step = q->first_step;
#if AC_NR > 0
    if (q->located) ac_arm(q, w, q->t0);
#endif
    for (long n = 0; n < count; n++) {
        if (q->steps >= q->max_steps) return AC_MAX_STEPS;
        if (ac_watched(q)) return AC_STOPPED;
        const double t = q->t_end, t1 = n + 1 == count ? q->t1 : q->t0 + direction * (n + 1) * q->first_step;
        double h = t1 - t;
        int event = 0;
        memcpy(w->z1, w->z, sizeof w->z);
        memcpy(e->k[0], w->f, sizeof w->f);
        memcpy(w->y, w->z, sizeof w->z);
        for (int s = 0; s < 4; s++) {
            if (s > 0) {
                for (int i = 0; i < AC_NX; i++) w->y[i] = w->z[i] + node[s] * h * e->k[s - 1][i];
                if (ac_slope(w, t + node[s] * h, w->y, e->k[s])) return AC_SINGULAR;
            }
            for (int i = 0; i < AC_NX; i++) w->z1[i] += weight[s] * h * e->k[s][i];
        }
        for (int i = AC_NX; i < AC_N; i++) w->z1[i] = w->y[i];
        for (int i = 0; i < AC_NX; i++)
            if (!(w->z1[i] - w->z1[i] == 0.0)) return AC_SMALLEST_STEP;
        q->steps++, q->accepted++;
#if AC_NG > 0
        ac_project(w, NULL, t1);
#endif
        if (ac_slope(w, t1, w->z1, e->f1)) return AC_SINGULAR;
        e->h = h;
        memcpy(e->end, w->z1, sizeof w->z1);
#if AC_NR > 0
        event = ac_cut(q, w, e, t, &h, ac_hermite_curve, e);
        if (event < 0) return AC_SINGULAR;
#endif
        if (ac_save_between(q, w, e, t, h, direction, event)) return AC_SINGULAR;
        memcpy(w->z, w->z1, sizeof w->z);
        memcpy(w->f, e->f1, sizeof w->f);
        q->t_end = event ? t + h : t1;
#if AC_NR > 0
        if (q->located) ac_note(q, w, event);
        if (event) return AC_EVENT;
#endif
    }
    return AC_DONE;
}

/* Largest |factor * phi| in units of the tolerance. */
static double ac_scaled(const ac_problem *q, const ac_work *w, double factor, const double *phi) {
    double worst = 0.0;
    for (int i = 0; i < AC_NX; i++) {
        const double size = fabs(factor * phi[i]) / (q->atol[i] + q->rtol * ac_max(fabs(w->z[i]), fabs(w->z1[i])));
        worst = ac_worse(worst, size);
    }
    return worst;
}

/* The past of a method of order k: phi_j(n), and its times x[0] = t_n, x[1] = t_{n-1}, ... */
static void ac_coefficients(const ac_explicit_work *e, int k, double h, double *g, double *beta) {
    double c[AC_ORDERS + 2][AC_ORDERS + 3];
    beta[0] = 1.0;
    for (int q = 1; q <= k + 2; q++) c[0][q] = 1.0 / q;
    for (int j = 1; j <= k; j++) {
        beta[j] = beta[j - 1] * (e->x[0] + h - e->x[j - 1]) / (e->x[0] - e->x[j]);
        for (int q = 1; q <= k + 2 - j; q++)
            c[j][q] = j == 1 ? 1.0 / (q * (q + 1.0)) : c[j - 1][q] - c[j - 1][q + 1] * h / (e->x[0] + h - e->x[j - 1]);
    }
    for (int j = 0; j <= k; j++) g[j] = c[j][1];
}

/* The solution at x, before the newest point, from the polynomial through the newest k + 1 slopes: with
   phi_j = f[x_n, ..., x_{n-j}] prod_{i<j} (x_n - x_{n-1-i}), integrated by Gauss's formula with 7 points. */
static void ac_adams_output(const ac_explicit_work *e, int k, const double *z1, double x, double *out) {
    static const double node[4] = {0.0, 0.4058451513773972, 0.7415311855993945, 0.9491079123427585};
    static const double weight[4] = {0.4179591836734694, 0.3818300505051189, 0.2797053914892767, 0.1294849661688697};
    const double half = 0.5 * (x - e->x[0]);
    double total[AC_ORDERS + 2] = {0.0};
    for (int m = -3; m <= 3; m++) {
        const double at = e->x[0] + half * (1.0 + (m < 0 ? -node[-m] : node[m]));
        double product = half * weight[m < 0 ? -m : m];
        for (int j = 0; j <= k; j++) {
            total[j] += product;
            product *= (at - e->x[j]) / (e->x[0] - e->x[j + 1]);
        }
    }
    for (int i = 0; i < AC_N; i++) out[i] = z1[i];
    for (int j = 0; j <= k; j++)
        for (int i = 0; i < AC_NX; i++) out[i] += total[j] * e->phi[j][i];
}

#if AC_NR > 0
typedef struct {
    const ac_explicit_work *e;
    const double *end;
    int k;
    double h;
} ac_adams_step;

static void ac_adams_curve(const ac_work *w, const void *data, double s, double *out) {
    const ac_adams_step *step = data;
    (void)w;
    ac_adams_output(step->e, step->k, step->end, step->e->x[0] - (1.0 - s) * step->h, out);
}
#endif

static int ac_adams(ac_problem *q, ac_work *w, ac_explicit_work *e) {
    static const double gamma[AC_ORDERS + 2] = {1.0,         0.5,           0.083333333, 0.041666667, 0.026388889,
                                                0.01875,     0.0142691799,  0.0113673942, 0.0093565365, 0.0078925540,
                                                0.0067858499, 0.0059240564, 0.0052366933, 0.0046774984};
    const double direction = q->t1 >= q->t0 ? 1.0 : -1.0;
    double beta[AC_ORDERS + 2], g[AC_ORDERS + 2];
    int k = 1, known = 1, failures = 0, starting = 1;
    if (ac_slope(w, q->t0, w->z, w->f)) return AC_SINGULAR;
    memcpy(w->z1, w->z, sizeof w->z);
    double h = q->first_step > 0.0 ? q->first_step : 0.1 * ac_first_step(q, w, direction);
    /* behind an event a state may just have left zero: the estimate is then below rounding of the time */
    h = ac_max(h, ac_smallest_step(q, q->t0));
    memset(e->phi, 0, sizeof e->phi);
    memcpy(e->phi[0], w->f, sizeof w->f);
    e->x[0] = q->t0;
    for (; q->saved < q->n_save && ac_due(q, q->save[q->saved], q->t0, direction, 0); q->saved++)
        memcpy(q->z_out + q->saved * AC_N, w->z, sizeof w->z);
#if AC_NR > 0
    if (q->located) ac_arm(q, w, q->t0);
#endif
    while (direction * (q->t1 - q->t_end) > 0.0) {
        if (q->steps >= q->max_steps) return AC_MAX_STEPS;
        if (ac_watched(q)) return AC_STOPPED;
        const double t = q->t_end, floor_ = ac_smallest_step(q, t);
        const double to = ac_smooth_until(q, w, t, floor_, 0), left = fabs(to - t);
        const int last = h >= left * (1.0 - 1e-12);
        if (h < floor_ && !last) return AC_SMALLEST_STEP;
        /* to a kink two equal steps rather than one and a short rest, behind which the steps would have to grow again */
        const double size_ = last ? left : to == q->t1 ? h : ac_min(h, 0.5 * left);
        const double step = direction * size_, t1 = last ? to : t + step;
        for (int j = known; j <= k; j++) e->x[j] = e->x[j - 1] - step; /* no past yet: phi there is zero */
        ac_coefficients(e, k, step, g, beta);
        q->steps++;
        memcpy(w->z1, w->z, sizeof w->z);
        for (int j = 0; j < k; j++)
            for (int i = 0; i < AC_NX; i++) w->z1[i] += step * g[j] * beta[j] * e->phi[j][i];
        memcpy(e->predicted, w->z1, sizeof w->z1);
        int bad = ac_slope(w, t1, w->z1, e->f1);
        /* past[j] = phi_j(n + 1) with the predicted slope */
        for (int i = 0; i < AC_NX; i++) {
            e->past[0][i] = e->f1[i];
            for (int j = 0; j <= k; j++) e->past[j + 1][i] = e->past[j][i] - beta[j] * e->phi[j][i];
        }
        const double error = ac_scaled(q, w, step * (g[k] - g[k - 1]), e->past[k]);
        const double lower = k > 1 ? ac_scaled(q, w, step * gamma[k - 1], e->past[k - 1]) : INFINITY;
        const double lowest = k > 2 ? ac_scaled(q, w, step * gamma[k - 2], e->past[k - 2]) : INFINITY;
        if (bad || !(error <= 1.0)) {
            q->rejected++, failures++, starting = 0;
            if (ac_max(lower, k > 2 ? lowest : 0.0) <= error && k > 1) k--;
            if (failures > 2) k = 1;
            h = fabs(step) * (failures > 2 ? 0.25 : 0.5);
            if (h < floor_) return bad ? AC_SINGULAR : AC_SMALLEST_STEP;
            continue;
        }
        for (int i = 0; i < AC_NX; i++) w->z1[i] += step * g[k] * e->past[k][i];
#if AC_NG > 0
        ac_project(w, NULL, t1);
#endif
        if (ac_slope(w, t1, w->z1, e->f1)) return AC_SINGULAR;
        q->accepted++, failures = 0;
        for (int i = 0; i < AC_NX; i++) { /* phi(n + 1) with the corrected slope */
            double value = e->f1[i];
            for (int j = 0; j <= k; j++) {
                const double next = value - beta[j] * e->phi[j][i];
                e->phi[j][i] = value;
                value = next;
            }
            e->phi[k + 1][i] = value;
        }
        for (int j = AC_ORDERS + 1; j > 0; j--) e->x[j] = e->x[j - 1];
        e->x[0] = t1;
        double cut = step;
        int event = 0;
        memcpy(e->end, w->z1, sizeof w->z1);
#if AC_NR > 0
        ac_adams_step whole = {e, e->end, k, step};
        event = ac_cut(q, w, e, t, &cut, ac_adams_curve, &whole);
        if (event < 0) return AC_SINGULAR;
#endif
        for (; q->saved < q->n_save && ac_due(q, q->save[q->saved], event ? t + cut : t1, direction, event); q->saved++) {
            double *out = q->z_out + q->saved * AC_N;
            ac_adams_output(e, k, e->end, q->save[q->saved], out);
            if (AC_N > AC_NX && ac_slope(w, q->save[q->saved], out, e->ignored)) return AC_SINGULAR;
        }
        memcpy(w->z, w->z1, sizeof w->z);
        memcpy(w->f, e->f1, sizeof w->f);
        q->t_end = event ? t + cut : t1;
#if AC_NR > 0
        if (q->located) ac_note(q, w, event);
        if (event) return AC_EVENT;
#endif
        if (known <= AC_ORDERS) known++;
        const double size = fabs(step);
        if (starting && k < AC_ORDERS && error <= 0.25 && known > k) {
            k++, h = 2.0 * size;
            continue;
        }
        starting = 0;
        const double upper = k < AC_ORDERS && known > k + 1 ? ac_scaled(q, w, step * gamma[k + 1], e->phi[k + 1]) : INFINITY;
        double best = error;
        if (k > 1 && (k > 2 ? ac_max(lower, lowest) : lower) <= error) k--, best = lower;
        else if (upper < error && (k > 1 ? upper < lower : upper < 0.5 * error)) k++, best = upper;
        const double factor = pow(0.5 / ac_max(best, 1e-12), 1.0 / (k + 1));
        h = size * (factor >= 2.0 ? 2.0 : factor >= 1.0 ? 1.0 : ac_max(factor, 0.5));
    }
    return AC_DONE;
}
