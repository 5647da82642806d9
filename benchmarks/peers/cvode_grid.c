/* The trajectory of the CVODE program for the crane, from which its error is measured: the same steps as its own run
   (one step at a time towards the same end, interpolated at the output times), no timing.
   Build: cc -O3 -march=native -DPROGRAM='"path/kbc_cvode.c"' cvode_grid.c -o cvode_grid (libraries as in that file)
   Run:   cvode_grid compliant|rigid RTOL POINTS -> a line a time: the states. */
#define main timed_main
#include PROGRAM
#undef main

int main(int argc, char **argv) {
  rigid = argc > 1 && !strcmp(argv[1], "rigid");
  double rtol = argc > 2 ? atof(argv[2]) : 1e-6, lo = 0, hi = 1.2, L, h, dh, y0[12] = {0}, end = 20.0;
  int points = argc > 3 ? atoi(argv[3]) : 401, n = rigid ? 10 : 12, next = 0;
  for (int i = 0; i < 100; i++) {
    double middle = (lo + hi) / 2;
    geo(middle, &L, &h, &dh);
    if (L - L0 > 1) hi = middle;
    else lo = middle;
  }
  geo(lo, &L, &h, &dh);
  double F0 = m * g * r * cos(lo) / h, Aa = M_PI / 4 * bore * bore, Ab = Aa - M_PI / 4 * rod * rod;
  double Pa = (F0 + pT * Ab) / Aa, first[7] = {pset, 0, pset, Pa + pcomp, Pa, Pa, pT};
  memcpy(y0, first, sizeof first);
  if (rigid) y0[7] = lo;
  else y0[7] = 1 + F0 / kc, y0[9] = lo;
  SUNContext context;
  SUNContext_Create(NULL, &context);
  N_Vector y = N_VNew_Serial(n, context), atol = N_VNew_Serial(n, context), shown = N_VNew_Serial(n, context);
  for (int i = 0; i < n; i++) {
    NV_Ith_S(y, i) = NV_Ith_S(shown, i) = y0[i];
    NV_Ith_S(atol, i) = rtol * (i == 1 ? 1e-3 : i < 7 ? 1e6 : 1);
  }
  void *memory = CVodeCreate(CV_BDF, context);
  CVodeInit(memory, f, 0, y);
  CVodeSVtolerances(memory, rtol, atol);
  SUNMatrix matrix = SUNDenseMatrix(n, n, context);
  SUNLinearSolver linear = SUNLinSol_Dense(y, matrix, context);
  CVodeSetLinearSolver(memory, linear, matrix);
  CVodeSetMaxNumSteps(memory, 10000000);
  double t = 0;
  while (next < points) {
    double at = end * next / (points - 1);
    while (t < at)
      if (CVode(memory, end, y, &t, CV_ONE_STEP) < 0) return 1;
    if (next) CVodeGetDky(memory, at, 0, shown);
    for (int i = 0; i < n; i++) printf("%.16g ", NV_Ith_S(shown, i));
    puts("");
    next++;
  }
  return 0;
}
