/* Its linear stiffness is that of the BEAMW forms for a doubly symmetric section: the data begin with theirs, so that stress
 * function and lumped inertia are shared. */
#include "elements/sheet/second.h"

#include <string.h>

#include "elements/beamw/inertia.h"

typedef struct second_data {
    element_data linear; /* S; no modified modes */
    relations relations;
} second_data;

static const second_data *data_of(const element_data *d)
{
    return (const second_data *)(const void *)d;
}

size_t second_data_size(const element_request *request)
{
    (void)request;
    return sizeof(second_data);
}

status second_prepare(const element_request *request, int consistent, element_data *d, fault *f)
{
    second_data *out = (second_data *)(void *)d;
    double Phi_y, Phi_z;
    stiffness_fields fields;
    memset(out, 0, sizeof *out);
    out->linear.l0 = request->length;
    relations_shear(request, &Phi_y, &Phi_z);
    stiffness_of(request->section, request->length, request->features & FEATURE_SHEAR ? STIFFNESS_DIAGONAL : STIFFNESS_RIGID,
                 &fields, out->linear.S);
    if (request->features & FEATURE_MASS)
        inertia_prepare(request->section, request->features, INERTIA_LUMPED, &fields, &out->linear);
    if (!(request->features & FEATURE_WARPING))
        forms_drop_warping(&out->linear);
    return relations_prepare(request, consistent ? Phi_y : 0, consistent ? Phi_z : 0, &out->relations, f);
}

void second_strain(const element_data *d, const node_state x[], strain_output *out)
{
    relations_strain(&data_of(d)->relations, x, out);
}

status second_stress(const element_data *d, const double e[], const double inner[], stress_output *out)
{
    return forms_stress(&data_of(d)->linear, e, inner, out);
}

void second_geometric(const element_data *d, const double sigma[], double G[])
{
    (void)d;
    (void)sigma;
    memset(G, 0, RELATIONS_STRAINS * RELATIONS_STRAINS * sizeof *G); /* the second order is in the deformation function */
}

status second_inertia(const element_data *d, const node_state x[], const node_rate v[], const node_rate a[], inertia_output *out)
{
    return inertia_of(&data_of(d)->linear, x, v, a, out);
}
