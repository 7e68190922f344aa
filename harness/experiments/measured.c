#include "harness/experiments/measured.h"

const measured_group measured_groups[MEASURED_GROUPS] = {
    {"states", "uniform and linear states of a cantilever: error with 1 element, 4 unequal ones",
     measured_states},
    {"locking", "8 elements, thickness by length from 1 to 1e-6", measured_locking},
    {"orders", "orders of convergence, and errors with 1 to 32 elements", measured_orders},
};
