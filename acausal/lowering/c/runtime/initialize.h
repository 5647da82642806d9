/* Consistent values at the start: the conditions of the start are solved by steps of least change.

   Gauss-Newton with minimum-norm steps (Deuflhard 2011, Newton Methods for Nonlinear Problems, 4.4); where it fails from
   the given guesses, the conditions are turned on gradually (Allgower and Georg 2003, Introduction to Numerical
   Continuation Methods, 1.1), or it begins beside them. The least-squares problems are solved by one-sided Jacobi
   rotations of the rows (Golub and Van Loan 2013, Matrix Computations, 8.6.3), so that conditions may repeat each other.

   To be included after solver.h, for a system that is written out. Nothing here allocates memory. */

enum { AC_NW = AC_N - AC_NX, AC_FIRST_WANTED = AC_NW + AC_NG };

#define AC_ITERATIONS 100
#define AC_HOMOTOPY 20
#define AC_RANK 1e-11         /* singular values below this fraction of the largest are zero */
#define AC_CHANGES_NOTHING 1e-15
#define AC_SATISFIED 1e-9     /* relative residual from which no other attempt is made */

/* What is given at the start: masks of the states that keep their start values, and values of other variables. */
typedef struct {
    const unsigned char *fixed; /* (AC_NX) */
    const double *ease;         /* (AC_N) scale in which a variable is moved */
    const double *wanted;       /* (n_wanted) of the conditions from AC_FIRST_WANTED on */
    int n_wanted;
} ac_given;

typedef struct {
    double t, r[AC_NI + 1], r0[AC_NI + 1], G[AC_NIZ + 1], size[AC_NI + 1], rhs[AC_NI + 1], share;
    double rows[AC_NI + 1][AC_N], delta[AC_N], start[AC_N], found[AC_N], trial[AC_N];
    unsigned char moves[AC_N];
    int n_rows;                 /* conditions in use: all, or the algebraic equations alone */
} ac_initial;

/* Residuals of the conditions at z, less the share of the first ones that is not turned on yet. */
static void ac_residuals(ac_work *w, ac_initial *a, const ac_given *given, const double *z) {
    ac_inputs(w, a->t);
    ac_conditions(&w->m, a->t, z, a->r, a->G);
    for (int i = 0; i < given->n_wanted; i++) a->r[AC_FIRST_WANTED + i] -= given->wanted[i];
    for (int i = 0; i < AC_NI; i++) a->r[i] -= a->share * a->r0[i];
}

/* Scaled Jacobian, and the size of each row. */
static void ac_scaled_rows(ac_initial *a, const ac_given *given) {
    memset(a->rows, 0, sizeof a->rows);
    memset(a->size, 0, sizeof a->size);
    for (int e = 0; e < AC_NIZ; e++) {
        const int i = ac_i_row[e], j = ac_i_column[e];
        if (a->moves[j]) a->rows[i][j] = a->G[e] * given->ease[j];
        a->size[i] = ac_max(a->size[i], ac_max(fabs(a->G[e]) * ac_nominal[j], fabs(a->rows[i][j])));
    }
    for (int i = 0; i < AC_NI; i++)
        if (!(a->size[i] > 0.0)) a->size[i] = 1.0;
}

static double ac_residual_norm(const ac_initial *a) {
    double sum = 0.0;
    for (int i = 0; i < a->n_rows; i++) sum += a->r[i] / a->size[i] * (a->r[i] / a->size[i]);
    return sum - sum == 0.0 ? sqrt(sum) : INFINITY;
}

/* Largest residual relative to the change that the nominal value of some variable makes. */
static double ac_residual_left(const ac_initial *a) {
    double size[AC_NI + 1] = {0.0}, worst = 0.0;
    for (int e = 0; e < AC_NIZ; e++)
        size[ac_i_row[e]] = ac_max(size[ac_i_row[e]], fabs(a->G[e]) * ac_nominal[ac_i_column[e]]);
    for (int i = 0; i < a->n_rows; i++) {
        const double left = fabs(a->r[i]) / (size[i] > 0.0 ? size[i] : 1.0);
        worst = ac_worse(worst, left);
    }
    return worst - worst == 0.0 ? worst : INFINITY;
}

/* One rotation makes two rows orthogonal; 1 if there was something to do. */
static int ac_rotate(double *p, double *q, double *bp, double *bq) {
    double pp = 0.0, qq = 0.0, pq = 0.0;
    for (int j = 0; j < AC_N; j++) pp += p[j] * p[j], qq += q[j] * q[j], pq += p[j] * q[j];
    if (!(fabs(pq) > 1e-15 * sqrt(pp * qq)) || fabs(pq) < 1e-300) return 0;
    const double tau = (qq - pp) / (2.0 * pq);
    const double tangent = (tau >= 0.0 ? 1.0 : -1.0) / (fabs(tau) + sqrt(1.0 + tau * tau));
    const double c = 1.0 / sqrt(1.0 + tangent * tangent), s = c * tangent;
    for (int j = 0; j < AC_N; j++) {
        const double old = p[j];
        p[j] = c * old - s * q[j];
        q[j] = s * old + c * q[j];
    }
    const double old = *bp;
    *bp = c * old - s * *bq;
    *bq = s * old + c * *bq;
    return 1;
}

