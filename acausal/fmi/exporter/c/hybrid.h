/* Events: modes of conditions, left limits, triggers and states until nothing changes any more.

   All that changes at events is a slot behind the parameters and the inputs; the equations are smooth between events.
   Modelica Language Specification 3.6, 8.6 and Appendix B. The generated function ac_event_values gives, one after the
   other: floors, left limits, conditions of triggers, reinitializations (trigger, value), assertions, ends, samples
   (start, interval). A model without events has none of these, and nothing here takes any time. */

#define FMU_BEHIND 1e-10 /* in nominal values of what is in the condition */
#define FMU_ROUNDING 1e-13 /* values of a condition this small, in units of what is in it, are rounding */
#define FMU_NOISE 1e-9 /* a condition that is no further from its switch, in units of what is in it, is there by rounding */

static void fmu_put(fmu_instance *f, int slot, double value, int *changed) {
    if (f->s.p[slot] != value) {
        f->s.p[slot] = value;
        f->constants_known = 0;
        f->slot_changed[slot - FMU_FIRST_SLOT] = 1;
        (*changed)++;
    }
}

static void fmu_no_changes(fmu_instance *f) {
    memset(f->slot_changed, 0, sizeof f->slot_changed);
}

/* Functions of the conditions, and all that events need, at the point of the instance. */
static void fmu_event_values(fmu_instance *f) {
    ac_work *w = fmu_prepare(f);
    ac_inputs(w, f->s.t);
    ac_roots(&w->m, f->s.t, f->s.z, f->roots);
    ac_event_values(&w->m, f->s.t, f->s.z, f->events);
}

/* Positive where the condition is taken to hold. The sign changes a little behind the switch, seen from the present mode,
   so that the condition has switched beyond doubt where an importer finds a root. */
static AC_UNUSED double fmu_indicator(const fmu_instance *f, int root) {
    const int slot = ac_root_slot[root], holds = slot < 0 || f->s.p[slot] != 0.0;
    return (holds ? FMU_BEHIND : -FMU_BEHIND) * fmu_root_scale[root] - f->roots[root];
}

static int fmu_holds(const fmu_instance *f, int root) {
    return ac_root_strict[root] ? f->roots[root] < 0.0 : f->roots[root] <= 0.0;
}

/* States and algebraic unknowns near the present ones that satisfy the equations and the retained constraints; states of
   the mask stay, and so do all states where there is none, and those above a level (velocities may jump while positions
   stay). */
static int fmu_move(fmu_instance *f, const unsigned char *stays, int level) {
    ac_work *w = fmu_prepare(f);
    ac_initial *a = &f->initial;
    double ease[AC_N + 1];
    for (int j = 0; j < AC_N; j++) {
        ease[j] = j < AC_NX ? ac_nominal[j] : 1e4 * ac_nominal[j];
        a->moves[j] = j >= AC_NX || (stays && !stays[j] && fmu_level[j] <= level);
    }
    const ac_given given = {fmu_fixed, ease, f->wanted, 0};
    memcpy(a->found, f->s.z, sizeof a->found);
    memset(a->r0, 0, sizeof a->r0);
    a->t = f->s.t, a->share = 0.0, a->n_rows = stays ? AC_FIRST_WANTED : AC_NW;
    ac_root_near(w, a, &given, a->found);
    const double left = ac_residual_left(a);
    if (!(left <= FMU_CONSISTENT)) {
        fmu_say(f, FMU_DISCARD, "the equations have no solution near the values before the event at t = %.12g s", f->s.t);
        return FMU_DISCARD;
    }
    memcpy(f->s.z, a->found, sizeof a->found);
    return FMU_OK;
}

/* The algebraic unknowns from the states; failing Newton's method, by steps of least change. */
static int fmu_settle(fmu_instance *f) {
    if (AC_N == AC_NX) return FMU_OK;
    ac_work *w = fmu_prepare(f);
    memcpy(w->y, f->s.z, sizeof w->y);
    if (!ac_slope(w, f->s.t, w->y, f->slopes)) {
        memcpy(f->s.z, w->y, sizeof w->y);
        return FMU_OK;
    }
    return fmu_move(f, NULL, 0);
}

