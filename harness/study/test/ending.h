/* A formulation whose cells end in a given way, for example with a crash. */
#ifndef BEAMWORK_TEST_ENDING_H
#define BEAMWORK_TEST_ENDING_H

#include <signal.h>
#include <unistd.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

enum { KILLED, ENDED, HANGING, STOPPED };

static inline void never_end(int output)
{
    const pid_t self = getpid();
    if (output > 0 && write(output, &self, sizeof self) != (ssize_t)sizeof self)
        _exit(4);
    for (;;)
        pause();
}

static inline formulation ending_good(void)
{
    formulation chosen;
    double value[CASE_MAX_PARAMETERS] = {0};
    scene s;
    char words[200];
    scene_init(&s, "test");
    parameters_default(registry_cases[0], value);
    case_build(registry_cases[0], value, &s, NULL);
    int i = 0;
    while (registry_formulations[i + 1] != NULL &&
           missing_words(&s, registry_formulations[i], words, sizeof words))
        i++;
    scene_free(&s);
    formulation_default(registry_formulations[i], &chosen);
    return chosen;
}

static struct {
    element_type type;
    status (*prepare)(const element_request *, element_data *, fault *);
    int end, output; /* end: how the process ends; output: descriptor to which an endless cell
                        writes its process number */
} ending;

static inline status prepare_end(const element_request *request, element_data *data, fault *f)
{
    if (ending.end == KILLED)
        raise(SIGKILL);
    if (ending.end == ENDED)
        _exit(3);
    if (ending.end == HANGING)
        never_end(ending.output);
    if (ending.end == STOPPED)
        raise(SIGSTOP);
    return ending.prepare(request, data, f);
}

static inline formulation ending_bad(int end, int output)
{
    formulation out = ending_good();
    ending.type = *out.type;
    ending.prepare = out.type->prepare;
    ending.end = end;
    ending.output = output;
    ending.type.prepare = prepare_end;
    out.type = &ending.type;
    return out;
}

#endif
