/* Rodas5P one stretch at a time, for a run that is cut into communication steps: what the error control knows goes from
   one stretch to the next. Sources as in solver.h, which is to be included before. Nothing here allocates memory. */

typedef struct {
    double h;                        /* step to be tried next; 0 to estimate one */
    double h_before, error_before;   /* of the last accepted step, for predictive control */
    int rejected_before;
    double sums[AC_NK + 1];          /* linear first integrals */
    long steps, accepted, rejected;
} ac_control;

/* Advances w->z from q->t_end to q->t1 (forward), or to the first event if they are located; at most q->max_steps steps.
   A result as that of acausal_run. */
static AC_UNUSED int ac_advance(ac_problem *q, ac_work *w, ac_control *k) {
    double t = q->t_end, tried = NAN;
    int forced = 0, fresh = 0, cut = 0, reference = 0;
#if AC_NR > 0
    if (q->located) ac_arm(q, w, t);
#endif
    if (!(k->h > 0.0)) {
        ac_inputs(w, t);
        ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
        fresh = 1;
        memset(k, 0, sizeof *k);
        ac_sums(w->z, k->sums);
        k->h = ac_first_step(q, w, 1.0);
    }
    for (long n = 0; q->t1 > t; n++) {
        if (n >= q->max_steps) return AC_MAX_STEPS;
        const double left = q->t1 - t, least = ac_max(1e-14 * fabs(t), 1e-10 * q->smallest);
        double h = ac_max(k->h, least);
        const int last = h >= left * (1.0 - 1e-12);
        const double planned = h;
        if (last) h = left;
        else if (h > 0.5 * left) h = 0.5 * left; /* no short rest that would spoil the next step size */
        cut = h < planned;
        if (!fresh) {
            ac_inputs(w, t);
            ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
            fresh = 1;
        }
        k->steps++;
        const int singular = ac_factorise(w, 1.0 / (ac_gamma * h)), at_floor = h <= 1.5 * least;
        if (!singular && !at_floor && ac_outrun(w, 1.0 / (ac_gamma * h), &reference)) {
            k->rejected++;
            k->h = 0.5 * h, k->rejected_before = 1;
            continue;
        }
        double error = NAN;
        if (!singular) {
            ac_stages(w, t, h);
            ac_combine(w, ac_B, w->z, w->z1);
            error = ac_error(q, w, AC_N);
        }
        const int finite = error - error == 0.0;
        int keep = finite && error <= 1.0;
        if (!keep && at_floor && !ac_resettle(w, t, &tried)) {
            fresh = 0, k->h = ac_max(h, 1e-3 * k->h_before);
            continue;
        }
        if (!keep && at_floor && finite && ac_jumped(q, w) && ++forced <= 50) keep = 1;
        else if (keep) forced = 0;
        if (!keep && at_floor) return singular ? AC_SINGULAR : AC_SMALLEST_STEP;
        const double size = ac_max(finite ? error : 1e10, 1e-10);
        double next = h * ac_clip(0.9 * pow(size, -0.2), 0.2, 8.0);
        if (!keep) {
            k->rejected++;
            k->h = finite ? next : 0.1 * h;
            k->rejected_before = 1;
            continue;
        }
        if (k->h_before > 0.0 && error <= 1.0) { /* Gustafsson (1994) */
            const double predicted = 0.9 * (h / k->h_before) * pow(k->error_before / (size * size), 0.2) * h;
            next = ac_min(next, ac_clip(predicted, 0.2 * h, 8.0 * h));
        }
        if (k->rejected_before) next = ac_min(next, h);
        if (cut) next = ac_max(next, planned); /* a step cut short says nothing against the planned one */
        k->h = next, k->h_before = h, k->error_before = ac_max(size, 1e-2), k->rejected_before = 0;
        int event = 0;
#if AC_NR > 0
        if (q->located) event = ac_to_switch(w, t, &h);
        if (event < 0) return AC_SINGULAR;
#endif
        t = last && !event ? q->t1 : t + h;
        ac_keep(k->sums, w->z1);
#if AC_NG > 0
        ac_project(w, NULL, t);
#endif
        memcpy(w->z, w->z1, sizeof w->z);
        k->accepted++;
        q->t_end = t;
        fresh = 0;
#if AC_NR > 0
        if (q->located) {
            ac_note(q, w, event);
            if (event) return AC_EVENT;
        }
#endif
    }
    return AC_DONE;
}
