/* Other stiff methods on the compiled equations of a model without algebraic unknowns: which one the native engine
   should have. All have the same right-hand side, analytic Jacobian, fill-reducing factors, error norm and step-size
   control as the engine's Rodas5P; output inside a step is cubic Hermite.

   Rodas4: Hairer and Wanner, Solving Ordinary Differential Equations II, 2nd ed., Table VI.4.1 and its transformation.
   ESDIRK: Kvaerno (2004), BIT 44:489, order 5(4), with simplified Newton iterations; coefficients from the caller.
   BDF: CVODE of SUNDIALS with the compiled right-hand side and Jacobian, dense factors; -DWITH_CVODE.

   Build: cc -O2 -march=native -shared -fPIC -DMODEL='"model.c"' -I folder methods.c */
#include MODEL
#if AC_N != AC_NX || AC_NG > 0
#error "for models of states only"
#endif

typedef struct {
    int stages, order; /* order: of the error estimate plus one */
    double a[8][8], c[8], b[8], e[8], gamma; /* ESDIRK; b = last row of a, e = b - embedded */
} esdirk;

typedef struct {
    ac_work w;
    double base[AC_N], slope[8][AC_N], stage[AC_N], error[AC_N], f1[AC_N];
} method_work;

#define RODAS4 6
static const double r4_gamma = 0.25, r4_nodes[RODAS4] = {0.0, 0.386, 0.21, 0.63, 1.0, 1.0};
static const double r4_D[RODAS4] = {0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0};
#define R4_LAST 1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950
static const double r4_A[RODAS4][RODAS4] = {
    {0}, {1.544}, {0.9466785280815826, 0.2557011698983284},
    {3.314825187068521, 2.896124015972201, 0.9986419139977817}, {R4_LAST}, {R4_LAST, 1.0}};
