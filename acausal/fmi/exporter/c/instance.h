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
#define FMU_RODAS5P 0 /* values of FMU_SOLVER, the method of co-simulation; FMU_DT: largest step of RK4 [s] */
#define FMU_RK4 1
#define FMU_ADAMS 2
#include "equations.c"

enum { FMU_OK, FMU_WARNING, FMU_DISCARD, FMU_ERROR, FMU_FATAL }; /* as in FMI 2 and 3 */
enum { FMU_MODEL_EXCHANGE, FMU_CO_SIMULATION };
enum { FMU_INSTANTIATED = 1, FMU_INITIALIZATION = 2, FMU_EVENT = 4, FMU_CONTINUOUS = 8, FMU_STEP = 16, FMU_FAILED = 32,
       FMU_TERMINATED = 64 };
#define FMU_INITIALIZED (FMU_EVENT | FMU_CONTINUOUS | FMU_STEP)
#define FMU_READABLE (FMU_INITIALIZATION | FMU_INITIALIZED | FMU_FAILED | FMU_TERMINATED)
#define FMU_ANY (FMU_INSTANTIATED | FMU_READABLE)

/* Kinds of variables in the table of equations.c: fmu_kind, fmu_index, fmu_sign, fmu_start. */
enum { FMU_PARAMETER, FMU_CALCULATED, FMU_INPUT, FMU_TIME, FMU_VARIABLE, FMU_DERIVATIVE, FMU_ZERO, FMU_INDICATOR };

#define FMU_MAGIC 0x61636d75u
#define FMU_TOLERANCE 1e-6
#define FMU_CONSISTENT 1e-6  /* largest relative residual of a consistent start */
#define FMU_MAX_STEPS 1000000
#define FMU_TURNS 200        /* most solutions of one event */

enum { /* places in what ac_event_values gives, see hybrid.h */
    FMU_AT_PRES = FMU_FLOORS, FMU_AT_CONDITIONS = FMU_AT_PRES + FMU_PRES, FMU_AT_REINITS = FMU_AT_CONDITIONS + FMU_CONDITIONS,
    FMU_AT_ASSERTS = FMU_AT_REINITS + 2 * FMU_REINITS, FMU_AT_ENDS = FMU_AT_ASSERTS + FMU_ASSERTS,
    FMU_AT_SAMPLES = FMU_AT_ENDS + FMU_ENDS, FMU_EVENT_VALUES = FMU_AT_SAMPLES + 2 * FMU_SAMPLES,
    FMU_FIRST_SLOT = AC_NPAR + AC_NU, FMU_HYBRID = AC_NR + FMU_SLOTS + FMU_EVENT_VALUES
};

typedef struct { /* all that a run depends on; no pointers, so that a copy is a saved FMU state */
    int mode, drifted;
    int touched, event_due, ended;           /* something was set; an event is to be carried out; terminate() was met */
    double sampled_until;                    /* time of the last samples */
    double t, t_start, rtol;
    double p[AC_NP + 1];                     /* parameters, inputs */
    double u_time, du[AC_NU + 1];            /* inputs are linear in time from u_time on */
    double z[AC_N + 1];
    double start[FMU_STARTS + 1];            /* start values that were set */
    unsigned char start_set[FMU_STARTS + 1];
    ac_control control;
    unsigned char before[FMU_CONDITIONS + 1], warned[FMU_ASSERTS + 1];
} fmu_state;

typedef struct fmu_instance fmu_instance;
typedef void fmu_logger(const fmu_instance *, int status, const char *category, const char *message);

struct fmu_instance {
    unsigned magic;
    int kind, logging, event_mode, early_return; /* the last two in co-simulation of FMI 3 */
    fmu_logger *log;
    void *callback, *environment;
    char *name;
    fmu_state s;
    int constants_known, start_known, algebraic_known, slopes_known, values_known; /* what is up to date */
    int start_status;
    double left;                             /* of the last initialization */
    double all[AC_NALL + 1], atol[AC_N + 1], slopes[AC_N + 1];
    double starts[AC_NS + 1], wanted[FMU_WANTED + 1];
    ac_signal signals[AC_NU + 1];
    double signal_time[2], signal_value[AC_NU + 1][2];
    double d_wanted[FMU_WANTED + 1];         /* directions of derivatives, and what follows from them */
    ac_vector dp[AC_NP + 1], dc[AC_NC + 1], dz[AC_N + 1], df[AC_N + 1], dall[AC_NALL + 1];
    double roots[AC_NR + 1], events[FMU_EVENT_VALUES + 1]; /* at events */
    unsigned char slot_changed[FMU_SLOTS + 1], due[FMU_SAMPLES + 1];
    double noise[AC_NR + 1];
    int switched[AC_NR + 1];
    unsigned long long tried[FMU_TURNS + 1];
    ac_work work;
#if FMU_SOLVER != FMU_RODAS5P
    ac_explicit_work explicit_work;
#endif
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
