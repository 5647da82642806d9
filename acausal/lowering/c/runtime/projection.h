/* The point of an accepted step is put back onto the retained constraints g = 0, the algebraic unknowns following
   through their own equations: Eich (1993), SIAM J. Numer. Anal. 30(5), Eq. (2.4), scaled by nominal values. */

/* follow = -r_w^{-1} (r_x | r): how the algebraic unknowns move with the states. */
static void ac_follow(const ac_work *w, ac_projection *a) {
    enum { NW = AC_N - AC_NX };
    if (NW == 0) return;
    memset(a->rr, 0, sizeof a->rr);
    memset(a->follow, 0, sizeof a->follow);
    for (int e = 0; e < AC_NZ; e++) {
        const int i = ac_row[e] - AC_NX, j = ac_column[e];
        if (i < 0) continue;
        if (j >= AC_NX) a->rr[i * NW + j - AC_NX] = w->J[e];
        else a->follow[i][j] = -w->J[e];
    }
    for (int i = 0; i < NW; i++) a->follow[i][AC_NX] = -w->f[AC_NX + i];
    ac_dense_factor(NW, a->rr, a->rpivot);
    for (int j = 0; j <= AC_NX; j++) {
        double column[NW + 1];
        for (int i = 0; i < NW; i++) column[i] = a->follow[i][j];
        ac_dense_solve(NW, a->rr, a->rpivot, column);
        for (int i = 0; i < NW; i++) a->follow[i][j] = column[i];
    }
}

/* Scaled derivatives of the constraints along the states, their normal equations factorised. */
static void ac_normal(const ac_work *w, ac_projection *a) {
    memset(a->matrix, 0, sizeof a->matrix);
    for (int i = 0; i < AC_NG; i++) a->rhs[i] = a->g[i];
    for (int e = 0; e < AC_NGZ; e++) {
        const int i = ac_g_row[e], j = ac_g_column[e];
        if (j < AC_NX) {
            a->matrix[i][j] += a->G[e] * ac_nominal[j];
            continue;
        }
        for (int k = 0; k < AC_NX; k++) a->matrix[i][k] += a->G[e] * a->follow[j - AC_NX][k] * ac_nominal[k];
        a->rhs[i] += a->G[e] * a->follow[j - AC_NX][AC_NX];
    }
    for (int i = 0; i < AC_NG; i++) {
        double sum = 0.0;
        for (int k = 0; k < AC_NX; k++) sum += a->matrix[i][k] * a->matrix[i][k];
        a->size[i] = sum > 0.0 ? 1.0 / sqrt(sum) : 0.0;
        for (int k = 0; k < AC_NX; k++) a->matrix[i][k] *= a->size[i];
    }
    for (int i = 0; i < AC_NG; i++)
        for (int j = 0; j < AC_NG; j++) {
            double sum = i == j ? 1e-14 : 0.0;
            for (int k = 0; k < AC_NX; k++) sum += a->matrix[i][k] * a->matrix[j][k];
            a->normal[i * AC_NG + j] = sum;
        }
    ac_dense_factor(AC_NG, a->normal, a->pivot);
}

static void ac_project(ac_work *w, void *tangents, double t) {
    ac_projection *const a = &w->projection;
    double z[AC_N];
    for (int turn = 0; turn < 2; turn++) {
        ac_inputs(w, t);
        if (AC_N > AC_NX) ac_field_jacobian(&w->m, t, w->z1, w->f, w->y, w->J);
        ac_follow(w, a);
        ac_invariants(&w->m, t, w->z1, a->g, a->G);
        ac_normal(w, a);
        for (int i = 0; i < AC_NG; i++) a->rhs[i] *= a->size[i];
        ac_dense_solve(AC_NG, a->normal, a->pivot, a->rhs);
        for (int k = 0; k < AC_NX; k++) {
            z[k] = 0.0;
            for (int i = 0; i < AC_NG; i++) z[k] -= ac_nominal[k] * a->matrix[i][k] * a->rhs[i];
        }
        for (int j = AC_NX; j < AC_N; j++) {
            z[j] = a->follow[j - AC_NX][AC_NX];
            for (int k = 0; k < AC_NX; k++) z[j] += a->follow[j - AC_NX][k] * z[k];
        }
        for (int i = 0; i < AC_N; i++) w->z1[i] += z[i];
    }
#ifdef AC_TANGENTS
    ac_tangent_work *d = tangents;
    if (!d) return;
    /* The same steps for the tangents: constraints and algebraic equations hold to first order in the directions. */
    ac_vector dg[AC_NG], df[AC_N], x[AC_N];
    ac_field_tangent(&w->m, t, w->z1, d->dz1, df);
    ac_invariants_tangent(&w->m, t, w->z1, d->dz1, dg);
    for (int j = AC_NX; j < AC_N; j++) x[j] = -df[j];
    if (AC_N > AC_NX) ac_dense_solve_vector(AC_N - AC_NX, a->rr, a->rpivot, x + AC_NX);
    for (int e = 0; e < AC_NGZ; e++)
        if (ac_g_column[e] >= AC_NX) dg[ac_g_row[e]] += a->G[e] * x[ac_g_column[e]];
    for (int i = 0; i < AC_NG; i++) dg[i] *= a->size[i];
    ac_dense_solve_vector(AC_NG, a->normal, a->pivot, dg);
    for (int k = 0; k < AC_NX; k++) {
        x[k] = ac_zero;
        for (int i = 0; i < AC_NG; i++) x[k] -= ac_nominal[k] * a->matrix[i][k] * dg[i];
    }
    for (int j = AC_NX; j < AC_N; j++)
        for (int k = 0; k < AC_NX; k++) x[j] += a->follow[j - AC_NX][k] * x[k];
    for (int i = 0; i < AC_N; i++) d->dz1[i] += x[i];
#else
    (void)tangents;
#endif
}
