#ifndef BEAMWORK_TEST_KIT_H
#define BEAMWORK_TEST_KIT_H

#include <math.h>
#include <stdint.h>

#include "elements/element.h"
#include "elements/section/section.h"

/* Returns 64 bits of splitmix64 (Steele, Lea, Flood, OOPSLA 2014), the same sequence on every
 * machine. */
uint64_t random_bits(uint64_t *seed);
/* Returns a random multiple of 2^-52, uniformly distributed in [-1, 1). */
double random_number(uint64_t *seed);
/* Returns an integer from 0 to count - 1. */
int random_below(uint64_t *seed, int count);

/* Returns the larger of two errors, or NaN if either error is NaN, which fmax would ignore. */
static inline double worst_of(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

/* Returns the computed constants of a section. If the section is invalid, the test fails and all
 * constants are zero. */
section sections_computed(const section_spec *);
/* Returns a section of this kind with the moduli of steel, E = 200 GPa and G = 80 GPa. */
section_spec sections_steel(section_kind);
/* Returns a section without warping and with the given constants [m^2, m^4], E = G = 1 Pa and Ip =
 * Iy + Iz. */
section_spec sections_of(double A, double Iy, double Iz, double It);

/* The next functions place the nodes of one element and compare derivatives of its strains with
 * finite differences. Increments d [7 nodes] contain the displacement [m], the spatial rotation
 * vector and the warping amplitude [rad/m]. */

void nodes_straight(int nodes, double length, node_state x[]);
void nodes_turn(double R[9], const double turn[3]);
void nodes_move(int nodes, double times, const double d[], node_state x[]);
void nodes_place(int nodes, double length, const double d[], node_state x[]);
/* Sets random increments that are uniform in (-size/2, size/2), for displacements relative to the
 * length, in radians for rotations, and times 1/length for warping. */
void nodes_increments(int nodes, double length, double size, unsigned seed, double d[]);

/* Compares J and H at x with fourth-order central differences of e and of J^T s along the path that
 * moves the nodes by d. s contains any stresses [strains]. */
typedef struct nodes_departure {
    double first;  /* error of J d, relative to its largest entry */
    double second; /* error of H d relative to the largest entry, for H in the exponential chart of
                      x */
    double asymmetry; /* asymmetry of H */
} nodes_departure;
nodes_departure nodes_differences(const element_type *, const element_data *, int nodes,
                                  int strains, const node_state x[], const double d[],
                                  const double s[]);

/* Returns the largest |A[i][j] - A[j][i]| of A [n x n], relative to the largest entry. */
double nodes_asymmetry(int n, const double A[]);

#endif
