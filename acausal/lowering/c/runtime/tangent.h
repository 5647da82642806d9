/* Tangents of an accepted step: each stage differentiated, W du = d(right-hand side) + dJ u. */

AC_DENSE_OUTPUT(ac_interpolate_vector, ac_vector)
AC_BACK(ac_back_vector, ac_vector, ac_solve_vector, ac_dense_solve_vector)

static void ac_step_tangent(ac_work *w, ac_tangent_work *d, double t, double h) {
    const double inverse = 1.0 / h;
    ac_inputs(w, t);
#ifdef AC_FAMILIES
    ac_model base = w->m; /* all variables at the start of the step, and their tangents */
    base.v = d->all, base.dv = d->d_all, base.dva = d->d_all_a;
    ac_field(&base, t, w->z, w->y);
    ac_along(&base, t, ac_zero, d->dz, d->dy);
    memset(w->y, 0, sizeof w->y);
    ac_second(&base, t, 1.0, w->y, d->dz, d->dft);
#else
    ac_jacobian_tangent(&w->m, t, w->z, d->dz, d->dJ, d->dft);
#endif
    for (int s = 0; s < 8; s++) {
        ac_vector *k = d->dk[s];
        for (int i = 0; i < AC_N; i++) w->y[i] = w->z[i], d->dy[i] = d->dz[i];
        for (int j = 0; j < s; j++) {
            const double a = ac_A[s][j];
            if (a != 0.0)
                for (int i = 0; i < AC_N; i++) w->y[i] += a * w->k[j][i], d->dy[i] += a * d->dk[j][i];
        }
        const double at = t + ac_nodes[s] * h;
        ac_inputs(w, at);
        ac_field_tangent(&w->m, at, w->y, d->dy, k);
        for (int j = 0; j < s; j++) {
            const double c = ac_C[s][j] * inverse;
            for (int i = 0; i < AC_NX; i++) k[i] += c * d->dk[j][i];
        }
        const double weight = ac_D[s] * h;
        if (weight != 0.0)
            for (int i = 0; i < AC_N; i++) k[i] += weight * d->dft[i];
#ifdef AC_FAMILIES
        ac_inputs(w, t);
        ac_second(&base, t, 0.0, w->k[s], d->dz, d->second);
        for (int i = 0; i < AC_N; i++) k[i] += d->second[i];
#else
        for (int e = 0; e < AC_NZ; e++) k[ac_row[e]] += w->k[s][ac_column[e]] * d->dJ[e];
#endif
        ac_back_vector(w, k);
    }
    for (int i = 0; i < AC_N; i++) d->dz1[i] = d->dz[i];
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < AC_N; i++) d->dz1[i] += ac_B[j] * d->dk[j][i];
    for (int r = 0; r < 3; r++)
        for (int i = 0; i < AC_N; i++) {
            d->dv[r][i] = ac_zero;
            for (int j = 0; j < 8; j++) d->dv[r][i] += ac_H[r][j] * d->dk[j][i];
        }
}

/* The solution may rest, and take long steps, while its tangents still move: their errors are held, too. What they are
   for needs fewer digits than the solution, and of a tangent that hardly moves a state none are needed. */
#define AC_TANGENT_LOOSE 100.0 /* tolerance of the tangents in units of that of the solution */
#define AC_TANGENT_LEAST 1e-6  /* size that counts, in nominal values where a parameter changes by its own size */

static void ac_tangent_grown(const ac_work *w, ac_tangent_work *d, const ac_vector *dz) {
    (void)w; /* large models keep the nominal values there */
    for (int i = 0; i < AC_NX; i++)
        for (int lane = 0; lane < AC_LANES; lane++)
            d->size[lane] = ac_max(d->size[lane], fabs(dz[i][lane]) / ac_nominal[i]);
}

/* Sizes of the tangents at the start of a stretch, in nominal values; the largest so far is what counts later. */
static void ac_tangent_begin(const ac_work *w, ac_tangent_work *d) {
    for (int lane = 0; lane < AC_LANES; lane++) {
        double moved = 0.0;
        for (int j = 0; j < AC_NP; j++)
            moved = ac_max(moved, fabs(w->m.dp[j][lane]) / (w->p[j] != 0.0 ? fabs(w->p[j]) : 1.0));
        d->size[lane] = AC_TANGENT_LEAST * moved;
    }
    ac_tangent_grown(w, d, d->dz);
}

/* Largest error of the tangents of the states in a step, in units of their tolerance. */
static double ac_tangent_error(const ac_problem *q, const ac_work *w, ac_tangent_work *d) {
    double worst = 0.0;
    ac_tangent_grown(w, d, d->dz1);
    for (int i = 0; i < AC_NX; i++)
        for (int lane = 0; lane < AC_LANES; lane++) {
            const double value = ac_max(fabs(d->dz[i][lane]), fabs(d->dz1[i][lane]));
            const double scale = q->atol[i] * d->size[lane] + q->rtol * value;
            if (scale > 0.0) worst = ac_worse(worst, fabs(d->dk[7][i][lane]) / scale);
        }
    return worst / AC_TANGENT_LOOSE;
}