/* ---- one turn ------------------------------------------------------------------------------------ */
/* Slots of floor(x) hold the integer above. */
static void fmu_steps(fmu_instance *f, int *changed) {
    for (int k = 0; k < FMU_FLOORS; k++) fmu_put(f, fmu_floor_slot[k], floor(f->events[k]) + 1.0, changed);
}

/* Modes that follow from values that move. */
static int fmu_modes(fmu_instance *f) {
    int changed = 0;
    for (int k = 0; k < AC_NR; k++)
        if (ac_root_slot[k] >= 0 && !fmu_root_follows[k]) fmu_put(f, ac_root_slot[k], fmu_holds(f, k), &changed);
    fmu_steps(f, &changed);
    return changed;
}

/* Modes of conditions on discrete quantities. */
static int fmu_following(fmu_instance *f) {
    int changed = 0;
    for (int k = 0; k < AC_NR; k++)
        if (ac_root_slot[k] >= 0 && fmu_root_follows[k]) fmu_put(f, ac_root_slot[k], fmu_holds(f, k), &changed);
    return changed;
}

static int fmu_lefts(fmu_instance *f) {
    int changed = 0;
    for (int k = 0; k < FMU_PRES; k++) fmu_put(f, fmu_pre_slot[k], f->events[FMU_AT_PRES + k], &changed);
    return changed;
}

/* Left limits of the next turn. Those of states are what `reinit` has given them in this one, from which a second `reinit`
   at the same moment begins: states are copied before their left limits are (Modelica Language Specification 8.3.6). */
static int fmu_next_lefts(fmu_instance *f, int active) {
    int changed = fmu_lefts(f);
    if (!active || FMU_REINITS == 0) return changed;
    fmu_event_values(f);
    for (int k = 0; k < FMU_PRES; k++)
        if (fmu_pre_of_states[k]) fmu_put(f, fmu_pre_slot[k], f->events[FMU_AT_PRES + k], &changed);
    return changed;
}

static int fmu_triggers(fmu_instance *f) {
    int changed = 0;
    for (int k = 0; k < FMU_CONDITIONS;) {
        const int slot = fmu_condition_slot[k];
        int pulled = 0;
        for (; k < FMU_CONDITIONS && fmu_condition_slot[k] == slot; k++)
            pulled |= f->events[FMU_AT_CONDITIONS + k] != 0.0 && !f->s.before[k];
        fmu_put(f, slot, pulled, &changed);
    }
    return changed;
}

static void fmu_remember(fmu_instance *f) {
    for (int k = 0; k < FMU_CONDITIONS; k++) f->s.before[k] = f->events[FMU_AT_CONDITIONS + k] != 0.0;
}

static int fmu_active(const fmu_instance *f) {
    int active = 0;
    for (int k = 0; k < FMU_CONDITIONS; k++) active |= f->s.p[fmu_condition_slot[k]] != 0.0;
    return active;
}

static void fmu_release(fmu_instance *f) {
    int changed = 0;
    for (int k = 0; k < FMU_CONDITIONS; k++) fmu_put(f, fmu_condition_slot[k], 0.0, &changed);
}

/* Largest value of the variables in a condition, or nominal value; those that move between events, or all. */
static double fmu_root_size(const fmu_instance *f, int root, int moving_only) {
    double size = 0.0;
    for (int e = ac_root_first[root]; e < ac_root_first[root + 1]; e++)
        if (!moving_only || ac_root_moves[e])
            size = ac_max(size, ac_max(fabs(f->all[ac_root_variable[e]]), ac_root_nominal[e]));
    return size;
}

/* What of each function of a condition is rounding: nothing where it depends on time and discrete variables only. */
static AC_UNUSED void fmu_find_noise(fmu_instance *f) {
    ac_observe(&fmu_prepare(f)->m, f->s.t, f->s.z, f->all);
    for (int k = 0; k < AC_NR; k++) f->noise[k] = FMU_ROUNDING * fmu_root_size(f, k, 1);
}

