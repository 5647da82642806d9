/* A stretch of a run with Rodas5P: steps, output, tangents, events. */

#if AC_N > AC_NX
/* Newton's method for the algebraic unknowns in z with the factors at hand, those of the step or of the output before;
   dz is overwritten. 0 where it gains a digit at each turn and ends far within the tolerance: the equations are those that
   the factors are of, and the Jacobian need not be made anew. */
static AC_UNUSED int ac_refined(const ac_problem *q, ac_work *w, double t, double *z, double *dz) {
    double before = 0.0;
    for (int turn = 0; turn < 3; turn++) {
        double size = 0.0;
        ac_value(w, t, z, dz);
        for (int i = 0; i < AC_NX; i++) dz[i] = 0.0;
        ac_back(w, dz);
        for (int i = AC_NX; i < AC_N; i++) {
            size = ac_worse(size, fabs(dz[i]) / (q->atol[i] + q->rtol * fabs(z[i])));
            z[i] += dz[i];
        }
        if (size == 0.0 || (turn > 0 && size <= 0.1 * ac_min(before, 1.0))) return 0;
        if (turn > 0 && !(size <= 0.1 * before)) return 1;
        before = size;
    }
    return 1;
}

/* What is saved inside of a step solves the equations of its time, from the interpolated values: the dense output does not
   know of kinks, jumps and pulses that no state feels. It stays where Newton's method does not converge. */
static void ac_save_solved(const ac_problem *q, long n, ac_work *w, void *tangents) {
    double z[AC_N], v[3][AC_N];
    memcpy(z, q->z_out + n * AC_N, sizeof z);
    if (AC_NX == 0 || ac_refined(q, w, q->save[n], z, w->y)) { /* without states to rounding: nothing else is solved */
        memcpy(z, q->z_out + n * AC_N, sizeof z);
        memcpy(v, w->v, sizeof v);
        const int failed = ac_slope(w, q->save[n], z, w->y);
        memcpy(w->v, v, sizeof v);
        if (failed) return;
    }
    memcpy(q->z_out + n * AC_N, z, sizeof z);
#ifdef AC_TANGENTS
    if (!tangents) return;
    ac_vector *dz = (ac_vector *)q->dz_out + n * AC_N, move[AC_N];
    ac_field_tangent(&w->m, q->save[n], z, dz, move);
    for (int i = 0; i < AC_NX; i++) move[i] = ac_zero;
    ac_back_vector(w, move);
    for (int i = AC_NX; i < AC_N; i++) dz[i] += move[i];
#else
    (void)tangents;
#endif
}
#endif

static void ac_save(const ac_problem *q, long n, double s, ac_work *w, void *tangents) {
    ac_interpolate(s, w->z, w->z1, w->v[0], w->v[1], w->v[2], q->z_out + n * AC_N);
#ifdef AC_TANGENTS
    ac_tangent_work *d = tangents;
    if (d) ac_interpolate_vector(s, d->dz, d->dz1, d->dv[0], d->dv[1], d->dv[2], (ac_vector *)q->dz_out + n * AC_N);
#else
    (void)tangents;
#endif
#if AC_N > AC_NX
    ac_save_solved(q, n, w, tangents);
#endif
}

/* How far from the end of a step, at t1, the last time may be that is saved in it. What is saved at an event is what
   follows it, and a time that differs from that of the event by rounding is the event's. */
static double ac_until(const ac_problem *q, double t1, int event, int last) {
    if (event) return -1e-13 * fabs(t1) - 1e-300;
    return q->open && last ? -1e-300 : 0.0;
}

/* Output at the start of a stretch. */
static void ac_save_start(ac_problem *q, ac_work *w, void *tangents, double t, double direction) {
    if (q->saved >= q->n_save) return;
    memcpy(w->z1, w->z, sizeof w->z);
    memset(w->v, 0, sizeof w->v);
#ifdef AC_TANGENTS
    ac_tangent_work *d = tangents;
    if (d) memcpy(d->dz1, d->dz, sizeof d->dz), memset(d->dv, 0, sizeof d->dv);
#endif
    const double until = q->open && t == q->t1 ? -1e300 : 0.0;
    for (; q->saved < q->n_save && direction * (q->save[q->saved] - t) <= until; q->saved++)
        ac_save(q, q->saved, 0.0, w, tangents);
}

/* Output within the step from t to t1. */
static void ac_save_step(ac_problem *q, ac_work *w, void *tangents, double t, double step, double t1, double until) {
    const double direction = step < 0.0 ? -1.0 : 1.0;
    if (q->saved >= q->n_save || direction * (q->save[q->saved] - t1) > until) return;
    for (int r = 0; r < 3; r++) ac_combine(w, ac_H[r], NULL, w->v[r]);
    for (; q->saved < q->n_save && direction * (q->save[q->saved] - t1) <= until; q->saved++)
        ac_save(q, q->saved, (q->save[q->saved] - t) / step, w, tangents);
}

/* Advances w->z from q->t_end to q->t1, or to the first event if they are located. */
static AC_UNUSED int ac_integrate(ac_problem *q, ac_work *w, ac_control *k, void *tangents) {
    const double direction = q->t1 >= q->t_end ? 1.0 : -1.0;
    ac_begin(q, w, k, q->t_end);
    ac_save_start(q, w, tangents, q->t_end, direction);
#ifdef AC_TANGENTS
    if (tangents) ac_tangent_begin(w, tangents);
#endif
#if AC_NR > 0
    if (q->located) ac_arm(q, w, q->t_end);
#endif
    while (direction * (q->t1 - q->t_end) > 0.0) {
        const double t = q->t_end;
        const int failed = ac_step(q, w, k, t);
        if (failed) return failed;
        double step = direction * k->size;
        int event = 0;
#if AC_NR > 0
        if (q->located) event = ac_to_switch(w, t, &step);
        if (event < 0) return AC_SINGULAR;
        if (event > 1 && k->size > 1e-8 * fabs(q->t1 - t) && k->size > 1e-12 * fabs(t)) {
            ac_reject(q, k, 0.5 * k->size);
            continue;
        }
        if (event > 1) event = 0;
#endif
#ifdef AC_TANGENTS
        if (tangents) {
            ac_step_tangent(w, tangents, t, step);
            if (!ac_tangents_good(q, k, ac_tangent_error(q, w, tangents), fabs(step))) continue;
        }
#endif
        const int last = k->last && !event;
        const double t1 = last ? k->to : t + step;
        ac_keep(k->sums, w->z1);
#if AC_NG > 0
        ac_project(w, tangents, t1);
#endif
        ac_save_step(q, w, tangents, t, step, t1, ac_until(q, t1, event, k->last && k->to == q->t1));
        memcpy(w->z, w->z1, sizeof w->z);
#ifdef AC_TANGENTS
        ac_tangent_work *d = tangents;
        if (d) memcpy(d->dz, d->dz1, sizeof d->dz);
#endif
        q->t_end = t1, q->step = k->h, k->fresh = 0;
#if AC_NR > 0
        if (q->located) ac_note(q, w, event);
        if (event) {
            *k = ac_anew(k->h);
            return AC_EVENT;
        }
#endif
    }
    return AC_DONE;
}