/* delta: least-squares solution of rows * delta = rhs of least norm. rows and rhs are used up. */
static void ac_least_change(ac_initial *a) {
    for (int sweep = 0, again = 1; again && sweep < 60; sweep++) {
        again = 0;
        for (int i = 0; i < a->n_rows; i++)
            for (int k = i + 1; k < a->n_rows; k++)
                again |= ac_rotate(a->rows[i], a->rows[k], a->rhs + i, a->rhs + k);
    }
    double square[AC_NI + 1], largest = 0.0;
    for (int i = 0; i < a->n_rows; i++) {
        square[i] = 0.0;
        for (int j = 0; j < AC_N; j++) square[i] += a->rows[i][j] * a->rows[i][j];
        largest = ac_max(largest, square[i]);
    }
    memset(a->delta, 0, sizeof a->delta);
    for (int i = 0; i < a->n_rows; i++)
        if (square[i] > AC_RANK * AC_RANK * largest)
            for (int j = 0; j < AC_N; j++) a->delta[j] += a->rhs[i] / square[i] * a->rows[i][j];
}

/* The root near z: steps of least norm, halved until the residual falls. Leaves residuals of the result in a. */
static void ac_root_near(ac_work *w, ac_initial *a, const ac_given *given, double *z) {
    ac_residuals(w, a, given, z);
    ac_scaled_rows(a, given);
    double norm = ac_residual_norm(a);
    for (int turn = 0; turn < AC_ITERATIONS && norm > 0.0 && norm < INFINITY; turn++) {
        for (int i = 0; i < a->n_rows; i++) {
            a->rhs[i] = -a->r[i] / a->size[i];
            for (int j = 0; j < AC_N; j++) a->rows[i][j] /= a->size[i];
        }
        ac_least_change(a);
        double length = 0.0, factor = 1.0, next = INFINITY;
        for (int j = 0; j < AC_N; j++) length = ac_max(length, fabs(a->delta[j]));
        if (!(length - length == 0.0)) break;
        for (; factor > 1e-9 && factor * length >= AC_CHANGES_NOTHING; factor *= 0.5) {
            for (int j = 0; j < AC_N; j++) a->trial[j] = z[j] + factor * a->delta[j] * given->ease[j];
            ac_residuals(w, a, given, a->trial);
            next = ac_residual_norm(a);
            if (next < norm) break;
        }
        if (!(next < norm)) break;
        memcpy(z, a->trial, sizeof a->trial);
        ac_scaled_rows(a, given);
        norm = ac_residual_norm(a);
    }
    ac_residuals(w, a, given, z);
}

static void ac_homotopy(ac_work *w, ac_initial *a, const ac_given *given, double *z) {
    a->share = 0.0;
    ac_residuals(w, a, given, z);
    memcpy(a->r0, a->r, sizeof a->r0);
    for (int k = 1; k <= AC_HOMOTOPY; k++) {
        a->share = 1.0 - (double)k / AC_HOMOTOPY;
        ac_root_near(w, a, given, z);
    }
    memset(a->r0, 0, sizeof a->r0);
}

/* From a guess beside z, where a slope may not vanish that vanishes there. */
static void ac_beside(ac_work *w, ac_initial *a, const ac_given *given, double *z, int attempt) {
    static const double sizes[6] = {1e-3, -1e-3, 0.1, -0.1, 1.0, -1.0}; /* upwards first, as in initial.py */
    unsigned long long state = 88172645463325252ULL + (unsigned)attempt; /* Marsaglia (2003), xorshift */
    for (int j = 0; j < AC_N; j++) {
        state ^= state << 13, state ^= state >> 7, state ^= state << 17;
        const double uniform = (double)(state >> 11) / 9007199254740992.0;
        if (a->moves[j]) z[j] += sizes[attempt] * ac_nominal[j] * uniform;
    }
    ac_root_near(w, a, given, z);
}

/* z: start values on entry, values at which all conditions hold on exit. Returns the largest relative residual left. */
static AC_UNUSED double ac_initialize(ac_work *w, ac_initial *a, const ac_given *given, double t, double *z) {
    const int conditions = AC_NI > AC_NW;
    if (AC_NI == 0) return 0.0;
    a->t = t, a->share = 0.0, a->n_rows = AC_NI;
    memset(a->r0, 0, sizeof a->r0);
    for (int j = 0; j < AC_N; j++) a->moves[j] = j >= AC_NX;
    if (conditions && AC_NW > 0) { /* the algebraic unknowns alone first, so that they do not pull at the states */
        memcpy(a->start, z, sizeof a->start);
        a->n_rows = AC_NW;
        ac_root_near(w, a, given, a->start);
        if (ac_residual_left(a) <= AC_SATISFIED) memcpy(z, a->start, sizeof a->start);
        a->n_rows = AC_NI;
    }
    for (int j = 0; conditions && j < AC_NX; j++) a->moves[j] = !given->fixed[j];
    memcpy(a->start, z, sizeof a->start);
    ac_root_near(w, a, given, z);
    double left = ac_residual_left(a);
    for (int attempt = -1; attempt < 6 && !(left <= AC_SATISFIED); attempt++) {
        memcpy(a->found, a->start, sizeof a->found);
        if (attempt < 0) ac_homotopy(w, a, given, a->found);
        else ac_beside(w, a, given, a->found, attempt);
        const double other = ac_residual_left(a);
        if (other < left) left = other, memcpy(z, a->found, sizeof a->found);
    }
    return left;
}
