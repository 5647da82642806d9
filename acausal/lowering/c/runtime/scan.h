/* The first switch within a step, on its dense output.

   A condition may depend on the time, and the step size knows nothing of it: a step can span many swings of a source that
   the states do not feel. So the functions are looked at in intervals over which a cubic through four of their values
   tells others; intervals where it does not, and where it matters, are halved.
   Shampine, Gladwell and Brankin (1991), Reliable solution of special event location problems for ODEs, ACM TOMS 17(1). */

enum { AC_LOOKS = 5, AC_FURTHER = 4, AC_MOST_INTERVALS = 1000000 };
#define AC_NARROWEST 1e-6
#define AC_TRUST 4.0 /* the cubic may be wrong by so many times what it is wrong by where it is compared */
#define AC_FAR 10.0  /* a condition is out of reach if it is so many times its variation away from its switch */
/* Not evenly, and at no simple fractions: so as not to fall in step with a swing. */
static const double ac_look[AC_LOOKS] = {0.0, 0.2329173741, 0.5131842019, 0.7874513277, 1.0};
static const double ac_further[AC_FURTHER] = {0.3719042273, 0.6527719033, 0.1136592107, 0.9023316619};

static double ac_of_cubic(const double *a, double x) {
    return a[0] + x * (a[1] + x * (a[2] + x * a[3]));
}

/* Coefficients a of the cubic through values at all places but the middle one. */
static void ac_cubic(const double *y, double *a) {
    const double p = ac_look[1], q = ac_look[3];
    const double d1 = (y[1] - y[0]) / p, e1 = (y[3] - y[1]) / (q - p), f1 = (y[4] - y[3]) / (1.0 - q);
    const double d2 = (e1 - d1) / q, e2 = (f1 - e1) / (1.0 - p), d3 = e2 - d2;
    a[0] = y[0], a[1] = d1 - p * d2 + p * q * d3, a[2] = d2 - (p + q) * d3, a[3] = d3;
}

/* Where in (0, 1) a cubic is largest; -1 if it is largest at an end. */
static double ac_cubic_top(const double *a, double *height) {
    const double square = a[2] * a[2] - 3.0 * a[3] * a[1];
    if (!(square > 0.0)) return -1.0;
    const double root = sqrt(square), x = a[2] > 0.0 ? (-a[2] - root) / (3.0 * a[3]) : a[1] / (root - a[2]);
    if (!(x > 0.0 && x < 1.0)) return -1.0;
    *height = ac_of_cubic(a, x);
    return *height > a[0] && *height > ac_of_cubic(a, 1.0) ? x : -1.0;
}

/* Whether the cubics tell the values at a place of an interval, where it matters. *peak: the earliest place where a
   condition may switch there and back between the five values, 2 for none; *near: whether any condition is within reach. */
static int ac_tells(const ac_work *w, double place, const double *values, double *peak, int *near) {
    *peak = 2.0, *near = 0;
    for (int k = 0; k < AC_NR; k++) {
        int at_zero;
        double y[AC_LOOKS], a[4], height = 0.0, most = -INFINITY, least = INFINITY;
        for (int i = 0; i < AC_LOOKS; i++) {
            y[i] = ac_beyond(w, w->scan[i], k, &at_zero) - w->slack[k];
            most = ac_max(most, y[i]), least = -ac_max(-least, -y[i]);
        }
        ac_cubic(y, a);
        const double found = ac_beyond(w, values, k, &at_zero) - w->slack[k];
        const double error = AC_TRUST * fabs(found - ac_of_cubic(a, place)), x = ac_cubic_top(a, &height);
        const double top = x > 0.0 ? ac_max(most, height) : most;
        const int matters = most >= 0.0 ? error > 0.1 * (most - least) : top + error > 0.0;
        if (matters && error > 10.0 * (w->noise ? w->noise[k] : 0.0) + 1e-13 * (most - least)) return 0;
        if (most < 0.0 && top >= 0.0 && x < *peak) *peak = x;
        *near |= most + AC_FAR * (most - least) > 0.0;
    }
    return 1;
}

