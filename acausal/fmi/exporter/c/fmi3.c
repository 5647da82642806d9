/* The functions of FMI 3.0, for model exchange and co-simulation. Every call is checked against the state machine of the
   standard (sections 2.3, 3.2 and 4.2); one that is refused leaves the instance as it is. */
#include "fmi3_types.h"
#include "instance.h"
#include "hybrid.h"
#include "values.h"
#include "advance.h"
#include "directional.h"

#define FMI3(NAME) FMU_EXPORT fmi3Status fmi3FullName(fmi3##NAME)

static fmu_instance *instance_of(fmi3Instance c) {
    fmu_instance *f = c;
    return f && f->magic == FMU_MAGIC ? f : NULL;
}

/* An instance in one of these modes, or the function returns an error. */
#define NEEDS(NAME, MODES)                   \
    fmu_instance *const f = instance_of(c);  \
    if (!f || fmu_refuse(f, "fmi3" NAME, MODES)) return fmi3Error
#define NEEDS_KIND(NAME, KIND, MODES)                                        \
    fmu_instance *const f = instance_of(c);                                  \
    if (!f || fmu_refuse_kind(f, "fmi3" NAME, KIND) || fmu_refuse(f, "fmi3" NAME, MODES)) return fmi3Error
#define NEEDS_POINTER(NAME, MISSING) \
    if (fmu_refuse_pointer(f, "fmi3" NAME, MISSING)) return fmi3Error
#define NEEDS_COUNT(NAME, GIVEN, WANTED)                                                                    \
    if ((GIVEN) != (WANTED)) {                                                                              \
        fmu_say(f, FMU_ERROR, "fmi3" NAME ": %lu values for %lu scalar variables", (unsigned long)(GIVEN),  \
                (unsigned long)(WANTED));                                                                   \
        return fmi3Error;                                                                                   \
    }

static void log_to(const fmu_instance *f, int status, const char *category, const char *message) {
    ((fmi3LogMessageCallback)f->callback)(f->environment, (fmi3Status)status, category, message);
}

FMU_EXPORT const char *fmi3FullName(fmi3GetVersion)(void) { return "3.0"; }

static fmu_instance *instantiate(
    int kind, fmi3String name, fmi3String token, fmi3Boolean logging, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log) {
    const char *wrong = !name || !*name ? "an instance needs a name"
                        : !token || strcmp(token, FMU_TOKEN) ? "the instantiation token is not that of this model"
                        : !(FMU_KINDS & (1 << kind)) ? "this FMU does not offer that interface" : NULL;
    if (wrong) {
        if (log) log(environment, fmi3Error, "logStatusError", wrong);
        return NULL;
    }
    fmu_instance *f = fmu_new(kind, name);
    if (!f) return NULL;
    f->callback = (void *)log;
    f->environment = environment;
    f->log = log ? log_to : NULL;
    f->logging = logging;
    return f;
}

FMU_EXPORT fmi3Instance fmi3FullName(fmi3InstantiateModelExchange)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
    (void)resources, (void)visible;
    return instantiate(FMU_MODEL_EXCHANGE, name, token, logging, environment, log);
}

FMU_EXPORT fmi3Instance fmi3FullName(fmi3InstantiateCoSimulation)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean event_mode_used, fmi3Boolean early_return_allowed, const fmi3ValueReference required[], size_t n_required,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    (void)resources, (void)visible, (void)required, (void)update;
    if (n_required) {
        if (log) log(environment, fmi3Error, "logStatusError", "there are no intermediate updates in this FMU");
        return NULL;
    }
    fmu_instance *f = instantiate(FMU_CO_SIMULATION, name, token, logging, environment, log);
    if (f) f->event_mode = event_mode_used, f->early_return = early_return_allowed;
    return f;
}

FMU_EXPORT fmi3Instance fmi3FullName(fmi3InstantiateScheduledExecution)(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock) {
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)update, (void)lock, (void)unlock;
    if (log) log(environment, fmi3Error, "logStatusError", "this FMU does not offer scheduled execution");
    return NULL;
}

FMU_EXPORT void fmi3FullName(fmi3FreeInstance)(fmi3Instance c) {
    if (instance_of(c)) fmu_free(c);
}

