/* Directional and adjoint derivatives: tangents of all variables along changes of states, inputs, parameters and time;
   algebraic unknowns, and in initialization mode the start, follow by the implicit-function theorem. */

/* The direction: a change of one variable. */
static int fmu_seed(fmu_instance *f, unsigned reference, double change, double *dt) {
    if (fmu_unknown(f, reference)) return FMU_ERROR;
    const int i = fmu_index[reference], kind = fmu_kind[reference], starting = f->s.mode == FMU_INITIALIZATION;
    const int slot = starting ? fmu_start[reference] : fmu_state_number[reference];
    if (kind == FMU_PARAMETER || kind == FMU_INPUT) f->dp[i][0] += change;
    else if (kind == FMU_TIME && !starting) *dt += change;
    else if (kind == FMU_VARIABLE && slot >= AC_N) f->d_wanted[slot - AC_N] += fmu_sign[reference] * change;
    else if (kind == FMU_VARIABLE && slot >= 0 && slot < AC_NX) f->dz[slot][0] += fmu_sign[reference] * change;
    else {
        fmu_say(f, FMU_ERROR, "the variable with value reference %u is not a known quantity in this mode", reference);
        return FMU_ERROR;
    }
    return FMU_OK;
}

/* The start along the direction: least change of what is free. */
static void fmu_start_along(fmu_instance *f) {
    ac_work *w = &f->work;
    ac_initial *a = &f->initial;
    ac_vector ds[AC_NS + 1], dg[AC_NI + 1];
    memset(ds, 0, sizeof ds);
    memset(dg, 0, sizeof dg);
    ac_starts_tangent(f->s.p, f->dp, ds);
    for (int i = 0; i < AC_NX; i++)
        if (!f->s.start_set[i]) f->dz[i] += fmu_start_sign[i] * ds[fmu_start_source[i]];
    if (AC_NI == 0) return;
    const ac_given given = {fmu_fixed, fmu_ease, f->wanted, FMU_WANTED};
    a->share = 0.0, a->n_rows = AC_NI, a->t = f->s.t;
    for (int j = 0; j < AC_N; j++) a->moves[j] = j >= AC_NX || (AC_NI > AC_NW && !fmu_fixed[j]);
    ac_residuals(w, a, &given, f->s.z);
    ac_scaled_rows(a, &given);
    ac_conditions_tangent(&w->m, f->s.t, f->s.z, f->dz, dg);
    for (int k = 0; k < FMU_WANTED; k++) {
        dg[AC_FIRST_WANTED + k][0] -= f->d_wanted[k];
        if (!f->s.start_set[AC_N + k]) dg[AC_FIRST_WANTED + k] -= fmu_start_sign[AC_N + k] * ds[fmu_start_source[AC_N + k]];
    }
    for (int i = 0; i < AC_NI; i++) {
        a->rhs[i] = -dg[i][0] / a->size[i];
        for (int j = 0; j < AC_N; j++) a->rows[i][j] /= a->size[i];
    }
    ac_least_change(a);
    for (int j = 0; j < AC_N; j++) f->dz[j] += fmu_ease[j] * a->delta[j];
}

/* The algebraic unknowns along the direction. */
static int fmu_algebraic_along(fmu_instance *f, double dt) {
    ac_work *w = &f->work;
    if (AC_N == AC_NX) return FMU_OK;
    ac_field_jacobian(&w->m, f->s.t, f->s.z, w->f, w->ft, w->J);
    ac_field_tangent(&w->m, f->s.t, f->s.z, f->dz, f->df);
    if (ac_factorise(w, 1e30)) {
        fmu_say(f, FMU_ERROR, "the algebraic equations are singular at t = %.9g s", f->s.t);
        return FMU_ERROR;
    }
    double follow[AC_N + 1];
    for (int i = 0; i < AC_N; i++) follow[i] = i < AC_NX ? 0.0 : f->df[i][0] + dt * w->ft[i];
    ac_back(w, follow);
    for (int i = AC_NX; i < AC_N; i++) f->dz[i][0] = follow[i];
    return FMU_OK;
}

