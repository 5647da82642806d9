/* Events that do nothing but switch modes, carried out within a run.

   Where a model has no left limits, triggers and actions, an event is over when the modes of the conditions that have
   switched are the opposite ones and the solution of the equations agrees with all modes. Whatever is not as simple as
   that ends the run, and the iteration of the caller carries it out.
   Modelica Language Specification 3.6, Appendix B. */

#define AC_ROUNDING 1e-13 /* values of a condition this small, in units of what is in it, are rounding */
#define AC_NOISE 1e-9     /* a condition that is no further from its switch, in these units, is there by rounding */

/* Largest of the variables in condition k, or of their nominal values; `moving`: of those that move between events. */
static double ac_size(const ac_work *w, int k, int moving) {
    double size = 0.0;
    for (int e = ac_root_first[k]; e < ac_root_first[k + 1]; e++)
        if (!moving || ac_root_moves[e]) size = fmax(size, fmax(fabs(w->all[ac_root_variable[e]]), ac_root_nominal[e]));
    return size;
}

/* Whether the modes agree with the conditions g2 and coupled equations have a solution. What has just switched may still
   be on its old side by rounding. */
static int ac_agree(const ac_problem *q, const ac_work *w) {
    for (int k = 0; k < AC_NR; k++) {
        const double g = w->g2[k];
        const int holds = g < 0.0 || (g == 0.0 && !ac_root_strict[k]);
        if (holds == (w->m.p[ac_root_slot[k]] != 0.0)) continue;
        const int variables = ac_root_first[k + 1] > ac_root_first[k];
        if (!q->switched[k] || !(fabs(g) <= AC_NOISE * fmax(q->largest[k], variables ? ac_size(w, k, 0) : 1.0))) return 0;
    }
    for (int k = 0; k < AC_COUPLED; k++)
        if (!isfinite(w->all[ac_coupled[k]])) return 0;
    return 1;
}

static void ac_flip(const ac_problem *q, ac_work *w) {
    for (int k = 0; k < AC_NR; k++)
        if (q->switched[k]) w->p[ac_root_slot[k]] = w->p[ac_root_slot[k]] == 0.0;
    ac_constants(w->p, w->c);
}

/* Carries out the event at w->z, q->t_end. 1: it is in the record of q, and the run can go on; 0: it is for the caller,
   and nothing has changed. */
static int ac_switch_modes(ac_problem *q, ac_work *w) {
    if (q->passed >= q->most_passed) return 0;
    const double t = q->t_end;
    double before[AC_N];
    memcpy(before, w->z, sizeof before);
    ac_flip(q, w);
    int agree = AC_N == AC_NX || !ac_slope(w, t, w->z, w->f);
    if (agree) {
        ac_inputs(w, t);
        ac_roots(&w->m, t, w->z, w->g2);
        ac_observe(&w->m, t, w->z, w->all);
        agree = ac_agree(q, w);
    }
    if (!agree) {
        memcpy(w->z, before, sizeof before);
        ac_flip(q, w);
        return 0;
    }
    for (int k = 0; k < AC_NR; k++) {
        q->noise[k] = AC_ROUNDING * ac_size(w, k, 1);
        if (isfinite(w->g2[k])) q->largest[k] = fmax(q->largest[k], fabs(w->g2[k]));
    }
    q->passed_t[q->passed] = t;
    q->passed_saved[q->passed] = q->saved;
    memcpy(q->passed_switched + q->passed * AC_NR, q->switched, sizeof(int) * AC_NR);
    q->passed++;
    return 1;
}