/* Whether what happens in an interval is known from the five values in it. */
static int ac_resolved(ac_work *w, double t, double h, ac_curve curve, const void *data, double from, double span,
                       double *peak) {
    int near;
    if (!ac_tells(w, ac_look[2], w->scan[2], peak, &near)) return 0;
    for (int i = 0; near && i < AC_FURTHER; i++) {
        ac_at(w, t, h, curve, data, from + ac_further[i] * span, w->g3);
        if (!ac_tells(w, ac_further[i], w->g3, peak, &near)) return 0;
    }
    return 1;
}

/* Narrows [from, to], of which `to` is behind a switch and `from` is not, to rounding; returns `to`. */
static double ac_narrow(ac_work *w, double t, double h, ac_curve curve, const void *data, double from, double to) {
    for (int turn = 0; turn < 200 && (to - from) * fabs(h) > 4e-16 * fabs(t) + 1e-18 * fabs(h); turn++) {
        double s = 0.5 * (from + to);
        if (turn % 3) { /* the secant of what switches first */
            double first = 2.0;
            ac_at(w, t, h, curve, data, from, w->g1);
            ac_at(w, t, h, curve, data, to, w->g3);
            for (int k = 0; k < AC_NR; k++) {
                int at_zero;
                if (!ac_switched(w, w->g3, k)) continue;
                const double a = ac_beyond(w, w->g1, k, &at_zero) - w->slack[k];
                const double b = ac_beyond(w, w->g3, k, &at_zero) - w->slack[k];
                const double at = a < 0.0 ? from - a * (to - from) / (b - a) : from;
                first = ac_min(first, at);
            }
            const double width = to - from; /* once behind it, once before it */
            s = first + (turn % 3 == 1 ? 1e-3 : -1e-3) * width;
            if (width < 1e-9) s = turn % 3 == 1 ? first + 1e-14 : first;
            if (!(s > from && s < to)) s = 0.5 * (from + to);
        }
        if (s <= from || s >= to) break;
        ac_at(w, t, h, curve, data, s, w->g1);
        if (ac_any(w, w->g1)) to = s;
        else from = s;
    }
    return to;
}

/* Where in the step (0, 1] something has switched, on the dense output: just behind the first switch found; 2 if none.
   Leaves the values at the end of the step in g2. */
static double ac_first_switch(ac_work *w, double t, double h, ac_curve curve, const void *data) {
    ac_inputs(w, t + h);
    ac_roots(&w->m, t + h, w->z1, w->g2);
    memcpy(w->scan[0], w->g0, sizeof w->g0);
    double from = 0.0, width = 1.0, peak;
    for (int n = 0; from < 1.0 && n < AC_MOST_INTERVALS; n++) {
        const int last = from + width >= 1.0 - AC_NARROWEST;
        const double span = last ? 1.0 - from : width;
        for (int i = 1; i < AC_LOOKS - last; i++) ac_at(w, t, h, curve, data, from + ac_look[i] * span, w->scan[i]);
        if (last) memcpy(w->scan[AC_LOOKS - 1], w->g2, sizeof w->g2);
        if (!ac_resolved(w, t, h, curve, data, from, span, &peak) && span > 2.0 * AC_NARROWEST) {
            width = 0.5 * span;
            continue;
        }
        int i = 1;
        while (i < AC_LOOKS && !ac_any(w, w->scan[i])) i++;
        if (peak < (i < AC_LOOKS ? ac_look[i] : 1.0)) {
            ac_at(w, t, h, curve, data, from + peak * span, w->g3);
            if (ac_any(w, w->g3)) {
                int before = 0;
                while (ac_look[before + 1] < peak) before++;
                return ac_narrow(w, t, h, curve, data, from + ac_look[before] * span, from + peak * span);
            }
            if (span > 2.0 * AC_NARROWEST) {
                width = 0.5 * span;
                continue;
            }
        }
        if (i < AC_LOOKS) {
            const double to = last && i == AC_LOOKS - 1 ? 1.0 : from + ac_look[i] * span;
            return ac_narrow(w, t, h, curve, data, from + ac_look[i - 1] * span, to);
        }
        memcpy(w->scan[0], w->scan[AC_LOOKS - 1], sizeof w->g0);
        from = last ? 1.0 : from + span;
        width = 2.0 * span;
    }
    return 2.0;
}