static int fmu_by_rounding(fmu_instance *f) {
    ac_observe(&fmu_prepare(f)->m, f->s.t, f->s.z, f->all);
    for (int k = 0; k < FMU_SLOTS; k++)
        if (f->slot_changed[k] && !fmu_is_mode[k]) return 0;
    for (int k = 0; k < AC_NR; k++) {
        const int slot = ac_root_slot[k];
        if (slot < 0 || !f->slot_changed[slot - FMU_FIRST_SLOT]) continue;
        const double scale = ac_root_first[k] == ac_root_first[k + 1] ? 1.0 : fmu_root_size(f, k, 0);
        if (!(fabs(f->roots[k]) <= FMU_NOISE * scale)) return 0;
    }
    return 1;
}

static unsigned long long fmu_slot_hash(const fmu_instance *f) { /* FNV-1a */
    const unsigned char *byte = (const unsigned char *)(f->s.p + FMU_FIRST_SLOT);
    unsigned long long hash = 14695981039346656037ULL;
    const size_t size = FMU_SLOTS * sizeof(double);
    for (size_t k = 0; k != size; k++) hash = (hash ^ byte[k]) * 1099511628211ULL;
    return hash;
}

static int fmu_tried(const fmu_instance *f, int n, unsigned long long hash) {
    for (int k = 0; k < n; k++)
        if (f->tried[k] == hash) return 1;
    return 0;
}

static void fmu_say_slots(fmu_instance *f, const char *what) {
    fmu_say(f, FMU_DISCARD, "at t = %.12g s %s", f->s.t, what);
    for (int k = 0, n = 0; k < FMU_SLOTS && n < 8; k++)
        if (f->slot_changed[k]) n++, fmu_say(f, FMU_DISCARD, "    %s", fmu_slot_text[k]);
}

/* Solution and values with all that follows from discrete quantities: a condition on a discrete variable is no choice of
   its own. *restless: number of slots that do not come to rest. */
static int fmu_propagate(fmu_instance *f, int *restless) {
    for (int turn = 0; turn < FMU_TURNS; turn++) {
        const int status = fmu_settle(f);
        if (status != FMU_OK) return status;
        fmu_event_values(f);
        fmu_no_changes(f);
        *restless = fmu_following(f);
        if (*restless) fmu_event_values(f);
        *restless += fmu_triggers(f);
        if (!*restless) return FMU_OK;
    }
    return FMU_OK;
}

/* Modes and triggers that agree with the solution of the equations. */
static int fmu_consistent(fmu_instance *f) {
    double old[FMU_SLOTS + 1];
    int one_by_one = 0, tried = 0, restless = 0;
    for (int turn = 0; turn < FMU_TURNS; turn++) {
        const int status = fmu_propagate(f, &restless);
        if (status != FMU_OK) return status;
        if (restless) break;
        const unsigned long long hash = fmu_slot_hash(f);
        memcpy(old, f->s.p + FMU_FIRST_SLOT, sizeof(double) * FMU_SLOTS);
        fmu_no_changes(f);
        const int changed = fmu_modes(f);
        if (!changed) return FMU_OK;
        if (fmu_tried(f, tried, hash)) {
            if (fmu_by_rounding(f)) {
                memcpy(f->s.p + FMU_FIRST_SLOT, old, sizeof(double) * FMU_SLOTS);
                f->constants_known = 0;
                fmu_event_values(f);
                return FMU_OK;
            }
            if (one_by_one) break;
            one_by_one = 1, tried = 0;
        }
        f->tried[tried++] = hash;
        if (one_by_one && changed > 1) { /* Murty's least-index rule: it does not cycle where a solution exists */
            int first = 0, again = 0;
            while (!f->slot_changed[first]) first++;
            const double value = f->s.p[FMU_FIRST_SLOT + first];
            memcpy(f->s.p + FMU_FIRST_SLOT, old, sizeof(double) * FMU_SLOTS);
            f->constants_known = 0;
            fmu_put(f, FMU_FIRST_SLOT + first, value, &again);
        }
    }
    fmu_say_slots(f, "no values of these conditions agree with the equations:");
    return FMU_DISCARD;
}

