#include "elements/sheet/second.h"

#include <string.h>

#include "elements/math/dense.h"

size_t second_data_size(const element_request *request)
{
    (void)request;
    return sizeof(base_data);
}

status second_prepare(const element_request *request, base_shear shear, element_data *out, fault *f)
{
    return base_prepare(request, shear, (base_data *)(void *)out, f);
}

status second_stress(const element_data *data, const double e[], const double inner[],
                     stress_output *out)
{
    enum { N = SHEET_STRAINS };
    const base_data *d = (const base_data *)(const void *)data;
    double sigma[N];
    (void)inner;
    dense_mul_vec(N, N, d->S, e, sigma);
    if (out->energy != NULL) {
        *out->energy = 0;
        for (int i = 0; i < N; i++)
            *out->energy += sigma[i] * e[i] / 2;
    }
    if (out->sigma != NULL)
        memcpy(out->sigma, sigma, sizeof sigma);
    if (out->C != NULL)
        memcpy(out->C, d->S, sizeof d->S);
    if (out->residual != NULL)
        *out->residual = 0;
    wagner_add(&d->wagner, e, out->energy, out->sigma, out->C);
    return STATUS_OK;
}
