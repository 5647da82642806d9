/* One instance in time: initialization, communication steps, retained constraints, saved states. */

#define FMU_CLOSE_EVENTS 200 /* events in a row without time passing */

/* The call is refused unless the instance is in one of the modes of a mask. */
static int fmu_refuse(const fmu_instance *f, const char *function, int modes) {
    static const char *const name[] = {"instantiated", "initialization mode", "event mode", "continuous-time mode",
                                       "step mode", "step failed", "terminated"};
    if (f->s.mode & modes) return 0;
    int k = 0;
    while (f->s.mode >> (k + 1)) k++;
    fmu_say(f, FMU_ERROR, "%s is not allowed in this state (%s)", function, name[k]);
    return 1;
}

static int fmu_refuse_kind(const fmu_instance *f, const char *function, int kind) {
    if (f->kind == kind) return 0;
    fmu_say(f, FMU_ERROR, "%s is a function of %s, this instance is for %s", function,
            kind == FMU_CO_SIMULATION ? "co-simulation" : "model exchange",
            kind == FMU_CO_SIMULATION ? "model exchange" : "co-simulation");
    return 1;
}

static int fmu_refuse_pointer(const fmu_instance *f, const char *function, int missing) {
    if (missing) fmu_say(f, FMU_ERROR, "%s was given a null pointer", function);
    return missing;
}

static int fmu_setup(fmu_instance *f, int tolerance_defined, double tolerance, double start, int stop_defined, double stop) {
    if (!(start - start == 0.0) || (stop_defined && !(stop > start))) {
        fmu_say(f, FMU_ERROR, "the experiment from t = %.9g s to %.9g s is not possible", start, stop);
        return FMU_ERROR;
    }
    if (tolerance_defined && !(tolerance > 0.0 && tolerance < 1.0)) {
        fmu_say(f, FMU_ERROR, "the relative tolerance %.3g is not between 0 and 1", tolerance);
        return FMU_ERROR;
    }
    if (tolerance_defined) f->s.rtol = tolerance;
    f->s.t = f->s.t_start = f->s.u_time = start;
    f->start_known = 0;
    fmu_forget(f);
    return FMU_OK;
}

static int fmu_exit_initialization(fmu_instance *f) {
    const int status = fmu_slopes(f);
    if (status != FMU_OK) return status;
    f->s.mode = f->kind == FMU_CO_SIMULATION && !f->event_mode ? FMU_STEP : FMU_EVENT;
    f->s.touched = f->s.event_due = 0;
    return FMU_OK;
}

static int fmu_terminate(fmu_instance *f) {
    const int status = FMU_TERMINAL >= 0 && f->s.mode != FMU_FAILED ? fmu_event(f, NULL, 0, 1) : FMU_OK;
    f->s.mode = FMU_TERMINATED;
    return status;
}

/* The method of the unit from q->t0 to q->t1. The explicit ones begin anew in every communication step, since inputs jump
   there; Adams begins with a step that those before it suggest. */
static int fmu_solve(fmu_instance *f, ac_problem *q, ac_work *w) {
#if FMU_SOLVER == FMU_RODAS5P
    return ac_integrate(q, w, &f->s.control, NULL);
#else
    const double span = q->t1 - q->t0;
    q->method = FMU_SOLVER == FMU_RK4 ? AC_RK4 : AC_ADAMS;
    q->first_step = FMU_SOLVER == FMU_RK4 ? span / ceil(span / FMU_DT - 1e-9) : ac_min(f->s.control.h, span);
    const int result = FMU_SOLVER == FMU_RK4 ? ac_fixed_steps(q, w, &f->explicit_work) : ac_adams(q, w, &f->explicit_work);
    if (q->accepted > 2) f->s.control.h = 0.5 * (q->t_end - q->t0) / q->accepted; /* fewer may be a rest, and tell nothing */
    return result;
#endif
}