/* Assertions at the values of f->events. */
static int fmu_assert(fmu_instance *f) {
    for (int k = 0; k < FMU_ASSERTS; k++) {
        if (f->events[FMU_AT_ASSERTS + k] != 0.0) continue;
        if (fmu_assert_fatal[k]) {
            fmu_say(f, FMU_DISCARD, "at t = %.9g s an assertion does not hold: %s", f->s.t, fmu_assert_text[k]);
            return FMU_DISCARD;
        }
        if (!f->s.warned[k]) fmu_say(f, FMU_WARNING, "at t = %.9g s: %s", f->s.t, fmu_assert_text[k]);
        f->s.warned[k] = 1;
    }
    return FMU_OK;
}

/* States with the values that reinit gives; those that depend on them follow by the least change. */
static int fmu_reinitialize(fmu_instance *f) {
    unsigned char stays[AC_N + 1] = {0};
    int any = 0, level = 0;
    for (int k = 0; k < FMU_REINITS; k++) {
        if (f->events[FMU_AT_REINITS + 2 * k] == 0.0) continue;
        const int i = fmu_reinit_state[k];
        f->s.z[i] = fmu_reinit_sign[k] * f->events[FMU_AT_REINITS + 2 * k + 1];
        stays[i] = 1, any = 1;
        if (fmu_level[i] > level) level = fmu_level[i];
    }
    return any && AC_NG > 0 ? fmu_move(f, stays, level) : FMU_OK;
}

static void fmu_end(fmu_instance *f) {
    for (int k = 0; k < FMU_ENDS && !f->s.ended; k++)
        if (f->events[FMU_AT_ENDS + k] != 0.0) {
            f->s.ended = 1;
            fmu_say(f, FMU_OK, "the model ends the simulation at t = %.9g s: %s", f->s.t, fmu_end_text[k]);
        }
}

/* To the fixed point: no trigger is left, and left limits are values. */
static int fmu_iterate(fmu_instance *f) {
    for (int turn = 0; turn < FMU_TURNS; turn++) {
        int status = fmu_consistent(f);
        if (status == FMU_OK) status = fmu_assert(f);
        if (status != FMU_OK) return status;
        const int active = fmu_active(f);
        if (active) {
            fmu_end(f);
            status = fmu_reinitialize(f);
            if (status != FMU_OK) return status;
        }
        fmu_remember(f);
        const int moved = fmu_next_lefts(f, active);
        if (!active && !moved) return FMU_OK;
        fmu_release(f);
    }
    fmu_say_slots(f, "the events do not come to an end: each change brings about another:");
    return FMU_DISCARD;
}

/* ---- samples ------------------------------------------------------------------------------------- */
#define FMU_SIMULTANEOUS 1e-9 /* a sample that is this part of its interval away from an event is at the event */

static double fmu_slack(double start, double interval, double t) {
    return FMU_SIMULTANEOUS + 1e-15 * (fabs(t) + fabs(start)) / interval;
}

/* How many samples there have been until t of those at start + k interval, what is behind t by rounding included. */
static double fmu_passed(double start, double interval, double t) {
    return interval > 0.0 ? fmax(floor((t - start) / interval + fmu_slack(start, interval, t)) + 1.0, 0.0) : 0.0;
}

/* Time of the next samples behind t. */
static double fmu_next_sample(const fmu_instance *f, double t) {
    double best = INFINITY;
    for (int k = 0; k < FMU_SAMPLES; k++) {
        const double start = f->events[FMU_AT_SAMPLES + 2 * k], interval = f->events[FMU_AT_SAMPLES + 2 * k + 1];
        if (interval > 0.0) best = fmin(best, start + fmu_passed(start, interval, t) * interval);
    }
    return best;
}

