/* The functions of FMI 2.0, for model exchange and co-simulation. Every call is checked against the state machine of the
   standard (sections 3.2.3 and 4.2.4); one that is refused leaves the instance as it is. */
#include "fmi2_types.h"
#include "instance.h"
#include "hybrid.h"
#include "values.h"
#include "advance.h"
#include "directional.h"

#define FMI2(NAME) FMU_EXPORT fmi2Status fmi2FullName(fmi2##NAME)

static fmu_instance *instance_of(fmi2Component c) {
    fmu_instance *f = c;
    return f && f->magic == FMU_MAGIC ? f : NULL;
}

/* An instance in one of these modes, or the function returns an error. */
#define NEEDS(NAME, MODES)                   \
    fmu_instance *const f = instance_of(c);  \
    if (!f || fmu_refuse(f, "fmi2" NAME, MODES)) return fmi2Error
#define NEEDS_KIND(NAME, KIND, MODES)                                        \
    fmu_instance *const f = instance_of(c);                                  \
    if (!f || fmu_refuse_kind(f, "fmi2" NAME, KIND) || fmu_refuse(f, "fmi2" NAME, MODES)) return fmi2Error
#define NEEDS_POINTER(NAME, MISSING) \
    if (fmu_refuse_pointer(f, "fmi2" NAME, MISSING)) return fmi2Error

/* The message is the format: it has no percent signs, and some importers do not read further arguments. */
static void log_to(const fmu_instance *f, int status, const char *category, const char *message) {
    const fmi2CallbackFunctions *callbacks = f->callback;
    callbacks->logger(f->environment, f->name, (fmi2Status)status, category, message);
}

FMU_EXPORT const char *fmi2FullName(fmi2GetTypesPlatform)(void) { return "default"; }
FMU_EXPORT const char *fmi2FullName(fmi2GetVersion)(void) { return "2.0"; }

FMU_EXPORT fmi2Component fmi2FullName(fmi2Instantiate)(
    fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions *callbacks,
    fmi2Boolean visible, fmi2Boolean logging) {
    (void)resources, (void)visible;
    const char *wrong = !name || !*name ? "an instance needs a name"
                        : !guid || strcmp(guid, FMU_TOKEN) ? "the GUID is not that of this model"
                        : type != fmi2ModelExchange && type != fmi2CoSimulation ? "the type of the instance is not known"
                        : !(FMU_KINDS & (1 << type)) ? "this FMU does not offer that interface" : NULL;
    if (wrong || !callbacks) {
        if (callbacks && callbacks->logger)
            callbacks->logger(callbacks->componentEnvironment, name ? name : "", fmi2Error, "logStatusError", wrong);
        return NULL;
    }
    fmu_instance *f = fmu_new(type == fmi2CoSimulation ? FMU_CO_SIMULATION : FMU_MODEL_EXCHANGE, name);
    if (!f) return NULL;
    f->callback = (void *)callbacks;
    f->environment = callbacks->componentEnvironment;
    f->log = callbacks->logger ? log_to : NULL;
    f->logging = logging;
    return f;
}

FMU_EXPORT void fmi2FullName(fmi2FreeInstance)(fmi2Component c) {
    if (instance_of(c)) fmu_free(c);
}

FMI2(SetDebugLogging)(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
    NEEDS("SetDebugLogging", FMU_ANY);
    NEEDS_POINTER("SetDebugLogging", n && !categories);
    f->logging = on;
    return fmi2OK;
}

/* ---- modes --------------------------------------------------------------------------------------- */
FMI2(SetupExperiment)(
    fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start, fmi2Boolean stop_defined,
    fmi2Real stop) {
    NEEDS("SetupExperiment", FMU_INSTANTIATED);
    return fmu_setup(f, tolerance_defined, tolerance, start, stop_defined, stop);
}

FMI2(EnterInitializationMode)(fmi2Component c) {
    NEEDS("EnterInitializationMode", FMU_INSTANTIATED);
    f->s.mode = FMU_INITIALIZATION;
    return fmi2OK;
}