/* Integrates to `stop`, or to the first event before it: AC_DONE, AC_EVENT or why it failed. */
static int fmu_integrate(fmu_instance *f, double stop) {
    ac_work *w = fmu_prepare(f);
    ac_problem q;
    memset(&q, 0, sizeof q);
    q.t0 = q.t_end = f->s.t, q.t1 = stop, q.rtol = f->s.rtol, q.atol = f->atol, q.max_steps = FMU_MAX_STEPS;
    q.smallest = 1e-14 * ac_max(fabs(stop), stop - f->s.t);
    q.located = 1, q.switched = f->switched, q.noise = f->noise;
    if (AC_NR > 0) fmu_find_noise(f);
    for (int i = 0; i < AC_N; i++) f->atol[i] = 0.1 * f->s.rtol * ac_nominal[i];
    memcpy(w->z, f->s.z, sizeof w->z);
    const int result = AC_N > 0 && stop > f->s.t ? fmu_solve(f, &q, w) : AC_DONE;
    memcpy(f->s.z, w->z, sizeof w->z);
    f->s.t = result == AC_DONE ? stop : q.t_end;
    fmu_forget(f);
    f->algebraic_known = 1; /* they are part of the solution */
    return result;
}

static int fmu_failed(fmu_instance *f, int result, double t1) {
    static const char *const why[] = {"", "too many steps", "the step size became too small", "a singular Jacobian"};
    fmu_say(f, FMU_DISCARD, "the solver stopped at t = %.9g s on the way to %.9g s: %s", f->s.t, t1,
            why[result <= AC_SINGULAR ? result : 0]);
    f->s.mode = FMU_FAILED;
    return FMU_DISCARD;
}

/* t1, or the time of the next samples, if that is sooner. */
static double fmu_until_sample(fmu_instance *f, double t1) {
    if (FMU_SAMPLES == 0) return t1;
    fmu_event_values(f);
    return ac_min(fmu_next_sample(f, f->s.t), t1);
}

/* Conditions that what was set has switched. */
static int fmu_react(fmu_instance *f) {
    if (FMU_HYBRID == 0 || !f->s.touched) return FMU_OK;
    f->s.touched = 0;
    return fmu_disagreeing(f, f->switched) ? fmu_event(f, f->switched, 0, 0) : FMU_OK;
}

/* Events so close together that time does not pass. */
static int fmu_chatters(fmu_instance *f, double since, double h, int *close) {
    *close = f->s.t - since < 1e-10 * h ? *close + 1 : 0;
    if (*close <= FMU_CLOSE_EVENTS) return 0;
    fmu_say_slots(f, "a condition chatters: it switches again as soon as it has switched:");
    return 1;
}

/* To t1, from event to event. *early: the step ended at an event before t1; *due: the event is left to event mode. */
static int fmu_stretches(fmu_instance *f, double t1, int *early, int *due) {
    const double h = t1 - f->s.t;
    for (int close = 0; f->s.t < t1 && !f->s.ended;) {
        const double since = f->s.t;
        const int result = fmu_integrate(f, fmu_until_sample(f, t1));
        if (result != AC_DONE && result != AC_EVENT) return fmu_failed(f, result, t1);
        const int sampled = FMU_SAMPLES > 0 && fmu_samples_due(f), event = result == AC_EVENT || sampled;
        *early = event && f->s.t < t1 && f->early_return;
        if (event && f->event_mode && (*early || f->s.t >= t1)) {
            *due = 1;
            return FMU_OK;
        }
        int status = FMU_OK;
        if (sampled) f->s.t = ac_min(fmu_moment(f), t1);
        if (event) status = fmu_event(f, result == AC_EVENT ? f->switched : NULL, sampled, 0);
        else if (FMU_ASSERTS > 0) fmu_event_values(f), status = fmu_assert(f);
        if (status == FMU_OK && event && fmu_chatters(f, since, h, &close)) status = FMU_DISCARD;
        if (status != FMU_OK) f->s.mode = FMU_FAILED;
        if (status != FMU_OK || *early) return status;
    }
    return FMU_OK;
}

/* One communication step. */
static int fmu_do_step(fmu_instance *f, double t, double h, int *early, int *due) {
    const double close = 1e-9 * ac_max(fabs(t), ac_max(fabs(h), 1e-6));
    *early = *due = 0;
    if (!(fabs(t - f->s.t) <= close) || !(h >= 0.0) || h - h != 0.0) {
        fmu_say(f, FMU_ERROR, "a step of %.9g s at t = %.9g s is not possible: the instance is at t = %.9g s", h, t, f->s.t);
        return FMU_ERROR;
    }
    if (f->s.ended) {
        fmu_say(f, FMU_ERROR, "no step is possible: the model has ended the simulation at t = %.9g s", f->s.t);
        return FMU_ERROR;
    }
    int status = AC_N > AC_NX ? fmu_slopes(f) : FMU_OK;
    if (status == FMU_OK) status = fmu_react(f);
    return status == FMU_OK ? fmu_stretches(f, t + h, early, due) : status;
}