/* Whether samples have become due since the last ones, until the time of the instance; they are marked. An event that comes
   before a sample by rounding takes it along: behind the event it counts as passed. */
static int fmu_samples_due(fmu_instance *f) {
    int any = 0;
    for (int k = 0; k < FMU_SAMPLES; k++) {
        const double start = f->events[FMU_AT_SAMPLES + 2 * k], interval = f->events[FMU_AT_SAMPLES + 2 * k + 1];
        f->due[k] = fmu_passed(start, interval, f->s.t) > fmu_passed(start, interval, f->s.sampled_until);
        any |= f->due[k];
    }
    return any;
}

/* The time of the samples that are due, which an event may be before by rounding: what else switches at it, as it is hit
   exactly, may not have switched yet. */
static double fmu_moment(const fmu_instance *f) {
    double t = f->s.t;
    for (int k = 0; k < FMU_SAMPLES; k++) {
        const double start = f->events[FMU_AT_SAMPLES + 2 * k], interval = f->events[FMU_AT_SAMPLES + 2 * k + 1];
        if (f->due[k]) t = fmax(t, start + (fmu_passed(start, interval, f->s.t) - 1.0) * interval);
    }
    return t;
}

/* Whether there are samples at the time of the start itself; they are marked. */
static int fmu_samples_at_start(fmu_instance *f) {
    int any = 0;
    for (int k = 0; k < FMU_SAMPLES; k++) {
        const double start = f->events[FMU_AT_SAMPLES + 2 * k], interval = f->events[FMU_AT_SAMPLES + 2 * k + 1];
        const double before = f->s.t - 4.0 * fmu_slack(start, interval, f->s.t) * interval;
        f->due[k] = fmu_passed(start, interval, f->s.t) > fmu_passed(start, interval, before);
        any |= f->due[k];
    }
    f->s.sampled_until = f->s.t;
    return any;
}

static void fmu_put_samples(fmu_instance *f, double value) {
    int changed = 0;
    for (int k = 0; k < FMU_SAMPLES; k++)
        if (f->due[k]) fmu_put(f, fmu_sample_slot[k], value, &changed);
}

/* ---- events -------------------------------------------------------------------------------------- */
/* What follows at the time of the instance from the left limits in it. `switched` is the mask of the conditions that have
   switched, `sampled` whether samples are due (f->due). */
static int fmu_event(fmu_instance *f, const int *switched, int sampled, int final) {
    int changed = 0;
    if (FMU_HYBRID == 0) return FMU_OK;
    int status = fmu_settle(f);
    if (status != FMU_OK) return status;
    fmu_event_values(f);
    fmu_lefts(f);
    if (sampled) fmu_put_samples(f, 1.0);
    if (final && FMU_TERMINAL >= 0) fmu_put(f, FMU_TERMINAL, 1.0, &changed);
    for (int k = 0; switched && k < AC_NR; k++)
        if (switched[k] && ac_root_slot[k] >= 0) fmu_put(f, ac_root_slot[k], 1.0 - f->s.p[ac_root_slot[k]], &changed);
    fmu_steps(f, &changed);
    status = fmu_iterate(f);
    if (status != FMU_OK) return status;
    if (sampled) { /* they are over at once: what is true with them falls back, and is seen to do so */
        f->s.sampled_until = f->s.t;
        fmu_put_samples(f, 0.0);
        status = fmu_iterate(f);
        if (status != FMU_OK) return status;
    }
    if (final && FMU_TERMINAL >= 0) {
        fmu_put(f, FMU_TERMINAL, 0.0, &changed);
        fmu_event_values(f);
        fmu_remember(f);
    }
    f->s.control = ac_anew(f->s.control.h); /* states may have jumped */
    fmu_forget(f);
    f->algebraic_known = 1;
    return FMU_OK;
}

/* Conditions that disagree with their modes. */
static int fmu_disagreeing(fmu_instance *f, int *switched) {
    int any = 0;
    fmu_event_values(f);
    for (int k = 0; k < AC_NR; k++) {
        const int slot = ac_root_slot[k];
        switched[k] = slot >= 0 ? fmu_holds(f, k) != (f->s.p[slot] != 0.0) : !fmu_holds(f, k);
        any |= switched[k];
    }
    return any;
}