/* Tangents of all variables along what f->dz and f->dp hold, and dt. */
static int fmu_along(fmu_instance *f, double dt) {
    const unsigned char none[AC_NP + 1] = {0};
    const ac_vector step = {dt};
    ac_work *w = fmu_prepare(f);
    ac_parameters_tangent(none, f->s.p, f->dp);
    ac_constants_tangent(f->s.p, f->dp, f->dc);
    ac_inputs(w, f->s.t);
    for (int i = 0; i < AC_NU; i++) w->du[i] = 0.0;
    if (f->s.mode == FMU_INITIALIZATION) fmu_start_along(f);
    else if (fmu_algebraic_along(f, dt) != FMU_OK) return FMU_ERROR;
    ac_observe_tangent(&w->m, f->s.t, f->s.z, step, f->dz, f->dall);
    return FMU_OK;
}

static double fmu_tangent_of(const fmu_instance *f, unsigned reference) {
    const int i = fmu_index[reference], kind = fmu_kind[reference];
    if (kind == FMU_VARIABLE) return fmu_sign[reference] * f->dall[i][0];
    if (kind == FMU_DERIVATIVE) return f->dall[fmu_slope_of[i]][0];
    if (kind == FMU_TIME || kind == FMU_ZERO) return 0.0;
    return f->dp[i][0];
}

/* Whether one of the variables is unknown, or has no derivatives. */
static int fmu_refuse_unknowns(const fmu_instance *f, size_t n, const unsigned *references) {
    for (size_t k = 0; k < n; k++) {
        if (fmu_unknown(f, references[k])) return 1;
        if (fmu_kind[references[k]] != FMU_INDICATOR) continue;
        fmu_say(f, FMU_ERROR, "the event indicator with value reference %u has no derivatives", references[k]);
        return 1;
    }
    return 0;
}

static void fmu_no_direction(fmu_instance *f) {
    memset(f->dp, 0, sizeof f->dp);
    memset(f->dz, 0, sizeof f->dz);
    memset(f->d_wanted, 0, sizeof f->d_wanted);
}

static int fmu_directional(
    fmu_instance *f, const unsigned *unknowns, size_t n_unknown, const unsigned *knowns, size_t n_known,
    const double *seed, double *sensitivity) {
    double dt = 0.0;
    if (fmu_refuse_unknowns(f, n_unknown, unknowns)) return FMU_ERROR;
    const int status = fmu_values(f);
    if (status != FMU_OK) return status;
    fmu_no_direction(f);
    for (size_t k = 0; k < n_known; k++)
        if (fmu_seed(f, knowns[k], seed[k], &dt) != FMU_OK) return FMU_ERROR;
    if (fmu_along(f, dt) != FMU_OK) return FMU_ERROR;
    for (size_t k = 0; k < n_unknown; k++) sensitivity[k] = fmu_tangent_of(f, unknowns[k]);
    return FMU_OK;
}

/* Rates of variables with time, along the solution. */
static AC_UNUSED int fmu_rates(fmu_instance *f, size_t n, const unsigned *references, double *values) {
    if (fmu_refuse_unknowns(f, n, references)) return FMU_ERROR;
    const int status = fmu_values(f);
    if (status != FMU_OK) return status;
    fmu_no_direction(f);
    for (int i = 0; i < AC_NX; i++) f->dz[i][0] = f->slopes[i];
    for (int i = 0; i < AC_NU; i++) f->dp[AC_NPAR + i][0] = f->s.du[i];
    if (fmu_along(f, 1.0) != FMU_OK) return FMU_ERROR;
    for (size_t k = 0; k < n; k++) values[k] = fmu_tangent_of(f, references[k]);
    return FMU_OK;
}

/* The transposed Jacobian times the seed, one known after the other. */
static AC_UNUSED int fmu_adjoint(
    fmu_instance *f, const unsigned *unknowns, size_t n_unknown, const unsigned *knowns, size_t n_known,
    const double *seed, double *sensitivity) {
    if (fmu_refuse_unknowns(f, n_unknown, unknowns)) return FMU_ERROR;
    const int status = fmu_values(f);
    if (status != FMU_OK) return status;
    for (size_t k = 0; k < n_known; k++) {
        double dt = 0.0;
        fmu_no_direction(f);
        if (fmu_seed(f, knowns[k], 1.0, &dt) != FMU_OK || fmu_along(f, dt) != FMU_OK) return FMU_ERROR;
        sensitivity[k] = 0.0;
        for (size_t i = 0; i < n_unknown; i++) sensitivity[k] += seed[i] * fmu_tangent_of(f, unknowns[i]);
    }
    return FMU_OK;
}
