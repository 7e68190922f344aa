#include "harness/experiments/checks.h"

const checks_family checks_families[CHECKS_FAMILIES] = {
    {"declared", "its declarations are consistent", checks_declared},
    {"features", "what it offers it can do: alone, in subsets, as the cases ask for it",
     checks_features},
    {"derivatives", "J and H are the derivatives of the strains", checks_derivatives},
    {"energy", "stress, C and G derive from the energy, C and G are symmetric", checks_energy},
    {"force", "force and stiffness derive from the energy", checks_force},
    {"motion", "rigid motion, order of the nodes and units change nothing", checks_motion},
    {"stateless", "the same call gives the same bits, whatever went before", checks_stateless},
    {"many", "many elements at once give what each gives alone", checks_many},
    {"bounds", "outputs are filled whole, and nothing beside them is touched", checks_bounds},
    {"unsound", "NaN and Inf are reported, not swallowed", checks_unsound},
    {"mass", "mass matrix: symmetric, positive, mass and moments of the beam", checks_mass},
    {"along", "loads along one element are as exact as forces at its nodes", checks_along},
    {"rotating", "centrifugal and gyroscopic terms derive from the kinetic energy",
     checks_rotating},
    {"in_time", "forces of inertia in time derive from the kinetic energy", checks_in_time},
};
