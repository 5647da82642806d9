/* Linear first integrals sum c_i x_i are kept: what a step has lost of them by rounding is given back, to each state in
   proportion to its size, so that none changes by more than rounding of its own.
   Source: Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, IV.4, Eq. (4.5), in this norm. */

/* Their values at z. */
static AC_UNUSED void ac_sums(const double *z, double *sums) {
    for (int i = 0; i < AC_NK; i++) sums[i] = 0.0;
    for (int e = 0; e < AC_NKZ; e++) sums[ac_k_row[e]] += ac_k_value[e] * z[ac_k_column[e]];
}

/* The states in z moved to where their sums are as given. */
static AC_UNUSED void ac_keep(const double *sums, double *z) {
#if AC_NK > 0
    double left[AC_NK], matrix[AC_NK][AC_NX], normal[AC_NK * AC_NK];
    int pivot[AC_NK];
    memset(matrix, 0, sizeof matrix);
    ac_sums(z, left);
    for (int e = 0; e < AC_NKZ; e++) matrix[ac_k_row[e]][ac_k_column[e]] = ac_k_value[e];
    for (int i = 0; i < AC_NK; i++) {
        double size = 0.0;
        for (int k = 0; k < AC_NX; k++) size += matrix[i][k] * matrix[i][k] * fabs(z[k]);
        const double scale = size > 0.0 ? 1.0 / sqrt(size) : 0.0;
        for (int k = 0; k < AC_NX; k++) matrix[i][k] *= scale;
        left[i] = (sums[i] - left[i]) * scale;
    }
    for (int i = 0; i < AC_NK; i++)
        for (int j = 0; j < AC_NK; j++) {
            double sum = i == j ? 1e-14 : 0.0;
            for (int k = 0; k < AC_NX; k++) sum += matrix[i][k] * fabs(z[k]) * matrix[j][k];
            normal[i * AC_NK + j] = sum;
        }
    ac_dense_factor(AC_NK, normal, pivot);
    ac_dense_solve(AC_NK, normal, pivot, left);
    for (int k = 0; k < AC_NX; k++) {
        double move = 0.0;
        for (int i = 0; i < AC_NK; i++) move += matrix[i][k] * left[i];
        z[k] += fabs(z[k]) * move;
    }
#else
    (void)sums, (void)z;
#endif
}
