/* Values of variables: the start, derivatives, all variables; what may be set when. */

/* Start values from parameters, then consistent values. */
static int fmu_initialize(fmu_instance *f) {
    if (f->start_known) return f->start_status;
    fmu_prepare(f);
    memcpy(f->starts, fmu_base_start, sizeof fmu_base_start);
    ac_starts(f->s.p, f->starts);
    for (int i = 0; i < FMU_STARTS; i++) {
        const double value = f->starts[fmu_start_source[i]];
        const double given = f->s.start_set[i] ? f->s.start[i] : fmu_start_sign[i] * value;
        if (i < AC_N) f->s.z[i] = given == given ? given : 0.0;
        else f->wanted[i - AC_N] = given;
    }
    for (int i = 0; i < FMU_STARTS; i++)
        if (f->s.start_set[i]) f->starts[fmu_start_source[i]] = fmu_start_sign[i] * f->s.start[i];
    const ac_given given = {fmu_fixed, fmu_ease, f->wanted, FMU_WANTED};
    f->start_status = fmu_hybrid_start(f, &given);
    f->start_known = 1;
    fmu_forget(f);
    f->algebraic_known = 1;
    if (!(f->left <= FMU_CONSISTENT)) f->start_status = FMU_ERROR;
    return f->start_status;
}

/* Derivatives of the states; algebraic unknowns are found on the way. */
static int fmu_slopes(fmu_instance *f) {
    if (f->s.mode == FMU_INITIALIZATION && fmu_initialize(f) != FMU_OK) {
        if (!(f->left <= FMU_CONSISTENT))
            fmu_say(f, FMU_ERROR, "the conditions of the start have no solution near the start values (left over: %.3g)", f->left);
        return FMU_ERROR;
    }
    if (f->slopes_known) return FMU_OK;
    ac_work *w = fmu_prepare(f);
    if (f->algebraic_known || AC_N == AC_NX) {
        ac_value(w, f->s.t, f->s.z, f->slopes);
    } else {
        memcpy(w->y, f->s.z, sizeof w->y);
        if (ac_slope(w, f->s.t, w->y, f->slopes)) {
            fmu_say(f, FMU_DISCARD, "the algebraic equations have no solution near the last one at t = %.9g s", f->s.t);
            return FMU_DISCARD;
        }
        memcpy(f->s.z, w->y, sizeof w->y);
        f->algebraic_known = 1;
    }
    for (int i = 0; i < AC_NX; i++)
        if (!(f->slopes[i] - f->slopes[i] == 0.0)) {
            fmu_say(f, FMU_DISCARD, "the derivative of state %d is not a finite number at t = %.9g s", i, f->s.t);
            return FMU_DISCARD;
        }
    f->slopes_known = 1;
    return FMU_OK;
}

static int fmu_values(fmu_instance *f) {
    const int status = fmu_slopes(f);
    if (status != FMU_OK || f->values_known) return status;
    ac_work *w = fmu_prepare(f);
    ac_inputs(w, f->s.t);
    ac_observe(&w->m, f->s.t, f->s.z, f->all);
    f->values_known = 1;
    return FMU_OK;
}

/* An input at the time of the instance. */
static double fmu_input(const fmu_instance *f, int i) {
    return f->s.p[AC_NPAR + i] + (f->s.t - f->s.u_time) * f->s.du[i];
}

/* Inputs as they are now, linear from now on. */
static void fmu_rebase(fmu_instance *f) {
    for (int i = 0; i < AC_NU; i++) f->s.p[AC_NPAR + i] = fmu_input(f, i);
    f->s.u_time = f->s.t;
}

static int fmu_unknown(const fmu_instance *f, unsigned reference) {
    if (reference < FMU_VARIABLES) return 0;
    fmu_say(f, FMU_ERROR, "there is no variable with value reference %u", reference);
    return 1;
}

static int fmu_get(fmu_instance *f, size_t n, const unsigned *references, double *values) {
    int status = FMU_OK, evaluated = 0;
    for (size_t k = 0; k < n; k++) {
        if (fmu_unknown(f, references[k])) return FMU_ERROR;
        const int i = fmu_index[references[k]], kind = fmu_kind[references[k]];
        if (!evaluated && kind >= FMU_VARIABLE && kind != FMU_ZERO) {
            evaluated = 1;
            if ((status = fmu_values(f)) != FMU_OK) return status;
        }
        if (kind == FMU_CALCULATED) fmu_prepare(f);
        if (kind == FMU_INDICATOR) fmu_event_values(f);
        values[k] = kind == FMU_PARAMETER || kind == FMU_CALCULATED ? f->s.p[i]
                    : kind == FMU_INPUT ? fmu_input(f, i - AC_NPAR)
                    : kind == FMU_TIME ? f->s.t
                    : kind == FMU_VARIABLE ? fmu_sign[references[k]] * f->all[i]
                    : kind == FMU_DERIVATIVE ? f->slopes[i]
                    : kind == FMU_INDICATOR ? fmu_indicator(f, i) : 0.0;
    }
    return status;
}

/* Whether a variable may be set now. Importers also set single states in model exchange, as they set all of them. */
static int fmu_settable(const fmu_instance *f, unsigned reference) {
    const int kind = fmu_kind[reference], mode = f->s.mode;
    if (kind == FMU_INPUT || kind == FMU_PARAMETER) return (mode & (FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_INITIALIZED)) != 0;
    if (mode & (FMU_EVENT | FMU_CONTINUOUS)) return f->kind == FMU_MODEL_EXCHANGE && fmu_state_number[reference] >= 0;
    return fmu_start[reference] >= 0 && (mode & (FMU_INSTANTIATED | FMU_INITIALIZATION));
}

static int fmu_set(fmu_instance *f, size_t n, const unsigned *references, const double *values) {
    for (size_t k = 0; k < n; k++) {
        const unsigned reference = references[k];
        if (fmu_unknown(f, reference)) return FMU_ERROR;
        const int i = fmu_index[reference], kind = fmu_kind[reference];
        if (!fmu_settable(f, reference)) {
            fmu_say(f, FMU_ERROR, "the variable with value reference %u cannot be set in this mode", reference);
            return FMU_ERROR;
        }
        if (!(values[k] - values[k] == 0.0)) {
            fmu_say(f, FMU_ERROR, "the value for the variable with value reference %u is not a finite number", reference);
            return FMU_ERROR;
        }
        if (kind == FMU_PARAMETER && (values[k] < fmu_low[i] || values[k] > fmu_high[i])) {
            fmu_say(f, FMU_DISCARD, "%.9g for the parameter with value reference %u lies outside its bounds [%.9g, %.9g]",
                    values[k], reference, fmu_low[i], fmu_high[i]);
            return FMU_DISCARD;
        }
        if (kind == FMU_PARAMETER) {
            f->s.p[i] = values[k];
            f->constants_known = 0;
        } else if (kind == FMU_INPUT) {
            fmu_rebase(f);
            f->s.p[i] = values[k];
            f->s.du[i - AC_NPAR] = 0.0;
        } else if (f->s.mode & (FMU_EVENT | FMU_CONTINUOUS)) {
            f->s.z[fmu_state_number[reference]] = fmu_sign[reference] * values[k];
        } else {
            f->s.start[fmu_start[reference]] = fmu_sign[reference] * values[k];
            f->s.start_set[fmu_start[reference]] = 1;
        }
    }
    if (n) {
        f->start_known = 0;
        f->s.touched = 1;
        fmu_forget(f);
    }
    return FMU_OK;
}