FMI3(SetDebugLogging)(fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String categories[]) {
    NEEDS("SetDebugLogging", FMU_ANY);
    NEEDS_POINTER("SetDebugLogging", n && !categories);
    f->logging = on;
    return fmi3OK;
}

/* ---- modes --------------------------------------------------------------------------------------- */
FMI3(EnterInitializationMode)(
    fmi3Instance c, fmi3Boolean tolerance_defined, fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean stop_defined,
    fmi3Float64 stop) {
    NEEDS("EnterInitializationMode", FMU_INSTANTIATED);
    const int status = fmu_setup(f, tolerance_defined, tolerance, start, stop_defined, stop);
    if (status == FMU_OK) f->s.mode = FMU_INITIALIZATION;
    return status;
}

FMI3(ExitInitializationMode)(fmi3Instance c) {
    NEEDS("ExitInitializationMode", FMU_INITIALIZATION);
    return fmu_exit_initialization(f);
}

FMI3(Terminate)(fmi3Instance c) {
    NEEDS("Terminate", FMU_INITIALIZED | FMU_FAILED);
    return fmu_terminate(f);
}

FMI3(Reset)(fmi3Instance c) {
    NEEDS("Reset", FMU_ANY);
    fmu_defaults(f);
    return fmi3OK;
}

