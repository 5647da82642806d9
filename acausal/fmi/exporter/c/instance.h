/* One instance of the model behind FMI: its state, values of variables, messages. The same for all versions of FMI.

   The generated file equations.c is included here; it tells sizes, equations and the table of variables. There is no
   global state, and nothing but instantiation and the copies of FMU states allocates memory. */
#include <stdarg.h>
#include <stdio.h>

#if defined(_WIN32)
#define FMU_EXPORT __declspec(dllexport)
#else
#define FMU_EXPORT __attribute__((visibility("default")))
#endif
#define AC_EXPORT static AC_UNUSED
#define AC_TANGENTS
#define AC_LANES 1
#include "equations.c"
#include "initialize.h"
#include "stepping.h"

enum { FMU_OK, FMU_WARNING, FMU_DISCARD, FMU_ERROR, FMU_FATAL }; /* as in FMI 2 and 3 */
enum { FMU_MODEL_EXCHANGE, FMU_CO_SIMULATION };
enum { FMU_INSTANTIATED = 1, FMU_INITIALIZATION = 2, FMU_EVENT = 4, FMU_CONTINUOUS = 8, FMU_STEP = 16, FMU_FAILED = 32,
       FMU_TERMINATED = 64 };
#define FMU_INITIALIZED (FMU_EVENT | FMU_CONTINUOUS | FMU_STEP)
#define FMU_READABLE (FMU_INITIALIZATION | FMU_INITIALIZED | FMU_FAILED | FMU_TERMINATED)
#define FMU_ANY (FMU_INSTANTIATED | FMU_READABLE)

/* Kinds of variables in the table of equations.c: fmu_kind, fmu_index, fmu_sign, fmu_start. */
enum { FMU_PARAMETER, FMU_CALCULATED, FMU_INPUT, FMU_TIME, FMU_VARIABLE, FMU_DERIVATIVE, FMU_ZERO };

#define FMU_MAGIC 0x61636d75u
#define FMU_TOLERANCE 1e-6
#define FMU_CONSISTENT 1e-6  /* largest relative residual of a consistent start */
#define FMU_MAX_STEPS 1000000
#define FMU_DRIFT 1e-8       /* in nominal values: retained constraints further off than this are restored by an event */

typedef struct { /* all that a run depends on; no pointers, so that a copy is a saved FMU state */
    int mode, drifted;
    double t, t_start, rtol;
    double p[AC_NP + 1];                     /* parameters, inputs */
    double u_time, du[AC_NU + 1];            /* inputs are linear in time from u_time on */
    double z[AC_N + 1];
    double start[FMU_STARTS + 1];            /* start values that were set */
    unsigned char start_set[FMU_STARTS + 1];
    ac_control control;
} fmu_state;

typedef struct fmu_instance fmu_instance;
typedef void fmu_logger(const fmu_instance *, int status, const char *category, const char *message);

struct fmu_instance {
    unsigned magic;
    int kind, logging;
    fmu_logger *log;
    void *callback, *environment;
    char *name;
    fmu_state s;
    int constants_known, start_known, algebraic_known, slopes_known, values_known; /* what is up to date */
    double left;                             /* of the last initialization */
    double all[AC_NALL + 1], atol[AC_N + 1], slopes[AC_N + 1];
    double starts[AC_NS + 1], wanted[FMU_WANTED + 1];
    ac_signal signals[AC_NU + 1];
    double signal_time[2], signal_value[AC_NU + 1][2];
    double d_wanted[FMU_WANTED + 1];         /* directions of derivatives, and what follows from them */
    ac_vector dp[AC_NP + 1], dc[AC_NC + 1], dz[AC_N + 1], df[AC_N + 1], dall[AC_NALL + 1];
    ac_work work;
    ac_initial initial;
};

static void fmu_say(const fmu_instance *f, int status, const char *format, ...) {
    static const char *const category[] = {"logEvents", "logStatusWarning", "logStatusDiscard", "logStatusError",
                                           "logStatusFatal"};
    char text[512];
    va_list arguments;
    if (!f->log || (status == FMU_OK && !f->logging)) return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    f->log(f, status, category[status], text);
}

static void fmu_forget(fmu_instance *f) {
    f->slopes_known = f->values_known = f->algebraic_known = 0;
}