/* ---- start --------------------------------------------------------------------------------------- */
/* Triggers that initial() pulls: conditions that hold with it and would not without. */
static int fmu_initial_triggers(fmu_instance *f) {
    double with[FMU_CONDITIONS + 1];
    int changed = 0;
    if (FMU_INITIAL < 0) return 0;
    memcpy(with, f->events + FMU_AT_CONDITIONS, sizeof(double) * FMU_CONDITIONS);
    f->s.p[FMU_INITIAL] = 0.0, f->constants_known = 0;
    fmu_event_values(f);
    f->s.p[FMU_INITIAL] = 1.0, f->constants_known = 0;
    for (int k = 0; k < FMU_CONDITIONS;) {
        const int slot = fmu_condition_slot[k];
        int pulled = 0;
        for (; k < FMU_CONDITIONS && fmu_condition_slot[k] == slot; k++)
            pulled |= with[k] != 0.0 && f->events[FMU_AT_CONDITIONS + k] == 0.0;
        fmu_put(f, slot, pulled, &changed);
    }
    fmu_event_values(f);
    return changed;
}

/* Slots before the first solution of the start. */
static void fmu_first_slots(fmu_instance *f) {
    memset(f->s.p + FMU_FIRST_SLOT, 0, sizeof(double) * FMU_SLOTS);
    memset(f->s.before, 0, sizeof f->s.before);
    f->s.ended = 0;
    if (FMU_INITIAL >= 0) f->s.p[FMU_INITIAL] = 1.0;
    for (int k = 0; k < FMU_PRES; k++)
        if (fmu_pre_source[k] >= 0) {
            const double value = fmu_pre_sign[k] * f->starts[fmu_pre_source[k]];
            f->s.p[fmu_pre_slot[k]] = value == value ? value : 0.0;
        }
    fmu_guess(f->s.t, f->starts, f->s.p);
    f->constants_known = 0;
}

/* Consistent values with their modes, from start values in f->s.z. */
static int fmu_hybrid_start(fmu_instance *f, const ac_given *given) {
    double first[AC_N + 1];
    int tried = 0, changed = 0;
    memcpy(first, f->s.z, sizeof f->s.z);
    fmu_first_slots(f);
    for (int turn = 0; turn < FMU_TURNS; turn++) {
        memcpy(f->s.z, first, sizeof f->s.z);
        f->left = ac_initialize(fmu_prepare(f), &f->initial, given, f->s.t, f->s.z);
        if (!(f->left <= FMU_CONSISTENT)) return FMU_OK; /* the caller looks at what is left */
        fmu_event_values(f);
        const unsigned long long hash = fmu_slot_hash(f);
        fmu_no_changes(f);
        changed = fmu_modes(f) + fmu_following(f) + fmu_initial_triggers(f);
        if (!changed || (fmu_tried(f, tried, fmu_slot_hash(f)) && fmu_by_rounding(f))) break;
        f->tried[tried++] = hash;
        if (turn == FMU_TURNS - 1) {
            fmu_say_slots(f, "the conditions and the equations of the start contradict each other:");
            return FMU_ERROR;
        }
    }
    if (FMU_HYBRID == 0) return FMU_OK;
    fmu_event_values(f);
    fmu_remember(f);
    int status = FMU_OK, ignored = 0;
    const int active = fmu_active(f);
    if (active) {
        fmu_end(f);
        status = fmu_reinitialize(f);
    }
    fmu_next_lefts(f, active);
    fmu_release(f);
    if (FMU_INITIAL >= 0) fmu_put(f, FMU_INITIAL, 0.0, &ignored);
    if (status == FMU_OK) status = fmu_iterate(f);
    if (status == FMU_OK && FMU_SAMPLES > 0 && fmu_samples_at_start(f)) status = fmu_event(f, NULL, 1, 0);
    return status;
}
