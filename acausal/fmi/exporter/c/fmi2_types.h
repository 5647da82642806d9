/* Types of the C interface of FMI 2.0.4 (Functional Mock-up Interface for Model Exchange and Co-Simulation, chapter 2). */
#ifndef FMI2_TYPES_H
#define FMI2_TYPES_H
#include <stddef.h>

typedef void *fmi2Component, *fmi2ComponentEnvironment, *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer, fmi2Boolean;
typedef char fmi2Char, fmi2Byte;
typedef const fmi2Char *fmi2String;

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef struct {
    void (*logger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category, fmi2String message, ...);
    void *(*allocateMemory)(size_t, size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded, terminateSimulation;
    fmi2Boolean nominalsOfContinuousStatesChanged, valuesOfContinuousStatesChanged;
    fmi2Boolean nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

/* Names of the functions, as the headers of the standard form them: with FMI2_FUNCTION_PREFIX before them, for units in
   static libraries (-DFMI2_FUNCTION_PREFIX=Crane_); FMI2_OVERRIDE_FUNCTION_PREFIX takes FMI2_ACTUAL_FUNCTION_PREFIX
   instead, or none. */
#if !defined(FMI2_OVERRIDE_FUNCTION_PREFIX) && defined(FMI2_FUNCTION_PREFIX)
#define FMI2_ACTUAL_FUNCTION_PREFIX FMI2_FUNCTION_PREFIX
#endif
#if defined(FMI2_ACTUAL_FUNCTION_PREFIX)
#define fmi2Paste(A, B) A##B
#define fmi2PasteB(A, B) fmi2Paste(A, B)
#define fmi2FullName(NAME) fmi2PasteB(FMI2_ACTUAL_FUNCTION_PREFIX, NAME)
#else
#define fmi2FullName(NAME) NAME
#endif
#endif
