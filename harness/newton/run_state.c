#include "harness/newton/run_state.h"

#include <string.h>

run_state run_state_of(model *m)
{
    run_state run;
    memset(&run, 0, sizeof run);
    run.m = m;
    return run;
}
