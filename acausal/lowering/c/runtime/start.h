/* The consistent start as a function of the library. */
#include "initialize.h"

/* z: start values on entry, values at which all conditions hold on exit; inputs as they are in p. Returns the largest
   relative residual left, or a negative number where there is no memory. */
AC_EXPORT double acausal_start(
    const double *p, double t, const unsigned char *fixed, const double *ease, const double *wanted, int n_wanted,
    double *z) {
    ac_work *w = calloc(1, sizeof *w);
    ac_initial *a = calloc(1, sizeof *a);
    double left = -1.0;
    if (w && a) {
        ac_signal signals[AC_NU + 1];
        for (int i = 0; i < AC_NU; i++) signals[i].n = 1, signals[i].t = NULL, signals[i].v = p + AC_NPAR + i;
        const ac_given given = {fixed, ease, wanted, n_wanted};
        w->m.p = p, w->m.c = w->c, w->m.u = w->u, w->m.du = w->du, w->m.signals = signals;
        ac_constants(p, w->c);
        left = ac_initialize(w, a, &given, t, z);
    }
    free(a);
    free(w);
    return left;
}