/* Whether the states have left the retained constraints further than the tolerance allows; they are put back if asked. */
static int fmu_restore(fmu_instance *f, int put_back) {
#if AC_NG > 0
    if (fmu_slopes(f) != FMU_OK) return 0;
    ac_work *w = fmu_prepare(f);
    memcpy(w->z1, f->s.z, sizeof w->z1);
    ac_project(w, NULL, f->s.t);
    double drift = 0.0;
    for (int i = 0; i < AC_NX; i++) drift = ac_max(drift, fabs(w->z1[i] - f->s.z[i]) / ac_nominal[i]);
    if (put_back) {
        memcpy(f->s.z, w->z1, sizeof w->z1);
        fmu_forget(f);
    }
    return drift > ac_max(f->s.rtol, 1e-10);
#else
    (void)f, (void)put_back;
    return 0;
#endif
}

/* Event mode: *changed tells whether states have new values, *next the time of the next event known, or infinity. */
static int fmu_update(fmu_instance *f, int *changed, double *next) {
    int status = FMU_OK;
    double before[AC_N + 1];
    memcpy(before, f->s.z, sizeof before);
    if (f->s.drifted) fmu_restore(f, 1);
    if (FMU_HYBRID > 0 && (f->s.event_due || f->s.touched)) {
        const int switched = fmu_disagreeing(f, f->switched), sampled = FMU_SAMPLES > 0 && fmu_samples_due(f);
        if (switched || sampled) status = fmu_event(f, switched ? f->switched : NULL, sampled, 0);
    }
    f->s.drifted = f->s.event_due = f->s.touched = 0;
    *changed = memcmp(before, f->s.z, sizeof(double) * AC_NX) != 0;
    *next = INFINITY;
    if (FMU_SAMPLES > 0) {
        fmu_event_values(f);
        *next = fmu_next_sample(f, f->s.t);
    }
    return status;
}

/* ---- saved states -------------------------------------------------------------------------------- */
typedef struct {
    unsigned magic, kind;
    char token[sizeof FMU_TOKEN];
    fmu_state s;
} fmu_saved;

static int fmu_is_saved(const fmu_instance *f, const fmu_saved *saved) {
    if (saved && saved->magic == FMU_MAGIC + 1 && !memcmp(saved->token, FMU_TOKEN, sizeof FMU_TOKEN) &&
        saved->kind == (unsigned)f->kind)
        return 1;
    fmu_say(f, FMU_ERROR, "this is not a saved state of the model `%s`", FMU_NAME);
    return 0;
}

static fmu_saved *fmu_new_saved(const fmu_instance *f) {
    fmu_saved *saved = calloc(1, sizeof *saved);
    if (saved) {
        saved->magic = FMU_MAGIC + 1, saved->kind = (unsigned)f->kind;
        memcpy(saved->token, FMU_TOKEN, sizeof FMU_TOKEN);
    } else {
        fmu_say(f, FMU_ERROR, "there is no memory for a saved state");
    }
    return saved;
}

static int fmu_save(fmu_instance *f, void **place) {
    if (*place && !fmu_is_saved(f, *place)) return FMU_ERROR;
    if (!*place) *place = fmu_new_saved(f);
    if (!*place) return FMU_ERROR;
    ((fmu_saved *)*place)->s = f->s;
    return FMU_OK;
}

static int fmu_load(fmu_instance *f, const void *place) {
    if (!fmu_is_saved(f, place)) return FMU_ERROR;
    f->s = ((const fmu_saved *)place)->s;
    f->constants_known = f->start_known = 0;
    fmu_forget(f);
    f->algebraic_known = f->s.mode != FMU_INITIALIZATION && f->s.mode != FMU_INSTANTIATED;
    return FMU_OK;
}

static int fmu_drop(const fmu_instance *f, void **place) {
    if (*place) {
        if (!fmu_is_saved(f, *place)) return FMU_ERROR;
        ((fmu_saved *)*place)->magic = 0;
        free(*place);
    }
    *place = NULL;
    return FMU_OK;
}

