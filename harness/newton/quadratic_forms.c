#include "harness/newton/quadratic_forms.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/linear.h"
#include "harness/newton/rotating_frame.h"

status quadratic_forms_alloc(const equations *eq, const sparse *pattern, quadratic_forms *p,
                             fault *f)
{
    const model *m = eq->m;
    const model_size size = model_sizes(m);
    const size_t all = (size_t)(size.free + size.driven) + 1,
                 stresses = (size_t)model_stresses(m) + 1;
    double **const of_coordinates[] = {&p->load_x, &p->x, &p->force, &p->product},
                   **const of_stresses[] = {&p->sigma, &p->stress};
    int good = 1;
    memset(p, 0, sizeof *p);
    p->eq = eq;
    p->free = size.free;
    for (int i = 0; i < 4; i++)
        good &= (*of_coordinates[i] = calloc(all, sizeof(double))) != NULL;
    for (int i = 0; i < 2; i++)
        good &= (*of_stresses[i] = calloc(stresses, sizeof(double))) != NULL;
    return good ? sparse_alloc_like(pattern, &p->loads, f)
                : fault_set(f, STATUS_FAULT, "out of memory for prestress and modes");
}

void quadratic_forms_free(quadratic_forms *p)
{
    double *const all[] = {p->load_x, p->x, p->force, p->product, p->sigma, p->stress};
    for (int i = 0; i < 6; i++)
        free(all[i]);
    sparse_free_values(&p->loads);
    memset(p, 0, sizeof *p);
}

status quadratic_forms_load(const equations *eq, quadratic_forms *p, double path, int whole,
                            fault *f)
{
    rotating_frame_load_stiffness(eq, kinematics_rest(eq->m), path, &p->loads);
    return whole ? linear_whole_stresses(eq, p->load_x, p->sigma, f)
                 : linear_stresses(eq, p->load_x, p->sigma, f);
}

/* With the driven coordinates. */
static const double *all_of(quadratic_forms *p, const double x[])
{
    memcpy(p->x, x, (size_t)p->free * sizeof *x);
    return p->x;
}

double quadratic_forms_stiffness(quadratic_forms *p, const double x[])
{
    return linear_strain_energy2(p->eq, all_of(p, x));
}

double quadratic_forms_stiffness_rounding(quadratic_forms *p, const double x[])
{
    return linear_strain_rounding(p->eq, all_of(p, x));
}

double quadratic_forms_geometric(quadratic_forms *p, const double x[])
{
    sparse_mul(&p->loads, x, p->product);
    return linear_geometric_energy2(p->eq, p->sigma, all_of(p, x)) +
           dense_dot(p->free, x, p->product);
}

double quadratic_forms_geometric_rounding(quadratic_forms *p, const double x[])
{
    return linear_geometric_rounding(p->eq, p->load_x, p->sigma, all_of(p, x));
}

/* The undeformed elements have been evaluated when K was assembled: they do not fail here. */
void quadratic_forms_product(quadratic_forms *p, const double x[], double y[])
{
    linear_stresses(p->eq, all_of(p, x), p->stress, NULL);
    linear_forces(p->eq, p->stress, p->force);
    memcpy(y, p->force, (size_t)p->free * sizeof *y);
}