#define REFUSED(NAME, ARGUMENTS, WHY)                                     \
    FMI3(NAME) ARGUMENTS {                                                \
        fmu_instance *const f = instance_of(c);                           \
        if (f) fmu_say(f, FMU_ERROR, "fmi3" #NAME ": %s", WHY);           \
        return fmi3Error;                                                 \
    }
REFUSED(EnterConfigurationMode, (fmi3Instance c), "the model has no structural parameters")
REFUSED(ExitConfigurationMode, (fmi3Instance c), "the model has no structural parameters")

static int has_event_mode(fmi3Instance c) {
    const fmu_instance *f = instance_of(c);
    return f && f->kind == FMU_CO_SIMULATION && f->event_mode;
}

FMI3(EnterStepMode)(fmi3Instance c) {
    NEEDS_KIND("EnterStepMode", FMU_CO_SIMULATION, FMU_EVENT);
    f->s.mode = FMU_STEP;
    return fmi3OK;
}

/* ---- values -------------------------------------------------------------------------------------- */
FMI3(GetFloat64)(fmi3Instance c, const fmi3ValueReference references[], size_t n, fmi3Float64 values[], size_t n_values) {
    NEEDS("GetFloat64", FMU_READABLE);
    NEEDS_POINTER("GetFloat64", n && (!references || !values));
    NEEDS_COUNT("GetFloat64", n_values, n)
    return fmu_get(f, n, references, values);
}

FMI3(SetFloat64)(
    fmi3Instance c, const fmi3ValueReference references[], size_t n, const fmi3Float64 values[], size_t n_values) {
    NEEDS("SetFloat64", FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_INITIALIZED);
    NEEDS_POINTER("SetFloat64", n && (!references || !values));
    NEEDS_COUNT("SetFloat64", n_values, n)
    return fmu_set(f, n, references, values);
}

static fmi3Status none_of(const fmu_instance *f, const char *type, size_t n) {
    if (n) fmu_say(f, FMU_ERROR, "the model has no variables of type %s", type);
    return n ? fmi3Error : fmi3OK;
}

#define NO_VARIABLES(TYPE)                                                                                          \
    FMI3(Get##TYPE)(fmi3Instance c, const fmi3ValueReference references[], size_t n, fmi3##TYPE values[], size_t m) { \
        NEEDS("Get" #TYPE, FMU_ANY);                                                                                \
        (void)references, (void)values;                                                                             \
        return none_of(f, #TYPE, n + m);                                                                            \
    }                                                                                                               \
    FMI3(Set##TYPE)(                                                                                                \
        fmi3Instance c, const fmi3ValueReference references[], size_t n, const fmi3##TYPE values[], size_t m) {     \
        NEEDS("Set" #TYPE, FMU_ANY);                                                                                \
        (void)references, (void)values;                                                                             \
        return none_of(f, #TYPE, n + m);                                                                            \
    }
NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(Int32)
NO_VARIABLES(UInt32)
NO_VARIABLES(Int64)
NO_VARIABLES(UInt64)
NO_VARIABLES(Boolean)
NO_VARIABLES(String)

#define NONE_OF(NAME, TYPE, ARGUMENTS)     \
    FMI3(NAME) ARGUMENTS {                 \
        NEEDS(#NAME, FMU_ANY);             \
        return none_of(f, TYPE, n);        \
    }
#define V const fmi3ValueReference r[] AC_UNUSED
NONE_OF(GetBinary, "Binary", (fmi3Instance c, V, size_t n, size_t s[] AC_UNUSED, fmi3Binary v[] AC_UNUSED, size_t m AC_UNUSED))
NONE_OF(SetBinary, "Binary", (fmi3Instance c, V, size_t n, const size_t s[] AC_UNUSED, const fmi3Binary v[] AC_UNUSED, size_t m AC_UNUSED))
NONE_OF(GetClock, "Clock", (fmi3Instance c, V, size_t n, fmi3Clock v[] AC_UNUSED))
NONE_OF(SetClock, "Clock", (fmi3Instance c, V, size_t n, const fmi3Clock v[] AC_UNUSED))
NONE_OF(GetIntervalDecimal, "Clock", (fmi3Instance c, V, size_t n, fmi3Float64 v[] AC_UNUSED, fmi3IntervalQualifier q[] AC_UNUSED))
NONE_OF(GetIntervalFraction, "Clock", (fmi3Instance c, V, size_t n, fmi3UInt64 a[] AC_UNUSED, fmi3UInt64 b[] AC_UNUSED, fmi3IntervalQualifier q[] AC_UNUSED))
NONE_OF(GetShiftDecimal, "Clock", (fmi3Instance c, V, size_t n, fmi3Float64 v[] AC_UNUSED))
NONE_OF(GetShiftFraction, "Clock", (fmi3Instance c, V, size_t n, fmi3UInt64 a[] AC_UNUSED, fmi3UInt64 b[] AC_UNUSED))
NONE_OF(SetIntervalDecimal, "Clock", (fmi3Instance c, V, size_t n, const fmi3Float64 v[] AC_UNUSED))
NONE_OF(SetIntervalFraction, "Clock", (fmi3Instance c, V, size_t n, const fmi3UInt64 a[] AC_UNUSED, const fmi3UInt64 b[] AC_UNUSED))
NONE_OF(SetShiftDecimal, "Clock", (fmi3Instance c, V, size_t n, const fmi3Float64 v[] AC_UNUSED))
NONE_OF(SetShiftFraction, "Clock", (fmi3Instance c, V, size_t n, const fmi3UInt64 a[] AC_UNUSED, const fmi3UInt64 b[] AC_UNUSED))
REFUSED(ActivateModelPartition, (fmi3Instance c, fmi3ValueReference clock AC_UNUSED, fmi3Float64 at AC_UNUSED),
        "this FMU does not offer scheduled execution")
REFUSED(GetNumberOfVariableDependencies, (fmi3Instance c, fmi3ValueReference v AC_UNUSED, size_t *n AC_UNUSED),
        "dependencies do not change: they are in the model description")
REFUSED(GetVariableDependencies,
        (fmi3Instance c, fmi3ValueReference v AC_UNUSED, size_t e[] AC_UNUSED, fmi3ValueReference r[] AC_UNUSED,
         size_t i[] AC_UNUSED, fmi3DependencyKind k[] AC_UNUSED, size_t n AC_UNUSED),
        "dependencies do not change: they are in the model description")

#define DERIVATIVE(NAME, FUNCTION, SEEDS, RESULTS)                                                                  \
    FMI3(NAME)(                                                                                                     \
        fmi3Instance c, const fmi3ValueReference unknowns[], size_t n_unknown, const fmi3ValueReference knowns[],   \
        size_t n_known, const fmi3Float64 seed[], size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity) { \
        NEEDS(#NAME, FMU_READABLE);                                                                                 \
        NEEDS_POINTER(#NAME, (n_unknown && !unknowns) || (n_known && !knowns) || (n_seed && !seed) ||               \
                                 (n_sensitivity && !sensitivity));                                                  \
        NEEDS_COUNT(#NAME, n_seed, SEEDS)                                                                           \
        NEEDS_COUNT(#NAME, n_sensitivity, RESULTS)                                                                  \
        return FUNCTION(f, unknowns, n_unknown, knowns, n_known, seed, sensitivity);                                \
    }
DERIVATIVE(GetDirectionalDerivative, fmu_directional, n_known, n_unknown)
DERIVATIVE(GetAdjointDerivative, fmu_adjoint, n_unknown, n_known)

/* ---- saved states -------------------------------------------------------------------------------- */
FMI3(GetFMUState)(fmi3Instance c, fmi3FMUState *state) {
    NEEDS("GetFMUState", FMU_ANY);
    NEEDS_POINTER("GetFMUState", !state);
    return fmu_save(f, state);
}

FMI3(SetFMUState)(fmi3Instance c, fmi3FMUState state) {
    NEEDS("SetFMUState", FMU_ANY);
    NEEDS_POINTER("SetFMUState", !state);
    return fmu_load(f, state);
}

FMI3(FreeFMUState)(fmi3Instance c, fmi3FMUState *state) {
    NEEDS("FreeFMUState", FMU_ANY);
    return state ? (fmi3Status)fmu_drop(f, state) : fmi3OK;
}

FMI3(SerializedFMUStateSize)(fmi3Instance c, fmi3FMUState state, size_t *size) {
    NEEDS("SerializedFMUStateSize", FMU_ANY);
    NEEDS_POINTER("SerializedFMUStateSize", !state || !size);
    *size = sizeof(fmu_saved);
    return fmi3OK;
}

FMI3(SerializeFMUState)(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
    NEEDS("SerializeFMUState", FMU_ANY);
    NEEDS_POINTER("SerializeFMUState", !state || !bytes);
    return fmu_to_bytes(f, state, bytes, size);
}

FMI3(DeserializeFMUState)(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
    NEEDS("DeserializeFMUState", FMU_ANY);
    NEEDS_POINTER("DeserializeFMUState", !state || !bytes);
    return fmu_from_bytes(f, bytes, size, state);
}

/* ---- model exchange ------------------------------------------------------------------------------ */
#define NEEDS_ME(NAME, MODES) NEEDS_KIND(NAME, FMU_MODEL_EXCHANGE, MODES)

FMI3(EnterEventMode)(fmi3Instance c) {
    NEEDS("EnterEventMode", has_event_mode(c) ? FMU_STEP : FMU_CONTINUOUS);
    f->s.mode = FMU_EVENT;
    f->s.event_due = 1;
    return fmi3OK;
}

FMI3(EvaluateDiscreteStates)(fmi3Instance c) {
    NEEDS("EvaluateDiscreteStates", FMU_INITIALIZATION | FMU_EVENT);
    return fmi3OK;
}

FMI3(UpdateDiscreteStates)(
    fmi3Instance c, fmi3Boolean *again, fmi3Boolean *terminate, fmi3Boolean *nominals_changed, fmi3Boolean *values_changed,
    fmi3Boolean *next_event_defined, fmi3Float64 *next_event) {
    NEEDS("UpdateDiscreteStates", FMU_EVENT);
    NEEDS_POINTER("UpdateDiscreteStates",
                  !again || !terminate || !nominals_changed || !values_changed || !next_event_defined || !next_event);
    int changed = 0;
    double next = INFINITY;
    const int status = fmu_update(f, &changed, &next);
    *again = *nominals_changed = false;
    *terminate = f->s.ended != 0, *values_changed = changed != 0;
    *next_event_defined = next < INFINITY;
    *next_event = *next_event_defined ? next : 0.0;
    return status;
}

FMI3(EnterContinuousTimeMode)(fmi3Instance c) {
    NEEDS_ME("EnterContinuousTimeMode", FMU_EVENT);
    f->s.mode = FMU_CONTINUOUS;
    return fmi3OK;
}

FMI3(CompletedIntegratorStep)(
    fmi3Instance c, fmi3Boolean no_set_prior, fmi3Boolean *enter_event_mode, fmi3Boolean *terminate) {
    NEEDS_ME("CompletedIntegratorStep", FMU_CONTINUOUS);
    NEEDS_POINTER("CompletedIntegratorStep", !enter_event_mode || !terminate);
    (void)no_set_prior;
    *terminate = false;
    f->s.drifted = fmu_restore(f, 0);
    *enter_event_mode = f->s.drifted != 0;
    return fmu_check(f);
}

FMI3(SetTime)(fmi3Instance c, fmi3Float64 time) {
    NEEDS_ME("SetTime", FMU_EVENT | FMU_CONTINUOUS);
    return fmu_set_time(f, time);
}

FMI3(SetContinuousStates)(fmi3Instance c, const fmi3Float64 x[], size_t n) {
    NEEDS_ME("SetContinuousStates", FMU_CONTINUOUS);
    NEEDS_POINTER("SetContinuousStates", n && !x);
    return fmu_set_states(f, x, n);
}

#define READ_STATES(NAME, FUNCTION)                                \
    FMI3(NAME)(fmi3Instance c, fmi3Float64 values[], size_t n) {   \
        NEEDS_ME(#NAME, FMU_READABLE);                             \
        NEEDS_POINTER(#NAME, n && !values);                        \
        return FUNCTION(f, values, n);                             \
    }
READ_STATES(GetContinuousStateDerivatives, fmu_get_slopes)
READ_STATES(GetEventIndicators, fmu_get_indicators)
READ_STATES(GetContinuousStates, fmu_get_states)
READ_STATES(GetNominalsOfContinuousStates, fmu_get_nominals)

#define COUNT(NAME, VALUE)                              \
    FMI3(NAME)(fmi3Instance c, size_t *n) {             \
        NEEDS_ME(#NAME, FMU_ANY);                       \
        NEEDS_POINTER(#NAME, !n);                       \
        *n = VALUE;                                     \
        return fmi3OK;                                  \
    }
COUNT(GetNumberOfEventIndicators, AC_NR)
COUNT(GetNumberOfContinuousStates, AC_NX)

/* ---- co-simulation ------------------------------------------------------------------------------- */
FMI3(DoStep)(
    fmi3Instance c, fmi3Float64 t, fmi3Float64 h, fmi3Boolean no_set_prior, fmi3Boolean *event, fmi3Boolean *terminate,
    fmi3Boolean *early_return, fmi3Float64 *last_time) {
    NEEDS_KIND("DoStep", FMU_CO_SIMULATION, FMU_STEP);
    NEEDS_POINTER("DoStep", !event || !terminate || !early_return || !last_time);
    (void)no_set_prior;
    *event = *terminate = *early_return = false;
    *last_time = f->s.t;
    if (!(h > 0.0)) {
        fmu_say(f, FMU_ERROR, "fmi3DoStep: the step size %.9g s is not positive", h);
        return fmi3Error;
    }
    int early, due;
    const int status = fmu_do_step(f, t, h, &early, &due);
    *last_time = f->s.t;
    *event = due != 0, *terminate = f->s.ended != 0;
    *early_return = early || status == FMU_DISCARD || (f->s.ended && f->s.t < t + h);
    return status;
}

FMI3(GetOutputDerivatives)(
    fmi3Instance c, const fmi3ValueReference references[], size_t n, const fmi3Int32 orders[], fmi3Float64 values[],
    size_t n_values) {
    NEEDS_KIND("GetOutputDerivatives", FMU_CO_SIMULATION, FMU_STEP | FMU_FAILED | FMU_TERMINATED);
    NEEDS_POINTER("GetOutputDerivatives", n && (!references || !orders || !values));
    NEEDS_COUNT("GetOutputDerivatives", n_values, n)
    for (size_t k = 0; k < n; k++)
        if (orders[k] != 1) {
            fmu_say(f, FMU_ERROR, "fmi3GetOutputDerivatives knows order 1, not %d", (int)orders[k]);
            return fmi3Error;
        }
    return fmu_rates(f, n, references, values);
}
