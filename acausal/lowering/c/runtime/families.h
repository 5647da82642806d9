/* Large systems: the Jacobian by compressed sweeps of tangents, LU factors by index arrays.

   Sources: Curtis, Powell and Reid (1974), J. Inst. Maths Applics 13 (compression); Davis (2006), Direct Methods for
   Sparse Linear Systems, ch. 6 (factors with a fixed pattern). */

static void ac_sweep(const ac_model *m, double t, ac_vector dt, const ac_vector *dz, ac_vector *df);
#define ac_color(m) ((m)->index[AC_COLOR_TABLE])

/* f, its rate with time, and the nonzeros of J: colours share a sweep, time is one colour more. */
static void ac_field_jacobian(const ac_model *m, double t, const double *z, double *f, double *ft, double *J) {
    const int *color = ac_color(m), *row = m->index[AC_ROW_TABLE], *column = m->index[AC_COLUMN_TABLE];
    ac_field(m, t, z, f);
    for (int first = 0; first <= AC_COLORS; first += AC_LANES) {
        ac_vector dt = ac_zero;
        for (int i = 0; i < AC_N; i++) {
            m->seed[i] = ac_zero;
            if (color[i] >= first && color[i] < first + AC_LANES) m->seed[i][color[i] - first] = 1.0;
        }
        if (AC_COLORS < first + AC_LANES) dt[AC_COLORS - first] = 1.0;
        ac_sweep(m, t, dt, m->seed, m->swept);
        for (int e = 0; e < AC_NZ; e++) {
            const int lane = color[column[e]] - first;
            if (lane >= 0 && lane < AC_LANES) J[e] = m->swept[row[e]][lane];
        }
        if (AC_COLORS < first + AC_LANES)
            for (int i = 0; i < AC_N; i++) ft[i] = m->swept[i][AC_COLORS - first];
    }
}

#if AC_NG > 0
/* The retained constraints and the nonzeros of their Jacobian. */
static void ac_invariants(const ac_model *m, double t, const double *z, double *g, double *G) {
    const int *color = m->index[AC_G_COLOR_TABLE], *row = m->index[AC_G_ROW_TABLE];
    const int *column = m->index[AC_G_COLUMN_TABLE];
    ac_vector dg[AC_NG];
    ac_constraints(m, t, z, g);
    for (int first = 0; first < AC_G_COLORS; first += AC_LANES) {
        for (int i = 0; i < AC_N; i++) {
            m->seed[i] = ac_zero;
            if (color[i] >= first && color[i] < first + AC_LANES) m->seed[i][color[i] - first] = 1.0;
        }
        ac_constraints_sweep(m, t, m->seed, dg);
        for (int e = 0; e < AC_NGZ; e++) {
            const int lane = color[column[e]] - first;
            if (lane >= 0 && lane < AC_LANES) G[e] = dg[row[e]][lane];
        }
    }
}
#endif

/* Row by row: F holds L and U of the permuted W = d M - J, then the inverse pivots. */
static int ac_factor(const ac_model *m, double d, const double *J, double *F) {
    const int *ptr = AC_LU_PTR(m), *col = AC_LU_COL(m), *entry = AC_LU_ENTRY(m), *mass = AC_LU_MASS(m);
    const int *diagonal = AC_LU_DIAGONAL(m), *columns = AC_LU_COLUMNS(m);
    double *inverse = F + AC_LU_SIZE, *line = m->f;
    int bad = 0;
    for (int i = 0; i < AC_N; i++) {
        double big = 0.0;
        for (int e = ptr[i]; e < ptr[i + 1]; e++) {
            double value = mass[e] ? d : 0.0;
            if (entry[e] >= 0) value -= J[entry[e]];
            line[col[e]] = value;
            big = ac_max(big, fabs(value) * m->nominal[columns[col[e]]]);
        }
        for (int e = ptr[i]; e < diagonal[i]; e++) {
            const int k = col[e];
            const double factor = line[k] *= inverse[k];
            if (factor != 0.0)
                for (int g = diagonal[k] + 1; g < ptr[k + 1]; g++) line[col[g]] -= factor * F[g];
        }
        for (int e = ptr[i]; e < ptr[i + 1]; e++) F[e] = line[col[e]];
        bad |= !(fabs(F[diagonal[i]]) * m->nominal[columns[i]] > AC_PIVOT * big);
        inverse[i] = 1.0 / F[diagonal[i]];
    }
    return bad;
}

#define AC_SPARSE_SOLVE(NAME, TYPE, ROOM)                                                              \
    static void NAME(const ac_model *m, const double *F, TYPE *b) {                                    \
        const int *ptr = AC_LU_PTR(m), *col = AC_LU_COL(m), *diagonal = AC_LU_DIAGONAL(m);             \
        const int *rows = AC_LU_ROWS(m), *columns = AC_LU_COLUMNS(m);                                  \
        TYPE *y = ROOM;                                                                                \
        for (int i = 0; i < AC_N; i++) {                                                               \
            TYPE sum = b[rows[i]];                                                                     \
            for (int e = ptr[i]; e < diagonal[i]; e++) sum -= F[e] * y[col[e]];                        \
            y[i] = sum;                                                                                \
        }                                                                                              \
        for (int i = AC_N - 1; i >= 0; i--) {                                                          \
            TYPE sum = y[i];                                                                           \
            for (int e = diagonal[i] + 1; e < ptr[i + 1]; e++) sum -= F[e] * y[col[e]];                \
            y[i] = sum * F[AC_LU_SIZE + i];                                                            \
        }                                                                                              \
        for (int i = 0; i < AC_N; i++) b[columns[i]] = y[i];                                           \
    }
AC_SPARSE_SOLVE(ac_solve, double, m->f)
#ifdef AC_TANGENTS
AC_SPARSE_SOLVE(ac_solve_vector, ac_vector, m->swept)

/* Tangents at (t, z): all variables there first. */
static void ac_field_tangent(const ac_model *m, double t, const double *z, const ac_vector *dz, ac_vector *df) {
    ac_field(m, t, z, m->f);
    ac_along(m, t, ac_zero, dz, df);
}

#if AC_NG > 0
static void ac_invariants_tangent(const ac_model *m, double t, const double *z, const ac_vector *dz, ac_vector *dg) {
    double g[AC_NG];
    ac_constraints(m, t, z, g);
    ac_constraints_along(m, t, dz, dg);
}
#endif
#endif