static const double r4_C[RODAS4][RODAS4] = {
    {0}, {-5.6688}, {-2.430093356833875, -0.2063599157091915},
    {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
    {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
    {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};

/* z1 and the error of one step; 0, or 1 where a matrix is singular or an iteration does not converge. */
static int step_rodas4(method_work *m, double t, double h) {
    ac_work *w = &m->w;
    if (ac_factorise(w, 1.0 / (r4_gamma * h))) return 1;
    for (int s = 0; s < RODAS4; s++) {
        double *k = w->k[s];
        for (int i = 0; i < AC_N; i++) w->y[i] = w->z[i];
        for (int j = 0; j < s; j++)
            for (int i = 0; i < AC_N; i++) w->y[i] += r4_A[s][j] * w->k[j][i];
        if (s == 0) memcpy(k, w->f, sizeof w->f);
        else ac_value(w, t + r4_nodes[s] * h, w->y, k);
        for (int j = 0; j < s; j++)
            for (int i = 0; i < AC_N; i++) k[i] += r4_C[s][j] / h * w->k[j][i];
        for (int i = 0; i < AC_N; i++) k[i] += r4_D[s] * h * w->ft[i];
        ac_back(w, k);
    }
    for (int i = 0; i < AC_N; i++) {
        w->z1[i] = w->y[i] + w->k[RODAS4 - 1][i];
        m->error[i] = w->k[RODAS4 - 1][i];
    }
    return 0;
}

static double scaled(const double *v, const double *z, const double *z1, const double *atol, double rtol) {
    double worst = 0.0;
    for (int i = 0; i < AC_N; i++) {
        const double e = fabs(v[i]) / (atol[i] + rtol * ac_max(fabs(z[i]), fabs(z1[i])));
        if (!(e <= worst)) worst = e;
    }
    return worst;
}

static int step_esdirk(method_work *m, const esdirk *a, const double *atol, double rtol, double t, double h) {
    ac_work *w = &m->w;
    const double d = 1.0 / (a->gamma * h);
    if (ac_factorise(w, d)) return 1;
    memcpy(m->slope[0], w->f, sizeof w->f);
    for (int s = 1; s < a->stages; s++) {
        for (int i = 0; i < AC_N; i++) {
            m->base[i] = w->z[i];
            for (int j = 0; j < s; j++) m->base[i] += h * a->a[s][j] * m->slope[j][i];
            m->stage[i] = m->base[i] + h * a->gamma * m->slope[s - 1][i];
        }
        double before = 0.0;
        int turn = 0, converged = 0;
        for (; turn < 10 && !converged; turn++) {
            ac_value(w, t + a->c[s] * h, m->stage, w->y);
            for (int i = 0; i < AC_N; i++) w->y[i] -= d * (m->stage[i] - m->base[i]);
            ac_back(w, w->y);
            for (int i = 0; i < AC_N; i++) m->stage[i] += w->y[i];
            const double size = scaled(w->y, w->z, m->stage, atol, rtol);
            if (!(size - size == 0.0)) return 1;
            const double rate = turn ? size / before : 0.9;
            if (turn && rate >= 1.0) return 1;
            converged = size * rate / (1.0 - rate) <= 0.01 || size == 0.0;
            before = size;
        }
        if (!converged) return 1;
        for (int i = 0; i < AC_N; i++) m->slope[s][i] = d * (m->stage[i] - m->base[i]);
    }
    memcpy(w->z1, m->stage, sizeof w->z1);
    for (int i = 0; i < AC_N; i++) {
        m->error[i] = 0.0;
        for (int s = 0; s < a->stages; s++) m->error[i] += h * a->e[s] * m->slope[s][i];
    }
    return 0;
}

static void prepare(method_work *m, const double *p, const double *z0) {
    ac_work *w = &m->w;
    w->m.p = p, w->m.c = w->c, w->m.u = w->u, w->m.du = w->du;
    ac_constants(p, w->c);
    memcpy(w->z, z0, sizeof w->z);
}

/* Rodas4, or ESDIRK where its coefficients are given; 0, or 1 where the steps become too small. */
AC_EXPORT int method_run(
    const esdirk *a, double rtol, const double *atol, double t1, const double *z0, const double *p, long n_save,
    const double *save, double *out, long *steps) {
    method_work *m = calloc(1, sizeof *m);
    if (!m) return 1;
    ac_work *w = &m->w;
    prepare(m, p, z0);
    const double power = -1.0 / (a ? a->order : 4);
    ac_problem q = {.t1 = t1, .rtol = rtol, .atol = atol};
    double t = 0.0, error_before = 1e-4, h_before = 0.0;
    long saved = 0;
    int rejected = 0, accepted = 0, fresh = 1, failed = 0;
    ac_inputs(w, t);
    ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J);
    double h = ac_first_step(&q, w, 1.0);
    for (; saved < n_save && save[saved] <= t; saved++) memcpy(out + saved * AC_N, w->z, sizeof w->z);
    for (*steps = 0; t < t1; ++*steps) {
        if (h < 1e-14 * t1) {
            failed = 1;
            break;
        }
        const int last = h >= (t1 - t) * (1.0 - 1e-12);
        if (last) h = t1 - t;
        if (!fresh) ac_field_jacobian(&w->m, t, w->z, w->f, w->ft, w->J), fresh = 1;
        const int bad = a ? step_esdirk(m, a, atol, rtol, t, h) : step_rodas4(m, t, h);
        const double found = bad ? NAN : scaled(m->error, w->z, w->z1, atol, rtol);
        if (!(found - found == 0.0)) {
            h *= bad && a ? 0.3 : 0.1, rejected = 1;
            continue;
        }
        const double size = ac_max(found, 1e-10);
        double next = h * ac_clip(0.9 * pow(size, power), 0.2, 8.0);
        if (found > 1.0) {
            h = next, rejected = 1;
            continue;
        }
        if (accepted++) {
            const double predicted = 0.9 * (h / h_before) * pow(size * size / error_before, power) * h;
            next = ac_min(next, ac_clip(predicted, 0.2 * h, 8.0 * h));
        }
        if (rejected) next = ac_min(next, h);
        h_before = h, error_before = ac_max(size, 1e-2), rejected = 0;
        if (saved < n_save && save[saved] <= t + h) {
            ac_value(w, t + h, w->z1, m->f1);
            for (; saved < n_save && save[saved] <= t + h; saved++) {
                const double s = (save[saved] - t) / h, u = s * s * (3.0 - 2.0 * s);
                for (int i = 0; i < AC_N; i++)
                    out[saved * AC_N + i] = (1.0 - u) * w->z[i] + u * w->z1[i] + h * s * (1.0 - s) * (1.0 - s) * w->f[i]
                                            + h * s * s * (s - 1.0) * m->f1[i];
            }
        }
        memcpy(w->z, w->z1, sizeof w->z);
        t = last ? t1 : t + h;
        h = next, fresh = 0;
    }
    free(m);
    return failed;
}

#ifdef WITH_CVODE
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

static int right(sunrealtype t, N_Vector y, N_Vector dy, void *data) {
    ac_value(data, t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
}

static int slopes(sunrealtype t, N_Vector y, N_Vector dy, SUNMatrix j, void *data, N_Vector u, N_Vector v, N_Vector x) {
    ac_work *w = data;
    (void)dy, (void)u, (void)v, (void)x;
    ac_field_jacobian(&w->m, t, N_VGetArrayPointer(y), w->f, w->ft, w->J);
    for (int e = 0; e < AC_NZ; e++) SM_ELEMENT_D(j, ac_row[e], ac_column[e]) = w->J[e];
    return 0;
}

AC_EXPORT int bdf_run(
    double rtol, const double *atol, double t1, const double *z0, const double *p, long n_save, const double *save,
    double *out, long *steps) {
    method_work *m = calloc(1, sizeof *m);
    if (!m) return 1;
    prepare(m, p, z0);
    SUNContext context;
    SUNContext_Create(NULL, &context);
    N_Vector y = N_VNew_Serial(AC_N, context), tolerance = N_VNew_Serial(AC_N, context), shown = N_VNew_Serial(AC_N, context);
    memcpy(N_VGetArrayPointer(y), z0, sizeof m->w.z);
    memcpy(N_VGetArrayPointer(tolerance), atol, sizeof m->w.z);
    void *memory = CVodeCreate(CV_BDF, context);
    CVodeInit(memory, right, 0.0, y);
    CVodeSVtolerances(memory, rtol, tolerance);
    SUNMatrix matrix = SUNDenseMatrix(AC_N, AC_N, context);
    SUNLinearSolver linear = SUNLinSol_Dense(y, matrix, context);
    CVodeSetLinearSolver(memory, linear, matrix);
    CVodeSetJacFn(memory, slopes);
    CVodeSetUserData(memory, &m->w);
    CVodeSetMaxNumSteps(memory, 10000000);
    double t = 0.0;
    int failed = 0;
    for (long n = 0; n < n_save && !failed; n++) {
        while (t < save[n] && !failed) failed = CVode(memory, t1, y, &t, CV_ONE_STEP) < 0;
        if (n && !failed) CVodeGetDky(memory, save[n], 0, shown);
        memcpy(out + n * AC_N, n ? N_VGetArrayPointer(shown) : z0, sizeof m->w.z);
    }
    CVodeGetNumSteps(memory, steps);
    CVodeFree(&memory);
    SUNLinSolFree(linear);
    SUNMatDestroy(matrix);
    N_VDestroy(y), N_VDestroy(tolerance), N_VDestroy(shown);
    SUNContext_Free(&context);
    free(m);
    return failed;
}
#endif