/* Default values, before anything is set. */
static void fmu_defaults(fmu_instance *f) {
    memset(&f->s, 0, sizeof f->s);
    f->s.mode = FMU_INSTANTIATED;
    f->s.rtol = FMU_TOLERANCE;
    for (int i = 0; i < AC_NP; i++) f->s.p[i] = fmu_default[i];
    for (int i = 0; i < FMU_STARTS; i++) f->s.start[i] = fmu_start_value[i];
    f->constants_known = f->start_known = 0;
    fmu_forget(f);
}

static fmu_instance *fmu_new(int kind, const char *name) {
    fmu_instance *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->name = malloc(strlen(name) + 1);
    if (!f->name) return free(f), NULL;
    strcpy(f->name, name);
    f->magic = FMU_MAGIC, f->kind = kind;
    ac_work *w = &f->work;
    w->m.p = f->s.p, w->m.c = w->c, w->m.dp = f->dp, w->m.dc = f->dc, w->m.signals = f->signals;
    w->m.u = w->u, w->m.du = w->du;
    for (int i = 0; i < AC_NU; i++) {
        f->signals[i].t = f->signal_time;
        f->signals[i].v = f->signal_value[i];
    }
    fmu_defaults(f);
    return f;
}

static void fmu_free(fmu_instance *f) {
    f->magic = 0;
    free(f->name);
    free(f);
}

/* What the equations are evaluated with: constants from parameters, inputs as signals. */
static ac_work *fmu_prepare(fmu_instance *f) {
    if (!f->constants_known) {
        const unsigned char none[AC_NP + 1] = {0};
        ac_parameters(none, f->s.p);
        ac_constants(f->s.p, f->work.c);
        f->constants_known = 1;
    }
    f->signal_time[0] = f->s.u_time;
    f->signal_time[1] = f->s.u_time + 1e30;
    for (int i = 0; i < AC_NU; i++) {
        f->signals[i].n = f->s.du[i] == 0.0 ? 1 : 2;
        f->signal_value[i][0] = f->s.p[AC_NPAR + i];
        f->signal_value[i][1] = f->s.p[AC_NPAR + i] + 1e30 * f->s.du[i];
    }
    return &f->work;
}

/* Start values from parameters, then consistent values. */
static int fmu_initialize(fmu_instance *f) {
    if (f->start_known) return f->left <= FMU_CONSISTENT ? FMU_OK : FMU_ERROR;
    ac_work *w = fmu_prepare(f);
    memcpy(f->starts, fmu_base_start, sizeof fmu_base_start);
    ac_starts(f->s.p, f->starts);
    for (int i = 0; i < FMU_STARTS; i++) {
        const double value = f->starts[fmu_start_source[i]];
        const double given = f->s.start_set[i] ? f->s.start[i] : fmu_start_sign[i] * value;
        if (i < AC_N) f->s.z[i] = given == given ? given : 0.0;
        else f->wanted[i - AC_N] = given;
    }
    const ac_given given = {fmu_fixed, fmu_ease, f->wanted, FMU_WANTED};
    f->left = ac_initialize(w, &f->initial, &given, f->s.t, f->s.z);
    f->start_known = 1;
    fmu_forget(f);
    f->algebraic_known = 1;
    return f->left <= FMU_CONSISTENT ? FMU_OK : FMU_ERROR;
}

/* Derivatives of the states; algebraic unknowns are found on the way. */
static int fmu_slopes(fmu_instance *f) {
    if (f->s.mode == FMU_INITIALIZATION && fmu_initialize(f) != FMU_OK) {
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
        values[k] = kind == FMU_PARAMETER || kind == FMU_CALCULATED ? f->s.p[i]
                    : kind == FMU_INPUT ? fmu_input(f, i - AC_NPAR)
                    : kind == FMU_TIME ? f->s.t
                    : kind == FMU_VARIABLE ? fmu_sign[references[k]] * f->all[i]
                    : kind == FMU_DERIVATIVE ? f->slopes[i] : 0.0;
    }
    return status;
}

/* Whether a variable may be set now. Importers also set single states in model exchange, as they set all of them. */
static int fmu_settable(const fmu_instance *f, unsigned reference) {
    const int kind = fmu_kind[reference], mode = f->s.mode;
    if (kind == FMU_INPUT || kind == FMU_PARAMETER) return (mode & (FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_INITIALIZED)) != 0;
    if (mode & (FMU_EVENT | FMU_CONTINUOUS)) return fmu_state_number[reference] >= 0;
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
        fmu_forget(f);
    }
    return FMU_OK;
}
