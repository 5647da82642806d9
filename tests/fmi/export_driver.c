/* A short life of some instances, for a memory checker: FMI is 2 or 3, TOKEN that of the unit. */
#include <stdio.h>
#include <stdlib.h>
#if FMI == 2
#include "fmi2_types.h"
#define CALL(NAME) fmi2##NAME
typedef fmi2Component instance;
typedef fmi2FMUstate state;
fmi2Component fmi2Instantiate(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *, fmi2Boolean, fmi2Boolean);
void fmi2FreeInstance(fmi2Component);
int fmi2SetupExperiment(fmi2Component, fmi2Boolean, double, double, fmi2Boolean, double);
int fmi2EnterInitializationMode(fmi2Component);
int fmi2DoStep(fmi2Component, double, double, fmi2Boolean);
int fmi2GetReal(fmi2Component, const unsigned *, size_t, double *);
int fmi2GetFMUstate(fmi2Component, state *), fmi2SetFMUstate(fmi2Component, state), fmi2FreeFMUstate(fmi2Component, state *);
int fmi2SerializedFMUstateSize(fmi2Component, state, size_t *), fmi2SerializeFMUstate(fmi2Component, state, char *, size_t);
int fmi2DeSerializeFMUstate(fmi2Component, const char *, size_t, state *);
int fmi2GetDirectionalDerivative(fmi2Component, const unsigned *, size_t, const unsigned *, size_t, const double *, double *);
#else
#include "fmi3_types.h"
#define CALL(NAME) fmi3##NAME
typedef fmi3Instance instance;
typedef fmi3FMUState state;
fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String, fmi3String, fmi3String, bool, bool, bool, bool, const unsigned *, size_t, void *, fmi3LogMessageCallback,
    fmi3IntermediateUpdateCallback);
void fmi3FreeInstance(fmi3Instance);
int fmi3EnterInitializationMode(fmi3Instance, bool, double, double, bool, double);
int fmi3DoStep(fmi3Instance, double, double, bool, bool *, bool *, bool *, double *);
int fmi3GetFloat64(fmi3Instance, const unsigned *, size_t, double *, size_t);
int fmi3GetFMUState(fmi3Instance, state *), fmi3SetFMUState(fmi3Instance, state), fmi3FreeFMUState(fmi3Instance, state *);
int fmi3SerializedFMUStateSize(fmi3Instance, state, size_t *), fmi3SerializeFMUState(fmi3Instance, state, char *, size_t);
int fmi3DeserializeFMUState(fmi3Instance, const char *, size_t, state *);
int fmi3GetAdjointDerivative(
    fmi3Instance, const unsigned *, size_t, const unsigned *, size_t, const double *, size_t, double *, size_t);
#endif
int CALL(ExitInitializationMode)(instance);
int CALL(Reset)(instance);

#define MUST(CALL_) \
    if (CALL_) return printf("%s failed\n", #CALL_), 1

#if FMI == 2
static void say(void *e, const char *name, fmi2Status status, const char *category, const char *message, ...) {
    (void)e, (void)status, (void)category;
    printf("%s: %s\n", name, message);
}
#else
static void say(void *e, fmi3Status status, const char *category, const char *message) {
    (void)e, (void)status, (void)category;
    printf("%s\n", message);
}
#endif

static int life(instance c) {
    const unsigned references[] = {0, 1, 2, 3, 4};
    double values[5], seed[2] = {1.0, 2.0}, result[2], t = 0.0;
    state saved = NULL, copy = NULL;
    size_t size = 0;
    (void)seed, (void)result;
#if FMI == 2
    MUST(fmi2SetupExperiment(c, 1, 1e-6, 0.0, 0, 0.0));
    MUST(fmi2EnterInitializationMode(c));
#else
    bool flags[3];
    double last;
    MUST(fmi3EnterInitializationMode(c, true, 1e-6, 0.0, false, 0.0));
#endif
    MUST(CALL(ExitInitializationMode)(c));
    for (int k = 0; k < 20; k++, t += 0.05) {
#if FMI == 2
        MUST(fmi2DoStep(c, t, 0.05, 1));
        MUST(fmi2GetReal(c, references, 5, values));
        fmi2GetDirectionalDerivative(c, references + 3, 2, references + 1, 2, seed, result);
        if (k == 10) {
            MUST(fmi2GetFMUstate(c, &saved));
            MUST(fmi2SerializedFMUstateSize(c, saved, &size));
            char *bytes = malloc(size);
            MUST(fmi2SerializeFMUstate(c, saved, bytes, size));
            MUST(fmi2DeSerializeFMUstate(c, bytes, size, &copy));
            free(bytes);
        }
#else
        MUST(fmi3DoStep(c, t, 0.05, true, flags, flags + 1, flags + 2, &last));
        MUST(fmi3GetFloat64(c, references, 5, values, 5));
        fmi3GetAdjointDerivative(c, references + 3, 2, references + 1, 2, seed, 2, result, 2);
        if (k == 10) {
            MUST(fmi3GetFMUState(c, &saved));
            MUST(fmi3SerializedFMUStateSize(c, saved, &size));
            char *bytes = malloc(size);
            MUST(fmi3SerializeFMUState(c, saved, bytes, size));
            MUST(fmi3DeserializeFMUState(c, bytes, size, &copy));
            free(bytes);
        }
#endif
        for (int i = 0; i < 5; i++)
            if (values[i] > 1e100) return 1; /* depends on every value */
    }
#if FMI == 2
    MUST(fmi2SetFMUstate(c, copy));
    MUST(fmi2FreeFMUstate(c, &copy));
    MUST(fmi2FreeFMUstate(c, &saved));
#else
    MUST(fmi3SetFMUState(c, copy));
    MUST(fmi3FreeFMUState(c, &copy));
    MUST(fmi3FreeFMUState(c, &saved));
#endif
    return CALL(Reset)(c);
}

int main(void) {
#if FMI == 2
    const fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
#endif
    for (int k = 0; k < 20; k++) {
#if FMI == 2
        instance c = fmi2Instantiate("one", fmi2CoSimulation, TOKEN, "", &callbacks, 0, 1);
#else
        instance c = fmi3InstantiateCoSimulation("one", TOKEN, NULL, false, true, false, false, NULL, 0, NULL, say, NULL);
#endif
        if (!c) return 2;
        if (life(c) || life(c)) return 3;
        CALL(FreeInstance)(c);
    }
    return 0;
}
