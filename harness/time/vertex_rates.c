#include "harness/time/vertex_rates.h"

#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/released.h"

void inertia_rates(const model *m, const model_state *s, int vertex, const double v[],
                   const double a[], frame_rates *out)
{
    if (model_is_released(m, vertex))
        released_rates(m, s, vertex, v, a, out);
    else
        forms_rates(m, s, vertex, v, a, out);
}

void vertex_rates(const model *m, const model_state *s, int vertex, const double v[],
                  const double a[], frame_rates *out)
{
    const int body = model_body(m, vertex),
              by_itself = vertex == body || model_is_released(m, vertex);
    double rho[3], moved[3], twice[3];
    inertia_rates(m, s, by_itself ? vertex : body, v, a, out);
    if (by_itself)
        return;
    kinematics_offset(m, s, vertex, rho);
    vec3_cross(out->w, rho, moved);
    vec3_cross(out->w, moved, twice);
    for (int i = 0; i < 3; i++) {
        out->v[i] += moved[i];
        out->a[i] += twice[i];
    }
    vec3_cross(out->wd, rho, moved);
    for (int i = 0; i < 3; i++)
        out->a[i] += moved[i];
}
