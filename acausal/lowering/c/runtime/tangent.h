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