static int fmu_to_bytes(const fmu_instance *f, const void *place, void *bytes, size_t size) {
    if (!fmu_is_saved(f, place)) return FMU_ERROR;
    if (size < sizeof(fmu_saved)) {
        fmu_say(f, FMU_ERROR, "a serialized state needs %lu bytes, not %lu", (unsigned long)sizeof(fmu_saved), (unsigned long)size);
        return FMU_ERROR;
    }
    memcpy(bytes, place, sizeof(fmu_saved));
    return FMU_OK;
}

static int fmu_from_bytes(const fmu_instance *f, const void *bytes, size_t size, void **place) {
    if (size < sizeof(fmu_saved)) {
        fmu_say(f, FMU_ERROR, "a serialized state has %lu bytes, not %lu", (unsigned long)sizeof(fmu_saved), (unsigned long)size);
        return FMU_ERROR;
    }
    fmu_saved *saved = fmu_new_saved(f);
    if (!saved) return FMU_ERROR;
    memcpy(saved, bytes, sizeof *saved);
    if (!fmu_is_saved(f, saved)) return free(saved), FMU_ERROR;
    if (*place && fmu_drop(f, place) != FMU_OK) return free(saved), FMU_ERROR;
    *place = saved;
    return FMU_OK;
}

/* ---- model exchange ------------------------------------------------------------------------------ */
static int fmu_refuse_size(const fmu_instance *f, size_t given, int wanted, const char *what) {
    if (given == (size_t)wanted) return 0;
    fmu_say(f, FMU_ERROR, "the model has %d %s, not %lu", wanted, what, (unsigned long)given);
    return 1;
}

static int fmu_set_time(fmu_instance *f, double t) {
    if (!(t - t == 0.0)) {
        fmu_say(f, FMU_ERROR, "the time is not a finite number");
        return FMU_ERROR;
    }
    if (t != f->s.t) fmu_forget(f);
    f->s.t = t;
    return FMU_OK;
}

static int fmu_set_states(fmu_instance *f, const double *x, size_t n) {
    if (fmu_refuse_size(f, n, AC_NX, "continuous states")) return FMU_ERROR;
    for (int i = 0; i < AC_NX; i++)
        if (!(x[i] - x[i] == 0.0)) {
            fmu_say(f, FMU_ERROR, "the value for state %d is not a finite number", i);
            return FMU_ERROR;
        }
    for (int i = 0; i < AC_NX; i++) f->s.z[i] = x[i];
    fmu_forget(f);
    return FMU_OK;
}

static int fmu_get_states(fmu_instance *f, double *x, size_t n) {
    if (fmu_refuse_size(f, n, AC_NX, "continuous states")) return FMU_ERROR;
    const int status = f->s.mode == FMU_INITIALIZATION ? fmu_slopes(f) : FMU_OK;
    if (status != FMU_OK) return status;
    for (int i = 0; i < AC_NX; i++) x[i] = f->s.z[i];
    return FMU_OK;
}

static int fmu_get_slopes(fmu_instance *f, double *dx, size_t n) {
    if (fmu_refuse_size(f, n, AC_NX, "continuous states")) return FMU_ERROR;
    const int status = fmu_slopes(f);
    if (status != FMU_OK) return status;
    for (int i = 0; i < AC_NX; i++) dx[i] = f->slopes[i];
    return FMU_OK;
}

static int fmu_get_nominals(const fmu_instance *f, double *nominals, size_t n) {
    if (fmu_refuse_size(f, n, AC_NX, "continuous states")) return FMU_ERROR;
    for (int i = 0; i < AC_NX; i++) nominals[i] = ac_nominal[i];
    return FMU_OK;
}

static int fmu_get_indicators(fmu_instance *f, double *indicators, size_t n) {
    if (fmu_refuse_size(f, n, AC_NR, "event indicators")) return FMU_ERROR;
    const int status = AC_NR > 0 ? fmu_slopes(f) : FMU_OK;
    if (status != FMU_OK || AC_NR == 0) return status;
    fmu_event_values(f);
    for (int k = 0; k < AC_NR; k++) indicators[k] = fmu_indicator(f, k);
    return FMU_OK;
}

/* Assertions at the end of an importer's step. */
static int fmu_check(fmu_instance *f) {
    if (FMU_ASSERTS == 0) return FMU_OK;
    const int status = fmu_slopes(f);
    if (status != FMU_OK) return status;
    fmu_event_values(f);
    return fmu_assert(f);
}