FMI2(ExitInitializationMode)(fmi2Component c) {
    NEEDS("ExitInitializationMode", FMU_INITIALIZATION);
    return fmu_exit_initialization(f);
}

FMI2(Terminate)(fmi2Component c) {
    NEEDS("Terminate", FMU_INITIALIZED | FMU_FAILED);
    return fmu_terminate(f);
}

FMI2(Reset)(fmi2Component c) {
    NEEDS("Reset", FMU_ANY);
    fmu_defaults(f);
    return fmi2OK;
}

/* ---- values -------------------------------------------------------------------------------------- */
FMI2(GetReal)(fmi2Component c, const fmi2ValueReference references[], size_t n, fmi2Real values[]) {
    NEEDS("GetReal", FMU_READABLE);
    NEEDS_POINTER("GetReal", n && (!references || !values));
    return fmu_get(f, n, references, values);
}

FMI2(SetReal)(fmi2Component c, const fmi2ValueReference references[], size_t n, const fmi2Real values[]) {
    NEEDS("SetReal", FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_INITIALIZED);
    NEEDS_POINTER("SetReal", n && (!references || !values));
    return fmu_set(f, n, references, values);
}

#define NO_VARIABLES(NAME, WHAT, CONST, TYPE)                                                                     \
    FMI2(NAME)(fmi2Component c, const fmi2ValueReference references[], size_t n, CONST TYPE values[]) {           \
        NEEDS(#NAME, FMU_ANY);                                                                                    \
        (void)references, (void)values;                                                                           \
        if (n) fmu_say(f, FMU_ERROR, "fmi2" #NAME ": the model has no " WHAT " variables");                       \
        return n ? fmi2Error : fmi2OK;                                                                            \
    }
NO_VARIABLES(GetInteger, "integer", , fmi2Integer)
NO_VARIABLES(GetBoolean, "Boolean", , fmi2Boolean)
NO_VARIABLES(GetString, "string", , fmi2String)
NO_VARIABLES(SetInteger, "integer", const, fmi2Integer)
NO_VARIABLES(SetBoolean, "Boolean", const, fmi2Boolean)
NO_VARIABLES(SetString, "string", const, fmi2String)

FMI2(GetDirectionalDerivative)(
    fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknown, const fmi2ValueReference knowns[],
    size_t n_known, const fmi2Real seed[], fmi2Real sensitivity[]) {
    NEEDS("GetDirectionalDerivative", FMU_READABLE);
    NEEDS_POINTER("GetDirectionalDerivative", (n_unknown && (!unknowns || !sensitivity)) || (n_known && (!knowns || !seed)));
    return fmu_directional(f, unknowns, n_unknown, knowns, n_known, seed, sensitivity);
}

/* ---- saved states -------------------------------------------------------------------------------- */
FMI2(GetFMUstate)(fmi2Component c, fmi2FMUstate *state) {
    NEEDS("GetFMUstate", FMU_ANY);
    NEEDS_POINTER("GetFMUstate", !state);
    return fmu_save(f, state);
}

FMI2(SetFMUstate)(fmi2Component c, fmi2FMUstate state) {
    NEEDS("SetFMUstate", FMU_ANY);
    NEEDS_POINTER("SetFMUstate", !state);
    return fmu_load(f, state);
}

FMI2(FreeFMUstate)(fmi2Component c, fmi2FMUstate *state) {
    NEEDS("FreeFMUstate", FMU_ANY);
    return state ? (fmi2Status)fmu_drop(f, state) : fmi2OK;
}

FMI2(SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size) {
    NEEDS("SerializedFMUstateSize", FMU_ANY);
    NEEDS_POINTER("SerializedFMUstateSize", !state || !size);
    *size = sizeof(fmu_saved);
    return fmi2OK;
}

FMI2(SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    NEEDS("SerializeFMUstate", FMU_ANY);
    NEEDS_POINTER("SerializeFMUstate", !state || !bytes);
    return fmu_to_bytes(f, state, bytes, size);
}

FMI2(DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
    NEEDS("DeSerializeFMUstate", FMU_ANY);
    NEEDS_POINTER("DeSerializeFMUstate", !state || !bytes);
    return fmu_from_bytes(f, bytes, size, state);
}

/* ---- model exchange ------------------------------------------------------------------------------ */
#define NEEDS_ME(NAME, MODES) NEEDS_KIND(NAME, FMU_MODEL_EXCHANGE, MODES)

FMI2(EnterEventMode)(fmi2Component c) {
    NEEDS_ME("EnterEventMode", FMU_CONTINUOUS);
    f->s.mode = FMU_EVENT;
    f->s.event_due = 1;
    return fmi2OK;
}

FMI2(NewDiscreteStates)(fmi2Component c, fmi2EventInfo *info) {
    NEEDS_ME("NewDiscreteStates", FMU_EVENT);
    NEEDS_POINTER("NewDiscreteStates", !info);
    memset(info, 0, sizeof *info);
    int changed = 0;
    double next = INFINITY;
    const int status = fmu_update(f, &changed, &next);
    info->valuesOfContinuousStatesChanged = changed;
    info->terminateSimulation = f->s.ended;
    info->nextEventTimeDefined = next < INFINITY;
    if (info->nextEventTimeDefined) info->nextEventTime = next;
    return status;
}

FMI2(EnterContinuousTimeMode)(fmi2Component c) {
    NEEDS_ME("EnterContinuousTimeMode", FMU_EVENT);
    f->s.mode = FMU_CONTINUOUS;
    return fmi2OK;
}

FMI2(CompletedIntegratorStep)(
    fmi2Component c, fmi2Boolean no_set_prior, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate) {
    NEEDS_ME("CompletedIntegratorStep", FMU_CONTINUOUS);
    NEEDS_POINTER("CompletedIntegratorStep", !enter_event_mode || !terminate);
    (void)no_set_prior;
    *terminate = 0;
    *enter_event_mode = f->s.drifted = fmu_restore(f, 0);
    return fmu_check(f);
}

FMI2(SetTime)(fmi2Component c, fmi2Real time) {
    NEEDS_ME("SetTime", FMU_EVENT | FMU_CONTINUOUS);
    return fmu_set_time(f, time);
}

FMI2(SetContinuousStates)(fmi2Component c, const fmi2Real x[], size_t n) {
    NEEDS_ME("SetContinuousStates", FMU_CONTINUOUS);
    NEEDS_POINTER("SetContinuousStates", n && !x);
    return fmu_set_states(f, x, n);
}

FMI2(GetDerivatives)(fmi2Component c, fmi2Real derivatives[], size_t n) {
    NEEDS_ME("GetDerivatives", FMU_READABLE);
    NEEDS_POINTER("GetDerivatives", n && !derivatives);
    return fmu_get_slopes(f, derivatives, n);
}

FMI2(GetEventIndicators)(fmi2Component c, fmi2Real indicators[], size_t n) {
    NEEDS_ME("GetEventIndicators", FMU_READABLE);
    NEEDS_POINTER("GetEventIndicators", n && !indicators);
    return fmu_get_indicators(f, indicators, n);
}

FMI2(GetContinuousStates)(fmi2Component c, fmi2Real x[], size_t n) {
    NEEDS_ME("GetContinuousStates", FMU_READABLE);
    NEEDS_POINTER("GetContinuousStates", n && !x);
    return fmu_get_states(f, x, n);
}

FMI2(GetNominalsOfContinuousStates)(fmi2Component c, fmi2Real nominals[], size_t n) {
    NEEDS_ME("GetNominalsOfContinuousStates", FMU_READABLE);
    NEEDS_POINTER("GetNominalsOfContinuousStates", n && !nominals);
    return fmu_get_nominals(f, nominals, n);
}

/* ---- co-simulation ------------------------------------------------------------------------------- */
#define NEEDS_CS(NAME, MODES) NEEDS_KIND(NAME, FMU_CO_SIMULATION, MODES)

FMI2(DoStep)(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean no_set_prior) {
    NEEDS_CS("DoStep", FMU_STEP);
    (void)no_set_prior;
    int early, due;
    const int status = fmu_do_step(f, t, h, &early, &due);
    return status == FMU_OK && f->s.ended ? fmi2Discard : (fmi2Status)status;
}

FMI2(CancelStep)(fmi2Component c) {
    NEEDS_CS("CancelStep", FMU_STEP | FMU_FAILED);
    fmu_say(f, FMU_ERROR, "fmi2CancelStep: no step is under way, all steps are synchronous");
    return fmi2Error;
}

FMI2(SetRealInputDerivatives)(
    fmi2Component c, const fmi2ValueReference references[], size_t n, const fmi2Integer orders[], const fmi2Real values[]) {
    NEEDS_CS("SetRealInputDerivatives", FMU_INSTANTIATED | FMU_INITIALIZATION | FMU_STEP);
    NEEDS_POINTER("SetRealInputDerivatives", n && (!references || !orders || !values));
    for (size_t k = 0; k < n; k++) {
        if (fmu_unknown(f, references[k])) return fmi2Error;
        if (fmu_kind[references[k]] != FMU_INPUT || orders[k] != 1 || !(values[k] - values[k] == 0.0)) {
            fmu_say(f, FMU_ERROR, "fmi2SetRealInputDerivatives takes inputs, order 1 and finite values");
            return fmi2Error;
        }
        fmu_rebase(f);
        f->s.du[fmu_index[references[k]] - AC_NPAR] = values[k];
        fmu_forget(f);
    }
    return fmi2OK;
}

FMI2(GetRealOutputDerivatives)(
    fmi2Component c, const fmi2ValueReference references[], size_t n, const fmi2Integer orders[], fmi2Real values[]) {
    NEEDS_CS("GetRealOutputDerivatives", FMU_STEP | FMU_FAILED | FMU_TERMINATED);
    NEEDS_POINTER("GetRealOutputDerivatives", n && (!references || !orders || !values));
    for (size_t k = 0; k < n; k++)
        if (orders[k] != 1) {
            fmu_say(f, FMU_ERROR, "fmi2GetRealOutputDerivatives knows order 1, not %d", orders[k]);
            return fmi2Error;
        }
    return fmu_rates(f, n, references, values);
}

static fmi2Status no_status(const fmu_instance *f, const char *function) {
    fmu_say(f, FMU_DISCARD, "%s: there is no such status, all steps are synchronous", function);
    return fmi2Discard;
}

FMI2(GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    NEEDS_CS("GetStatus", FMU_STEP | FMU_FAILED | FMU_TERMINATED);
    (void)kind, (void)value;
    return no_status(f, "fmi2GetStatus");
}

FMI2(GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    NEEDS_CS("GetRealStatus", FMU_STEP | FMU_FAILED | FMU_TERMINATED);
    NEEDS_POINTER("GetRealStatus", !value);
    if (kind != fmi2LastSuccessfulTime) return no_status(f, "fmi2GetRealStatus");
    *value = f->s.t;
    return fmi2OK;
}

FMI2(GetIntegerStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    NEEDS_CS("GetIntegerStatus", FMU_STEP | FMU_FAILED | FMU_TERMINATED);
    (void)kind, (void)value;
    return no_status(f, "fmi2GetIntegerStatus");
}

FMI2(GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    NEEDS_CS("GetBooleanStatus", FMU_STEP | FMU_FAILED | FMU_TERMINATED);
    NEEDS_POINTER("GetBooleanStatus", !value);
    if (kind != fmi2Terminated) return no_status(f, "fmi2GetBooleanStatus");
    *value = f->s.ended;
    return fmi2OK;
}

FMI2(GetStringStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    NEEDS_CS("GetStringStatus", FMU_STEP | FMU_FAILED | FMU_TERMINATED);
    (void)kind, (void)value;
    return no_status(f, "fmi2GetStringStatus");
}
